# SPDX-License-Identifier: MIT
"""Ownership of memory and the times at which it may change (reliability rows P2 and P3)."""

import gc
from concurrent.futures import ThreadPoolExecutor

import meshes
import meshhood
import numpy as np
import pytest


def make():
    V, F = meshes.two_plates(20)
    return meshhood.MeshIndex(V, F)


def test_results_outlive_the_index():
    index = make()
    permutation = index.permutation
    ids = index.neighborhood(5, 3.0)
    kept = ids.copy(), permutation.copy()
    del index
    gc.collect()
    make()
    for now, then in zip((ids, permutation), kept):
        np.testing.assert_array_equal(now, then)


def test_arrays_that_are_not_copied_are_read_only():
    index = make()
    assert np.shares_memory(index.permutation, index.permutation)
    with pytest.raises(ValueError, match="read-only"):
        index.permutation[0] = 1


def test_answers_belong_to_the_caller():
    index = make()
    before = index.neighborhood(5, 3.0).copy()
    index.neighborhood(5, 3.0)[:] = 0
    np.testing.assert_array_equal(index.neighborhood(5, 3.0), before)


@pytest.mark.parametrize("method", ("exact", "paper", "bfs", "ball"))
def test_arrays_may_change_after_the_index_is_made(method):
    V, F = meshes.two_plates(20)
    index, untouched = meshhood.MeshIndex(V, F), make()
    V[:], F[:] = 0, 0
    np.testing.assert_array_equal(index.neighborhood(5, 3.0, method=method), untouched.neighborhood(5, 3.0, method=method))


@pytest.mark.parametrize("method", ("exact", "paper", "bfs", "ball"))
def test_threads_may_share_an_index(method):
    index = make()
    wanted = [index.neighborhood(v, 4.0, sort="id", method=method) for v in range(len(index))]
    shared = make()  # which has made neither searchers nor the index of the paper yet

    def run_query(v):
        return shared.neighborhood(v, 4.0, sort="id", method=method)

    with ThreadPoolExecutor(4) as pool:
        for got, want in zip(pool.map(run_query, range(len(index))), wanted):
            np.testing.assert_array_equal(got, want)
