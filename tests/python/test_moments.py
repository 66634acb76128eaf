# SPDX-License-Identifier: MIT
"""Principal components, features and jets, compared with NumPy over the vertices that SciPy finds; refused arguments.
test_dense.py has the sums."""

from typing import get_args

import meshes
import meshhood
import numpy as np
import oracle
import pytest
from meshhood._shape import Kind
from test_curvature import ellipsoid


@pytest.fixture(scope="module")
def plates():
    V, F = meshes.two_plates(12)
    V = V + np.random.default_rng(1).normal(scale=0.05, size=V.shape)
    return V, F, oracle.triangle_graph(len(V), F), meshhood.MeshIndex(V, F)


def test_principal_components_are_those_of_the_covariance(plates):
    V, F, edges, index = plates
    areas = meshhood.vertex_areas(V, F)
    got = index.principal_components(2.5, weights="area", F=F)
    for v in range(0, len(V), 5):
        ids = oracle.neighborhood(V, edges, v, 2.5)
        values, vectors = np.linalg.eigh(np.cov(V[ids].T, aweights=areas[ids], ddof=0))
        np.testing.assert_allclose(got.weight[v], areas[ids].sum(), rtol=1e-12)
        np.testing.assert_allclose(got.center[v], np.average(V[ids], axis=0, weights=areas[ids]) - V[v], atol=1e-12)
        np.testing.assert_allclose(got.variances[v], values, atol=1e-12)
        np.testing.assert_allclose(abs((got.axes[v] * vectors.T).sum(axis=1)), 1, atol=1e-6)
        np.testing.assert_allclose(got.surface_variation[v], values[0] / values.sum(), atol=1e-12)
    np.testing.assert_array_equal(got.normal, got.axes[:, 0])


def test_features_are_curvatures_times_the_radius():
    V, F = ellipsoid(3)
    index = meshhood.MeshIndex(V, F)
    radii = meshhood.geometric_radii(0.5, 2, 3)
    found = index.features(scales=radii, F=F, kinds=get_args(Kind))
    assert found.shape == (3, len(V), len(get_args(Kind)))
    k = index.curvature(1.0, F=F)
    np.testing.assert_allclose(found[1, :, get_args(Kind).index("mean")], k.mean, rtol=1e-12)
    np.testing.assert_allclose(found[1, :, get_args(Kind).index("shape_index")], k.shape_index, rtol=1e-12)
    patch = index.principal_components(1.0, weights="area", F=F)
    np.testing.assert_allclose(found[1, :, get_args(Kind).index("variation")], patch.surface_variation, rtol=1e-12)
    np.testing.assert_array_equal(index.features(scales=radii, F=F), found[..., 0])
    np.testing.assert_array_equal(index.features(scales=[1.0], vertices=[4, 4], F=F, unit="edge").shape, (1, 2))


def test_jets_are_near_quadrics_on_a_smooth_surface():
    V, F = ellipsoid(5)
    index = meshhood.MeshIndex(V, F)
    quadric = index.curvature(4, F=F, unit="edge")
    jet = index.curvature(4, F=F, unit="edge", fit="jet", filter=False)
    assert jet.ok.all()
    assert np.median(abs(jet.k1 / quadric.k1 - 1)) < 0.05


def test_wrong_arguments_are_refused_by_name(plates):
    V, F, _, index = plates
    for call, message in (
        (lambda: index.moments(1, degree=5), "degree: 5, expected 0 to 4"),
        (lambda: index.moments(1, weights=[1.0]), "weights: expected an array of shape"),
        (lambda: index.moments(1, weights=np.full(len(V), -1.0)), "weights: vertex 0: -1.0, expected a finite number >= 0"),
        (lambda: index.features(0, F=F), "^r: radius 0"),
        (lambda: index.features(scales=[0], F=F), "^scales: radius 0: 0"),
        (lambda: index.features(scales=[1, 0], F=F), "^scales: radius 1: 0"),
        (lambda: index.features(1, F=F, kinds="ridge"), "kinds: 'ridge'"),
        (lambda: index.features(1, F=F, kinds=[]), "kinds: there are none"),
        (lambda: index.curvature(1, F=F, fit="jet", like="libigl"), "like: 'libigl', expected None with fit='jet'"),
        (lambda: meshhood.persistence(np.zeros((2, 3)), [1.0], 0.5), "values: expected an array of shape"),
        (lambda: meshhood.persistence(np.zeros((2, 3)), [2, 1], 0.5), "^radii: value 1: radius 1.0, expected more than 2.0"),
        (lambda: meshhood.persistence(np.zeros((0, 3)), [], 0.5), "^radii: there are none, expected at least one"),
        (lambda: meshhood.persistence(np.zeros((2, 3)), [-1.0, 1.0], 0.5), "^radii: value 0: radius -1.0"),
        (lambda: meshhood.persistence(np.zeros((2, 3)), [1.0, np.nan], 0.5), "^radii: value 1: radius nan"),
        (lambda: meshhood.geometric_radii(1, 2, 0), "count: 0"),
        (lambda: meshhood.geometric_radii(2, 1, 3), "^smallest: 2.0, expected at most largest, 1.0"),
        (lambda: index.moments(scales=[0.1, 0.2, -1]), "^scales: value 2: radius -1"),
    ):
        with pytest.raises(ValueError, match=message):
            call()
    for radii in ([1j, 2], ["1", "2"]):
        with pytest.raises(TypeError, match="^radii: "):
            meshhood.persistence(np.zeros((2, 3)), radii, 0.5)


@pytest.mark.parametrize("name", ("curvature", "corrected_curvature", "moments", "principal_components", "features"))
def test_a_wrong_dtype_is_refused_before_the_computation(plates, name):
    def progress(done, total):
        pytest.fail("has begun")

    with pytest.raises(ValueError, match="^dtype: int8"):
        getattr(plates[3], name)(1, dtype="int8", progress=progress)
