# SPDX-License-Identifier: MIT
"""Parameters of the paper, workers and sizes. test_pairs.py has the answers."""

import meshes
import meshhood
import numpy as np


def test_paper_with_other_parameters():
    index = meshhood.MeshIndex(*meshes.folded(12))
    one_cluster = meshhood.Paper(levels=64, discard=64, fusion_growth=0)
    single_vertices = meshhood.Paper(levels=1)
    # One cluster that holds all makes each answer the ball; single vertices make it exact.
    for paper, method in ((one_cluster, "ball"), (single_vertices, "exact"), (meshhood.Paper(), "paper")):
        for got, want in zip(*(index.neighborhoods(2.5, sort="id", method=m) for m in (paper, method))):
            np.testing.assert_array_equal(got, want)
    exact, ball = (index.counts(2.5, method=method) for method in ("exact", "ball"))
    assert (exact < ball).any()


def test_a_larger_radius_ratio_adds_fewer_vertices():
    index = meshhood.MeshIndex(*meshes.folded(40))
    few, many = (index.counts(12.0, method=meshhood.Paper(radius_ratio=ratio)).sum() for ratio in (100, 1))
    assert few < many


def test_index_does_not_depend_on_workers():
    V, F = meshes.two_plates(60)
    one, many = (meshhood.MeshIndex(V, F, workers=workers) for workers in (1, 4))
    np.testing.assert_array_equal(one.permutation, many.permutation)
    for a, b in zip(one.neighborhoods(3.0, workers=1), many.neighborhoods(3.0, workers=4)):
        np.testing.assert_array_equal(a, b)


def test_length_and_bytes():
    V, F = meshes.two_plates(12)
    index = meshhood.MeshIndex(V, F)
    assert len(index) == len(V)
    assert index.nbytes > V.nbytes
    assert str(len(V)) in repr(index)
