# SPDX-License-Identifier: MIT
"""An answer depends on index, vertex and radius alone: its order, which is that of the index, and its distances, bit for
bit, whatever was asked before, one by one or together, in any thread or process."""

import concurrent.futures
import multiprocessing

import meshes
import meshhood
import numpy as np
import oracle
import pytest

RADII = (0.0, 0.3, 1.0, 2.5, 6.0, 11.0, 25.0, np.inf)


@pytest.fixture(scope="module", params=("folded", "plates"))
def case(request):
    V, F = meshes.folded(24) if request.param == "folded" else meshes.two_plates(24)
    index = meshhood.MeshIndex(V, F)
    edges = oracle.triangle_graph(len(V), F)
    rows = [(v, r) for v in range(3, len(V), 97) for r in RADII]
    return V, F, index, rows, [expected(V, edges, index, v, r) for v, r in rows]


def expected(V, edges, index, v, r):
    """By the oracle: ids in index order, and their distances."""
    places = np.empty(len(V), int)
    places[index.permutation] = np.arange(len(V))
    ids = oracle.neighborhood(V, edges, v, r)
    ids = ids[np.argsort(places[ids])]
    return ids, oracle.distances(V, v)[ids]


def same(got, wanted):
    ids, distances = got
    return np.array_equal(ids, wanted[0]) and distances.tobytes() == wanted[1].tobytes()


def ask(index, rows):
    return [index.neighborhood(v, r, return_distance=True) for v, r in rows]


def test_of_queries_in_any_order(case):
    _, _, index, rows, wanted = case
    random = np.random.default_rng(5)
    for order in (range(len(rows)), range(len(rows) - 1, -1, -1), *(random.permutation(len(rows)) for _ in range(3))):
        for i in order:
            assert same(index.neighborhood(*rows[i], return_distance=True), wanted[i]), rows[i]


def test_of_a_new_index_for_each_query(case):
    V, F, _, rows, wanted = case
    for row, want in list(zip(rows, wanted))[::9]:
        assert same(meshhood.MeshIndex(V, F).neighborhood(*row, return_distance=True), want), row


@pytest.mark.parametrize("workers", (1, 2))
def test_of_many_queries_in_one_call(case, workers):
    _, _, index, rows, wanted = case
    v, r = np.array([v for v, _ in rows]), np.array([r for _, r in rows])
    indptr, indices, distances = index.neighborhoods(r, v, return_distance=True)
    for i, want in enumerate(wanted):
        part = slice(indptr[i], indptr[i + 1])
        assert same((indices[part], distances[part]), want), rows[i]


@pytest.mark.parametrize("order", ("query", "index"))
def test_of_chunks(case, order):
    _, _, index, rows, wanted = case
    answers = {(v, r): want for (v, r), want in zip(rows, wanted)}
    vertices = sorted({v for v, _ in rows})
    for r in RADII:
        for chunk in index.iter_neighborhoods(r, vertices, chunk=3, order=order, return_distance=True):
            for i, v in enumerate(chunk.vertices):
                part = slice(chunk.indptr[i], chunk.indptr[i + 1])
                assert same((chunk.indices[part], chunk.distances[part]), answers[int(v), r]), (v, r)


def test_of_regions_and_of_rings_of_nested_radii(case):
    V, _, index, rows, wanted = case
    open_mesh = np.zeros(len(V), bool)
    answers = {(v, r): want for (v, r), want in zip(rows, wanted)}
    for (v, r), want in answers.items():
        assert same(index.neighborhood(v, r, return_distance=True), want), (v, r)
        assert same(index.neighborhood(v, r, walls=open_mesh, return_distance=True), want), (v, r)
    for v in sorted({v for v, _ in rows}):
        for walls in (None, open_mesh):
            counts, indices = index.nested(v, RADII, walls=walls)
            begin, before = 0, np.zeros(0, int)
            for r, end in zip(RADII, counts):
                ids = answers[v, r][0]
                np.testing.assert_array_equal(indices[begin:end], ids[~np.isin(ids, before)])
                begin, before = end, ids


def test_sorted_answers_ascend(case):
    _, _, index, rows, wanted = case
    for (v, r), want in zip(rows, wanted):
        np.testing.assert_array_equal(index.neighborhood(v, r, sort="id"), np.sort(want[0]))


def test_of_threads(case):
    _, _, index, rows, wanted = case
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        for answers in pool.map(ask, [index] * 4, [rows] * 4):
            assert all(map(same, answers, wanted))


@pytest.mark.parametrize("method", multiprocessing.get_all_start_methods())
@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_of_processes(case, method):
    _, _, index, rows, wanted = case
    with concurrent.futures.ProcessPoolExecutor(2, multiprocessing.get_context(method)) as pool:
        # The second process begins with other queries.
        for answers, begin in zip(pool.map(ask, [index] * 2, [rows, rows[5:] + rows[:5]]), (0, 5)):
            assert all(map(same, answers, wanted[begin:] + wanted[:begin]))
