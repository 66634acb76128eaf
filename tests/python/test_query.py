# SPDX-License-Identifier: MIT
"""Every kind of query, compared with SciPy."""

import meshes
import meshhood
import numpy as np
import oracle
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st


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


coordinate = st.integers(-3, 3).map(lambda x: x / 2)


@st.composite
def random_meshes(draw):
    """Any polygons over points of a coarse lattice, so that many lie at exactly the radius or on top of each other."""
    V = np.array(draw(st.lists(st.tuples(coordinate, coordinate, coordinate), min_size=1, max_size=40)))
    corner = st.integers(0, len(V) - 1)
    faces = draw(st.lists(st.lists(corner, max_size=6), max_size=40))
    return V.astype(draw(st.sampled_from([np.float32, np.float64]))), faces


@pytest.mark.filterwarnings("ignore:.*Weld the mesh")
@settings(deadline=None, max_examples=200, derandomize=True)
@given(mesh=random_meshes(), r=st.sampled_from([0.0, 0.5, 1.0, 1.5, 3.0]))
def test_random_meshes(mesh, r):
    V, faces = mesh
    offsets = np.cumsum([0, *map(len, faces)])
    corners = np.array([corner for face in faces for corner in face], int)
    index = meshhood.MeshIndex(V, (offsets, corners))
    edges = oracle.graph(len(V), faces)
    wanted = np.concatenate([oracle.neighborhood(V, edges, v, r) for v in range(len(V))])
    for method in ("exact", "bfs"):
        np.testing.assert_array_equal(index.neighborhoods(r, sort="id", method=method)[1], wanted)
