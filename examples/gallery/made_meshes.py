# SPDX-License-Identifier: MIT
"""The meshes of the gallery, made by formula, so that each example runs anywhere."""

import numpy as np


def divided(V, F, splits):
    """V, F: the same surface, whose triangles are divided into four `splits` times."""
    for _ in range(splits):
        sides = np.sort(np.stack([F[:, [0, 1]], F[:, [1, 2]], F[:, [2, 0]]], axis=1).reshape(-1, 2), axis=1)
        edges, middles = np.unique(sides, axis=0, return_inverse=True)
        m = middles.reshape(-1, 3) + len(V)
        V = np.concatenate([V, V[edges].mean(axis=1)])
        F = np.concatenate([m] + [np.c_[F[:, i], m[:, i], m[:, i - 1]] for i in range(3)])
    return V, F


def sphere(splits):
    """V, F: an icosahedron whose triangles are divided into four `splits` times."""
    golden = (1 + 5**0.5) / 2
    corners = [(-1, golden, 0), (1, golden, 0), (-1, -golden, 0), (1, -golden, 0)]
    V = np.array([np.roll(corner, shift) for shift in range(3) for corner in corners], float)
    distances = np.linalg.norm(V[:, None] - V, axis=2)
    near = abs(distances - 2) < 1e-9
    triples = [(a, b, c) for a in range(12) for b in range(a) for c in range(b)]
    F = np.array([(a, b, c) for a, b, c in triples if near[a, b] and near[b, c] and near[a, c]])
    outward = np.einsum("ij,ij->i", np.cross(V[F[:, 1]] - V[F[:, 0]], V[F[:, 2]] - V[F[:, 0]]), V[F[:, 0]]) > 0
    F[~outward] = F[~outward][:, ::-1]
    V, F = divided(V, F, splits)
    return V / np.linalg.norm(V, axis=1, keepdims=True), F


def waves(V, count, frequency, seed):
    """A smooth random field over space: a sum of plane waves, with mean 0 and deviation 1."""
    random = np.random.default_rng(seed)
    directions = random.normal(size=(count, 3))
    directions *= frequency / np.linalg.norm(directions, axis=1, keepdims=True)
    return np.cos(V @ directions.T + random.uniform(0, 2 * np.pi, count)).sum(axis=1) * (2 / count) ** 0.5


def cortex(splits=6):
    """V in mm, F: a closed surface with deep, narrow grooves, as between the folds of a cortex."""
    V, F = sphere(splits)
    groove = np.exp(-((waves(V, 40, 13.0, 4) / 0.3) ** 2))
    return V * (50 - 10 * groove + 2 * waves(V, 40, 4.0, 5))[:, None] * (1.2, 0.9, 0.9), F


def revolved(profile, around):
    """V, F: the surface that a profile of (radius, height) makes around the z axis; its ends lie on the axis."""
    angles = np.arange(around) * (2 * np.pi / around)
    rings = np.array([(r * np.cos(angles), r * np.sin(angles), np.full(around, z)) for r, z in profile[1:-1]])
    V = np.concatenate([rings.transpose(0, 2, 1).reshape(-1, 3), [(0, 0, profile[0][1]), (0, 0, profile[-1][1])]])
    ids = np.arange(len(rings) * around).reshape(len(rings), around)
    a, b = ids[:-1].ravel(), np.roll(ids[:-1], -1, axis=1).ravel()
    c, d = ids[1:].ravel(), np.roll(ids[1:], -1, axis=1).ravel()
    first = np.c_[ids[0], np.roll(ids[0], 1), np.full(around, len(V) - 2)]
    last = np.c_[ids[-1], np.roll(ids[-1], -1), np.full(around, len(V) - 1)]
    return V, np.concatenate([np.c_[a, b, c], np.c_[b, d, c], first, last])


def bowl():
    """V in mm, F: a bowl with a wall of 1.5 mm at its bottom and 5 mm at its rim."""
    t = np.linspace(0, 1, 50)
    angle = t * (np.pi / 2)
    outer = np.c_[40 * np.sin(angle), -40 * np.cos(angle)]
    inner = outer * (1 - (1.5 + 3.5 * t) / 40)[:, None]
    return revolved([*outer, *inner[::-1]], 160)


def pin_in_a_cup(cup_splits):
    """V in mm, F, and the vertices of the pin: a pin of 16 mm leans in a cup with a bore of 18 mm. The cup is as CAD
    writes it, of few, long triangles, which are divided `cup_splits` times. The pin has many."""
    pin, G = divided(*revolved([(0, 0), (8, 0), (8, 40), (0, 40)], 36), 4)
    pin[:, 0] += pin[:, 2] / 60
    cup, F = divided(*revolved([(0, -6), (14, -6), (14, 40), (9, 40), (9, -2), (0, -2)], 36), cup_splits)
    return np.concatenate([pin, cup]), np.concatenate([G, F + len(pin)]), np.arange(len(pin))


def rolled(turn, side=100):
    """V, F: a sheet of 3 side by side vertices, 1 apart, rolled up by `turn` turns 4 apart; its middle stays."""
    along, across = (axis.ravel().astype(float) for axis in np.indices((3 * side, side)))
    share = np.linspace(0, 1, 4096)
    angle = 2 * np.pi * turn * (share - 0.5) - np.pi / 2
    radius = 3 * side / (2 * np.pi * turn) - 4 * turn * (share - 0.5)
    x, y = radius * np.cos(angle), radius * np.sin(angle)
    length = np.concatenate([[0], np.cumsum(np.hypot(np.diff(x), np.diff(y)))])
    V = np.c_[np.interp(along, length, x), np.interp(along, length, y), across]
    V -= V[3 * side // 2 * side] * (1, 1, 0)
    ids = np.arange(3 * side * side).reshape(3 * side, side)
    a, b, c, d = ids[:-1, :-1].ravel(), ids[1:, :-1].ravel(), ids[1:, 1:].ravel(), ids[:-1, 1:].ravel()
    return V, np.concatenate([np.c_[a, b, c], np.c_[a, c, d]])


def worn_tablet(side=240):
    """V in mm, F: a pillow of clay with strokes of 0.6 mm, worn until they are 0.4 mm deep, and grains."""
    random = np.random.default_rng(3)
    x, y = (axis.ravel().astype(float) for axis in np.indices((side, side)))
    depth = np.zeros((side, side))
    for middle in np.stack(np.meshgrid(*2 * [np.arange(30, side - 20, 36)]), -1).reshape(-1, 2):
        for angle in np.pi / 4 * random.choice(4, 2, replace=False):
            u = (x - middle[0]) * np.cos(angle) + (y - middle[1]) * np.sin(angle)
            v = (y - middle[1]) * np.cos(angle) - (x - middle[0]) * np.sin(angle)
            stroke = np.clip(1.5 * (1 - abs(u) / 15), 0, 1) - abs(v) / 4
            depth = np.maximum(depth, np.clip(stroke, 0, 1).reshape(side, side))
    for shift in (1, 1, 2, 2):
        depth = (depth + np.roll(depth, shift, 0) + np.roll(depth, -shift, 0)) / 3
        depth = (depth + np.roll(depth, shift, 1) + np.roll(depth, -shift, 1)) / 3
    pillow = 20 - 40 * ((x / side - 0.5) ** 2 + (y / side - 0.5) ** 2)
    ids = np.arange(side * side).reshape(side, side)
    a, b, c, d = ids[:-1, :-1].ravel(), ids[1:, :-1].ravel(), ids[1:, 1:].ravel(), ids[:-1, 1:].ravel()
    V = np.c_[x, y, pillow - 0.6 * depth.ravel() + random.normal(0, 0.05, len(x))]
    return V, np.concatenate([np.c_[a, b, c], np.c_[a, c, d]])
