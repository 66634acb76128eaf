#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The overhead of a call from Python over the query itself, and of a batch over its rows, all timed in the same run.

    PYTHONPATH=build/release/python bench/python_overhead.py

A grid of 250,000 vertices, always the same vertex, so that all data is in the cache; the median of several rounds. The
query itself is a batch of one thread that only counts, so the overhead is not underestimated. """

import statistics
import time

import meshhood
import numpy as np

SIDE = 500
CALLS = 5_000
ROUNDS = 7
RADII = (1.0, 3.0, 10.0)
LARGE_RADIUS = 65.0
CHUNK = 1024


def grid(side):
    x, y = np.meshgrid(np.arange(side, dtype=np.float32), np.arange(side, dtype=np.float32))
    corner = (np.arange(side - 1)[:, None] * side + np.arange(side - 1)).ravel()
    quads = np.column_stack([corner, corner + 1, corner + side + 1, corner + side])
    return np.column_stack([x.ravel(), y.ravel(), np.zeros(side * side, np.float32)]), quads


def microseconds(work):
    start = time.perf_counter()
    work()
    return (time.perf_counter() - start) / CALLS * 1e6


def medians(*works):
    """The medians of alternating rounds."""
    rounds = [[microseconds(work) for work in works] for _ in range(ROUNDS)]
    return [statistics.median(times) for times in zip(*rounds)]


def print_calls(index, v, r):
    rows = np.full(CALLS, v)

    def calls():
        for _ in range(CALLS):
            index.neighborhood(v, r)

    call, query = medians(calls, lambda: index.counts(r, rows, workers=1))
    count = index.count(v, r)
    print(f"{r:4.0f} {count:9d} {call:8.2f} {query:9.2f} {call - query:12.2f} {call / query:13.2f}")


def print_batch(index, v, r):
    """A batch is one call of the library, so its overhead does not depend on the number of rows."""
    one, rows, everything = np.array([v]), np.full(CALLS, v), np.arange(len(index))

    def batches():
        for _ in range(CALLS):
            index.neighborhood(one, r)

    batch, query = medians(batches, lambda: index.counts(r, rows, workers=1))
    start = time.perf_counter()
    index.neighborhoods(r, everything, workers=1)
    whole = (time.perf_counter() - start) * 1e6
    beside = batch - query
    print(f"a batch has an overhead of {beside:.1f} us: {beside / whole:.5%} of a batch of all {len(index)} vertices")


def print_rows(index, v, r):
    """Rows of many ids, kept in arrays chunk by chunk, compared with the same rows only counted."""
    rows = np.arange(v, v + CALLS)

    def kept():
        for chunk in index.iter_neighborhoods(r, rows, chunk=CHUNK, workers=1):
            del chunk

    ids, counted = medians(kept, lambda: index.counts(r, rows, workers=1))
    count = index.counts(r, rows).mean()
    print(f"a row of {count:.0f} ids takes {ids:.1f} us in chunks of {CHUNK}, {counted:.1f} us if it is only counted")


def main():
    index = meshhood.MeshIndex(*grid(SIDE))
    v = SIDE * SIDE // 2 + SIDE // 2
    print("   r  vertices  call us  query us  overhead us  call / query")
    for r in RADII:
        print_calls(index, v, r)
    print_batch(index, v, RADII[-1])
    print_rows(index, v, LARGE_RADIUS)


if __name__ == "__main__":
    main()
