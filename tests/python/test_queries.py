# SPDX-License-Identifier: MIT
"""Nearest vertices, cut edges, faces and rims, parameters of the paper; refused arguments. test_pairs.py has the answers
of all calls, and test_newcomer.py whole messages."""

import warnings

import numpy as np
import pytest
from meshes import folded, grid
from oracle import distances

import meshhood


def test_nearest_is_that_of_a_scan(mesh):
    V, _, index = mesh
    p = V[30] + [0.2, 0.1, 0]
    vertex, distance = index.nearest(p)
    assert vertex == np.argmin(distances(V, p)) and distance == distances(V, p).min()
    for none in ([], np.empty((0, 3))):
        assert [len(found) for found in index.nearest(none)] == [0, 0]
    done = []
    vertices, _ = index.nearest(V[:50], workers=2, progress=lambda part, whole: done.append((part, whole)))
    np.testing.assert_array_equal(vertices, np.arange(50))
    assert done[0] == (0, 50) and done[-1] == (50, 50)


def test_paper_with_other_parameters():
    index = meshhood.MeshIndex(*folded(12))
    one_cluster = meshhood.Paper(levels=64, discard=64, fusion_growth=0)
    single_vertices = meshhood.Paper(levels=1)
    # One cluster that holds all makes each answer the ball; single vertices make it exact.
    for paper, method in ((one_cluster, "ball"), (single_vertices, "exact"), (meshhood.Paper(), "paper")):
        for got, want in zip(*(index.neighborhoods(2.5, sort="id", method=m) for m in (paper, method))):
            np.testing.assert_array_equal(got, want)
    wide = meshhood.MeshIndex(*folded(40))
    few, many = (wide.counts(12.0, method=meshhood.Paper(radius_ratio=ratio)).sum() for ratio in (100, 1))
    assert few < many


def test_cut_edges_are_not_crossed():
    V, quads = grid(6)
    cut = [(12 + i, 18 + i) for i in range(6)]
    index = meshhood.MeshIndex(V, quads, cut=cut)
    assert len(index.neighborhood(0, np.inf)) == 18
    assert len(meshhood.MeshIndex(V, quads).neighborhood(0, np.inf)) == 36


def test_a_cut_line_stays_joined_to_both_sides_and_what_crosses_it_separates_them():
    V, quads = grid(4)
    line, across = [(4 * i + 1, 4 * i + 5) for i in range(3)], [(4 * i + 1, 4 * i + 2) for i in range(4)]
    assert meshhood.MeshIndex(V, quads, cut=line).count(0, np.inf) == 16
    separate = meshhood.MeshIndex(V, quads, cut=across)
    assert separate.count(0, np.inf) == 8
    assert separate.measure(0, 9.0).area == 9.0


def test_submesh_of_a_region(mesh):
    V, F, index = mesh
    ids = index.neighborhood(5, 3.2)
    inside, part = np.isin(F, ids), index.submesh(ids, "any")
    np.testing.assert_array_equal(index.submesh(ids).faces, np.flatnonzero(inside.all(axis=1)))
    np.testing.assert_array_equal(part.faces, np.flatnonzero(inside.any(axis=1)))
    np.testing.assert_array_equal(part.vertices[part.F], F[part.faces])
    np.testing.assert_array_equal(part.V, V[part.vertices])
    np.testing.assert_array_equal(meshhood.MeshIndex(part).faces, part.F)


def test_rim_of_polygons_on_a_sheet_is_one_loop():
    V, quads = grid(12)
    index = meshhood.MeshIndex(V, quads)
    center = 6 * 12 + 6
    (line,) = index.rim(index.neighborhood(center, 3.3), center, 3.3)
    assert line.closed


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda i: i.neighborhood(np.zeros((2, 3)), 1), r"start: expected a vertex or 3 numbers"),
        (lambda i: i.neighborhood(3, 1, seeds=[3]), r"seeds: expected None"),
        (lambda i: i.neighborhood([0.0, 0.0, 0.0], 1, seeds=[0, 36]), r"seeds: row 1: vertex 36"),
        (lambda i: i.neighborhood(0, 1, metric="geodesic"), r"metric: 'geodesic'"),
        (lambda i: i.neighborhood(0, 1, walls=np.full(36, 0.5)), r"walls: expected integers, not float64"),
        (lambda i: i.stroke([[0, 0, 0]], 1, seeds=[[0], [1]]), r"seeds: expected \(1,\) or \(1, k\)"),
        (lambda i: i.nested(0, [np.nan]), r"radii: value 0: radius nan"),
        (lambda i: i.connecting_radius(0, -1), r"w: vertex -1"),
        (lambda i: i.nearest_connected(0, -1), r"k: -1"),
        (lambda i: i.nested(36, range(2), metric="rings"), r"start: vertex 36"),
        (lambda i: i.rim([8], [], 1), r"start: expected a vertex or 3 numbers, not .* \(0,\)"),
        (lambda i: i.neighborhood(0, 1, metric="path", method="bfs"), r"method: 'bfs', expected 'exact'"),
        (lambda i: meshhood.MeshIndex(*grid(3), cut=[(0, 1), (0, 8)]), r"cut: edge 1: vertices 0 and 8"),
        (lambda i: meshhood.MeshIndex(*grid(3), cut=[(0, 9)]), r"^cut: edge 0: vertex 9, but the mesh has 9 vertices"),
        (lambda i: i.submesh([36]), r"ids: row 0: vertex 36"),
        (lambda i: i.rim([8], 0, 1), r"vertex 8 is not within the radius 1"),
    ],
)
def test_wrong_arguments_are_refused_by_name(call, message):
    with pytest.raises((ValueError, TypeError), match=message):
        call(meshhood.MeshIndex(*grid(6)))


def test_an_empty_list_has_no_seeds():
    index = meshhood.MeshIndex(*grid(5))
    assert index.count([2.0, 2.0, 0.0], 1.5, seeds=[]) == index.count([2.0, 2.0, 0.0], 1.5, seeds=()) == 0
    with warnings.catch_warnings():
        warnings.simplefilter("error")  # no seed is far
        for points, seeds in (([], []), ([[2.0, 2.0, 0.0]] * 2, [[], []])):
            assert len(index.stroke(points, 1.5, seeds=seeds)) == 0
        empty = meshhood.MeshIndex(np.empty((0, 3)), np.empty((0, 3), int))
        assert len(empty.stroke([[0.0, 0, 0]] * 2, 1)) == len(empty.stroke([], 1)) == len(index.stroke([], 1)) == 0


FAR = "point is farther than r from the vertices where its search starts"


@pytest.mark.filterwarnings("error")
def test_a_point_farther_from_the_mesh_than_the_radius_causes_a_warning():
    V, quads = grid(5)
    index = meshhood.MeshIndex(V, quads)
    above = [2.0, 2.0, 3.0]
    for ask in (
        lambda r: index.neighborhood(above, r),
        lambda r: index.neighborhood(above, r, seeds=[0, 12]),
        lambda r: index.nested(above, [0.5, r])[1],
        lambda r: index.stroke([above], r),
    ):
        with pytest.warns(UserWarning, match=FAR) as caught:
            assert len(ask(2.9)) == 0
        assert caught[0].filename == __file__
        assert 12 in ask(3.0)  # at exactly 3; no warning
    walls = np.ones(25, bool)
    assert len(index.neighborhood(above, 3.0, seeds=12, walls=walls)) == 0  # no warning: a wall lies in the ball
    with pytest.raises(ValueError, match="all vertices of the mesh are walls"):
        index.neighborhood(above, 3.0, walls=walls)
    assert len(index.neighborhood(above, 1.0, seeds=np.empty(0, int))) == 0  # no seed is far
