#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Smooths a noisy signal on a mesh of trimesh: each value becomes the mean of its neighborhood, in which near values
have more weight.

    smooth_signal.py [MESH]

MESH   anything that trimesh reads; without it, a sphere
"""

import sys

import meshhood
import numpy as np
import trimesh


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
    smooth = meshhood.MeshIndex(mesh).smooth(noisy, fwhm=5, unit="edge")
    before, after = root_mean_square(noisy - clean), root_mean_square(smooth - clean)
    print(f"{len(clean)} vertices, noise before {before:.2f}, after {after:.2f}")
    if after > before / 2:
        sys.exit("the noise was not reduced")


if __name__ == "__main__":
    main()
