#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The mean of one channel over all neighborhoods, beside a sparse matrix of ours that SciPy multiplies. With --smooth,
smoothing by a Gaussian beside the biweight nearest to it in L2 and that of the same radius. With --together, one call
for several quantities beside a call for each, and the median beside the mean, with the memory that they hold.

    PYTHONPATH=build/release/python bench/aggregate.py [--workers N] [--smooth | --together] MESH...

MESH is a file; radii are in mean edge lengths. Both have the same rows, consecutive in index order: all vertices, or
the first ones, so that the matrix has at most 100 million entries. The matrix is made by `neighborhoods` without sorting,
with a value of one for each entry, in pieces of 20 million entries; the product is divided by the size of each row. Both
results are compared. Times are medians of alternating rounds. `aggregate` includes its preparation for the whole mesh,
which few rows share where the radius is large. The tables are Markdown. """

import argparse
import statistics
import time
from pathlib import Path

import meshhood
import numpy as np
from scipy.sparse import csr_array

from memory import peak_of

RADII = (3, 5, 10, 20, 65)
MOST_ENTRIES = 100_000_000
ENTRIES_OF_A_PIECE = 20_000_000
ROUNDS = 3
WIDTHS = (3, 4, 6, 10)  # in mean edge lengths
THREE = ("mean", "std", "max")
PATCHES = ("area", "volume", "gap")
KINDS = ("mean", "gaussian", "k1", "k2", "curvedness", "shape_index", *PATCHES, "height")
BIWEIGHT = 1.06165  # its radius by the width of the Gaussian nearest to it, whose standard deviation is 0.4 of it


def mean_by_matrix(index, values, rows, piece, r, workers):
    means = np.empty(len(rows))
    for begin in range(0, len(rows), piece):
        part = rows[begin : begin + piece]
        indptr, indices = index.neighborhoods(r, part, workers=workers)
        matrix = csr_array((np.ones(len(indices)), indices, indptr), shape=(len(part), len(values)))
        means[begin : begin + piece] = matrix @ values / np.diff(indptr)
    return means


def seconds(work, workers):
    """Processor time if there is one thread, because other programs disturb it less."""
    clock = time.process_time if workers == 1 else time.perf_counter
    start = clock()
    result = work()
    return clock() - start, result


def rows_of(index, r, workers):
    """Vertices in index order, and the mean size of their neighborhoods."""
    sample = index.permutation[:: max(1, len(index) // 2000)]
    size = index.counts(r, sample, workers=workers).mean()
    return index.permutation[: max(1000, int(MOST_ENTRIES / size))], size


def measure(name, index, workers):
    values = np.random.default_rng(1).normal(size=len(index))
    for edges in RADII:
        r = edges * index.mean_edge_length
        rows, size = rows_of(index, r, workers)
        piece = max(1, int(ENTRIES_OF_A_PIECE / size))
        listed = None if len(rows) == len(index) else rows
        aggregated, multiplied = [], []
        for _ in range(ROUNDS):
            ours, result = seconds(lambda: index.aggregate(values, r, vertices=listed, workers=workers), workers)
            theirs, expected = seconds(
                lambda: mean_by_matrix(index, values, rows, piece, r, workers), workers
            )
            np.testing.assert_allclose(result if listed is not None else result[rows], expected, atol=1e-12)
            aggregated.append(1e6 * ours / len(rows))
            multiplied.append(1e6 * theirs / len(rows))
        ours, theirs = statistics.median(aggregated), statistics.median(multiplied)
        print(f"| {name} | {edges} | {size:.0f} | {len(rows)} | {ours:.3f} | {theirs:.3f} | {theirs / ours:.1f} |", flush=True)


def smooth(name, index, workers):
    for channels in (1, 20):
        values = np.random.default_rng(1).normal(size=(len(index), channels))
        for metric in ("straight", "path"):
            for fwhm in np.multiply(WIDTHS, index.mean_edge_length):
                gaussian, biweight = meshhood.smoothing_radius(fwhm), BIWEIGHT * fwhm
                words = {"metric": metric, "workers": workers}
                kernels = [(gaussian, "gaussian"), (biweight, "biweight"), (gaussian, "biweight")]
                took = np.full((ROUNDS, len(kernels)), np.inf)
                for i in range(ROUNDS):
                    for k, (r, kernel) in enumerate(kernels):
                        took[i, k] = seconds(lambda: index.aggregate(values, r, kernel=kernel, **words), workers)[0]  # noqa: B023
                ours, near, same = 1e6 * np.median(took, axis=0) / len(index)
                sizes = [index.counts(r, **words).mean() for r in (gaussian, biweight)]
                edges = fwhm / index.mean_edge_length
                row = f"{name} | {channels} | {metric} | {edges:.0f} | {sizes[0]:.0f} | {sizes[1]:.0f}"
                print(f"| {row} | {ours:.2f} | {near:.2f} | {ours / near:.2f} | {ours / same:.2f} |", flush=True)


def together(name, index, workers):
    values = np.random.default_rng(1).normal(size=len(index))
    for edges in (3, 5, 10, 20, np.arange(1, 17)):
        scales = np.atleast_1d(edges) * index.mean_edge_length
        words = {"scales": scales, "vertices": index.permutation[: len(index) // len(scales)], "workers": workers}

        def reduce(names):
            return index.aggregate(values, reduce=names, **words)  # noqa: B023

        def features(kinds):
            return index.features(kinds=kinds, **words)  # noqa: B023

        def each(call, names):
            return [call(name) for name in names]

        if len(scales) == 1:
            contests = [
                ("mean, std, max", lambda: reduce(THREE), "each", lambda: each(reduce, THREE)),
                ("median", lambda: reduce("median"), "mean", lambda: reduce("mean")),
                ("area, volume, gap", lambda: features(PATCHES), "each", lambda: each(features, PATCHES)),
            ]
        else:
            contests = [("mean, std, max; ten kinds of features", lambda: (reduce(THREE), features(KINDS)),
                         "each", lambda: (each(reduce, THREE), each(features, KINDS)))]  # fmt: skip
        for what, call, beside, others in contests:
            took = [[seconds(work, workers)[0] for work in (call, others)] for _ in range(ROUNDS)]
            ours, theirs = 1e6 * np.median(took, axis=0) / len(words["vertices"])
            peaks = [peak_of(work) / len(index) for work in (call, others)]
            print(f"| {name} | {edges if len(scales) == 1 else '1 to 16'} | {what} | {beside} | {ours:.2f} | {theirs:.2f} | {ours / theirs:.2f} "
                  f"| {peaks[0]:.0f} | {peaks[1]:.0f} |", flush=True)  # fmt: skip


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--workers", type=int, default=1)
    table = parser.add_mutually_exclusive_group()
    table.add_argument("--smooth", action="store_true")
    table.add_argument("--together", action="store_true")
    parser.add_argument("meshes", nargs="+", metavar="MESH")
    options = parser.parse_args()
    if options.smooth:
        print("| mesh | channels | metric | width in edges | vertices, Gaussian | biweight "
              "| Gaussian, µs a row | biweight | ratio | ratio at the same radius |")  # fmt: skip
        print("|--|--|--|--|--|--|--|--|--|--|")
    elif options.together:
        print("| mesh | radii in edges | one call | beside calls of | µs a row | beside | ratio | bytes a vertex | beside |")
        print("|--|--|--|--|--|--|--|--|--|")
    else:
        print("| mesh | radius in edges | vertices in it | rows | aggregate, µs a row | matrix, µs a row | ratio |")
        print("|--|--|--|--|--|--|--|")
    for name in options.meshes:
        index = meshhood.MeshIndex(*meshhood.read_mesh(name))
        (smooth if options.smooth else together if options.together else measure)(Path(name).stem, index, options.workers)


if __name__ == "__main__":
    main()
