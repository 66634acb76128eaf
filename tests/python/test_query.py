# SPDX-License-Identifier: MIT
"""Every kind of query, compared with SciPy."""

import meshes
import meshhood
import numpy as np
import oracle
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

METHODS = ("exact", "paper", "bfs", "ball", meshhood.Paper(levels=4, discard=1, fusion_growth=2, radius_ratio=3))
RADII = (0.0, 0.3, 1.0, 2.5, 5.0, np.inf)


@pytest.fixture(scope="module")
def plates():
    V, F = meshes.two_plates(12)
    return V, F, oracle.triangle_graph(len(V), F), meshhood.MeshIndex(V, F)


def expected(V, edges, method, v, r):
    return oracle.ball(V, v, r) if method == "ball" else oracle.neighborhood(V, edges, v, r)


def rows(indptr, values):
    return np.split(values, indptr[1:-1])


@pytest.mark.parametrize("method", ("exact", "bfs", "ball"))
@pytest.mark.parametrize("r", RADII)
def test_one_vertex(plates, method, r):
    V, _, edges, index = plates
    for v in range(0, len(V), 17):
        wanted = expected(V, edges, method, v, r)
        ids, distances = index.neighborhood(v, r, return_distance=True, method=method)
        np.testing.assert_array_equal(np.sort(ids), wanted)
        np.testing.assert_array_equal(distances, oracle.distances(V, v)[ids])
        np.testing.assert_array_equal(index.neighborhood(v, r, sort="id", method=method), wanted)
        assert index.count(v, r, method=method) == len(wanted)


@pytest.mark.parametrize("r", RADII)
def test_paper_lies_between_exact_and_ball(plates, r):
    V, _, edges, index = plates
    for v in range(0, len(V), 17):
        ids = index.neighborhood(v, r, method="paper")
        assert set(oracle.neighborhood(V, edges, v, r)) <= set(ids) <= set(oracle.ball(V, v, r))


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


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("workers", (1, 2, -1))
def test_many_vertices_are_one_after_the_other(plates, method, workers):
    _, _, _, index = plates
    v = np.array([5, 200, 5, 0, 287])
    r = np.array([1.0, 2.0, 0.0, np.inf, 3.5])
    options = {"return_distance": True, "sort": "id", "method": method}
    indptr, indices, distances = index.neighborhoods(r, v, **options)
    singles = [index.neighborhood(*query, **options) for query in zip(v, r)]
    for ids, far, single in zip(rows(indptr, indices), rows(indptr, distances), singles):
        np.testing.assert_array_equal(ids, single[0])
        np.testing.assert_array_equal(far, single[1])
    np.testing.assert_array_equal(np.diff(indptr), index.counts(r, v, method=method))


def test_all_vertices(plates):
    V, _, edges, index = plates
    indptr, indices = index.neighborhoods(2.5, sort="id")
    assert len(indptr) == len(V) + 1
    for v, ids in enumerate(rows(indptr, indices)):
        np.testing.assert_array_equal(ids, oracle.neighborhood(V, edges, v, 2.5))


def test_permutation_has_each_vertex_once(plates):
    np.testing.assert_array_equal(np.sort(plates[3].permutation), np.arange(len(plates[3])))


def test_graph(plates):
    V, _, edges, index = plates
    connected, far = index.radius_neighbors_graph(2.5), index.radius_neighbors_graph(2.5, mode="distance")
    for graph in (connected, far):
        assert graph.shape == (len(V), len(V))
        assert graph.indices.dtype == np.int32
    wanted = [oracle.neighborhood(V, edges, v, 2.5) for v in range(len(V))]
    np.testing.assert_array_equal(connected.indices, np.concatenate(wanted))
    assert connected.data.all()
    np.testing.assert_array_equal(far.data, np.concatenate([oracle.distances(V, v)[w] for v, w in enumerate(wanted)]))


def test_graph_with_a_radius_for_each_vertex(plates):
    index = plates[3]
    r = np.linspace(0, 4, len(index))
    graph = index.radius_neighbors_graph(r)
    np.testing.assert_array_equal(np.diff(graph.indptr), index.counts(r))


@pytest.mark.parametrize("chunk", (1, 100, 10_000))
def test_chunks_are_the_rows(plates, chunk):
    index = plates[3]
    r = np.linspace(0, 4, len(index))
    parts = list(index.iter_neighborhoods(r, chunk=chunk, return_distance=True))
    np.testing.assert_array_equal(np.concatenate([p.vertices for p in parts]), np.arange(len(index)))
    assert all(len(p.vertices) <= chunk for p in parts)
    indptr, _, distances = index.neighborhoods(r, return_distance=True)
    np.testing.assert_array_equal(np.concatenate([np.diff(p.indptr) for p in parts]), np.diff(indptr))
    np.testing.assert_array_equal(np.sort(np.concatenate([p.distances for p in parts])), np.sort(distances))


def test_chunks_of_some_vertices(plates):
    index = plates[3]
    parts = list(index.iter_neighborhoods(1.0, [7, 3, 9], chunk=2, sort="id"))
    assert [list(p.vertices) for p in parts] == [[7, 3], [9]]
    assert parts[0].distances is None
    np.testing.assert_array_equal(parts[1].indices, index.neighborhood(9, 1.0, sort="id"))


@pytest.mark.parametrize("method", ("exact", "bfs"))
def test_chunks_in_index_order_are_the_rows(plates, method):
    index = plates[3]
    v = np.random.default_rng(5).integers(0, len(index), 300)  # some of them more than once
    r = np.linspace(0, 4, len(v))
    parts = list(index.iter_neighborhoods(r, v, chunk=70, order="index", sort="id", method=method))
    place = np.argsort(index.permutation)
    order = np.argsort(place[v], kind="stable")
    np.testing.assert_array_equal(np.concatenate([p.vertices for p in parts]), v[order])
    indptr, indices = index.neighborhoods(r[order], v[order], sort="id", method=method)
    np.testing.assert_array_equal(np.concatenate([np.diff(p.indptr) for p in parts]), np.diff(indptr))
    np.testing.assert_array_equal(np.concatenate([p.indices for p in parts]), indices)


def test_all_vertices_in_index_order(plates):
    index = plates[3]
    r = np.linspace(0, 4, len(index))
    (part,) = index.iter_neighborhoods(r, chunk=len(index), order="index")
    np.testing.assert_array_equal(part.vertices, index.permutation)
    np.testing.assert_array_equal(np.diff(part.indptr), index.counts(r)[index.permutation])


def test_index_does_not_depend_on_workers():
    V, F = meshes.two_plates(60)
    one, many = (meshhood.MeshIndex(V, F, workers=workers) for workers in (1, 4))
    np.testing.assert_array_equal(one.permutation, many.permutation)
    for a, b in zip(one.neighborhoods(3.0, workers=1), many.neighborhoods(3.0, workers=4)):
        np.testing.assert_array_equal(a, b)


def test_length_and_bytes(plates):
    V, _, _, index = plates
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
