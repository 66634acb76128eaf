#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A searchlight over a cortical surface: where do the patterns of two conditions differ?

    searchlight.py MESH [RADIUS]

MESH     a surface, in mm        RADIUS   of the searchlight, 8 mm unless given

The measurements are made up: 20 trials, noise everywhere, and an effect in one patch, which the analysis must find. A
ball instead of the neighborhood would include the other bank of the sulcus. The script prints how much of it.
"""

import sys

import meshhood
import numpy as np

TRIALS = 20


def trials(vertex_count, patch, rng):
    """Measurements of two conditions, each TRIALS by #V; they differ in the patch."""
    first, second = rng.normal(size=(2, TRIALS, vertex_count))
    second[:, patch] += rng.choice([-1.0, 1.0], size=len(patch))  # a pattern whose mean contains no information
    return first, second


def evidence(first, second):
    """Per vertex, the squared t statistic."""
    error = np.sqrt((first.var(axis=0, ddof=1) + second.var(axis=0, ddof=1)) / TRIALS)
    return ((second.mean(axis=0) - first.mean(axis=0)) / error) ** 2


def searchlight(index, radius, values):
    """Per vertex, the mean of `values` over its neighborhood; memory does not grow with the mesh."""
    result = np.empty(len(index))
    for part in index.iter_neighborhoods(radius, chunk=10_000):
        result[part.vertices] = np.add.reduceat(values[part.indices], part.indptr[:-1]) / np.diff(part.indptr)
    return result


def main():
    V, F = meshhood.read_mesh(sys.argv[1])
    radius = float(sys.argv[2]) if len(sys.argv) > 2 else 8.0
    index = meshhood.MeshIndex(V, F)
    rng = np.random.default_rng(7)
    center = int(rng.integers(len(index)))
    patch = index.neighborhood(center, radius)
    peak = int(searchlight(index, radius, evidence(*trials(len(index), patch, rng))).argmax())

    sample = rng.integers(len(index), size=50)
    inside, ball = (index.counts(radius, sample, method=method).sum() for method in ("exact", "ball"))
    print(f"effect around vertex {center}, found at vertex {peak}, {np.linalg.norm(V[peak] - V[center]):.1f} mm away")
    print(f"of the vertices in a ball, {1 - inside / ball:.0%} are on other folds")
    if peak not in patch:
        sys.exit("the effect was not found")


if __name__ == "__main__":
    main()
