#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The mean of one channel over all neighborhoods, beside a sparse matrix of ours that SciPy multiplies.

    PYTHONPATH=build/release/python bench/aggregate.py [--workers N] MESH...

MESH is a file; radii are in mean edge lengths. Both have the same rows, consecutive in index order: all vertices, or at
large radii the first ones, so that the matrix has at most so many entries. The matrix is made by `query_ball` without
sorting, 65,536 rows at a time, with a value of one for each entry, and the product is divided by the size of each row.
Both results are compared. Times are medians of rounds in which each has its turn; `aggregate` includes what it prepares
for the whole mesh, which at large radii is shared by few rows. The table is Markdown.
"""

import argparse
import statistics
import time
from pathlib import Path

import meshhood
import numpy as np
from scipy.sparse import csr_array

RADII = (3, 5, 10, 20, 65)
MOST_ENTRIES = 400_000_000
ROUNDS = 3
CHUNK = 65_536


def mean_by_matrix(index, values, rows, r, workers):
    means = np.empty(len(rows))
    for begin in range(0, len(rows), CHUNK):
        part = rows[begin : begin + CHUNK]
        indptr, indices = index.query_ball(part, r, workers=workers)
        matrix = csr_array((np.ones(len(indices)), indices, indptr), shape=(len(part), len(values)))
        means[begin : begin + CHUNK] = matrix @ values / np.diff(indptr)
    return means


def seconds(work):
    start = time.perf_counter()
    result = work()
    return time.perf_counter() - start, result


def rows_of(index, r, workers):
    """Vertices in index order, and the mean size of their neighborhoods."""
    sample = index.permutation[:: max(1, len(index) // 2000)]
    size = index.query_ball_count(sample, r, workers=workers).mean()
    return index.permutation[: max(1000, int(MOST_ENTRIES / size))], size


def measure(name, index, workers):
    values = np.random.default_rng(1).normal(size=len(index))
    for edges in RADII:
        r = edges * index.mean_edge_length
        rows, size = rows_of(index, r, workers)
        listed = None if len(rows) == len(index) else rows
        aggregated, multiplied = [], []
        for _ in range(ROUNDS):
            ours, result = seconds(lambda: index.aggregate(values, r, vertices=listed, workers=workers))
            theirs, expected = seconds(lambda: mean_by_matrix(index, values, rows, r, workers))
            np.testing.assert_allclose(result if listed is not None else result[rows], expected, atol=1e-12)
            aggregated.append(1e6 * ours / len(rows))
            multiplied.append(1e6 * theirs / len(rows))
        ours, theirs = statistics.median(aggregated), statistics.median(multiplied)
        print(f"| {name} | {edges} | {size:.0f} | {len(rows)} | {ours:.3f} | {theirs:.3f} | {theirs / ours:.1f} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--workers", type=int, default=1)
    parser.add_argument("meshes", nargs="+", metavar="MESH")
    options = parser.parse_args()
    print("| mesh | radius in edges | vertices in it | rows | aggregate, µs a row | matrix, µs a row | ratio |")
    print("|--|--|--|--|--|--|--|")
    for name in options.meshes:
        measure(Path(name).stem, meshhood.MeshIndex(*meshhood.read_mesh(name)), options.workers)


if __name__ == "__main__":
    main()
