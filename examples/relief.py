#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Distinguishes the signs on a tablet from its curved, rough surface by features over 16 radii, as multi-scale integral
invariants do for cuneiform tablets. The tablet is made by formula, so that the answer is known.

    relief.py [OUTPUT.npz]

OUTPUT   the feature vectors and the vertices of the signs
"""

import sys

import meshhood
import numpy as np

SIDE = 240  # vertices of a row; 1 mm apart
DEPTH = 1.5  # of a wedge, in mm
WIDTH = 5.0


def wedges(random, count):
    """Middle and direction of each impression."""
    angles = random.uniform(0, np.pi, count)
    return random.uniform(20, SIDE - 20, (count, 2)), np.column_stack([np.cos(angles), np.sin(angles)])


def tablet():
    """V, F and the depth of the signs at each vertex: a pillow of clay with V-shaped impressions and grains."""
    random = np.random.default_rng(3)
    x, y = (axis.ravel().astype(float) for axis in np.meshgrid(np.arange(SIDE), np.arange(SIDE), indexing="ij"))
    depth = np.zeros(len(x))
    for middle, along in zip(*wedges(random, 60)):
        u = (x - middle[0]) * along[0] + (y - middle[1]) * along[1]
        v = (y - middle[1]) * along[0] - (x - middle[0]) * along[1]
        taper = np.clip(1 - abs(u) / 12, 0, 1)
        depth = np.maximum(depth, DEPTH * np.clip(taper - abs(v) / (WIDTH / 2), 0, 1))
    pillow = 30 * (1 - ((x / SIDE - 0.5) ** 2 + (y / SIDE - 0.5) ** 2))
    V = np.column_stack([x, y, pillow - depth + random.normal(0, 0.08, len(x))])
    a = np.arange(SIDE * SIDE).reshape(SIDE, SIDE)
    corners = [a[:-1, :-1], a[1:, :-1], a[1:, 1:], a[:-1, 1:]]
    quads = np.stack(corners, axis=-1).reshape(-1, 4)
    return V, np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]]), depth


def main():
    V, F, depth = tablet()
    index = meshhood.MeshIndex(V, F)
    radii = np.arange(1, 17) / 2  # 0.5, 1, ..., 8 mm
    vectors = index.features(scales=radii, kinds=("crease", "height", "area"))
    lasting = meshhood.persistence(vectors[:, :, 0], radii, threshold=0.3)
    found = lasting.scales <= -5  # a valley at five consecutive radii or more
    signs = depth > DEPTH / 4
    inner = (abs(V[:, :2] - SIDE / 2) < SIDE / 2 - 10).all(axis=1)  # the rim of the sheet is no sign
    right = (found & signs & inner).sum() / (found & inner).sum()
    seen = (found & signs & inner).sum() / (signs & inner).sum()
    print(f"{len(V)} vertices, {(signs & inner).sum()} of signs: {100 * seen:.0f} % found, {100 * right:.0f} % of those found are right")
    if len(sys.argv) > 1:
        np.savez(sys.argv[1], radii=radii, vectors=vectors, found=found)
    if min(right, seen) < 0.7:
        sys.exit("the signs were not found")


if __name__ == "__main__":
    main()
