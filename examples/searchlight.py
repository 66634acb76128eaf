#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A searchlight over a cortical surface: where do the patterns of two conditions differ?

    searchlight.py MESH [RADIUS [WALL]]

MESH     a surface, in mm        RADIUS   of the searchlight along the surface, 8 mm unless given
WALL     a map (.func.gii, .shape.gii or .label.gii, by nibabel) that is 0 on the cortex and not on the medial wall,
         which has no searchlights and is in none

The measurements are made up: 20 trials, noise everywhere, and an effect in one patch, which the analysis must find. A
ball would include the other bank of the sulcus. The script prints how much of a ball is no part of the searchlight.
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


def wall_of(names, vertex_count):
    """A mask (#V,), of no vertices without a file."""
    if not names:
        return np.zeros(vertex_count, bool)
    import nibabel

    return nibabel.load(names[0]).agg_data() != 0


def searchlight(index, radius, walls, values):
    """Per vertex, the mean of `values` over its searchlight, NaN for walls; memory does not grow with the mesh."""
    result = np.full(len(index), np.nan)
    rows = np.flatnonzero(~walls)
    for part in index.iter_neighborhoods(radius, rows, chunk=10_000, metric="surface", walls=walls):
        result[part.vertices] = np.add.reduceat(values[part.indices], part.indptr[:-1]) / np.diff(part.indptr)
    return result


def main():
    if len(sys.argv) not in (2, 3, 4):
        sys.exit(__doc__)
    V, F = meshhood.read_mesh(sys.argv[1])
    radius = float(sys.argv[2]) if len(sys.argv) > 2 else 8.0
    walls = wall_of(sys.argv[3:], len(V)) | np.isnan(V).any(axis=1)
    index = meshhood.MeshIndex(V, F)
    rng = np.random.default_rng(7)
    center = int(rng.choice(np.flatnonzero(~walls)))
    patch = index.neighborhood(center, radius, metric="surface", walls=walls)
    found = searchlight(index, radius, walls, evidence(*trials(len(index), patch, rng)))
    peak = int(np.nanargmax(found))

    sample = rng.choice(np.flatnonzero(~walls), size=50)
    inside, ball = (index.counts(radius, sample, metric=metric).sum() for metric in ("surface", "space"))
    print(f"effect around vertex {center}, found at vertex {peak}, {np.linalg.norm(V[peak] - V[center]):.1f} mm away")
    print(f"of the vertices in a ball, {1 - inside / ball:.0%} are on other folds, or farther along the surface")
    if peak not in patch:
        sys.exit("the effect was not found")


if __name__ == "__main__":
    main()
