#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""How often the vertex nearest to a random point in space does not belong to the nearest face, and how often it lies on
another sheet: not connected with the face in the smallest ball around the nearest point that has both.

    PYTHONPATH=PACKAGE bench/wrong_sheets.py MESH...
"""

import sys

import meshhood
import numpy as np

POINTS = 10_000

for path in sys.argv[1:]:
    V, F = meshhood.read_mesh(path)
    index = meshhood.MeshIndex(V, F)
    picks = np.random.default_rng(1).uniform(V.min(axis=0), V.max(axis=0), (POINTS, 3))
    faces, _, points, _ = index.closest_point(picks)
    vertices, _ = index.nearest(picks)
    needed = V[np.column_stack([F[faces], vertices])].astype(np.float64)
    radii = np.linalg.norm(needed - points[:, None], axis=2).max(axis=1)
    connected = [index.contains(p, v, r, face=f) for p, v, r, f in zip(points, vertices, radii, faces)]
    other = (F[faces] != vertices[:, None]).all(axis=1)
    print(f"{path}: of {POINTS} points, {100 * other.mean():.1f} % not of the face, "
          f"{100 * (1 - np.mean(connected)):.2f} % on another sheet")
