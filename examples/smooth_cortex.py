#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Smooths a map on a cortical surface, as GIFTI files hold them, by distances along the surface. Nothing is smoothed
across a sulcus, and vertices without a value (NaN) have no influence.

    smooth_cortex.py SURFACE MAP FWHM OUTPUT [WALL]

SURFACE  lh.midthickness.surf.gii, in mm, or another file that meshhood.read_mesh reads
MAP      values by vertex (.func.gii or .shape.gii), one or several; a "-" makes noise, to try it
FWHM     full width at half maximum in mm
OUTPUT   the smoothed map (.func.gii or .shape.gii)
WALL     a map (.func.gii, .shape.gii or .label.gii) that is 0 on the cortex and not on the medial wall, from which
         nothing comes; the result is NaN there

Needs nibabel.
"""

import sys

import meshhood
import nibabel
import numpy as np


def map_of(name, vertex_count):
    """(#V,) or (#V, maps)."""
    if name == "-":
        return np.random.default_rng(1).normal(size=vertex_count)
    maps = nibabel.load(name).agg_data()
    return np.stack(maps, axis=1) if isinstance(maps, tuple) else maps


def main():
    if len(sys.argv) not in (5, 6):
        sys.exit(__doc__)
    surface, name, fwhm, output, *wall = sys.argv[1:]
    V, F = meshhood.read_mesh(surface)
    values = map_of(name, len(V))
    walls = map_of(wall[0], len(V)) != 0 if wall else None
    index = meshhood.MeshIndex(V, F)
    smooth = index.smooth(values, float(fwhm), metric="surface", walls=walls, weights="area", nan="omit")
    maps = {f"map{i}": values_of_map for i, values_of_map in enumerate(np.atleast_2d(smooth.T))}
    meshhood.write_mesh(output, V, F, values=maps)
    print(f"{len(V)} vertices, standard deviation before {np.nanstd(values):.3f}, after {np.nanstd(smooth):.3f}")


if __name__ == "__main__":
    main()
