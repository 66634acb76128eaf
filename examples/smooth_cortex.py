#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Smooths a map on a cortical surface, as GIFTI files hold them. Nothing is smoothed across a sulcus, and vertices
without a value (NaN) have no influence.

    smooth_cortex.py SURFACE MAP FWHM OUTPUT

SURFACE  lh.midthickness.surf.gii, in mm
MAP      values by vertex (.func.gii or .shape.gii), one or several; a "-" makes noise, to try it
FWHM     full width at half maximum in mm, a straight-line distance
OUTPUT   the smoothed map, a GIFTI file

Needs nibabel. SURFACE may also be a PLY, OBJ, OFF or STL file.
"""

import sys

import meshhood
import nibabel
import numpy as np


def surface_of(name):
    if not name.endswith(".gii"):
        return meshhood.read_mesh(name)
    return nibabel.load(name).agg_data(("pointset", "triangle"))


def map_of(name, vertex_count):
    """(#V,) or (#V, maps)."""
    if name == "-":
        return np.random.default_rng(1).normal(size=vertex_count)
    maps = nibabel.load(name).agg_data()
    return np.stack(maps, axis=1) if isinstance(maps, tuple) else maps


def save_map(values, name):
    image = nibabel.gifti.GiftiImage()
    for values_of_map in np.atleast_2d(values.T).astype(np.float32):
        image.add_gifti_data_array(nibabel.gifti.GiftiDataArray(values_of_map, intent="NIFTI_INTENT_SHAPE"))
    nibabel.save(image, name)


def main():
    if len(sys.argv) != 5:
        sys.exit(__doc__)
    surface, values_name, fwhm, output = sys.argv[1:]
    V, F = surface_of(surface)
    values = map_of(values_name, len(V))
    smooth = meshhood.MeshIndex(V, F).smooth(values, float(fwhm), weights="area", nan="omit")
    save_map(smooth, output)
    print(f"{len(V)} vertices, standard deviation before {np.nanstd(values):.3f}, after {np.nanstd(smooth):.3f}")


if __name__ == "__main__":
    main()
