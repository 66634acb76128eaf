# SPDX-License-Identifier: MIT
"""The same failure raises the same exception in every method and function: class, errno and filename."""

import errno
import os
import pickle
import resource
import sys
import tracemalloc
import weakref
from pathlib import Path

import meshes
import meshhood
import numpy as np
import programs
import pytest
from meshhood import _convert

METHODS = ("exact", "paper", "bfs", "ball", meshhood.Paper(levels=3))
INDEX = meshhood.MeshIndex(*meshes.two_plates(5))
POINTS = meshhood.MeshIndex.from_points(INDEX.positions, link=1.0)
MASK = np.arange(len(INDEX)) < 9


def save(path):
    INDEX.save(path)


def map_index(path):
    return meshhood.load(path, mmap=True)


READERS = (meshhood.read_mesh, meshhood.load, map_index)


def raised(call, *arguments, **options):
    with pytest.raises(Exception) as caught:
        call(*arguments, **options)
    return caught.value


def check_os_error(error, kind, number, path):
    assert type(error) is kind, repr(error)
    assert error.errno == number
    assert os.fspath(error.filename) == os.fspath(path)
    assert str(path) in str(error)
    assert str(error).count(str(path)) == 1


@pytest.mark.parametrize("read", READERS)
def test_a_missing_file(tmp_path, read):
    path = tmp_path / "nothing.ply"
    check_os_error(raised(read, path), FileNotFoundError, errno.ENOENT, path)
    check_os_error(raised(read, str(path)), FileNotFoundError, errno.ENOENT, path)
    check_os_error(raised(read, os.fsencode(path)), FileNotFoundError, errno.ENOENT, path)


def test_a_missing_folder_of_parts(tmp_path):
    manifest = tmp_path / "parts" / "manifest.json"
    try:
        meshhood.open_parts(manifest.parent)
    except FileNotFoundError as error:  # not pytest.raises, which hides what Python before 3.11 compares
        check_os_error(error, FileNotFoundError, errno.ENOENT, manifest)
    else:
        pytest.fail("nothing was raised")


def test_saving_into_a_missing_folder(tmp_path):
    path = tmp_path / "nowhere" / "file"
    check_os_error(raised(save, path), FileNotFoundError, errno.ENOENT, path)


@pytest.mark.parametrize("read", READERS)
def test_a_folder_instead_of_a_file(tmp_path, read):
    check_os_error(raised(read, tmp_path), IsADirectoryError, errno.EISDIR, tmp_path)


def test_saving_over_a_folder(tmp_path):
    folder = tmp_path / "folder"
    folder.mkdir()
    check_os_error(raised(save, folder), IsADirectoryError, errno.EISDIR, folder)
    assert list(tmp_path.iterdir()) == [folder]


@pytest.mark.parametrize("call", (*READERS, save))
def test_a_file_as_a_folder(tmp_path, call):
    (tmp_path / "file").write_text("")
    path = tmp_path / "file" / "inside"
    check_os_error(raised(call, path), NotADirectoryError, errno.ENOTDIR, path)


@pytest.mark.parametrize("call", (*READERS, save))
def test_a_name_that_is_too_long(tmp_path, call):
    path = tmp_path / ("x" * 300)
    check_os_error(raised(call, path), OSError, errno.ENAMETOOLONG, path)


@pytest.mark.skipif(os.geteuid() == 0, reason="root may read everything")
@pytest.mark.parametrize("call", (*READERS, save))
def test_no_permission(tmp_path, call):
    path = tmp_path / "locked" / "file"
    path.parent.mkdir()
    path.write_text("")
    path.parent.chmod(0)
    try:
        check_os_error(raised(call, path), PermissionError, errno.EACCES, path)
    finally:
        path.parent.chmod(0o700)


def test_a_full_disk():
    if not os.path.exists("/dev/full"):
        pytest.skip("no /dev/full here")
    check_os_error(raised(save, "/dev/full"), OSError, errno.ENOSPC, "/dev/full")


def test_a_file_size_limit(tmp_path):
    """Under the default disposition of SIGXFSZ, in a process of its own."""
    programs.run(f"""
import errno, resource
signal.signal(signal.SIGXFSZ, signal.SIG_DFL)
index = meshhood.MeshIndex(*meshes.two_plates(60))
resource.setrlimit(resource.RLIMIT_FSIZE, (4096, {resource.RLIM_INFINITY}))
path = {str(tmp_path / "index")!r}
try:
    index.save(path)
except OSError as error:
    assert (error.errno, error.filename) == (errno.EFBIG, path), repr(error)
else:
    raise AssertionError("saved")
assert signal.getsignal(signal.SIGXFSZ) == signal.SIG_DFL
""")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("path", ("a\0b", b"a\0b"))
@pytest.mark.parametrize("call", (*READERS, save))
def test_a_name_with_a_null_byte(call, path):
    assert type(raised(call, path)) is ValueError


@pytest.mark.parametrize("call", (*READERS, save))
@pytest.mark.parametrize("path", (None, 3, ["x"]))
def test_arguments_that_are_not_paths_are_refused(call, path):
    assert type(raised(call, path)) is TypeError


def star(count):
    """A vertex joined to all others, so that every larger neighborhood is the whole mesh."""
    V = np.random.default_rng(3).normal(size=(count, 3))
    V[0] = 0
    edges = np.column_stack([np.zeros(count - 1, int), np.arange(1, count)])
    return meshhood.MeshIndex(V, (2 * np.arange(count), edges.ravel()))


def test_a_result_that_cannot_fit_is_refused_before_its_rows_are_counted(monkeypatch):
    index = star(40_000)
    reports = []
    for options in ({"max_bytes": 10**9}, {}):
        monkeypatch.setattr(_convert, "free_bytes", lambda: 10**9)
        with pytest.raises(MemoryError, match="exceeds max_bytes, 1000000000; iter_neighborhoods"):
            index.neighborhoods(np.inf, progress=lambda done, total: reports.append(done / total), **options)
        with pytest.raises(MemoryError, match="exceeds max_bytes, 1000000000; iter_neighborhoods"):
            index.radius_neighbors_graph(np.inf, **options)
    print(f"refused after {max(reports):.2%} of the work")
    assert max(reports) < 0.1


@pytest.mark.parametrize("method", METHODS)
def test_a_result_of_just_the_limit_is_returned(method):
    wanted = INDEX.neighborhoods(2.0, return_distance=True, method=method)
    size = len(wanted[1]) * 12
    got = INDEX.neighborhoods(2.0, return_distance=True, method=method, max_bytes=size)
    np.testing.assert_array_equal(got[1], wanted[1])
    with pytest.raises(MemoryError, match="max_bytes"):
        INDEX.neighborhoods(2.0, return_distance=True, method=method, max_bytes=size - 1)


@pytest.mark.parametrize("sort", ("index", "id", "distance"))
def test_sorted_rows_need_no_memory_beside_the_result(sort):
    index = meshhood.MeshIndex(*meshes.two_plates(60))
    tracemalloc.start()
    try:
        rows = index.neighborhoods(4.0, return_distance=True, sort=sort)
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert peak < 1.1 * sum(array.nbytes for array in rows)


NAMES = [name for name in dir(meshhood.MeshIndex) if not name.startswith("_")]


@pytest.mark.parametrize("name", [name for name in NAMES if callable(getattr(meshhood.MeshIndex, name))])
def test_a_method_that_is_called_on_the_class_asks_for_an_instance(name):
    if name in ("from_points", "of_faces"):  # which make one
        return
    with pytest.raises(TypeError, match=rf"MeshIndex.{name}: called on the class, expected on an instance"):
        getattr(meshhood.MeshIndex, name)(3, 2.0)
    assert getattr(meshhood.MeshIndex, name).__doc__ == getattr(INDEX, name).__doc__


def doubled(x):
    return 2 * x


class OfUser(meshhood.MeshIndex):
    h = doubled

    @staticmethod
    def unit(x):
        return x

    def m(self):
        return len(self)


def test_what_a_user_adds_to_the_class_stays_as_it_is():
    assert OfUser.unit(5) == 5 and OfUser.h is doubled and doubled.__qualname__ == "doubled"
    assert pickle.loads(pickle.dumps(OfUser.m)) is OfUser.m


def test_methods_are_pickled():
    for method in (meshhood.MeshIndex.count, meshhood.MeshIndex.curvature, OfUser.counts):
        assert pickle.loads(pickle.dumps(method)) is method
    for instance in (INDEX, weakref.proxy(INDEX)):
        assert meshhood.MeshIndex.count(instance, 3, 2.0) == INDEX.count(3, 2.0)


def test_the_class_can_be_used_as_others():
    from abc import ABC

    class Abstract(meshhood.MeshIndex, ABC):
        def neighborhood(self, *arguments, **words):
            return super().neighborhood(*arguments, **words)

    index = Abstract(*meshes.two_plates(5))
    wanted = INDEX.neighborhood(3, 2.0)
    by_class = (cls.neighborhood(index, 3, 2.0) for cls in (Abstract, meshhood.MeshIndex))
    for found in (index.neighborhood(3, 2.0), *by_class):
        np.testing.assert_array_equal(found, wanted)


@pytest.mark.parametrize(
    ("call", "error", "message"),
    (
        (lambda: INDEX.curvature(), TypeError, "r: missing"),
        (lambda: INDEX.smooth(np.ones(50), 1.0, scales=[1.0]), TypeError, "fwhm: given, but so are scales"),
        (lambda: INDEX.smooth(np.ones(50), 1.0, weights=-np.ones(50)), ValueError, "weights: vertex 0: -1.0"),
        (lambda: INDEX.refit("hand.stl"), TypeError, r"V: a path, .* read_mesh\(path\)"),
        (lambda: POINTS.curvature(1.0), ValueError, "F: expected the faces or normals=, because this index has none"),
        (lambda: POINTS.discs(1.0), ValueError, "F: expected the faces or numbers as weights=, because this index has"),
        (lambda: POINTS.invariants(1.0), ValueError, "F: expected the faces, because this index has none"),
        (lambda: meshhood.MeshIndex.from_points(np.eye(3)), TypeError, "^MeshIndex.from_points.*'link'"),
        (lambda: meshhood.padded([0, 2], [1, 2], width=3, fill=None), ValueError, "fill: None, expected one value of int64"),
        (lambda: INDEX.counts(1.0, walls=np.where(MASK)), ValueError, r"walls: .*; .* np.flatnonzero\(mask\) the list"),
        (lambda: INDEX.counts(1.0, walls=np.zeros((50, 2), int)), ValueError, "walls: .* or a bool mask of 50, not an"),
        (lambda: INDEX.iter_neighborhoods(1.0, chunk=2**70), ValueError, f"chunk: {2**70}, expected 1 to {2**63 - 1}"),
    ),
)
def test_an_error_says_what_is_missing_or_what_helps(call, error, message):
    with pytest.raises(error, match=message):
        call()


def test_values_that_every_file_holds_need_no_memory_for_a_check():
    values = np.ones(10**5, np.float32)
    tracemalloc.start()
    assert _convert.as_float32(values, "values", "a file") is values
    assert tracemalloc.get_traced_memory()[1] < values.nbytes
    tracemalloc.stop()


@pytest.mark.parametrize("extension", ("ply", "vtk", "vtp"))
@pytest.mark.parametrize(
    ("values", "error", "message"),
    (
        ({5: np.ones(50)}, TypeError, "values: the name 5, expected text"),
        ({"h": np.where(MASK, 1.0, -1e300)}, ValueError, r"values\['h'\]: vertex 9: -1e\+300, but a file holds .* 3.4e\+38"),
        ({"n": np.where(MASK, 1, 1e39)[:, None] * np.ones(3)}, ValueError, r"values\['n'\]: vertex 9: 1e\+39"),
    ),
)
def test_values_that_a_file_cannot_hold_are_refused(tmp_path, extension, values, error, message):
    with pytest.raises(error, match=message):
        meshhood.write_mesh(tmp_path / f"a.{extension}", *meshes.two_plates(5), values=values)
    assert not list(tmp_path.iterdir())


def test_a_mesh_file_is_not_an_index_file(tmp_path):
    path = tmp_path / "mesh.ply"
    meshhood.write_mesh(path, *meshes.two_plates(5))
    for mmap in (False, True):
        with pytest.raises(ValueError, match=f"{path}: .*not a saved index.* a mesh file is read by read_mesh"):
            meshhood.load(path, mmap=mmap)


def read_file_of(content):
    Path("mesh").write_bytes(content)
    meshhood.read_mesh("mesh")


@pytest.mark.parametrize(
    ("library", "call"),
    (
        ("nibabel", lambda: meshhood.write_mesh("left.surf.gii", *meshes.two_plates(5))),
        ("nibabel", lambda: read_file_of(b"<GIFTI")),
        ("pyvista", lambda: read_file_of(b"<VTKFile")),
        ("meshio", lambda: read_file_of(b"$MeshFormat")),
        ("trimesh", lambda: read_file_of(b"glTF")),
        ("trimesh", lambda: read_file_of(b"PK\x03\x04")),
        ("scipy", lambda: INDEX.radius_neighbors_graph(1.0)),
        ("scipy", lambda: INDEX.smoothing_matrix(1.0)),
        ("pyvista", lambda: meshhood.plot_neighborhood(INDEX, 3, 1.0)),
        ("dask", lambda: meshhood.distributed.map_meshes(["hand.ply"], len)),
    ),
)
def test_a_library_that_is_missing_is_named_with_its_installation(monkeypatch, tmp_path, library, call):
    monkeypatch.chdir(tmp_path)
    for name in [name for name in sys.modules if name.partition(".")[0] == library]:
        monkeypatch.delitem(sys.modules, name)

    class Missing:
        @staticmethod
        def find_spec(name, path=None, target=None):
            if name.partition(".")[0] == library:
                raise ModuleNotFoundError(f"No module named {name!r}", name=name)

    monkeypatch.setattr(sys, "meta_path", [Missing, *sys.meta_path])
    with pytest.raises(ModuleNotFoundError, match=f"needs {library}: pip install '?{library}"):
        call()
