#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Smooths a noisy signal on a mesh of trimesh: each value becomes the mean of its neighborhood, the near ones counting
more.

    smooth_signal.py [MESH]

MESH   anything that trimesh reads; without it, a sphere
"""

import sys

import meshhood
import numpy as np
import trimesh


def smoothed(mesh, signal, width):
    """`signal` (#V) under a Gaussian of `width`, in the unit of the mesh, cut off at three widths."""
    weights = meshhood.MeshIndex(mesh).radius_neighbors_graph(3 * width, mode="distance")
    weights.data = np.exp(-0.5 * (weights.data / width) ** 2)
    return (weights @ signal) / weights.sum(axis=1)


def root_mean_square(values):
    return np.sqrt(np.mean(values**2))


def main():
    if len(sys.argv) > 1:
        mesh = trimesh.load(sys.argv[1], process=False, force="mesh")
    else:
        mesh = trimesh.creation.icosphere(subdivisions=5)
    heights = np.asarray(mesh.vertices)[:, 2]
    clean = (heights - heights.mean()) / heights.std()
    noisy = clean + np.random.default_rng(1).normal(size=len(clean))
    errors = [
        root_mean_square(signal - clean)
        for signal in (noisy, smoothed(mesh, noisy, 2 * mesh.edges_unique_length.mean()))
    ]
    print(f"{len(clean)} vertices, noise before {errors[0]:.2f}, after {errors[1]:.2f}")
    if errors[1] > errors[0] / 2:
        sys.exit("the noise did not go")


if __name__ == "__main__":
    main()
