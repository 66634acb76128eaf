# SPDX-License-Identifier: MIT
"""Meshes that deform: which vertices are said to have moved, and refused arguments. test_outlive.py has what was made
before."""

import meshes
import meshhood
import numpy as np
import oracle
import pytest

SIDE = 30


@pytest.fixture(params=(np.float32, np.float64))
def mesh(request):
    V, F = meshes.folded(SIDE)
    return V.astype(request.param), F


def expect_answers_of(index, V, F, radii=(0.25, 1.0, 2.5, 7.0)):
    edges = oracle.triangle_graph(len(V), F)
    for v in range(0, len(V), 97):
        for r in (*radii, oracle.distances(V, v)[(7 * v + 11) % len(V)]):
            np.testing.assert_array_equal(index.neighborhood(v, r, sort="id"), oracle.neighborhood(V, edges, v, r))


def test_of_changed_vertices_answers_are_those_of_the_moved_mesh(mesh):
    V, F = mesh
    index = meshhood.MeshIndex(V, F)
    moved = V.copy()
    inside = (abs(V[:, 0] - 10) < 4) & (abs(V[:, 1] - 12) < 5)
    moved[inside, 2] *= 0.5
    moved[inside, 0] += 0.75
    for changed in (inside, np.flatnonzero(inside), list(np.flatnonzero(inside)[::-1]) * 2):
        expect_answers_of(index.refit(moved, changed), moved, F)
    expect_answers_of(index.refit(moved, np.flatnonzero(inside)).refit(V, inside), V, F)
    assert len(index.refit(V, [])) == len(index)


def test_every_method_unit_and_property_belongs_to_the_moved_mesh(mesh):
    V, F = mesh
    index = meshhood.MeshIndex(V, F)
    index.counts(2.0, method="bfs")
    index.counts(2.0, method="paper")
    moved = (2 * V).astype(V.dtype)
    twice = index.refit(moved)
    np.testing.assert_array_equal(twice.positions, moved)
    assert twice.mean_edge_length == pytest.approx(2 * index.mean_edge_length)
    for method in ("exact", "bfs", "ball", "paper"):
        np.testing.assert_array_equal(
            twice.counts(4.0, method=method), index.counts(2.0, method=method)
        )
        np.testing.assert_array_equal(
            twice.neighborhood(7, 3, unit="edge", method=method, sort="id"),
            index.neighborhood(7, 3, unit="edge", method=method, sort="id"),
        )
    np.testing.assert_array_equal(index.positions, V)


@pytest.mark.parametrize(
    ("change", "error", "message"),
    (
        (lambda V: (V[:, :2], None), ValueError, r"V: expected an array of shape \(#V, 3\)"),
        (lambda V: (np.where(V == 5, np.nan, V), None), ValueError, "V: vertex 5: x is nan"),
        (lambda V: (V, [0, 3600]), ValueError, "changed: row 1: vertex 3600, but the mesh has 3600 vertices"),
        (lambda V: (V, [-1]), ValueError, "changed: row 0: vertex -1"),
        (lambda V: (V, [0.5]), TypeError, "changed: expected integers"),
        (lambda V: (V, np.ones(7, bool)), ValueError, "changed: a bool mask of shape"),
        (lambda V: (np.full_like(V, np.inf), [3]), ValueError, "V: vertex 3: x is inf"),
        (lambda V: (V.astype(np.float64), [3]), ValueError, "V: the positions are double, but those of the index are"),
    ),
)
def test_wrong_arguments_are_refused_by_name(change, error, message):
    V, F = meshes.folded(SIDE)
    V = V.astype(np.float32)
    index = meshhood.MeshIndex(V, F)
    positions, changed = change(V)
    with pytest.raises(error, match=message):
        index.refit(positions, changed)
    expect_answers_of(index, V, F, radii=(1.0,))


def test_the_attributes_of_a_subclass_are_kept():
    class Named(meshhood.MeshIndex):
        pass

    V, F = meshes.folded(SIDE)
    index = Named(V, F)
    index.name = "hand"
    moved = index.refit(2 * V)
    assert type(moved) is Named and moved.name == "hand" and moved is not index


def test_surfaces_follow_refits_that_nobody_asked_in_between(mesh):
    """What is made of the faces is renewed where vertices have moved since it was made, on each of two ways."""
    V, F = mesh
    points = V[::7].astype(float) + [0.1, 0.2, 0.3]

    def expect_surface_of(index, V):
        fresh = meshhood.MeshIndex(V, F)
        for found, expected in zip(index.closest_point(points), fresh.closest_point(points)):
            np.testing.assert_array_equal(found, expected)
        np.testing.assert_allclose(index.curvature(2.0).mean, fresh.curvature(2.0).mean, rtol=1e-5, atol=1e-9)

    def moved(index, V, step, asks):
        ids, V = np.arange(100 * step, 100 * step + 20), V.copy()
        V[ids] += 0.125
        index = index.refit(V, ids)
        if asks:
            expect_surface_of(index, V)
        return index, V

    first = meshhood.MeshIndex(V, F)
    expect_surface_of(first, V)
    for asked in ((False, False, True), (True, False, True)):
        index, positions = first, V
        for step, asks in enumerate(asked):
            index, positions = moved(index, positions, step, asks)
    expect_surface_of(first, V)
