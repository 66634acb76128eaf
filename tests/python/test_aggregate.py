# SPDX-License-Identifier: MIT
"""Shapes, types and refused arguments of aggregates. test_pairs.py has their values."""

import meshes
import meshhood
import numpy as np
import pytest


@pytest.fixture(scope="module")
def plates():
    V, F = meshes.two_plates(12)
    values = np.random.default_rng(2).normal(size=(len(V), 2, 3))
    return V, meshhood.MeshIndex(V, F), values


def test_shapes(plates):
    V, index, values = plates
    n = len(V)
    assert index.aggregate(values, 1).shape == (n, 2, 3)
    assert index.aggregate(values, scales=[1, 2.5]).shape == (2, n, 2, 3)
    assert index.aggregate(values, scales=[1]).shape == (1, n, 2, 3)
    assert index.aggregate(values, 1, vertices=[3, 3, 4]).shape == (3, 2, 3)
    assert index.aggregate(values, scales=[1, 2], vertices=5).shape == (2, 2, 3)
    assert index.aggregate(values, 1, vertices=[]).shape == (0, 2, 3)
    assert index.aggregate(values[:, :0], 1).shape == (n, 0, 3)
    assert isinstance(index.aggregate(values[:, 0, 0], 1, vertices=5), float)
    assert index.aggregate(values[:, 0, 0], 1, ["sum"], vertices=5).shape == (1,)
    three = ("mean", "std", "max")
    both = index.aggregate(values, scales=[1, 2.5], reduce=three, vertices=[3, 3, 4])
    assert both.shape == (2, 3, 2, 3, 3)
    for k, name in enumerate(three):
        each = index.aggregate(values, scales=[1, 2.5], reduce=name, vertices=[3, 3, 4])
        np.testing.assert_array_equal(both[..., k], each)
    np.testing.assert_array_equal(index.aggregate(values, 1, three, kernel="box"), index.aggregate(values, 1, three))
    np.testing.assert_array_equal(index.aggregate(values, 1, vertices=5), index.aggregate(values, 1, vertices=[5])[0])
    mask = np.zeros(n, bool)
    mask[[4, 9]] = True
    np.testing.assert_array_equal(index.aggregate(values, 1, vertices=mask), index.aggregate(values, 1, vertices=[4, 9]))


def test_values_of_any_type_and_layout(plates):
    _, index, values = plates
    whole = np.round(100 * values[:, :, 0])
    want = index.aggregate(whole, 2.5)
    for same in (whole.astype(np.int32), np.asfortranarray(whole), whole.astype(">f8"), whole.tolist()):
        np.testing.assert_array_equal(index.aggregate(same, 2.5), want)
    np.testing.assert_array_equal(index.aggregate(whole > 0, 2.5, "sum"), index.aggregate((whole > 0) * 1.0, 2.5, "sum"))


def test_vertex_areas():
    V = np.array([[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0], [9, 9, 9]], float)
    np.testing.assert_allclose(meshhood.vertex_areas(V, [[0, 1, 2, 3]]), [1, 1, 1, 1, 0])
    np.testing.assert_allclose(meshhood.vertex_areas(V, [[0, 1, 2]]), [2 / 3, 2 / 3, 2 / 3, 0, 0])


def test_area_weights_are_kept_and_follow_a_refit(plates):
    from meshhood._aggregate import area_weights

    V, index, _ = plates
    _, F = meshes.two_plates(12)
    areas = area_weights(index, "area", None)
    assert not areas.flags.writeable
    masked = index.masked(walls=[4, 9])
    for other in (area_weights(index, "area", None), area_weights(masked, "area", None)):
        assert np.shares_memory(areas, other)
    np.testing.assert_array_equal(areas, meshhood.vertex_areas(V, F))
    other_faces = area_weights(index, "area", F[::2])
    np.testing.assert_array_equal(other_faces, meshhood.vertex_areas(V, F[::2]))
    for changed in (None, [7]):
        moved = V.copy()
        moved[7] += 0.25
        got = area_weights(index.refit(moved, changed), "area", None)
        np.testing.assert_array_equal(got, meshhood.vertex_areas(moved, F))
    np.testing.assert_array_equal(areas, meshhood.vertex_areas(V, F))


def test_errors_name_the_argument(plates):
    _, index, values = plates
    n = len(index)
    for cause, error, call in (
        ("values: expected numbers", TypeError, lambda: index.aggregate(values.astype(complex), 1)),
        ("scales: value 1: radius nan", ValueError, lambda: index.aggregate(values, scales=[1, np.nan])),
        ("unexpected keyword argument .sort.", TypeError, lambda: index.aggregate(values, 1, sort="id")),
        ("reduce: 'medium', expected 'sum' or 'mean'", ValueError, lambda: index.aggregate(values, 1, ("mean", "medium"))),
        ("reduce: there are none", ValueError, lambda: index.aggregate(values, 1, ())),
        ("reduce: expected a name or several, not int", TypeError, lambda: index.aggregate(values, 1, 3)),
        ("expected None or 'box' with reduce=.'mean', 'std'.", ValueError, lambda: index.aggregate(values, 1, ("mean", "std"), kernel="biweight")),
        ("kernel: 'biweight', expected None or 'box' with reduce='max'", ValueError, lambda: index.aggregate(values, 1, "max", kernel="biweight")),
        ("^scales: value 1: -1.0, expected a finite number > 0", ValueError, lambda: index.smooth(values, scales=[1, -1])),
        ("nan: 'ignore'", ValueError, lambda: index.aggregate(values, 1, nan="ignore")),
        ("nesting: 'both'", ValueError, lambda: index.aggregate(values, 1, nesting="both")),
        ("q: 1.5, expected 0 to 1", ValueError, lambda: index.aggregate(values, 1, "quantile", q=1.5)),
        ("ddof: 2", ValueError, lambda: index.aggregate(values, 1, "var", ddof=2)),
        ("weights: expected an array of shape", ValueError, lambda: index.aggregate(values, 1, weights=[1, 2])),
        ("weights: vertex 0: -1.0, expected a finite number >= 0", ValueError, lambda: index.aggregate(values, 1, weights=np.full(n, -1.0))),
        (f"vertices: row 1: vertex {n}", ValueError, lambda: index.aggregate(values, 1, vertices=[0, n])),
        ("bytes, exceeds max_bytes, 100", MemoryError, lambda: index.aggregate(values, 1, max_bytes=100)),
    ):
        with pytest.raises(error, match=cause):
            call()
