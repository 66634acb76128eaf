# SPDX-License-Identifier: MIT
"""The arguments that calls on many vertices share mean the same in each: rows, radii, scales, masks, metric, order."""

import inspect
import pickle

import meshes
import meshhood
import numpy as np
import oracle
import pytest
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra

V, F = meshes.two_plates(9)
INDEX = meshhood.MeshIndex(V, F)
COUNT = len(V)
RANDOM = np.random.default_rng(5)
VALUES = RANDOM.normal(size=(COUNT, 2))
WALLS, IGNORED = RANDOM.random(COUNT) < 0.15, RANDOM.random(COUNT) < 0.1
MASKS = {"walls": WALLS, "ignored": IGNORED}

# Each call with rows and radii; the result is an array, or several.
CALLS = {
    "counts": lambda r=None, **words: INDEX.counts(r, **words),
    "aggregate": lambda r=None, **words: INDEX.aggregate(VALUES, r, "sum", **words),
    "maximum": lambda r=None, **words: INDEX.aggregate(VALUES, r, "max", **words),
    "variance": lambda r=None, **words: INDEX.aggregate(VALUES, r, "var", **words),
    "kernel": lambda r=None, **words: INDEX.aggregate(VALUES, r, kernel="biweight", **words),
    "curvature": lambda r=None, **words: INDEX.curvature(r, **words),
    "corrected": lambda r=None, **words: INDEX.corrected_curvature(r, **words),
    "moments": lambda r=None, **words: INDEX.moments(r, **words),
    "components": lambda r=None, **words: INDEX.principal_components(r, **words),
    "features": lambda r=None, **words: INDEX.features(r, kinds=("area", "crease"), **words),
}
PATH_CALLS = ("counts", "aggregate", "maximum", "variance", "kernel")


def arrays(result):
    return result if isinstance(result, tuple) else (result,)


def rows_of(indptr, *columns):
    return [tuple(column[begin:end] for column in columns) for begin, end in zip(indptr[:-1], indptr[1:])]


def edges_without(walls):
    kept = INDEX_EDGES[~walls[INDEX_EDGES].any(axis=1)]
    both = np.concatenate([kept, kept[:, ::-1]])
    return csr_array((np.ones(len(both)), both.T), shape=(COUNT, COUNT))


def _edges():
    sides = np.concatenate([F[:, [0, 1]], F[:, [1, 2]], F[:, [2, 0]]])
    return np.unique(np.sort(sides, axis=1), axis=0)


INDEX_EDGES = _edges()


@pytest.mark.parametrize("name", CALLS)
def test_scales_are_a_leading_axis(name):
    call = CALLS[name]
    both = arrays(call(scales=[1.5, 2.5]))
    for i, r in enumerate((1.5, 2.5)):
        for one, all_scales in zip(arrays(call(r)), both):
            np.testing.assert_array_equal(all_scales[i], one)
    for one, single in zip(arrays(call(1.5)), arrays(call(scales=[1.5]))):
        assert single.shape == (1, *one.shape)


@pytest.mark.parametrize("name", CALLS)
def test_vertices_are_the_rows(name):
    call, some = CALLS[name], [5, 3, 3]
    mask = np.zeros(COUNT, bool)
    mask[[3, 5]] = True
    for whole, rows, masked in zip(*(arrays(call(2.5, vertices=rows)) for rows in (None, some, mask))):
        np.testing.assert_array_equal(rows, whole[some])
        np.testing.assert_array_equal(masked, whole[[3, 5]])


@pytest.mark.parametrize("name", CALLS)
def test_one_radius_for_each_row(name):
    call, radii = CALLS[name], RANDOM.uniform(1.2, 3, COUNT)
    given = arrays(call(radii))
    for v in range(0, COUNT, 7):
        for column, one in zip(given, arrays(call(float(radii[v]), vertices=[v]))):
            np.testing.assert_allclose(column[v], one[0], rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("name", CALLS)
def test_a_list_of_another_length_is_never_guessed(name):
    with pytest.raises(ValueError, match="several radii for all rows are scales="):
        CALLS[name]([1.0, 2.0])
    with pytest.raises(ValueError, match="scales: expected a list"):
        CALLS[name](scales=2.0)
    with pytest.raises(TypeError, match="r: missing, expected a number"):
        CALLS[name]()


@pytest.mark.parametrize("name", PATH_CALLS)
def test_masks_give_what_a_mesh_without_the_walls_gives(name):
    found = arrays(CALLS[name](2.5, walls=WALLS))
    graph = edges_without(WALLS)
    alone = meshhood.MeshIndex(V, graph)
    free = ~WALLS
    for column, wanted in zip(found, arrays(_with(alone, name, 2.5))):
        np.testing.assert_allclose(column[free], wanted[free], rtol=1e-9, atol=1e-12)


def _with(index, name, r):
    if name == "counts":
        return index.counts(r)
    reduce = {"aggregate": "sum", "maximum": "max", "variance": "var", "kernel": "mean"}[name]
    return index.aggregate(VALUES, r, reduce, kernel="biweight" if name == "kernel" else None)


@pytest.mark.parametrize("metric", ("straight", "path"))
def test_batches_with_masks_are_single_queries_with_masks(metric):
    words = {**MASKS, "metric": metric, "return_distance": True, "sort": "id"}
    many = rows_of(*INDEX.neighborhoods(2.5, **words))
    for v, (ids, distances) in enumerate(many):
        one = INDEX.neighborhood(v, 2.5, **words)
        np.testing.assert_array_equal(ids, one[0])
        np.testing.assert_array_equal(distances, one[1])
        np.testing.assert_array_equal(ids, INDEX.neighborhood(v, 2.5, **MASKS, metric=metric, sort="id"))
        assert not (WALLS | IGNORED)[ids].any()
    np.testing.assert_array_equal(INDEX.counts(2.5, **MASKS, metric=metric), [len(ids) for ids, _ in many])


@pytest.mark.parametrize("name", ("aggregate", "maximum", "variance", "kernel", "moments"))
@pytest.mark.parametrize("metric", ("straight", "path", "rings"))
def test_masks_and_metrics_in_values(name, metric):
    found = CALLS[name](2.5, **MASKS, metric=metric)
    listed = rows_of(*INDEX.neighborhoods(2.5, return_distance=True, **MASKS, metric=metric))
    for v, (ids, distances) in enumerate(listed):
        if name == "moments":
            assert found[v, 0] == len(ids)
            np.testing.assert_allclose(found[v, 1:4], (V[ids].astype(float) - V[v]).sum(axis=0), atol=1e-9)
            continue
        if not len(ids):
            assert np.all(found[v] == 0) if name == "aggregate" else np.isnan(found[v]).all()
            continue
        weights = (1 - (distances / 2.5) ** 2) ** 2
        wanted = {
            "aggregate": lambda x: x.sum(axis=0),
            "maximum": lambda x: x.max(axis=0),
            "variance": lambda x: x.var(axis=0),
            "kernel": lambda x: np.average(x, axis=0, weights=weights),
        }[name](VALUES[ids])
        np.testing.assert_allclose(found[v], wanted, rtol=1e-9, atol=1e-12)


def test_rows_of_all_scales_follow_each_other():
    indptr, indices, distances = INDEX.neighborhoods(vertices=[4, 9], scales=[1.0, 2.0], return_distance=True)
    assert len(indptr) == 5
    for (ids, lengths), (v, r) in zip(rows_of(indptr, indices, distances), ((4, 1.0), (9, 1.0), (4, 2.0), (9, 2.0))):
        one = INDEX.neighborhood(v, r, return_distance=True)
        np.testing.assert_array_equal(ids, one[0])
        np.testing.assert_array_equal(lengths, one[1])
    assert INDEX.counts(scales=[1.0, 2.0], vertices=4).tolist() == [len(INDEX.neighborhood(4, r)) for r in (1.0, 2.0)]
    graph = INDEX.radius_neighbors_graph(scales=[1.0, 2.0], vertices=[4, 9])
    assert graph.shape == (4, COUNT) and graph.nnz == len(indices)
    with pytest.raises(MemoryError, match="max_bytes"):
        INDEX.neighborhoods(scales=[1.0, 2.0], max_bytes=4 * int(INDEX.counts(2.0).sum()))


@pytest.mark.parametrize("metric", ("straight", "path"))
@pytest.mark.parametrize("method", ("exact", "paper", "bfs", "ball"))
def test_sort(method, metric):
    if metric == "path" and method != "exact":
        return
    place = np.argsort(INDEX.permutation)
    words = {"method": method, "metric": metric, "return_distance": True}
    whole = rows_of(*INDEX.neighborhoods(2.5, **words))
    keys_of = {"id": lambda i, d: i, "index": lambda i, d: place[i], "distance": lambda i, d: list(zip(d, i))}
    for sort, key in keys_of.items():
        rows = rows_of(*INDEX.neighborhoods(2.5, sort=sort, **words))
        for v, ((ids, distances), (all_ids, _)) in enumerate(zip(rows, whole)):
            assert sorted(ids) == sorted(all_ids)
            keys = [tuple(k) if isinstance(k, tuple) else k for k in key(ids, distances)]
            assert keys == sorted(keys)
            np.testing.assert_array_equal(INDEX.neighborhood(v, 2.5, sort=sort, method=method, metric=metric), ids)
    with pytest.raises(ValueError, match="sort: True, expected 'index' or 'id' or 'distance'"):
        INDEX.neighborhood(0, 1.0, sort=True)


def test_path_distances_are_those_of_dijkstra():
    lengths = np.linalg.norm(V[INDEX_EDGES[:, 0]].astype(float) - V[INDEX_EDGES[:, 1]], axis=1)
    matrix = csr_array((lengths, INDEX_EDGES.T), shape=(COUNT, COUNT))
    expected = dijkstra(matrix, directed=False, limit=2.5)
    graph = INDEX.radius_neighbors_graph(2.5, metric="path", mode="distance")
    assert graph.nnz == np.isfinite(expected).sum()
    np.testing.assert_allclose(graph.data, expected[np.repeat(np.arange(COUNT), np.diff(graph.indptr)), graph.indices])


def test_types():
    single, double = VALUES.astype(np.float32), VALUES
    assert INDEX.aggregate(single, 2.0).dtype == INDEX.smooth(single, 2.0).dtype == np.float32
    np.testing.assert_array_equal(
        INDEX.aggregate(single, 2.0), INDEX.aggregate(single.astype(float), 2.0).astype(np.float32)
    )
    assert INDEX.aggregate(single, 2.0, dtype=np.float64).dtype == INDEX.aggregate(double, 2.0).dtype == np.float64
    assert INDEX.aggregate(VALUES.astype(int), 2.0).dtype == np.float64
    indptr, indices, distances = INDEX.neighborhoods(2.0, return_distance=True, dtype="float32")
    assert (indptr.dtype, indices.dtype, distances.dtype) == (np.int32, np.int32, np.float32)
    graph = INDEX.radius_neighbors_graph(2.0, dtype=np.float32)
    assert (graph.indptr.dtype, graph.indices.dtype, graph.data.dtype) == (np.int32, np.int32, np.float32)
    with pytest.raises(ValueError, match="dtype: int32, expected float32 or float64"):
        INDEX.aggregate(VALUES, 2.0, dtype=np.int32)


def test_the_graph_has_the_rows_that_are_asked():
    whole, some = INDEX.radius_neighbors_graph(2.0), INDEX.radius_neighbors_graph(2.0, vertices=[7, 2, 7])
    assert some.shape == (3, COUNT)
    assert (some != whole[[7, 2, 7]]).nnz == 0


@pytest.mark.parametrize("metric", ("straight", "path"))
@pytest.mark.parametrize("weights", (None, "area"))
def test_the_smoothing_matrix_smooths(metric, weights):
    words = {"metric": metric, "weights": weights, **MASKS}
    matrix = INDEX.smoothing_matrix(2.0, **words)
    smooth = INDEX.smooth(VALUES, 2.0, **words)
    alone = np.diff(matrix.indptr) == 0
    np.testing.assert_allclose((matrix @ VALUES)[~alone], smooth[~alone], rtol=1e-11, atol=1e-13)
    assert np.isnan(smooth[alone]).all() and alone.any()
    np.testing.assert_allclose(matrix.sum(axis=1)[~alone], 1)


def test_many_channels_are_each_channel_by_itself():
    many = RANDOM.normal(size=(COUNT, 70))
    many[3, 5] = np.nan
    for words in ({}, {"weights": "area"}, {"nan": "omit"}, MASKS, {"vertices": [5, 3, 3]}):
        together = INDEX.smooth(many, 2.0, **words)
        for channel in (0, 5, 69):
            alone = INDEX.smooth(many[:, channel], 2.0, **words)
            np.testing.assert_allclose(together[:, channel], alone, rtol=1e-11, atol=1e-13)


def test_two_banks_are_not_mixed_along_paths():
    """Two banks, 5 deep and 1 apart, joined at the bottom; a signal on one of them."""
    width = 10
    profile = [(0, 5 - i) for i in range(5)] + [(0, 0), (1, 0)] + [(1, i + 1) for i in range(5)]
    points = np.array([(x, y, z) for x, z in profile for y in range(width)], float)
    corner = (np.arange(len(profile) - 1)[:, None] * width + np.arange(width - 1)).ravel()
    quads = np.column_stack([corner, corner + 1, corner + width + 1, corner + width])
    index = meshhood.MeshIndex(points, quads)
    signal = (points[:, 0] == 0).astype(float)
    top = (points[:, 0] == 1) & (points[:, 2] == 5)
    straight, path = (index.smooth(signal, 6.0, metric=metric)[top].max() for metric in ("straight", "path"))
    assert straight > 0.4
    assert path < 0.02


def test_progress_ascends_over_all_scales():
    for call in (
        lambda watch: INDEX.curvature(scales=[1.0, 2.0, 3.0], progress=watch),
        lambda watch: INDEX.counts(scales=[1.0, 2.0, 3.0], progress=watch),
        lambda watch: INDEX.neighborhoods(scales=[1.0, 2.0], progress=watch),
        lambda watch: INDEX.corrected_curvature(scales=[1.0, 2.0], progress=watch),
        lambda watch: INDEX.aggregate(VALUES, scales=[1.0, 2.0], progress=watch),
        lambda watch: INDEX.features(scales=[1.0, 2.0], kinds=("area", "crease"), progress=watch),
    ):
        reports = []
        call(lambda done, total: reports.append((done, total)))
        done, totals = zip(*reports)
        assert list(done) == sorted(done)
        assert set(totals) == {done[-1]}


def test_a_bar_has_a_title_and_counts_vertices(monkeypatch):
    tqdm = pytest.importorskip("tqdm.auto")
    bars = []

    class Bar(tqdm.tqdm):
        def __init__(self, *arguments, **words):
            super().__init__(*arguments, **words, disable=False)
            bars.append(self)

    monkeypatch.setattr(tqdm, "tqdm", Bar)
    INDEX.neighborhoods(scales=[1.0, 2.0], progress=True)
    INDEX.curvature(2.0, progress=True)
    meshhood.MeshIndex(V, F, progress=True)
    assert [(bar.desc.rstrip(": "), bar.unit.strip()) for bar in bars] == [
        ("neighborhoods", "vertices"), ("curvature", "vertices"), ("MeshIndex", "steps"),
    ]  # fmt: skip
    assert [(bar.n, bar.total) for bar in bars[:2]] == [(2 * COUNT, 2 * COUNT), (COUNT, COUNT)]


@pytest.mark.parametrize(
    ("call", "message"),
    (
        (lambda: INDEX.neighborhood([100, 120, 130], 5.0), r"start: integers .*neighborhoods\(r, vertices\)"),
        (lambda: INDEX.neighborhood(np.array([1, 2, 3]), 5.0), r"start: integers .*neighborhoods\(r, vertices\)"),
        (lambda: INDEX.nearest_connected([100, 120, 130], 5), r"start: integers .*k_nearest\(k, vertices\)"),
        (lambda: INDEX.nearest_connected([1, 2], 100), r"start: integers .*k_nearest\(k, vertices\)"),
        (lambda: INDEX.nested([1, 2, 3], [1.0, 2.0]), r"start: integers .*scales=radii"),
        (lambda: INDEX.contains([1, 2, 3], 4, 1.0), "start: integers"),
    ),
)
def test_vertices_are_not_taken_for_a_point(call, message):
    with pytest.raises(TypeError, match=message):
        call()


def test_errors_blame_the_argument_at_fault():
    with pytest.raises(ValueError, match=r"vertices: .* faces are passed as F="):
        INDEX.curvature(5.0, F)
    with pytest.raises(ValueError, match="method: 'bfs', expected 'exact' with walls"):
        INDEX.counts(1.0, walls=WALLS, method="bfs")
    with pytest.raises(TypeError, match="walls: .* numbers 0 or 1, expected a bool mask, or vertices"):
        INDEX.counts(1.0, walls=WALLS.astype(int))
    with pytest.raises(ValueError, match="walls: "):
        INDEX.counts(1.0, walls=[COUNT])


def test_masks_are_also_lists_of_vertices():
    words = {"walls": np.flatnonzero(WALLS), "ignored": np.flatnonzero(IGNORED).tolist()}
    np.testing.assert_array_equal(INDEX.counts(2.5, **words), INDEX.counts(2.5, **MASKS))
    np.testing.assert_array_equal(INDEX.neighborhood(4, 2.5, **words), INDEX.neighborhood(4, 2.5, **MASKS))
    np.testing.assert_array_equal(INDEX.counts(2.5, walls=[], ignored=()), INDEX.counts(2.5))


def test_an_index_with_masks_has_the_attributes_of_a_subclass():
    class Named(meshhood.MeshIndex):
        pass

    index = Named(V, F)
    index.name = "left"
    assert index.masked(walls=[3]).name == "left"



def test_an_index_with_masks_answers_as_calls_with_them():
    index = INDEX.masked(**MASKS)
    for metric in ("straight", "path", "rings"):
        np.testing.assert_array_equal(index.counts(2, metric=metric), INDEX.counts(2, metric=metric, **MASKS))
    np.testing.assert_array_equal(index.curvature(2.5).k1, INDEX.curvature(2.5, **MASKS).k1)
    np.testing.assert_array_equal(index.neighborhood(4, 2.5), INDEX.neighborhood(4, 2.5, **MASKS))
    assert index.mean_edge_length == INDEX.mean_edge_length
    np.testing.assert_array_equal(index.counts(2, unit="edge"), INDEX.counts(2, unit="edge", **MASKS))
    for refused, message in (
        (lambda: index.counts(2, walls=WALLS), "walls, ignored: expected None, because this index has masks"),
        (lambda: index.masked(ignored=[1]), "masked again"),
        (lambda: index.refit(V), "not refitted"),
        (lambda: pickle.dumps(index), "not saved"),
        (lambda: index.counts(2, method="bfs"), "method: 'bfs', expected 'exact' with walls"),
        (lambda: index.count(3, 2, method="ball"), "method: 'ball', expected 'exact' with walls"),
    ):
        with pytest.raises(ValueError, match=message):
            refused()


def test_masks_whose_content_changes_are_other_masks():
    walls = np.zeros(COUNT, bool)
    for v in (3, 9, 30):
        walls[v] = True
        assert INDEX.count(v, 2.5, walls=walls) == 0
        walls[v] = False
        assert INDEX.count(v, 2.5, walls=walls) == INDEX.count(v, 2.5)


# Each call that takes faces.
WITH_FACES = {
    "aggregate": lambda index, F: index.aggregate(VALUES, 2.0, weights="area", F=F),
    "smooth": lambda index, F: index.smooth(VALUES, 2.0, weights="area", F=F),
    "smoothing_matrix": lambda index, F: index.smoothing_matrix(2.0, weights="area", F=F).toarray(),
    "curvature": lambda index, F: index.curvature(2.0, F=F),
    "corrected_curvature": lambda index, F: index.corrected_curvature(2.0, F=F),
    "moments": lambda index, F: index.moments(2.0, weights="area", F=F),
    "principal_components": lambda index, F: index.principal_components(2.0, weights="area", F=F),
    "features": lambda index, F: index.features(2.0, kinds=("area", "crease"), F=F),
    "invariants": lambda index, F: index.invariants(2.0, F=F),
    "gaps": lambda index, F: index.gaps(2.0, F=F),
    "patch": lambda index, F: index.patch(40, 2.0, F=F),
    "closest_point": lambda index, F: index.closest_point(V[:20] + 0.1, F=F),
    "first_hit": lambda index, F: index.first_hit(V[:20] + [0, 0, 3], np.tile([0.01, 0, -1], (20, 1)), F=F),
    "thickness": lambda index, F: index.thickness(F=F),
    "discs": lambda index, F: index.discs(3.0, F=F),
    "submesh": lambda index, F: index.submesh([0, 1, 2, 9, 10, 11], F=F),
    "rim": lambda index, F: [line.points for line in index.rim(INDEX.neighborhood(40, 2.0), 40, 2.0, F=F)],
}


def test_each_call_that_takes_faces_is_listed():
    methods = inspect.getmembers(meshhood.MeshIndex, inspect.isfunction)
    taking = {name for name, method in methods if "F" in inspect.signature(method).parameters and name[0] != "_"}
    assert taking == set(WITH_FACES)


@pytest.mark.parametrize("name", WITH_FACES)
def test_faces_of_another_mesh_are_refused(name):
    call = WITH_FACES[name]
    other = np.concatenate([F[:, [1, 0, 2]][::-1][:-1], [[0, 5, 40]]])
    bare = meshhood.MeshIndex(V, F, keep_faces=False)
    for index in (INDEX, bare):
        for wrong in (other, (F + 7) % COUNT):
            with pytest.raises(ValueError, match="F: faces of another mesh: one joins vertices"):
                call(index, wrong)
        with pytest.raises(ValueError, match=f"F: .*vertex {COUNT}"):
            call(index, np.concatenate([F, [[0, 1, COUNT]]]))
        for a, b in zip(arrays(call(INDEX, None)), arrays(call(index, meshhood.Mesh(V, F)))):
            np.testing.assert_array_equal(a, b)
        call(index, F[::-1])
    with pytest.raises(ValueError, match="F: expected the faces"):
        call(bare, None)
    call(meshhood.MeshIndex(V, F, cut=F[:5, :2], keep_faces=False), F)


def test_a_region_as_a_mesh_needs_no_faces():
    ids = INDEX.neighborhood(40, 2.0)
    wanted, found = meshhood.RegionMesh(V, F).submesh(ids), INDEX.submesh(ids)
    for a, b in zip(wanted, found):
        np.testing.assert_array_equal(a, b)
    assert len(INDEX.rim(ids, 40, 2.0)) == 1
    bare = meshhood.MeshIndex(V, F, keep_faces=False)
    np.testing.assert_array_equal(bare.submesh(ids, F=F).F, wanted.F)
    with pytest.raises(ValueError, match="F: expected the faces"):
        bare.submesh(ids)


def test_a_curvature_counts_its_vertices():
    found = INDEX.curvature(1.0, filter=False)
    np.testing.assert_array_equal(found.count, INDEX.counts(1.0))
    assert (found.count < 6).any() and not found.ok[found.count < 6].any()
    assert len(repr(found)) < 60 and "ok" in repr(found)


def test_the_representation_has_the_mean_edge_length():
    index = meshhood.MeshIndex(V, F)
    assert "not computed yet" in repr(index)
    assert f"mean edge {index.mean_edge_length:.4g}" in repr(index)


def test_the_radius_of_smoothing():
    assert meshhood.smoothing_radius(2.0) == pytest.approx(np.sqrt(np.log2(1000)), rel=1e-15)


def test_free_memory_is_what_a_control_group_leaves(tmp_path, monkeypatch):
    from meshhood import _memory

    (tmp_path / "memory.max").write_text("max\n")
    inner = tmp_path / "job"
    inner.mkdir()
    (inner / "memory.max").write_text("5000000\n")
    (inner / "memory.current").write_text("3000000\n")
    (inner / "memory.stat").write_text("anon 7\ninactive_file 500000\n")

    def left(name):
        return list(_memory._left(str(tmp_path), name, "memory.max", "memory.current", "inactive_file"))

    assert left("/job") == left("/job/") == left("/job/part") == [2_500_000]
    assert left("/") == left("/other") == []
    (tmp_path / "memory.max").write_text(f"{2**63 - 4096}\n")  # that of no limit in version 1
    assert left("/job") == [2_500_000]
    (tmp_path / "memory.max").write_text("9000\n")
    (tmp_path / "memory.current").write_text("1000\n")
    (tmp_path / "memory.stat").write_text("anon 7\n")
    assert left("/job") == [2_500_000, 8000]
    assert left("/") == [8000]
    monkeypatch.setattr(_memory, "_of_control_groups", lambda: iter([1000]))
    assert _memory.free_bytes() == 1000
    with pytest.raises(MemoryError, match=r"\d+ bytes, exceeds max_bytes, 1000; iter_neighborhoods"):
        INDEX.neighborhoods(5.0)
    with pytest.raises(MemoryError, match=r"\d+ bytes, exceeds max_bytes, 1000"):
        INDEX.aggregate(VALUES, 5.0)


def test_a_ball_is_every_vertex_in_space():
    edges = oracle.triangle_graph(COUNT, F)
    for v in range(0, COUNT, 11):
        ids = INDEX.neighborhood(v, 1.1, method="ball", sort="id")
        np.testing.assert_array_equal(ids, np.flatnonzero(oracle.distances(V, v) <= 1.1))
        assert len(ids) >= len(oracle.neighborhood(V, edges, v, 1.1))


@pytest.mark.parametrize("masks", ({}, MASKS), ids=("all", "masks"))
def test_rings_are_a_metric(masks):
    words = {**masks, "metric": "rings", "return_distance": True, "sort": "id"}
    for v, (ids, edges) in enumerate(rows_of(*INDEX.neighborhoods(2, **words))):
        counts, wanted = INDEX.nested(v, range(3), metric="rings", **masks)
        np.testing.assert_array_equal(ids, np.sort(wanted))
        number = dict(zip(wanted, np.repeat(np.arange(len(counts)), np.diff(counts, prepend=0))))
        assert edges.tolist() == [number[i] for i in ids]
        np.testing.assert_array_equal(INDEX.neighborhood(v, 2, **words)[0], ids)
        np.testing.assert_array_equal(INDEX.neighborhood(v, 2, **words)[0], ids)
    with pytest.raises(ValueError, match="unit: expected 'mesh' with metric='rings'"):
        INDEX.counts(2, metric="rings", unit="edge")
