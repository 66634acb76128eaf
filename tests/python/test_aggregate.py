# SPDX-License-Identifier: MIT
"""Aggregates, compared with NumPy over the vertices that SciPy finds."""

import meshes
import meshhood
import numpy as np
import oracle
import pytest

REDUCTIONS = {
    "sum": np.sum,
    "mean": np.mean,
    "min": np.min,
    "max": np.max,
    "var": np.var,
    "std": np.std,
    "count": len,
}


@pytest.fixture(scope="module")
def plates():
    V, F = meshes.two_plates(12)
    values = np.random.default_rng(2).normal(size=(len(V), 2, 3))
    return V, F, oracle.triangle_graph(len(V), F), meshhood.MeshIndex(V, F), values


@pytest.mark.parametrize("reduce", REDUCTIONS)
@pytest.mark.parametrize("r", (0.0, 1.0, 2.5, np.inf))
def test_equals_numpy(plates, reduce, r):
    V, _, edges, index, values = plates
    got = index.aggregate(values[:, 0, 0], r, reduce)
    for v in range(len(V)):
        ids = oracle.neighborhood(V, edges, v, r)
        want = REDUCTIONS[reduce](values[ids, 0, 0])
        np.testing.assert_allclose(got[v], want, rtol=1e-12, atol=1e-13)


WEIGHTS = {
    "epanechnikov": lambda share: 1 - share**2,
    "biweight": lambda share: (1 - share**2) ** 2,
    "gaussian": lambda share: np.exp(-np.log(1000) * share**2),
}


@pytest.mark.parametrize("kernel", WEIGHTS)
def test_smoothing_kernels(plates, kernel):
    V, F, edges, index, values = plates
    areas = meshhood.vertex_areas(V, F)
    got = index.aggregate(values, 2.5, kernel=kernel, weights="area", F=F)
    np.testing.assert_array_equal(got, index.aggregate(values, 2.5, kernel=kernel, weights=areas))
    for v in range(len(V)):
        ids = oracle.neighborhood(V, edges, v, 2.5)
        weights = WEIGHTS[kernel](oracle.distances(V, v)[ids] / 2.5) * areas[ids]
        np.testing.assert_allclose(got[v], np.average(values[ids], axis=0, weights=weights), rtol=1e-10, atol=1e-12)


def test_shapes(plates):
    V, _, _, index, values = plates
    n = len(V)
    assert index.aggregate(values, 1).shape == (n, 2, 3)
    assert index.aggregate(values, scales=[1, 2.5]).shape == (2, n, 2, 3)
    assert index.aggregate(values, scales=[1]).shape == (1, n, 2, 3)
    assert index.aggregate(values, 1, vertices=[3, 3, 4]).shape == (3, 2, 3)
    assert index.aggregate(values, scales=[1, 2], vertices=5).shape == (2, 2, 3)
    assert index.aggregate(values, 1, vertices=[]).shape == (0, 2, 3)
    assert index.aggregate(values[:, :0], 1).shape == (n, 0, 3)
    assert isinstance(index.aggregate(values[:, 0, 0], 1, vertices=5), float)
    np.testing.assert_array_equal(index.aggregate(values, 1, vertices=5), index.aggregate(values, 1, vertices=[5])[0])
    mask = np.zeros(n, bool)
    mask[[4, 9]] = True
    np.testing.assert_array_equal(index.aggregate(values, 1, vertices=mask), index.aggregate(values, 1, vertices=[4, 9]))


def test_values_of_any_type_and_layout(plates):
    _, _, _, index, values = plates
    whole = np.round(100 * values[:, :, 0])
    want = index.aggregate(whole, 2.5)
    for same in (whole.astype(np.int32), np.asfortranarray(whole), whole.astype(">f8"), whole.tolist()):
        np.testing.assert_array_equal(index.aggregate(same, 2.5), want)
    np.testing.assert_array_equal(index.aggregate(whole > 0, 2.5, "sum"), index.aggregate((whole > 0) * 1.0, 2.5, "sum"))


def test_missing_values(plates):
    V, _, edges, index, values = plates
    gaps = values[:, 0, 0].copy()
    gaps[::3] = np.nan
    spread = index.aggregate(gaps, 1.0)
    left_out = index.aggregate(gaps, 1.0, nan="omit")
    for v in range(len(V)):
        ids = oracle.neighborhood(V, edges, v, 1.0)
        np.testing.assert_allclose(spread[v], np.mean(gaps[ids]), rtol=1e-12, atol=1e-13)
        np.testing.assert_allclose(left_out[v], np.nanmean(gaps[ids]), rtol=1e-12, atol=1e-13)


def test_patch(plates):
    V, _, edges, index, values = plates
    got = index.aggregate(values[:, 0, 0], scales=[4.0, 1.5], reduce="sum", nesting="patch")
    for v in range(len(V)):
        ids = oracle.neighborhood(V, edges, v, 4.0)
        near = ids[oracle.distances(V, v)[ids] <= 1.5]
        np.testing.assert_allclose(got[:, v], [values[ids, 0, 0].sum(), values[near, 0, 0].sum()], atol=1e-12)


def test_unit_and_workers(plates):
    _, _, _, index, values = plates
    want = index.aggregate(values, 2 * index.mean_edge_length, kernel="biweight")
    np.testing.assert_array_equal(index.aggregate(values, 2, kernel="biweight", unit="edge"), want)
    for workers in (1, 2, 3):
        np.testing.assert_array_equal(index.aggregate(values, 2, kernel="biweight", unit="edge", workers=workers), want)


def test_smooth(plates):
    _, F, _, index, values = plates
    radius = 2.0 * np.sqrt(np.log2(1000)) / 2
    np.testing.assert_allclose(index.smooth(values, 2.0), index.aggregate(values, radius, kernel="gaussian"))
    constant = np.full(len(index), 3.5)
    np.testing.assert_allclose(index.smooth(constant, 2.0, weights="area", F=F), constant)


@pytest.mark.parametrize("metric", ("straight", "path"))
def test_smooth_is_a_gaussian_of_the_width(plates, metric):
    _, _, _, index, values = plates
    kept = np.arange(len(index)) % 5 > 0
    ids, distances = index.neighborhood(20, 3 * 2.0, metric=metric, ignored=~kept, return_distance=True)
    deviation = 2.0 / np.sqrt(8 * np.log(2))
    weights = np.exp(-((distances / deviation) ** 2) / 2)
    weights[weights < 1 / 1000] = 0  # where the ball is larger, it has the same part of this plate
    want = np.average(values[ids], axis=0, weights=weights)
    got = index.smooth(values, 2.0, metric=metric, ignored=~kept, vertices=20)
    np.testing.assert_allclose(got, want, rtol=1e-12, atol=1e-14)


def test_of_a_loaded_index(plates, tmp_path):
    _, _, _, index, values = plates
    index.save(tmp_path / "plates.mhi")
    loaded = meshhood.load(tmp_path / "plates.mhi")
    np.testing.assert_array_equal(loaded.aggregate(values, 2.5), index.aggregate(values, 2.5))


def test_vertex_areas():
    V = np.array([[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0], [9, 9, 9]], float)
    np.testing.assert_allclose(meshhood.vertex_areas(V, [[0, 1, 2, 3]]), [1, 1, 1, 1, 0])
    np.testing.assert_allclose(meshhood.vertex_areas(V, [[0, 1, 2]]), [2 / 3, 2 / 3, 2 / 3, 0, 0])


def test_errors_name_the_argument(plates):
    _, _, _, index, values = plates
    n = len(index)
    for cause, error, call in (
        ("values: expected an array of shape", ValueError, lambda: index.aggregate(values[1:], 1)),
        ("values: expected numbers", TypeError, lambda: index.aggregate(values.astype(complex), 1)),
        ("r: radius -1", ValueError, lambda: index.aggregate(values, -1)),
        ("scales: radius nan", ValueError, lambda: index.aggregate(values, scales=[1, np.nan])),
        ("r: .* several radii for all rows are scales=", ValueError, lambda: index.aggregate(values, [1, 2])),
        ("scales: expected a list", ValueError, lambda: index.aggregate(values, scales=[])),
        ("r: missing, expected a number", TypeError, lambda: index.aggregate(values)),
        ("r: given, but so are scales", TypeError, lambda: index.aggregate(values, 1, scales=[1])),
        ("unexpected keyword argument .sort.", TypeError, lambda: index.aggregate(values, 1, sort="id")),
        ("reduce: 'median'", ValueError, lambda: index.aggregate(values, 1, "median")),
        ("kernel: 'gauss'", ValueError, lambda: index.aggregate(values, 1, kernel="gauss")),
        ("kernel: 'biweight', expected None with reduce='max'", ValueError, lambda: index.aggregate(values, 1, "max", kernel="biweight")),
        ("nan: 'ignore'", ValueError, lambda: index.aggregate(values, 1, nan="ignore")),
        ("nesting: 'both'", ValueError, lambda: index.aggregate(values, 1, nesting="both")),
        ("ddof: 2", ValueError, lambda: index.aggregate(values, 1, "var", ddof=2)),
        ("weights: expected an array of shape", ValueError, lambda: index.aggregate(values, 1, weights=[1, 2])),
        ("weights: vertex 0: -1.0, expected a finite number >= 0", ValueError, lambda: index.aggregate(values, 1, weights=np.full(n, -1.0))),
        (f"vertices: row 1: vertex {n}", ValueError, lambda: index.aggregate(values, 1, vertices=[0, n])),
        ("bytes, exceeds max_bytes, 100", MemoryError, lambda: index.aggregate(values, 1, max_bytes=100)),
        ("fwhm: 0", ValueError, lambda: index.smooth(values, 0)),
    ):
        with pytest.raises(error, match=cause):
            call()


def test_progress_may_end_the_call(plates):
    _, _, _, index, values = plates
    reports = []
    index.aggregate(values, scales=[1, 2], progress=lambda done, total: reports.append((done, total)))
    assert reports[-1] == (2 * len(index), 2 * len(index))

    def stop(done, total):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        index.aggregate(values, 1, progress=stop)
