# SPDX-License-Identifier: MIT
"""One grammar: every call on many vertices takes every argument, and the result is that of the same arguments put together by
hand. test_words.py looks at single arguments more closely."""

import meshes
import meshhood
import numpy as np
import pytest

V, F = meshes.two_plates(9)
COUNT = len(V)
RANDOM = np.random.default_rng(7)
VALUES = RANDOM.normal(size=(COUNT, 2))
WALLS, IGNORED = RANDOM.random(COUNT) < 0.1, RANDOM.random(COUNT) < 0.1
R = 2.5


def edges():
    sides = np.concatenate([F[:, [0, 1]], F[:, [1, 2]], F[:, [2, 0]]])
    return np.unique(np.sort(sides, axis=1), axis=0)


INDEX = meshhood.MeshIndex(V, F)
CUT = meshhood.MeshIndex(V, F, cut=[edge for edge in edges() if WALLS[edge].any()])  # as if the walls were not there


def dense(indptr, ids, distances, words):
    """Lists as a matrix with 1 + the distance of each vertex, with a leading axis for scales."""
    matrix = np.zeros((len(indptr) - 1, COUNT))
    matrix[np.repeat(np.arange(len(matrix)), np.diff(indptr)), ids] = 1 + distances.astype(float)
    return matrix if words.get("scales") is None else matrix.reshape(len(words["scales"]), -1, COUNT)


def listed(index, r=None, vertices=None, **words):
    return dense(*index.neighborhoods(r, vertices, return_distance=True, **words), words)


def iterated(index, r=None, vertices=None, **words):
    parts = list(index.iter_neighborhoods(r, vertices, chunk=50, return_distance=True, **words))
    indptr = np.cumsum([0, *np.concatenate([np.diff(part.indptr) for part in parts])])
    return dense(indptr, np.concatenate([p.indices for p in parts]), np.concatenate([p.distances for p in parts]), words)


def graph(index, r=None, **words):
    found = index.radius_neighbors_graph(r, mode="distance", **words)
    return dense(found.indptr, found.indices, found.data, words)


def gaussian(distances, fwhm):
    return np.exp(-4 * np.log(2) * (distances / fwhm) ** 2)


def smoothing_matrix(index, r=None, **words):
    rows = index.smoothing_matrix(r, **words).toarray()
    return rows if words.get("scales") is None else rows.reshape(len(words["scales"]), -1, COUNT)


def columns(found):
    """All arrays of a tuple side by side, after the axes of scales and rows."""
    axes = found[0].ndim
    return np.concatenate([np.asarray(part, float).reshape(*found[0].shape, -1) for part in found], axis=axes)


LISTS = {"neighborhoods": listed, "iter_neighborhoods": iterated, "radius_neighbors_graph": graph}
VALUES_OVER = {
    "aggregate": lambda index, r=None, **words: index.aggregate(VALUES, r, "sum", **words),
    "smooth": lambda index, r=None, **words: index.smooth(VALUES, r, **words),
    "smoothing_matrix": smoothing_matrix,
}
SHAPE = {
    "curvature": lambda index, r=None, **words: columns(index.curvature(r, **words)),
    "corrected_curvature": lambda index, r=None, **words: columns(index.corrected_curvature(r, **words)),
    "moments": lambda index, r=None, **words: index.moments(r, **words),
    "principal_components": lambda index, r=None, **words: columns(index.principal_components(r, **words)),
    "features": lambda index, r=None, **words: index.features(r, kinds=("crease", "area"), **words),
}
COUNTS = {"counts": lambda index, r=None, vertices=None, **words: index.counts(r, vertices, **words)}
CALLS = {**LISTS, **COUNTS, **VALUES_OVER, **SHAPE}
EACH = pytest.mark.parametrize("name", CALLS)


def close(found, wanted):
    np.testing.assert_allclose(found, wanted, rtol=1e-9, atol=1e-11)


@EACH
def test_vertices(name):
    whole = CALLS[name](INDEX, R)
    mask = np.zeros(COUNT, bool)
    mask[[3, 5, 90]] = True
    for rows, places in (([5, 3, 3, 90], [5, 3, 3, 90]), (np.array([7], np.uint8), [7]), (mask, [3, 5, 90])):
        np.testing.assert_array_equal(CALLS[name](INDEX, R, vertices=rows), whole[np.array(places, int)])


@EACH
def test_a_radius_for_each_row(name):
    radii = RANDOM.uniform(1.1, 3, COUNT)
    given = CALLS[name](INDEX, radii)
    for v in range(0, COUNT, 11):
        close(given[v], CALLS[name](INDEX, float(radii[v]), vertices=[v])[0])
    close(CALLS[name](INDEX, radii[[90, 4]], vertices=[90, 4]), given[[90, 4]])


@EACH
def test_scales(name):
    scales = [2.5, 1.5]
    np.testing.assert_array_equal(
        CALLS[name](INDEX, scales=scales, vertices=[4, 90, 7]),
        np.stack([CALLS[name](INDEX, r, vertices=[4, 90, 7]) for r in scales]),
    )


@EACH
def test_walls(name):
    free, found = ~WALLS, CALLS[name](INDEX, R, walls=WALLS)
    close(found[free], CALLS[name](CUT, R)[free])
    for row in found[WALLS]:
        zero_or_nan = (row == 0) | np.isnan(row)
        assert np.all(zero_or_nan | (row == 2)), "2 is the state of a fit without vertices"


@EACH
def test_ignored(name):
    found = CALLS[name](INDEX, R, ignored=IGNORED)
    lists = listed(INDEX, R)
    lists[:, IGNORED] = 0
    if name in LISTS:
        return np.testing.assert_array_equal(found, lists)
    if name == "counts":
        return np.testing.assert_array_equal(found, (lists > 0).sum(axis=1))
    if name == "aggregate":
        return close(found, (lists > 0) @ VALUES)
    if name in ("smooth", "smoothing_matrix"):
        r = meshhood.smoothing_radius(R)
        near = listed(INDEX, r)
        weights = np.where((near > 0) & ~IGNORED, gaussian(near - 1, R), 0)
        weights /= weights.sum(axis=1, keepdims=True)
        return close(found, weights if name == "smoothing_matrix" else weights @ VALUES)
    # Where the same vertices are left, it does not matter whether the others are passed.
    same = (listed(INDEX, R, walls=IGNORED) > 0).sum(axis=1) == (lists > 0).sum(axis=1)
    same &= ~IGNORED
    assert same.sum() > COUNT / 2
    return close(found[same], CALLS[name](INDEX, R, walls=IGNORED)[same])


def lists_by(metric, r):
    """1 + the distance of each vertex of each neighborhood, one vertex at a time."""
    lists = np.zeros((COUNT, COUNT))
    for v in range(COUNT):
        if metric == "path":
            ids, lengths = INDEX.neighborhood(v, r, return_distance=True, metric="path", walls=WALLS, ignored=IGNORED)
        else:
            counts, ids = INDEX.nested(v, range(int(r) + 1), metric="rings", walls=WALLS, ignored=IGNORED)
            lengths = np.repeat(np.arange(len(counts)), np.diff(counts, prepend=0))
        lists[v, ids] = 1 + lengths
    return lists


@pytest.mark.parametrize("metric", ("path", "rings"))
@pytest.mark.parametrize("name", [name for name in CALLS if name not in SHAPE])
def test_metric(name, metric):
    found = CALLS[name](INDEX, R, metric=metric, walls=WALLS, ignored=IGNORED)
    lists = lists_by(metric, meshhood.smoothing_radius(R) if "smooth" in name else R)
    weights = np.where(lists > 0, gaussian(lists - 1, R), 0)
    with np.errstate(invalid="ignore"):
        mean = weights / weights.sum(axis=1, keepdims=True)
    wanted = {
        "counts": lambda: (lists > 0).sum(axis=1),
        "aggregate": lambda: (lists > 0) @ VALUES,
        "smooth": lambda: mean @ VALUES,
        "smoothing_matrix": lambda: np.nan_to_num(mean),
    }.get(name, lambda: lists)()
    close(found, wanted)


# The columns that do not depend on signs or equal variances.
OF_SHAPE = {"curvature": 2, "corrected_curvature": 3, "moments": 10, "principal_components": 7, "features": 2}


@pytest.mark.parametrize("metric", ("path", "rings"))
@pytest.mark.parametrize("name", SHAPE)
def test_metric_of_the_shape(name, metric):
    """As by a ball with all vertices, of which those of no neighborhood are ignored."""
    found = CALLS[name](INDEX, R, metric=metric, walls=WALLS, ignored=IGNORED)
    lists, compared, large = lists_by(metric, R), 0, 1e3
    for v in range(0, COUNT, 3):
        if (lists[v] > 0).sum() < 6:  # a fit would be extended
            continue
        wanted = CALLS[name](INDEX, large, vertices=[v], ignored=lists[v] == 0)[0]
        if name == "features":
            r = R * INDEX.mean_edge_length if metric == "rings" else R
            wanted = wanted * [r / large, (large / r) ** 2]
        np.testing.assert_allclose(found[v][: OF_SHAPE[name]], wanted[: OF_SHAPE[name]], rtol=1e-7, atol=1e-9)
        compared += 1
    assert compared > 20


@EACH
def test_rings_have_no_unit(name):
    with pytest.raises(ValueError, match="unit: expected 'mesh' with metric='rings'"):
        CALLS[name](INDEX, 2, metric="rings", unit="edge")


@EACH
def test_unit(name):
    edge = INDEX.mean_edge_length
    close(CALLS[name](INDEX, 2.0, unit="edge"), CALLS[name](INDEX, 2.0 * edge))
    close(CALLS[name](INDEX, scales=[1.5], unit="edge"), CALLS[name](INDEX, scales=[1.5 * edge]))


@EACH
def test_workers_and_progress(name):
    reports = []
    words = {"walls": WALLS, "scales": [1.5, 2.5]}
    if name == "iter_neighborhoods":  # whose caller sees how far it is
        found = CALLS[name](INDEX, workers=3, **words)
    else:
        found = CALLS[name](INDEX, workers=3, progress=lambda done, total: reports.append((done, total)), **words)
        assert reports[-1][0] == reports[-1][1] > 0 and reports == sorted(reports)
    np.testing.assert_array_equal(found, CALLS[name](INDEX, workers=1, **words))


@pytest.mark.parametrize("name", (*LISTS, *VALUES_OVER))
def test_dtype(name):
    single, double = (CALLS[name](INDEX, R, dtype=dtype) for dtype in (np.float32, np.float64))
    np.testing.assert_allclose(single, double, rtol=1e-6, atol=1e-6)
    assert (single != double).any()


@pytest.mark.parametrize("name", SHAPE)
def test_dtype_of_the_shape(name):
    call = getattr(INDEX, name)
    single, double = call(0.9 * R, dtype=np.float32), call(0.9 * R)
    for found, wanted in zip(*((a,) if isinstance(a, np.ndarray) else a for a in (single, double))):
        assert found.dtype == (np.float32 if wanted.dtype == np.float64 else wanted.dtype)
        np.testing.assert_array_equal(found, wanted.astype(found.dtype))


@pytest.mark.parametrize("sort", ("index", "id", "distance"))
@pytest.mark.parametrize("name", ("neighborhoods", "iter_neighborhoods"))
def test_sort(name, sort):
    place = np.argsort(INDEX.permutation)
    words = {"walls": WALLS, "return_distance": True, "sort": sort}
    if name == "neighborhoods":
        indptr, ids, distances = INDEX.neighborhoods(R, **words)
    else:
        ((_, indptr, ids, distances),) = INDEX.iter_neighborhoods(R, chunk=COUNT, **words)
    for begin, end in zip(indptr[:-1], indptr[1:]):
        keys = {"id": ids, "index": place[ids], "distance": distances}[sort][begin:end]
        assert list(keys) == sorted(keys)


def test_nearest_vertices_take_the_words_too():
    """`k_nearest` and `nearest_unconnected` have rows, metrics, masks, units and workers."""
    for call in (
        lambda **words: INDEX.k_nearest(9, words.pop("vertices", None), **words)[1],
        lambda **words: INDEX.nearest_unconnected(words.pop("r", 0.5), words.pop("vertices", None), **words)[1],
    ):
        whole = call(walls=WALLS, ignored=IGNORED, workers=1)
        np.testing.assert_array_equal(call(vertices=[5, 3, 3], walls=WALLS, ignored=IGNORED, workers=2), whole[[5, 3, 3]])
        assert np.isinf(whole[WALLS]).all()
        edge = INDEX.mean_edge_length
        np.testing.assert_array_equal(call(r=0.5, unit="edge"), call(r=0.5 * edge))
        with pytest.raises(ValueError, match="metric: 'ring', expected 'straight'"):
            call(metric="ring")
