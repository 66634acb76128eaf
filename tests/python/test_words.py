# SPDX-License-Identifier: MIT
"""Arguments that calls share: what is refused, masks, faces, types. test_pairs.py has their answers, in all pairs."""

import inspect
import pickle

import meshes
import meshhood
import numpy as np
import pytest

V, F = meshes.two_plates(9)
INDEX = meshhood.MeshIndex(V, F)
COUNT = len(V)
RANDOM = np.random.default_rng(5)
VALUES = RANDOM.normal(size=(COUNT, 2))
WALLS, IGNORED = RANDOM.random(COUNT) < 0.15, RANDOM.random(COUNT) < 0.1
MASKS = {"walls": WALLS, "ignored": IGNORED}

def arrays(result):
    return result if isinstance(result, tuple) else (result,)


@pytest.mark.parametrize("name", ("counts", "curvature", "corrected_curvature", "moments", "principal_components", "features"))
def test_a_list_of_another_length_is_never_guessed(name):
    call = getattr(INDEX, name)
    with pytest.raises(ValueError, match="several radii for all rows are scales="):
        call([1.0, 2.0])
    with pytest.raises(ValueError, match="scales: expected a list"):
        call(scales=2.0)
    with pytest.raises(TypeError, match="r: missing, expected a number"):
        call()


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


@pytest.mark.parametrize("number", (int, np.uint8, float))
@pytest.mark.parametrize("argument", ("vertices", "walls", "ignored"))
def test_a_mask_of_numbers_is_refused(argument, number):
    for mask in (WALLS, np.zeros(COUNT, bool), np.ones(COUNT, bool)):
        with pytest.raises(TypeError, match=f"{argument}: {COUNT} numbers 0 or 1, .* a bool mask: {argument} == 1"):
            INDEX.counts(1.0, **{argument: mask.astype(number)})
    assert len(INDEX.counts(1.0, [0, 1] * COUNT)) == 2 * COUNT
    with pytest.raises(TypeError, match=f"{argument}: {COUNT} numbers 0 or 255, .* a bool mask: {argument} == 255"):
        INDEX.counts(1.0, **{argument: WALLS * number(255)})
    for name, call in (
        ("ids", INDEX.submesh),
        ("ids", lambda mask: INDEX.rim(mask, 0, 1.0)),
        ("changed", lambda mask: INDEX.refit(V, mask)),
        ("seeds", lambda mask: INDEX.neighborhood(V[0], 1.0, seeds=mask)),
    ):
        with pytest.raises(TypeError, match=f"^{name}: .* a bool mask"):
            call(WALLS.astype(number))


def test_a_list_of_vertices_may_look_like_a_mask():
    index = meshhood.MeshIndex(V[:3], [[0, 1, 2]])
    np.testing.assert_array_equal(index.counts(99, [0, 1, 1]), [3, 3, 3])
    smooth = index.smooth([1.0, 2, 3], 9)
    np.testing.assert_array_equal(index.smooth([1.0, 2, 3], 9, vertices=(0, 2, 2)), smooth[[0, 2, 2]])
    np.testing.assert_array_equal(np.sort(index.neighborhood(V[0], 99, seeds=[0, 0, 1])), [0, 1, 2])
    np.testing.assert_array_equal(index.refit(V[:3] + 1, [0, 0, 1]).positions, V[:3] + [[1], [1], [0]])
    np.testing.assert_array_equal(index.counts(99, walls=[0, 1, 0]), [0, 0, 1])
    assert len(index.submesh((0, 1, 1), "any").faces) == 1


def test_the_points_and_seeds_of_a_stroke_repeat_as_they_like():
    rows = np.arange(COUNT) % 2
    wanted = INDEX.stroke(V[:2], 1.5, seeds=[0, 1])
    np.testing.assert_array_equal(INDEX.stroke(V[rows], 1.5, seeds=rows), wanted)
    np.testing.assert_array_equal(INDEX.stroke(rows, 1.5), wanted)


def test_the_smoothing_matrix_has_the_form_of_scipy():
    INDEX.smoothing_matrix(scales=[0.7, 1.9], **MASKS).check_format(full_check=True)


@pytest.mark.parametrize("kind", (list, tuple))
def test_empty_rows_of_a_smoothing_matrix_are_those_of_the_vertices(kind):
    rows, walls = np.array([4, 0, 40]), [0, 40]
    wanted = INDEX.smoothing_matrix(scales=[1.0, 2.0], vertices=rows, walls=walls).toarray()
    found = INDEX.smoothing_matrix(scales=[1.0, 2.0], vertices=kind(rows.tolist()), walls=walls).toarray()
    np.testing.assert_array_equal(found, wanted)


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
    for metric in ("straight", "path", "rings", "space"):
        np.testing.assert_array_equal(index.counts(2, metric=metric), INDEX.counts(2, metric=metric, **MASKS))
    np.testing.assert_array_equal(index.curvature(2.5).k1, INDEX.curvature(2.5, **MASKS).k1)
    np.testing.assert_array_equal(index.neighborhood(4, 2.5), INDEX.neighborhood(4, 2.5, **MASKS))
    assert index.mean_edge_length == INDEX.mean_edge_length
    np.testing.assert_array_equal(index.counts(2, unit="edge"), INDEX.counts(2, unit="edge", **MASKS))
    for refused, message in (
        (lambda: index.counts(2, walls=WALLS), "walls, ignored: expected None, because this index has masks"),
        (lambda: index.masked(ignored=[1]), "masked again"),
        (lambda: index.refit(V), "^an index with masks is not refitted"),
        (lambda: pickle.dumps(index), "^an index with masks is not pickled"),
        (lambda: index.counts(2, method="bfs"), "method: 'bfs', expected 'exact' or 'ball' with walls"),
    ):
        with pytest.raises(ValueError, match=message):
            refused()


# Each call that takes walls. The vertex nearest to the point is one, so that a search starts at another.
BESIDE = V[40] + [0.1, 0.1, -0.2]
AROUND = {"walls": WALLS | (np.arange(COUNT) == 40)}
METRICS = ("straight", "path", "surface", "space")
WITH_WALLS = {
    "neighborhood": lambda index, **walls: [
        *(index.neighborhood(BESIDE, 2.5, metric=each, **walls) for each in METRICS),
        index.neighborhood(V[F[20]].mean(axis=0), 2.5, face=20, **walls),
    ],
    "count": lambda index, **walls: index.count(BESIDE, 2.5, **walls),
    "stroke": lambda index, **walls: [
        index.stroke([BESIDE, V[3]], 1.5, **walls),
        index.stroke(V[F[:20:9]].mean(axis=1), 1.5, face=np.arange(0, 20, 9), **walls),
    ],
    "nested": lambda index, **walls: index.nested(BESIDE, [1.5, 2.5], **walls),
    "contains": lambda index, **walls: [index.contains(BESIDE, w, 2.5, **walls) for w in range(COUNT)],
    "connecting_radius": lambda index, **walls: [index.connecting_radius(BESIDE, w, **walls) for w in range(COUNT)],
    "nearest_connected": lambda index, **walls: index.nearest_connected(BESIDE, 9, **walls),
    "patch": lambda index, **walls: index.patch(V[F[20]].mean(axis=0), 2.5, face=20, **walls),
    "clip": lambda index, **walls: index.clip(V[F[20]].mean(axis=0), 2.5, face=20, **walls),
    "measure": lambda index, **walls: index.measure(V[F[20]].mean(axis=0), 2.5, face=20, **walls),
    "gap": lambda index, **walls: index.gap(V[F[20]].mean(axis=0), 2.5, face=20, **walls),
    "invariants": lambda index, **walls: index.invariants(2.5, **walls),
    "gaps": lambda index, **walls: index.gaps(2.5, **walls),
    "neighborhoods": lambda index, **walls: index.neighborhoods(2.5, **walls),
    "iter_neighborhoods": lambda index, **walls: list(index.iter_neighborhoods(2.5, **walls)),
    "radius_neighbors_graph": lambda index, **walls: index.radius_neighbors_graph(2.5, **walls).toarray(),
    "counts": lambda index, **walls: index.counts(2.5, **walls),
    "k_nearest": lambda index, **walls: index.k_nearest(9, **walls),
    "discs": lambda index, **walls: index.discs(3.0, **walls),
    "nearest_unconnected": lambda index, **walls: index.nearest_unconnected(2.5, **walls),
    "aggregate": lambda index, **walls: index.aggregate(VALUES, 2.5, **walls),
    "smooth": lambda index, **walls: index.smooth(VALUES, 2.5, **walls),
    "smoothing_matrix": lambda index, **walls: [
        index.smoothing_matrix(2.5, vertices=rows, **walls).toarray() for rows in (None, [4, 0, 40])
    ],
    "curvature": lambda index, **walls: index.curvature(2.5, **walls).count,
    "corrected_curvature": lambda index, **walls: index.corrected_curvature(2.5, **walls).area,
    "moments": lambda index, **walls: index.moments(2.5, **walls),
    "principal_components": lambda index, **walls: index.principal_components(2.5, **walls),
    "features": lambda index, **walls: index.features(2.5, kinds="area", **walls),
}


@pytest.mark.parametrize("name", WITH_WALLS)
def test_walls_of_a_call_are_those_of_an_index_with_them(name):
    call = WITH_WALLS[name]
    np.testing.assert_equal(call(INDEX, **AROUND), call(INDEX.masked(**AROUND)))
    with pytest.raises(AssertionError):
        np.testing.assert_equal(call(INDEX, **AROUND), call(INDEX))


def test_each_call_that_takes_walls_is_listed():
    methods = inspect.getmembers(meshhood.MeshIndex, inspect.isfunction)
    taking = {name for name, method in methods if "walls" in inspect.signature(method).parameters and name[0] != "_"}
    assert taking - {"masked"} == set(WITH_WALLS)


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
    "clip": lambda index, F: index.clip(40, 2.0, F=F),
    "measure": lambda index, F: index.measure(40, 2.0, F=F),
    "gap": lambda index, F: index.gap(40, 2.0, F=F),
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
    assert len(INDEX.rim(ids, 40, 2.0)) == 1
    bare = meshhood.MeshIndex(V, F, keep_faces=False)
    np.testing.assert_array_equal(bare.submesh(ids, F=F).faces, np.flatnonzero(np.isin(F, ids).all(axis=1)))
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
    for call in (  # too small to read the free memory for them
        lambda: INDEX.moments(0.5),
        lambda: INDEX.neighborhoods(5.0, [3, 4]),
        lambda: INDEX.k_nearest(20, [3, 4]),
        lambda: INDEX.discs(1.0, [3, 4]),
        lambda: meshhood.MeshIndex.from_points(V[:50], 1.0),
    ):
        assert call() is not None
    with pytest.raises(MemoryError, match=r"\d+ bytes, exceeds max_bytes, 1000; iter_neighborhoods"):
        INDEX.neighborhoods(5.0, np.zeros(2**17, int))
    with pytest.raises(MemoryError, match=r"\d+ bytes, exceeds max_bytes, 1000; take fewer vertices"):
        INDEX.k_nearest(2**17, [3])
    rows = np.zeros(2**17, int)
    for call in (
        lambda: INDEX.aggregate(VALUES, 5.0, vertices=rows),
        lambda: INDEX.curvature(0.5, rows),
        lambda: INDEX.corrected_curvature(0.5, rows),
        lambda: INDEX.moments(0.5, rows, degree=4),
        lambda: INDEX.principal_components(0.5, rows),
        lambda: INDEX.features(vertices=rows, scales=[0.5, 1.0], kinds=("mean", "area", "gap")),
        lambda: INDEX.invariants(0.5, rows),
        lambda: INDEX.gaps(0.5, rows),
    ):
        with pytest.raises(MemoryError, match=r"\d+ bytes, exceeds the free memory, 1000"):
            call()


def test_results_are_described_in_a_line():
    assert repr(INDEX.k_nearest(3)) == f"<meshhood.Nearest: ids {COUNT} by 3, distances {COUNT} by 3>"
    assert repr(INDEX.nested(3, [0.1, 0.2])) == "<meshhood.Nested: counts 2 values, ids 1 value>"
    assert repr(INDEX.nearest_unconnected(0.1, 3)) == "<meshhood.Unconnected: vertex -1, distance inf>"
    assert repr(meshhood.Mesh(V, F)).startswith(f"<meshhood.Mesh: vertices {COUNT} by 3")
    polygons = meshhood.Mesh(V, (np.array([0, 4]), np.arange(4)))
    assert repr(polygons) == f"<meshhood.Mesh: vertices {COUNT} by 3, faces (2 values, 4 values)>"
    assert repr(next(INDEX.iter_neighborhoods(0.1, [3]))).endswith("indices 1 value, distances None>")
