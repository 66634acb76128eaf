# SPDX-License-Identifier: MIT
"""Meshes that deform: answers after `refit`, objects that must not change, and refused arguments."""

import threading

import meshes
import meshhood
import numpy as np
import oracle
import pytest

SIDE = 30


def bent(V, amount):
    V = V.copy()
    V[:, 2] += amount * np.sin(V[:, 0] / 3)
    V[:, 0] *= 1 - amount / 20
    return V


@pytest.fixture(params=(np.float32, np.float64))
def mesh(request):
    V, F = meshes.folded(SIDE)
    return V.astype(request.param), F


def expect_answers_of(index, V, F, radii=(0.25, 1.0, 2.5, 7.0)):
    edges = oracle.triangle_graph(len(V), F)
    for v in range(0, len(V), 97):
        for r in (*radii, oracle.distances(V, v)[(7 * v + 11) % len(V)]):
            np.testing.assert_array_equal(index.neighborhood(v, r, sort="id"), oracle.neighborhood(V, edges, v, r))


def test_answers_are_those_of_the_moved_mesh(mesh):
    V, F = mesh
    index = meshhood.MeshIndex(V, F)
    for amount in (0.5, 3, 10):
        moved = bent(V, amount)
        expect_answers_of(index.refit(moved), moved, F)
    expect_answers_of(index, V, F)


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


def test_rows_of_other_vertices_are_not_read(mesh):
    V, F = mesh
    index = meshhood.MeshIndex(V, F)
    poisoned = np.full_like(V, np.nan)
    poisoned[[3, 40]] = V[[3, 40]] + 0.125
    moved = V.copy()
    moved[[3, 40]] += 0.125
    expect_answers_of(index.refit(poisoned, [40, 3]), moved, F)


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


def test_a_refitted_index_is_saved_loaded_and_refitted_again(mesh, tmp_path):
    V, F = mesh
    inside = np.flatnonzero(V[:, 1] < 9)
    moved = (0.25 * V).astype(V.dtype)
    moved[V[:, 1] >= 9] = V[V[:, 1] >= 9]
    meshhood.MeshIndex(V, F).refit(moved, inside).save(tmp_path / "moved.index")
    for mmap in (False, True):
        loaded = meshhood.load(tmp_path / "moved.index", mmap=mmap)
        expect_answers_of(loaded, moved, F)
        expect_answers_of(loaded.refit(V, inside), V, F)
        expect_answers_of(loaded.refit(V), V, F)


def test_other_threads_search_the_old_index_meanwhile(mesh):
    V, F = mesh
    moved = bent(V, 4)
    index = meshhood.MeshIndex(V, F)
    shared = {"index": index}
    wanted = {id(index): index.counts(2.0)}
    kept, wrong, stop = [index], [], threading.Event()

    def search():
        while not stop.is_set():
            current = shared["index"]
            if not np.array_equal(current.counts(2.0, workers=1), wanted[id(current)]):
                wrong.append(current)

    threads = [threading.Thread(target=search) for _ in range(3)]
    for thread in threads:
        thread.start()
    for step in range(12):
        following = kept[-1].refit(moved if step % 2 == 0 else V)
        wanted[id(following)] = wanted[id(index)] if step % 2 else following.counts(2.0, method="bfs")
        kept.append(following)
        shared["index"] = following
    stop.set()
    for thread in threads:
        thread.join()
    assert not wrong
    assert not np.array_equal(wanted[id(kept[0])], wanted[id(kept[1])])


@pytest.mark.parametrize(
    ("change", "error", "message"),
    (
        (lambda V: (V[:-1], None), ValueError, "V: 3599 positions, but the index has 3600 vertices"),
        (lambda V: (V[:, :2], None), ValueError, r"V: expected an array of shape \(#V, 3\)"),
        (lambda V: (np.where(V == 5, np.nan, V), None), ValueError, "V: vertex 5: x is nan"),
        (lambda V: (V, [0, 3600]), ValueError, "changed: row 1: vertex 3600, but the mesh has 3600 vertices"),
        (lambda V: (V, [-1]), ValueError, "changed: row 0: vertex -1"),
        (lambda V: (V, [0.5]), TypeError, "changed: expected integers"),
        (lambda V: (V, np.ones(7, bool)), ValueError, "changed: a bool mask of shape"),
        (lambda V: (np.full_like(V, np.inf), [3]), ValueError, "V: vertex 3: x is inf"),
        (lambda V: (V.astype(np.float64), [3]), ValueError, "V: the positions are double, but those of the index are"),
        (lambda V: ("V", None), TypeError, "V: a path, expected arrays or a mesh"),
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


def test_a_cancelled_refit_leaves_the_index_as_it_is(mesh):
    V, F = mesh
    index = meshhood.MeshIndex(V, F)

    def stop(done, total):
        raise InterruptedError

    with pytest.raises(InterruptedError):
        index.refit(bent(V, 1), progress=stop)
    expect_answers_of(index, V, F, radii=(1.0,))


def test_the_attributes_of_a_subclass_are_kept():
    class Named(meshhood.MeshIndex):
        pass

    V, F = meshes.folded(SIDE)
    index = Named(V, F)
    index.name = "hand"
    moved = index.refit(bent(V, 1))
    assert type(moved) is Named and moved.name == "hand" and moved is not index


def test_quality_detects_stretched_leaves():
    V, F = meshes.folded(60)
    index = meshhood.MeshIndex(V, F)
    fresh = index.quality()
    assert isinstance(fresh, meshhood.Quality)
    assert 0.8 < fresh.gain < 1.2
    assert fresh.gain == pytest.approx(fresh.mean_radius / fresh.rebuilt_radius)
    stretched = index.refit(V * [8, 1, 1])
    assert stretched.quality().gain > 1.5
    assert meshhood.MeshIndex(V * [8, 1, 1], F).quality().gain < 1.2


def test_surfaces_follow_whatever_index_lives(mesh):
    """What is made of the faces is renewed where vertices have moved: from the index before, which may be asked again,
    have been refitted twice, or be gone."""
    V, F = mesh
    points = V[::7].astype(float) + [0.1, 0.2, 0.3]
    ways = np.broadcast_to([0.0, 0.1, -1.0], points.shape)

    def expect_surface_of(index, V):
        fresh = meshhood.MeshIndex(V, F)
        for found, expected in zip(index.closest_point(points), fresh.closest_point(points)):
            np.testing.assert_array_equal(found, expected)
        for found, expected in zip(index.first_hit(points, ways), fresh.first_hit(points, ways)):
            np.testing.assert_array_equal(found, expected)
        np.testing.assert_allclose(index.curvature(2.0).mean, fresh.curvature(2.0).mean, rtol=1e-5, atol=1e-9)

    def moved(V, ids, way):
        V = V.copy()
        V[ids] += way
        return V

    some, others = np.arange(40, 60), np.arange(50, 90)
    index = meshhood.MeshIndex(V, F)
    expect_surface_of(index, V)
    one, two = moved(V, some, 0.25), moved(V, others, -0.5)
    first, second = index.refit(one, some), index.refit(two, others)
    third = first.refit(moved(one, others, -0.5), others)
    expect_surface_of(second, two)
    expect_surface_of(index, V)
    expect_surface_of(third, moved(one, others, -0.5))
    expect_surface_of(first, one)
    del first, second, third
    for step in range(5):
        V = moved(V, some + 100 * step, 0.125)
        index = index.refit(V, some + 100 * step)
        if step != 2:
            expect_surface_of(index, V)
