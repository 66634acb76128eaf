# SPDX-License-Identifier: MIT
"""A mesh in parts, on threads and on a cluster of processes."""

import functools
import os
import shutil
import signal
import threading
import time
import types

import meshes
import meshhood
import numpy as np
import pytest
from meshhood import _result_files, distributed

dask = pytest.importorskip("dask")
pytest.importorskip("dask.array")

HALO = 6.5

# Dask leaves sockets to the garbage collector.
pytestmark = pytest.mark.filterwarnings("ignore::ResourceWarning", "ignore::pytest.PytestUnraisableExceptionWarning")


def written(path, V, F):
    meshhood.write_mesh(path, V, F)
    return path


@pytest.fixture(scope="module")
def mesh():
    V, F = meshes.two_plates(60)
    V = np.concatenate([V, [[5, 5, 5], [5, 5, 5]]]).astype(np.float32)  # isolated, at one position
    order = np.random.default_rng(1).permutation(len(V))
    return V[np.argsort(order)], order[F]


@pytest.fixture(scope="module")
def index(mesh):
    return meshhood.MeshIndex(*mesh)


@pytest.fixture(scope="module")
def folder(mesh, tmp_path_factory):
    place = tmp_path_factory.mktemp("mesh")
    meshhood.partition(written(place / "mesh.ply", *mesh), place / "parts", parts=7, halo=HALO)
    return place / "parts"


@pytest.fixture(scope="module")
def parts(folder):
    return meshhood.open_parts(folder)


def copy_of(folder, target):
    shutil.copytree(folder, target)
    return target


def test_parts_describe_the_mesh(parts, index):
    assert parts.n_vertices == len(index)
    assert len(parts) == 7
    assert parts.halo == HALO
    assert parts.mean_edge_length == index.mean_edge_length
    assert sum(size.owned for size in parts.sizes) == len(index)
    assert all(size.vertices > size.owned for size in parts.sizes)


@pytest.mark.parametrize("r", (0, 1, 1.5, 4.25, HALO))
def test_counts_are_those_of_one_index(parts, index, r):
    counts = parts.counts(r)
    assert counts.shape == (len(index),)
    np.testing.assert_array_equal(counts.compute(), index.counts(r))


def test_counts_in_the_order_of_the_parts(parts, index):
    counts = parts.counts(2, unit="edge", order="parts")
    assert counts.chunks == (tuple(size.owned for size in parts.sizes),)
    ids = parts.ids().compute()
    assert sorted(ids) == list(range(len(index)))
    np.testing.assert_array_equal(counts.compute(), index.counts(2, ids, unit="edge"))


def test_a_radius_above_the_halo_is_refused_naming_the_required_halo(parts, tmp_path):
    wider = np.nextafter(HALO, 10)
    for call in (
        lambda: parts.counts(wider),
        lambda: parts.curvature(wider),
        lambda: parts.map(len, wider),
        lambda: parts.neighborhoods(wider, tmp_path / "out"),
        lambda: parts.write(len, wider, tmp_path / "out"),
    ):
        with pytest.raises(ValueError, match=f"halo={wider:.17g}"):
            call()
    assert not (tmp_path / "out").exists()


def sum_of_x(part, index, owned):
    x = index.positions[:, 0].astype(np.float64)
    indptr, indices = index.neighborhoods(HALO, owned, sort="id", workers=1)
    return np.add.reduceat(x[indices], indptr[:-1])


def test_a_function_sees_each_part(parts, index):
    expected = sum_of_x(None, index, np.arange(len(index)))
    np.testing.assert_array_equal(parts.map(sum_of_x, HALO).compute(), expected)


def test_values_of_aggregates_may_lie_in_a_file(parts, index, tmp_path):
    values = np.random.default_rng(2).normal(size=(len(index), 2))
    np.save(tmp_path / "values.npy", values)
    for reduce in ("max", ["min", "median"]):
        found = parts.aggregate(tmp_path / "values.npy", 4.5, reduce).compute()
        np.testing.assert_array_equal(found, index.aggregate(values, 4.5, reduce))


def test_aggregates_refuse_values_of_another_mesh(parts):
    with pytest.raises(ValueError, match="values: an array of shape"):
        parts.aggregate(np.ones(3), 1)
    with pytest.raises(TypeError, match="weights: 'volume'"):
        parts.aggregate(np.ones(parts.n_vertices), 1, weights="volume")
    weights = np.ones(parts.n_vertices)
    weights[1234] = -1
    with pytest.raises(ValueError, match="weights: vertex 1234: -1.0, expected a finite number >= 0"):
        parts.aggregate(weights, 1, weights=weights).compute()
    with pytest.raises(ValueError, match="halo="):
        parts.aggregate(np.ones(parts.n_vertices), 2 * HALO)


@pytest.mark.parametrize("like", (None, "libigl"))
@pytest.mark.parametrize("stretch", (3, 1.2))
def test_a_fit_that_needs_edges_beyond_the_halo_is_refused(tmp_path, stretch, like):
    """Balls of three or five vertices, so that the fit is extended, for the rows at the rim of a part beyond the halo."""
    V, quads = meshes.grid(40)
    V[:, 1] *= stretch
    V[:, 2] = np.cos(V[:, 0] / 3) * np.sin(V[:, 1] / 5)
    V, F, r = V.astype(np.float32), meshes.triangles(quads), 1.5
    expected = meshhood.MeshIndex(V, F).curvature(r, like=like)
    assert (expected.count < 6).all()
    for halo in (r, 6.0):
        parts = meshhood.partition(written(tmp_path / "mesh.ply", V, F), tmp_path / f"{halo}", parts=7, halo=halo)
        k1, k2, _, _, state, count = dask.compute(*parts.curvature(r, like=like))
        refused = state == 5
        print(f"stretch {stretch}, halo {halo}, {like}: {refused.sum()} of {len(V)} rows refused")
        assert np.isnan(k1[refused]).all() and refused.sum() < len(V) / 8
        assert refused.any() or not (stretch == 3 and halo == r)
        assert not refused.any() or halo == r
        np.testing.assert_array_equal(state[~refused], expected.state[~refused])
        np.testing.assert_array_equal(count, expected.count)
        for found, wanted in ((k1, expected.k1), (k2, expected.k2)):  # sums in another order
            np.testing.assert_allclose(found[~refused], wanted[~refused], rtol=0, atol=1e-9)


def ones_too_many(part, index, owned):
    return np.ones(len(owned) + 1)


def test_a_function_with_a_wrong_result_is_named(parts, tmp_path):
    with pytest.raises(ValueError, match="function: an array of shape"):
        parts.map(ones_too_many, 1).compute()
    with pytest.raises(ValueError, match="function: an array of shape"):
        parts.write(ones_too_many, 1, tmp_path / "out")


def corners_of(part, index, owned):
    """The number of faces around each vertex, from the faces of the part."""
    _, faces = part.mesh
    return np.bincount(faces.ravel(), minlength=len(index))[owned]


def measured(r, part, index, owned):
    F = part.mesh
    gaps = index.gaps(r, owned, F=F, workers=1).distance
    sizes = [len(index.patch(int(vertex), r, F=F)) for vertex in owned]
    return np.column_stack([*index.invariants(r, owned, F=F, workers=1), gaps, sizes])


def test_what_is_measured_on_faces_is_that_of_the_whole_mesh(tmp_path):
    """Two sheets with edges longer than the halo, and parts of one vertex: balls reach faces whose corners are all outside."""
    V, quads = meshes.grid(8)
    F = meshes.triangles(quads)
    V, F, r = np.concatenate([V, V + [0.5, 0.4, 0.2]]), np.concatenate([F, F + len(V)]), 0.9
    parts = meshhood.partition(written(tmp_path / "mesh.ply", V, F), tmp_path / "parts", parts=len(V), halo=r)
    found = parts.map(functools.partial(measured, r), r, shape=(4,)).compute()
    expected = measured(r, types.SimpleNamespace(mesh=F), meshhood.MeshIndex(V, F), np.arange(len(V)))
    assert np.isfinite(expected[:, 2]).sum() > len(V) / 2  # of the gaps
    np.testing.assert_allclose(found, expected, rtol=1e-9)


def test_a_part_without_faces_has_no_normals(tmp_path):
    V, F = meshes.two_plates(30)
    V = np.concatenate([V, np.random.default_rng(3).uniform(100, 101, (len(V), 3))])
    parts = meshhood.partition(written(tmp_path / "mesh.ply", V, F), tmp_path / "parts", parts=4, halo=3)
    assert min(size.faces for size in parts.sizes) == 0
    expected = meshhood.MeshIndex(V, F).curvature(2)
    state, count = dask.compute(*parts.curvature(2)[4:])
    np.testing.assert_array_equal(state, expected.state)
    np.testing.assert_array_equal(count, expected.count)
    parts = meshhood.partition(written(tmp_path / "points.ply", V, F[:0]), tmp_path / "points", parts=2, halo=3)
    with pytest.raises(ValueError, match="the mesh has no faces, expected faces"):
        parts.curvature(2)


def test_the_faces_around_every_vertex_are_complete(parts, mesh):
    V, F = mesh
    expected = np.bincount(F.ravel(), minlength=len(V))
    np.testing.assert_array_equal(parts.map(corners_of, 0, dtype=int).compute(), expected)


@pytest.mark.parametrize("format", ("npz", "zarr"))
def test_neighborhoods_are_those_of_one_index(parts, index, tmp_path, format):
    if format == "zarr":
        zarr = pytest.importorskip("zarr", "3")
    paths = parts.neighborhoods(3.5, tmp_path / "out", format=format, return_distance=True)
    rows = 0
    for path in paths:
        found = np.load(path) if format == "npz" else zarr.open_group(path, mode="r")
        vertices, indptr, indices, distances = (
            np.asarray(found[name]) for name in ("vertices", "indptr", "indices", "distances")
        )
        expected = index.neighborhoods(3.5, vertices, sort="id", return_distance=True)
        for one, other in zip((indptr, indices, distances), expected):
            np.testing.assert_array_equal(one, other)
        rows += len(vertices)
    assert rows == len(index)


def test_a_stopped_call_can_be_continued(parts, tmp_path):
    out = tmp_path / "out"
    calls = []

    def function(part, index, owned):
        calls.append(part.number)
        if len(calls) == 4:
            raise RuntimeError("stop")
        return owned

    with dask.config.set(scheduler="synchronous"):
        with pytest.raises(RuntimeError, match="stop"):
            parts.write(function, 1, out)
        written = sorted(path.name for path in out.glob("*.npy"))
        assert len(written) == 3
        paths = parts.write(function, 1, out)
    assert len(calls) == 4 + 4
    assert [np.load(path).shape[0] for path in paths] == [size.owned for size in parts.sizes]
    assert sorted(os.listdir(out)) == [os.path.basename(path) for path in paths] + ["result.json"]


def test_an_old_zarr_is_refused_before_anything_is_written(parts, tmp_path, monkeypatch):
    zarr = pytest.importorskip("zarr")
    monkeypatch.delattr(zarr.Group, "create_array", raising=False)
    with pytest.raises(ImportError, match="format: 'zarr' needs zarr 3, found "):
        parts.neighborhoods(1, tmp_path / "out", format="zarr")
    assert not (tmp_path / "out").exists()


def test_a_folder_of_another_call_is_refused(parts, tmp_path):
    pytest.importorskip("zarr", "3")
    parts.neighborhoods(1, tmp_path / "out")
    with pytest.raises(ValueError, match="another call, which differs in r"):
        parts.neighborhoods(2, tmp_path / "out")
    with pytest.raises(ValueError, match="another call, which differs in neighborhoods"):
        parts.neighborhoods(1, tmp_path / "out", format="zarr")
    (tmp_path / "other").mkdir()
    (tmp_path / "other" / "text").write_text("mine")
    with pytest.raises(ValueError, match="expected an empty folder"):
        parts.neighborhoods(1, tmp_path / "other")
    (tmp_path / "out" / "result.json").write_text("{")
    with pytest.raises(ValueError, match="result.json"):
        parts.neighborhoods(1, tmp_path / "out")


def times(part, index, owned, *, factor):
    return owned * factor


def count_of(index, *, factor):
    return np.array([len(index) * factor])


def test_a_partial_function_of_other_arguments_is_another_call(mesh, parts, tmp_path):
    file = written(tmp_path / "mesh.ply", *mesh)
    for name, call in (
        ("write", lambda factor: parts.write(functools.partial(times, factor=factor), 0, tmp_path / "write")),
        ("map_meshes", lambda factor: distributed.map_meshes(
            [file], functools.partial(count_of, factor=factor), to=tmp_path / "map_meshes")),
    ):
        paths = call(2)
        assert call(2) == paths, name
        with pytest.raises(ValueError, match="another call, which differs in map"):
            call(3)


@pytest.mark.parametrize("format", ("npz", "zarr"))
def test_a_task_of_a_stopped_call_leaves_nothing_torn(tmp_path, format):
    """It still writes when the call is repeated, which removes its temporary file or store."""
    if format == "zarr":
        zarr = pytest.importorskip("zarr", "3")
    out, saved, calls = tmp_path / "out", np.arange(100), []
    path = out / f"part.{format}"

    def save(between, call=None):
        def pieces():
            yield saved[:50]
            between()
            yield saved[50:]

        arrays = [("first", np.int64, 100, lambda: iter([saved])), ("second", np.int64, 100, pieces)]
        _result_files.SAVERS[format](_result_files.ResultFile(str(path), call or calls[0]), arrays)

    def call(is_whole):
        with _result_files.result_folder(str(out), {"r": 1}) as digest:
            calls.append(digest)
            if is_whole:
                save(lambda: None)

    call(False)
    with pytest.raises(ValueError, match="out: has results of another call"):
        save(lambda: None, "another")
    for is_whole in (False, True):  # the repeated call: it has only begun, or has already written
        call(False)
        with pytest.raises(OSError):
            save(lambda: call(is_whole))
        assert sorted(os.listdir(out)) == [path.name] * is_whole + ["result.json"]
    found = np.load(path) if format == "npz" else zarr.open_group(path, mode="r")
    for name in ("first", "second"):
        np.testing.assert_array_equal(found[name][:], saved)


def test_a_task_of_a_stopped_call_writes_nothing_into_the_folder_of_another(parts, tmp_path):
    out = tmp_path / "out"

    def function(part, index, owned):
        shutil.rmtree(out)
        with _result_files.result_folder(str(out), {"r": 2}):
            return owned

    with dask.config.set(scheduler="synchronous"), pytest.raises(ValueError, match="out: has results of another call"):
        parts.write(function, 1, out)
    assert os.listdir(out) == ["result.json"]


def test_a_temporary_file_of_a_killed_call_does_not_block_its_folder(parts, tmp_path):
    (tmp_path / ".result.json.meshhood-1-1.tmp").write_text("{")
    paths = parts.neighborhoods(1, tmp_path)
    assert sorted(os.listdir(tmp_path)) == [os.path.basename(path) for path in paths] + ["result.json"]


def test_errors_name_the_argument_or_the_file(parts, tmp_path):
    np.savez(tmp_path / "t.npz", np.ones(parts.n_vertices))
    np.savetxt(tmp_path / "t.npy", np.ones(parts.n_vertices))
    for call, error, message in (
        (lambda: parts.aggregate(tmp_path / "t.npz", 1), ValueError, "t.npz: the magic string is not correct"),
        (lambda: parts.aggregate(tmp_path / "t.npy", 1), ValueError, "t.npy: the magic string is not correct"),
        (lambda: meshhood.partition(["V.npy", "F.npy"], tmp_path, parts=2, halo=1), TypeError, "mesh: expected a path, not list"),
        (lambda: meshhood.partition("V.ply", 3, parts=2, halo=1), TypeError, "folder: expected a path, not int"),
        (lambda: meshhood.open_parts(3), TypeError, "folder: expected a path, not int"),
        (lambda: parts.neighborhoods(1, 3), TypeError, "to: expected a path, not int"),
        (lambda: distributed.map_meshes([3], len), TypeError, "paths: expected a path, not int"),
        (lambda: distributed.map_meshes(["a.ply"], len, to=3), TypeError, "to: expected a path, not int"),
    ):
        with pytest.raises(error, match=message):
            call()


def test_one_of_two_calls_into_a_folder_is_refused(parts, tmp_path):
    begun, go_on = threading.Event(), threading.Event()

    def function(part, index, owned):
        begun.set()
        assert go_on.wait(60)
        return owned

    first = threading.Thread(target=parts.write, args=(function, 1, tmp_path / "out"))
    first.start()
    assert begun.wait(60)
    try:
        with pytest.raises(BlockingIOError, match="another call writes into this folder"):
            parts.write(function, 1, tmp_path / "out")
    finally:
        go_on.set()
        first.join()


def test_progress_counts_the_parts(parts, tmp_path):
    seen = []
    parts.write(corners_of, 0, tmp_path / "out", progress=lambda done, total: seen.append((done, total)))
    assert seen[0] == (0, 7)
    assert seen[-1] == (7, 7)


def test_partition_reads_arrays(mesh, index, tmp_path):
    V, F = mesh
    np.save(tmp_path / "V.npy", V)
    np.save(tmp_path / "F.npy", F)
    parts = meshhood.partition(
        (tmp_path / "V.npy", tmp_path / "F.npy"), tmp_path / "parts", vertices_per_part=1000, halo=3, unit="edge"
    )
    assert len(parts) == -(-len(V) // 1000)
    assert parts.halo == 3 * index.mean_edge_length
    np.testing.assert_array_equal(
        parts.counts(3, unit="edge").compute(), index.counts(3, unit="edge")
    )


def test_partition_refuses_wrong_arguments(mesh, tmp_path):
    file = written(tmp_path / "mesh.ply", *mesh)
    for options, message in (
        ({"halo": 1}, "expected one of them"),
        ({"halo": 1, "parts": 2, "vertices_per_part": 2}, "expected one of them"),
        ({"halo": 1, "parts": 0}, "parts: 0"),
        ({"halo": -1, "parts": 2}, "halo: -1"),
        ({"halo": float("inf"), "parts": 2}, "halo: inf"),
        ({"halo": 1, "parts": 2, "memory": "lots"}, "memory: 'lots'"),
        ({"halo": 1, "parts": 2, "memory": 5}, "a memory of 5 bytes"),
        ({"halo": 1, "parts": 2, "unit": "inch"}, "unit: 'inch'"),
        ({"halo": 1, "parts": 2**70}, f"parts: {2**70}, expected 1 to"),
        ({"halo": 1, "vertices_per_part": 2**70}, f"vertices_per_part: {2**70}, expected 1 to"),
        ({"halo": 1, "parts": 2, "memory": "99999999999999GiB"}, f"memory: {99999999999999 * 2**30}, expected 0 to"),
    ):
        with pytest.raises(ValueError, match=message):
            meshhood.partition(file, tmp_path / "parts", **options)
    with pytest.raises(ValueError, match="has files, but not .partition, the mark of a partition; expected a new or an"):
        meshhood.partition(file, tmp_path, halo=1, parts=2)
    assert file.exists()
    with pytest.raises(ValueError, match="mesh: a tuple of 3, expected a path, or a tuple of those of positions and faces"):
        meshhood.partition(("a", "b", "c"), tmp_path / "parts", parts=2, halo=1)
    with pytest.raises(FileNotFoundError):
        meshhood.partition(tmp_path / "none.ply", tmp_path / "parts", parts=2, halo=1)
    with pytest.warns(UserWarning, match="2 of 2 parts are as large as the mesh"):
        meshhood.partition(file, tmp_path / "parts", parts=2, halo=1000)


def test_a_part_of_another_mesh_is_refused(mesh, folder, tmp_path):
    V, F = mesh
    other = tmp_path / "other"
    meshhood.partition(written(tmp_path / "other.ply", V + np.float32(1), F), other, parts=7, halo=HALO)
    forged = copy_of(folder, tmp_path / "forged")
    os.rename(forged / "part-00002", tmp_path / "old")
    os.rename(other / "part-00002", forged / "part-00002")
    with pytest.raises(ValueError, match="part-00002/.*is of another mesh"):
        meshhood.open_parts(forged).counts(1).compute()
    opened = meshhood.open_parts(folder)
    with pytest.raises(ValueError, match="holds 7 parts of another mesh"):
        meshhood.partition(tmp_path / "other.ply", folder, parts=7, halo=HALO)
    assert len(meshhood.open_parts(folder)) == len(opened)


@pytest.fixture(scope="module")
def client():
    cluster_of = pytest.importorskip("distributed")
    with cluster_of.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None
    ) as cluster, cluster_of.Client(cluster) as client:
        yield client


def test_a_cluster_of_processes_gives_the_same(parts, index, client, tmp_path):
    np.testing.assert_array_equal(parts.counts(HALO).compute(), index.counts(HALO))
    paths = parts.neighborhoods(2, tmp_path / "out")
    vertices = np.concatenate([np.load(path)["vertices"] for path in paths])
    assert sorted(vertices) == list(range(len(index)))
    # On the cluster, not here.
    assert set(parts.map(process, 0, dtype=int).compute()) <= set(client.run(os.getpid).values())


def process(part, index, owned):
    return np.full(len(owned), os.getpid())


def slow_count(folder, part, index, owned):
    """Writes which process computes the part, and leaves time to kill it."""
    with open(os.path.join(folder, f"{part.number}-{os.getpid()}"), "w"):
        time.sleep(0.3)
    return index.counts(3, owned, workers=1)


class SlowCount:
    def __init__(self, folder):
        self.folder = str(folder)

    def __call__(self, part, index, owned):
        return slow_count(self.folder, part, index, owned)


def test_a_worker_that_is_killed_loses_only_its_parts(parts, index, client, tmp_path):
    begun = tmp_path / "begun"
    begun.mkdir()
    killed = []

    def kill_one(done, total):
        if done == 2 and not killed:
            running = [pid for pid in client.run(os.getpid).values()]
            killed.append(running[0])
            os.kill(running[0], signal.SIGKILL)

    paths = parts.write(SlowCount(begun), 3, tmp_path / "out", progress=kill_one)
    assert killed
    counts = np.empty(len(index), int)
    for number, path in enumerate(paths):
        counts[parts.open(number).vertices[parts.open(number).owned]] = np.load(path)
    np.testing.assert_array_equal(counts, index.counts(3))
    tries = [name.split("-") for name in os.listdir(begun)]
    by_others = [number for number, pid in tries if int(pid) != killed[0]]
    assert len(by_others) == len(set(by_others)), "parts of other workers are not computed again"
    assert not list((tmp_path / "out").glob(".*.tmp"))


def partition_again(mesh, folder, parts, halo, how):
    """Replaces the parts in a folder."""
    if how == "made anew" and folder.exists():
        shutil.rmtree(folder)
    return meshhood.partition(mesh, folder, parts=parts, halo=halo, resume=False)


REPLACED = ((4, 3.0), (4, HALO), (2, HALO), (3, 5.0), (4, 3.0))


@pytest.mark.parametrize("how", ("made anew", "replaced"))
@pytest.mark.parametrize("where", ("in this process", "on a cluster"))
def test_parts_that_replace_others_are_used(mesh, index, tmp_path, how, where, request):
    """Of the same mesh, with another halo or number of parts, and of another mesh."""
    if where == "on a cluster":
        request.getfixturevalue("client")
    V, F = mesh
    other = meshhood.MeshIndex(V * np.float32(1.25), F)
    files = written(tmp_path / "mesh.ply", V, F), written(tmp_path / "other.ply", V * np.float32(1.25), F)
    values = np.random.default_rng(4).random(len(V))
    for n, halo in REPLACED:
        for file, whole in zip(files, (index, other)):
            parts = partition_again(file, tmp_path / "parts", n, halo, how)
            np.testing.assert_array_equal(parts.counts(halo).compute(), whole.counts(halo))
            maxima = parts.aggregate(values, halo, "max").compute()
            np.testing.assert_array_equal(maxima, whole.aggregate(values, halo, "max"))
            corners = np.bincount(F.ravel(), minlength=len(V))
            np.testing.assert_array_equal(parts.map(corners_of, 0, dtype=int).compute(), corners)


@pytest.mark.parametrize("how", ("made anew", "replaced"))
def test_parts_that_were_replaced_are_right_or_refused(mesh, tmp_path, how):
    V, F = mesh
    file = written(tmp_path / "mesh.ply", V, F)
    old = partition_again(file, tmp_path / "parts", 4, 3.0, how)
    part = old.open(1)
    counts = part.index.counts(3.0, part.owned)
    new = partition_again(file, tmp_path / "parts", 3, HALO, how)
    with pytest.raises(ValueError, match="other parts have replaced those that were opened"):
        old.open(2)
    with pytest.raises(ValueError, match="other parts have replaced those that were opened"):
        old.counts(3.0).compute()
    np.testing.assert_array_equal(part.index.counts(3.0, part.owned), counts)
    with pytest.raises(ValueError, match="part-00001/face_corners.npy"):
        part.mesh
    shutil.rmtree(tmp_path / "parts")
    with pytest.raises(FileNotFoundError, match="face_corners.npy"):
        part.mesh
    with pytest.raises(FileNotFoundError, match="manifest.json"):
        new.counts(3.0).compute()
    assert old.open(1) is part


def test_a_result_has_every_vertex_or_none():
    blocks = [np.array([1.0, 2.0]), np.array([3.0])]
    in_order = distributed.in_mesh_order
    np.testing.assert_array_equal(in_order([np.array([2, 0]), np.array([1])], blocks, 3), [2, 3, 1])
    for ids in ([[2, 0], [0]], [[2, 0], [3]], [[2, 0], []], [[2, 0], [1, 1]]):
        with pytest.raises(ValueError, match="do not own each vertex"):
            in_order([np.array(rows, np.int64) for rows in ids], blocks, 3)


def test_a_part_that_owns_other_vertices_than_the_manifest_says_is_refused(folder):
    parts = meshhood.open_parts(folder)
    files = meshhood._core.part_files(parts.folder, 1, parts._checksum)

    class Lying:
        folder, vertices, owned = files.folder, files.vertices, files.owned + 1
        index, read = files.index, files.read

    with pytest.raises(ValueError, match=f"part-00001: owns {files.owned} of {files.vertices} vertices, but the manifest"):
        distributed.OpenPart(Lying(), 1)


def test_a_pipe_or_a_larger_file_in_place_of_an_array_is_refused_before_it_is_read(folder, tmp_path):
    for name in ("vertices.npy", "owned.npy", "face_corners.npy", "face_offsets.npy"):
        forged = copy_of(folder, tmp_path / name)
        file = forged / "part-00001" / name
        os.truncate(file, 6 << 30)  # takes no room on the disk
        with pytest.raises(ValueError, match=f"part-00001/{name}: has {6 << 30} bytes, but the manifest says"):
            meshhood.open_parts(forged).open(1)
        file.unlink()
        os.mkfifo(file)
        with pytest.raises(OSError, match="is not a regular file"):
            meshhood.open_parts(forged).open(1)


def test_a_part_that_is_emptied_while_it_is_opened_is_refused(folder, tmp_path, monkeypatch):
    """Between the verification of a file and its use, there is no second read."""
    for name in ("vertices.npy", "owned.npy", "face_corners.npy", "face_offsets.npy"):
        forged = copy_of(folder, tmp_path / name)
        parts = meshhood.open_parts(forged)
        part_files = meshhood._core.part_files

        def then_empty(*arguments):
            files = part_files(*arguments)
            (forged / "part-00001" / name).write_bytes(b"")
            return files

        monkeypatch.setattr(meshhood._core, "part_files", then_empty)
        with pytest.raises(ValueError, match=f"part-00001/{name}: has 0 bytes, but the manifest says"):
            parts.open(1)
        monkeypatch.undo()


def mean_count(index):
    return np.array([index.counts(2, workers=1).mean()])


def test_map_meshes_takes_meshes_and_indexes(tmp_path):
    paths, expected = [], []
    for side in (5, 8, 11):
        V, F = meshes.two_plates(side)
        index = meshhood.MeshIndex(V, F)
        expected.append(mean_count(index))
        paths += [written(tmp_path / f"{side}.ply", V, F), tmp_path / f"{side}.mhi"]
        index.save(paths[-1])
    np.testing.assert_array_equal(distributed.map_meshes(paths, mean_count)[::2], expected)
    np.testing.assert_array_equal(distributed.map_meshes(paths, mean_count)[1::2], expected)
    files = distributed.map_meshes(paths, mean_count, to=tmp_path / "out")
    np.testing.assert_array_equal([np.load(file) for file in files][::2], expected)
    os.unlink(files[3])
    assert distributed.map_meshes(paths, mean_count, to=tmp_path / "out") == files
    np.testing.assert_array_equal([np.load(file) for file in files][1::2], expected)
    with pytest.raises(FileNotFoundError):
        distributed.map_meshes([tmp_path / "none.ply"], mean_count)


class Old(ValueError):
    """An exception of Python 3.9 or 3.10, without `add_note`."""

    @property
    def add_note(self):
        raise AttributeError


class Unsaved:
    def __array__(self, *_, **__):
        raise Old("not an array")


@pytest.mark.parametrize("result", (None, Unsaved()))
def test_an_error_names_its_mesh_also_while_the_result_is_saved(tmp_path, result):
    file = written(tmp_path / "mesh.ply", *meshes.two_plates(5))
    with pytest.raises(ValueError) as caught:
        distributed.map_meshes([file], lambda index: result, to=tmp_path / "out")
    assert f"in {file}" in "".join([str(caught.value), *getattr(caught.value, "__notes__", ())])
