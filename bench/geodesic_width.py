#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The width of `smooth` along a surface: the full width at half maximum of the Gaussian whose second moment, over exact
geodesic distances, is that of the weights of a vertex; the mean of some vertices. Weights are by area.

    PYTHONPATH=PACKAGE bench/geodesic_width.py SURFACE [VERTICES]

Needs libigl, whose exact geodesics they are, and a mesh of triangles.
"""

import sys

import igl
import numpy as np

import meshhood

FWHM = (3.0, 6.0, 10.0)
METRICS = ("surface", "path")
FARTHER = 1.3  # the part of the mesh in which geodesics are sought, by paths


def geodesics(index, v, radius):
    """Vertices, and their geodesic distances from v."""
    near = index.neighborhood(v, FARTHER * radius, metric="surface")
    part = index.submesh(near)
    start = np.flatnonzero(part.vertices == v)
    none = np.empty(0, np.int64)
    ends = np.arange(len(part.vertices))
    lengths = igl.exact_geodesic(part.V.astype(np.float64), part.F, start, none, ends, none)
    return part.vertices, np.asarray(lengths)


def width(weights, distances):
    """Over an infinite plane the mean of d^2 is twice the variance."""
    return np.sqrt(4 * np.log(2) * np.average(distances**2, weights=weights))


def main():
    V, F = meshhood.read_mesh(sys.argv[1])
    index = meshhood.MeshIndex(V, F)
    areas = meshhood.vertex_areas(V, F)
    count = int(sys.argv[2]) if len(sys.argv) > 2 else 200
    vertices = np.random.default_rng(1).choice(len(V), count, replace=False)
    for fwhm in FWHM:
        radius = meshhood.smoothing_radius(fwhm)
        widths = []
        for v in vertices.tolist():
            distance = np.full(len(V), np.nan)
            ends, lengths = geodesics(index, v, radius)
            distance[ends] = lengths
            rows = [index.neighborhood(v, radius, metric=metric, return_distance=True) for metric in METRICS]
            rows.append((ends[lengths <= radius], lengths[lengths <= radius]))
            widths.append([width(areas[w] * 1000 ** -((d / radius) ** 2), distance[w]) for w, d in rows])
        names = zip((*METRICS, "exact geodesics"), np.mean(widths, axis=0))
        text = [f"{name} {mean:.3f} ({100 * (mean / fwhm - 1):+.1f} %)" for name, mean in names]
        print(f"fwhm {fwhm:g}:", ", ".join(text))


if __name__ == "__main__":
    main()
