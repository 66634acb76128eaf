# SPDX-License-Identifier: MIT
"""The faces that an index keeps, in each form, file and copy. test_words.py has the calls that need them."""

import pickle

import meshes
import meshhood
import numpy as np
import pytest
from scipy.sparse import csr_array

V, TRIANGLES = meshes.two_plates(12)
V = V + 0.2 * np.sin(V[:, [1, 2, 0]])  # curved


def polygons():
    """The first two triangles of a plate as a quad, the others as they are."""
    quad = [TRIANGLES[0, 0], TRIANGLES[0, 1], TRIANGLES[0, 2], next(iter(set(TRIANGLES[1]) - set(TRIANGLES[0])))]
    corners = np.concatenate([quad, TRIANGLES[2:].ravel()])
    return np.concatenate([[0], np.arange(4, len(corners) + 1, 3)]), corners


@pytest.fixture(
    params=(
        TRIANGLES.astype(np.int64),
        TRIANGLES.astype(np.uint32),
        TRIANGLES.astype(np.uint16),
        polygons(),
        np.concatenate([np.full((len(TRIANGLES), 1), 3), TRIANGLES], axis=1).ravel(),
    ),
    ids=("int64", "uint32", "uint16", "polygons", "padded"),
)
def F(request):
    return request.param


def test_triangles_are_rows_of_three_in_whatever_form_they_are_given():
    offsets = 3 * np.arange(len(TRIANGLES) + 1)
    padded = np.insert(TRIANGLES, 0, 3, axis=1).ravel()
    for F in (TRIANGLES, (offsets, TRIANGLES.ravel()), (offsets.astype(np.uint64), TRIANGLES.ravel()), padded):
        np.testing.assert_array_equal(meshhood.MeshIndex(V, F).faces, TRIANGLES.astype(np.int32), strict=True)


def test_an_index_without_faces_says_so(tmp_path):
    edges = np.concatenate([TRIANGLES[:, [0, 1]], TRIANGLES[:, [1, 2]], TRIANGLES[:, [2, 0]]]).T
    graph = csr_array((np.ones(edges.shape[1]), tuple(edges)), shape=(len(V), len(V)))
    meshhood.MeshIndex(V, TRIANGLES).save(tmp_path / "plates.mhi")
    for index in (
        meshhood.MeshIndex(V, TRIANGLES, keep_faces=False),
        meshhood.MeshIndex(V, graph),
        meshhood.load(tmp_path / "plates.mhi"),
    ):
        assert index.faces is None
        with pytest.raises(ValueError, match=r"F: expected the faces or normals=, because this index has none.*saved without faces=True"):
            index.curvature(2.5)
        index.curvature(2.5, F=TRIANGLES)


WAYS = ({}, {"mmap": True}, {"mmap": True, "trusted": True})


@pytest.mark.parametrize("way", WAYS, ids=lambda way: "-".join(way) or "copied")
def test_a_file_may_have_the_faces(F, way, tmp_path):
    index = meshhood.MeshIndex(V, F)
    index.save(tmp_path / "with.mhi", faces=True)
    loaded = meshhood.load(tmp_path / "with.mhi", **way)
    if isinstance(index.faces, tuple):
        for ours, given in zip(loaded.faces, index.faces):
            np.testing.assert_array_equal(ours, given)
            assert ours.dtype == given.dtype
    else:
        np.testing.assert_array_equal(loaded.faces, index.faces)
        assert loaded.faces.dtype == index.faces.dtype
    np.testing.assert_array_equal(loaded.curvature(5.0, unit="edge").k1, index.curvature(5.0, unit="edge").k1)
    assert loaded.nbytes == index.nbytes
    assert loaded.refit(2 * V).faces is not None


def test_the_faces_of_a_file_are_read_only_and_outlive_its_index(tmp_path):
    meshhood.MeshIndex(V, TRIANGLES).save(tmp_path / "with.mhi", faces=True)
    for mmap in (False, True):
        faces = meshhood.load(tmp_path / "with.mhi", mmap=mmap).faces
        np.testing.assert_array_equal(faces, TRIANGLES)
        with pytest.raises(ValueError, match="read-only"):
            faces[0, 0] = 1


def test_a_loaded_index_saves_its_faces_again(F, tmp_path):
    with_faces, again, without, bare = (tmp_path / name for name in ("with", "again", "without", "bare"))
    index = meshhood.MeshIndex(V, F)
    index.save(with_faces, faces=True)
    index.save(bare)
    loaded = meshhood.load(with_faces)
    loaded.save(again, faces=True)
    loaded.save(without)
    assert again.read_bytes() == with_faces.read_bytes()
    assert without.read_bytes() == bare.read_bytes()
    np.testing.assert_array_equal(pickle.loads(pickle.dumps(loaded)).curvature(2.5).k1, index.curvature(2.5).k1)


def test_an_index_without_faces_cannot_save_them(tmp_path):
    meshhood.MeshIndex(V, TRIANGLES).save(tmp_path / "bare.mhi")
    for index in (meshhood.MeshIndex(V, TRIANGLES, keep_faces=False), meshhood.load(tmp_path / "bare.mhi")):
        with pytest.raises(ValueError, match=r"faces: True, but this index has none.*saved without faces=True"):
            index.save(tmp_path / "no.mhi", faces=True)
    assert not (tmp_path / "no.mhi").exists()


def test_the_copy_is_compact_and_read_only():
    F = TRIANGLES.astype(np.int64)
    index, without = meshhood.MeshIndex(V, F), meshhood.MeshIndex(V, F, keep_faces=False)
    F[:] = 0
    assert index.faces.dtype == np.int32
    np.testing.assert_array_equal(index.faces, TRIANGLES)
    assert index.nbytes == without.nbytes + 4 * TRIANGLES.size
    with pytest.raises(ValueError, match="read-only"):
        index.faces[0, 0] = 1
    offsets, corners = meshhood.MeshIndex(V, polygons()).faces
    assert (offsets.dtype, corners.dtype) == (np.int32, np.int32)
    for kept, given in zip((offsets, corners), polygons()):
        np.testing.assert_array_equal(kept, given)


def test_the_faces_of_the_caller_stay_writable():
    F = TRIANGLES.astype(np.int32)
    meshhood.MeshIndex(V, F)
    F[0, 0] = F[0, 0]


def test_an_index_does_not_share_the_memory_of_buffers_that_it_was_unpickled_from():
    buffers = []
    pickled = pickle.dumps(meshhood.MeshIndex(V, TRIANGLES), 5, buffer_callback=buffers.append)
    sent = [bytearray(buffer) for buffer in buffers]
    index = pickle.loads(pickled, buffers=sent)
    for buffer in sent:
        buffer[:] = bytes(len(buffer))
    np.testing.assert_array_equal(index.faces, TRIANGLES)
    with pytest.raises(ValueError, match="read-only"):
        index.faces[0, 0] = 1
