# SPDX-License-Identifier: MIT
"""Welding: types, faces, warnings and refused arguments."""

import numpy as np
import pytest
from meshes import grid, shared, soup, triangles

import meshhood

V, QUADS = grid(6)
F = triangles(QUADS)


@pytest.mark.parametrize("dtype", (np.float32, np.float64))
def test_vertices_are_the_first_of_each_id_and_have_the_type_of_the_positions(dtype):
    random = np.random.default_rng(1)
    points = random.integers(0, 8, (400, 3)).astype(dtype) / 2
    welded = meshhood.weld(points, np.zeros((0, 3), int), 1.0)
    assert welded.vertices.dtype == dtype
    assert welded.ids.dtype == np.int32
    np.testing.assert_array_equal(welded.vertices, points[np.unique(welded.ids, return_index=True)[1]])


def test_faces_stay_and_name_the_new_vertices():
    apart, separate = soup(V, F)
    vertices, faces, ids = meshhood.weld(apart, separate)
    assert faces.dtype == np.int32
    np.testing.assert_array_equal(faces, ids[separate])
    np.testing.assert_array_equal(vertices[ids], apart)
    assert len(vertices) == len(V)
    assert meshhood.MeshIndex(vertices, faces).counts(np.inf).min() == len(V)


def test_polygons_stay_with_all_corners():
    apart, separate = soup(V, QUADS)
    vertices, (offsets, corners), ids = meshhood.weld(apart, separate, eps=1)
    np.testing.assert_array_equal(offsets, 4 * np.arange(len(QUADS) + 1))
    np.testing.assert_array_equal(corners, ids[separate].ravel())
    assert len(vertices) < len(V)


def test_a_mesh_of_read_mesh_is_welded_as_it_is(tmp_path):
    mesh = meshhood.read_mesh(shared("components/suzanne_unwelded.ply", tmp_path))
    with pytest.warns(UserWarning, match="meshhood.weld"):
        meshhood.MeshIndex(*mesh)
    welded = meshhood.weld(*mesh)
    assert len(welded.vertices) == 1966 - 1461
    index = meshhood.MeshIndex(welded.vertices, welded.faces)  # no warning
    assert index.count(0, np.inf) > 100


def test_a_soup_whose_corners_differ_by_rounding_warns_with_a_distance():
    apart, separate = soup(V, F)
    apart = apart + np.random.default_rng(3).uniform(-1e-7, 1e-7, apart.shape)
    with pytest.warns(UserWarning, match=r"nearly equal positions.*meshhood.weld\(V, F, eps=") as caught:
        meshhood.MeshIndex(apart, separate)
    eps = float(str(caught[0].message).rpartition("eps=")[2].rstrip(")"))
    assert eps < 1e-5, "near the noise, so that no true vertices are joined"
    vertices, faces, _ = meshhood.weld(apart, separate, eps=eps)
    assert len(vertices) == len(V)
    meshhood.MeshIndex(vertices, faces)  # no warning


@pytest.mark.parametrize(("scales", "welds"), (((1,), 0), ((1, 1e-3, 1e-3), 1)), ids=("one size", "two sizes"))
def test_faces_that_are_truly_separate_cause_no_warning_and_hardly_a_weld(monkeypatch, scales, welds):
    random = np.random.default_rng(4)
    cards = [scale * (V[quad] + random.uniform(0, 100, 3)) for scale in scales for quad in QUADS]
    calls = []
    weld = meshhood._mesh._core.weld
    monkeypatch.setattr(meshhood._mesh._core, "weld", lambda *args, **options: calls.append(1) or weld(*args, **options))
    meshhood.MeshIndex(np.concatenate(cards), np.arange(4 * len(cards)).reshape(-1, 4))
    assert len(calls) == welds


@pytest.mark.parametrize("eps", (np.nan, np.inf))
def test_a_wrong_eps_is_refused(eps):
    with pytest.raises(ValueError, match="eps: .*expected a finite number >= 0"):
        meshhood.weld(V, F, eps)


def test_wrong_arrays_are_refused():
    with pytest.raises(ValueError, match="F: face 0: corner 1 is vertex 36"):
        meshhood.weld(V, [[0, 36, 1]])
    with pytest.raises(TypeError, match="eps: text, expected a number"):
        meshhood.weld(V, F, "1")
