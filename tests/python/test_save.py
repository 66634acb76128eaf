# SPDX-License-Identifier: MIT
"""Indexes in files and between processes (reliability row P6)."""

import concurrent.futures
import copy
import multiprocessing
import pickle
from pathlib import Path

import meshes
import meshhood
import numpy as np
import pytest

METHODS = ("exact", "paper", "bfs", "ball", meshhood.Paper(levels=4, discard=1, radius_ratio=3))


def make():
    return meshhood.MeshIndex(*meshes.two_plates(20))


@pytest.fixture(scope="module")
def index():
    return make()


@pytest.fixture
def file(index, tmp_path):
    path = tmp_path / "plates.index"
    index.save(path)
    return path


def assert_same(one, other):
    assert len(one) == len(other)
    np.testing.assert_array_equal(one.permutation, other.permutation)
    for method in METHODS:
        for a, b in zip(*(i.neighborhoods(3.5, return_distance=True, method=method) for i in (one, other))):
            np.testing.assert_array_equal(a, b)
    assert (one.radius_neighbors_graph(2.0) != other.radius_neighbors_graph(2.0)).nnz == 0


WAYS = ({}, {"mmap": True}, {"mmap": True, "trusted": True})


@pytest.mark.parametrize("way", WAYS, ids=lambda way: "-".join(way) or "copied")
def test_a_loaded_index_is_the_one_that_was_saved(index, file, way):
    assert_same(meshhood.load(file, **way), index)
    assert_same(meshhood.load(str(file), **way), index)


def test_a_trusted_file_is_verified_in_its_header_alone(file):
    whole = bytearray(file.read_bytes())
    whole[len(whole) // 2] ^= 1
    file.write_bytes(whole)
    with pytest.raises(ValueError, match="plates.index"):
        meshhood.load(file, mmap=True)
    meshhood.load(file, mmap=True, trusted=True)
    file.write_bytes(whole[:-64])
    with pytest.raises(ValueError, match="plates.index"):
        meshhood.load(file, mmap=True, trusted=True)


def test_only_mapped_files_can_be_trusted(file):
    with pytest.raises(ValueError, match="trusted: .*mmap"):
        meshhood.load(file, trusted=True)


def test_the_bytes_depend_on_the_mesh_alone(index, file, tmp_path):
    V, F = meshes.two_plates(20)
    meshhood.MeshIndex(V, np.asfortranarray(F.astype(np.uint64)), workers=3).save(tmp_path / "again")
    meshhood.load(file).save(tmp_path / "loaded")
    assert file.read_bytes() == (tmp_path / "again").read_bytes() == (tmp_path / "loaded").read_bytes()
    assert pickle.loads(pickle.dumps(index)).__reduce_ex__(4)[1][1] == file.read_bytes()


@pytest.mark.parametrize("mmap", (False, True))
def test_results_outlive_a_loaded_index(index, file, mmap):
    permutation = meshhood.load(file, mmap=mmap).permutation
    file.unlink()
    np.testing.assert_array_equal(permutation, index.permutation)


def test_an_endless_file_that_is_not_an_index_is_refused():
    with pytest.raises(ValueError, match="not a saved index"):
        meshhood.load("/dev/zero")


def test_a_changed_byte_of_a_pickle_is_refused(index, file):
    whole = file.read_bytes()
    for place in range(0, len(whole), 997):
        changed = bytearray(whole)
        changed[place] ^= 1
        with pytest.raises(ValueError, match="byte"):
            pickle.loads(pickle.dumps(index).replace(whole, bytes(changed)))


GOLDEN = Path(__file__).resolve().parents[1] / "golden"


@pytest.mark.parametrize("file", sorted(GOLDEN.glob("format3/*.mhi")), ids=lambda file: file.stem)
def test_indexes_saved_by_the_cpp_library_are_loaded(file):
    """One of them is the index of a reordered mesh, which has no permutation."""
    index = meshhood.load(file)
    np.testing.assert_array_equal(np.sort(index.permutation), np.arange(len(index)))
    for v in range(0, len(index), 7):
        ids = index.neighborhood(v, 1.0, sort="id")
        np.testing.assert_array_equal(ids, index.neighborhood(v, 1.0, sort="id", method="bfs"))


@pytest.mark.parametrize("protocol", range(pickle.HIGHEST_PROTOCOL + 1))
def test_pickling(index, protocol):
    assert_same(pickle.loads(pickle.dumps(index, protocol)), index)


def test_a_pickle_is_the_bytes_of_the_file_the_faces_and_a_name(index, file):
    pickled, saved = pickle.dumps(index), file.read_bytes()
    assert saved in pickled
    assert len(pickled) < len(saved) + index.faces.nbytes + 400


def test_pickling_without_a_copy(index):
    buffers = []
    pickled = pickle.dumps(index, protocol=5, buffer_callback=buffers.append)
    assert len(pickled) < 200
    assert_same(pickle.loads(pickled, buffers=buffers), index)


def test_a_copy_is_the_index_itself(index):
    assert copy.copy(index) is index
    assert copy.deepcopy([index])[0] is index


def run_query(index, v):
    return index.neighborhood(v, 3.5)


_mapped = None


def map_index(file):
    global _mapped
    _mapped = meshhood.load(file, mmap=True)


def query_mapped(v):
    return run_query(_mapped, v)


def test_processes_may_share_a_file(index, file):
    context = multiprocessing.get_context("spawn")
    with concurrent.futures.ProcessPoolExecutor(2, context, initializer=map_index, initargs=(file,)) as pool:
        for v, got in enumerate(pool.map(query_mapped, range(5))):
            np.testing.assert_array_equal(got, index.neighborhood(v, 3.5))
