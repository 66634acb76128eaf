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
