#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Mean curvatures of surfaces with noise, beside the exact ones: root mean square errors in percent of the root mean
square of the mean curvature.

    PYTHONPATH=PACKAGE bench/noisy_curvature.py [RADIUS IN MEAN EDGES...]

Noise is normal, in percent of the mean edge, along the normals. A, the area of the patch, has no mean curvature, but
(k1 - k2)^2 = 32 (A / (pi r^2) - 1) / r^2; the error of its root is in the last column, in percent of the same."""

import sys

import meshhood
import numpy as np

PI = np.pi
SIDES = 100, 250  # of the torus, around its tube and its axis


def grid(rows, columns):
    """The triangles of a grid that is closed both ways."""
    i, j = (a.ravel() for a in np.meshgrid(np.arange(rows), np.arange(columns), indexing="ij"))
    a, b = i * columns + j, i * columns + (j + 1) % columns
    c, d = (np.roll(x.reshape(rows, columns), -1, axis=0).ravel() for x in (a, b))
    return np.concatenate([np.stack([a, b, d], axis=1), np.stack([a, d, c], axis=1)])


def ellipsoid(*axes):
    """Vertices, faces, normals, the mean and half the difference of the principal curvatures. A cube, blown up."""
    n = 65
    u, v = (a.ravel() for a in np.meshgrid(*2 * [np.tan(np.linspace(-PI / 4, PI / 4, n))], indexing="ij"))
    one, F = np.ones(n * n), grid(n, n)
    F = F[(np.ptp(F % n, axis=1) < n - 1) & (np.ptp(F // n, axis=1) < n - 1), ::-1]  # not closed
    sides = [(u, v, one), (v, u, -one), (v, one, u), (u, -one, v), (one, u, v), (-one, v, u)]
    V, F = np.concatenate([np.stack(s, axis=1) for s in sides]), np.concatenate([F + k * n * n for k in range(6)])
    V, F = meshhood.weld(V, F, 1e-9)[:2]
    a, b, c = axes
    V = V / np.linalg.norm(V, axis=1, keepdims=True) * axes
    steep = (V**2 / np.array(axes) ** 4).sum(axis=1)
    H = (a * a + b * b + c * c - (V**2).sum(axis=1)) / (2 * (a * b * c) ** 2 * steep**1.5)
    K = 1 / ((a * b * c) * steep) ** 2
    return V, F, V / np.array(axes) ** 2 / np.sqrt(steep)[:, None], H, np.sqrt(np.maximum(H * H - K, 0))


def torus(R, r):
    s, t = (a.ravel() for a in np.meshgrid(*(np.arange(n) * 2 * PI / n for n in SIDES), indexing="ij"))
    normal = np.stack([np.cos(s) * np.cos(t), np.cos(s) * np.sin(t), np.sin(s)], axis=1)
    V = r * normal + R * np.stack([np.cos(t), np.sin(t), 0 * t], axis=1)
    k1, k2 = 1 / r, np.cos(s) / (R + r * np.cos(s))
    return V, grid(*SIDES), normal, (k1 + k2) / 2, (k1 - k2) / 2


def percent(found, exact, H):
    return 100 * np.sqrt(np.mean((found - exact) ** 2) / np.mean(H**2))


surfaces = {"sphere": ellipsoid(1, 1, 1), "ellipsoid": ellipsoid(1, 0.7, 0.5), "torus": torus(1, 0.4)}
print(f"{'surface':9} {'noise':>5} {'edges':>5} {'V':>7} {'quadric':>8} {'jet':>7} {'corrected':>9} {'A':>7}")
for name, (V, F, normals, H, half) in surfaces.items():
    edge = meshhood.MeshIndex(V, F).mean_edge_length
    for noise in 0, 1, 5:
        bumps = np.random.default_rng(1).normal(scale=noise / 100 * edge, size=(len(V), 1))
        index = meshhood.MeshIndex(V + bumps * normals, F)
        for edges in [float(word) for word in sys.argv[1:]] or [3, 5, 10]:
            r = edges * edge
            area, volume = index.invariants(r)
            means = (2 * PI / 3 - volume / r**3) * 4 / (PI * r), index.curvature(r).mean
            means += index.curvature(r, fit="jet").mean, index.corrected_curvature(r).mean
            by_area = np.sqrt(8 * np.maximum(area / (PI * r * r) - 1, 0)) / r
            v, quadric, jet, corrected = (percent(mean, H, H) for mean in means)
            print(f"{name:9} {noise:4}% {edges:5g} {v:7.2f} {quadric:8.2f} {jet:7.2f} {corrected:9.2f} "
                  f"{percent(by_area, half, H):7.2f}")
