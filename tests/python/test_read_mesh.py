# SPDX-License-Identifier: MIT
"""Mesh files, read by the C++ library."""

import meshes
import meshhood
import numpy as np
import pytest

TRIANGLE = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"


def test_triangles(tmp_path):
    file = tmp_path / "triangle.off"
    file.write_text(TRIANGLE)
    for path in (file, str(file)):
        V, F = meshhood.read_mesh(path)
        np.testing.assert_array_equal(V, [[0, 0, 0], [1, 0, 0], [0, 1, 0]])
        np.testing.assert_array_equal(F, [[0, 1, 2]])
        assert (V.dtype, F.dtype) == (np.float32, np.int32)
    assert meshhood.MeshIndex(meshhood.read_mesh(file)).count(0, 1.0) == 3


def test_polygons(tmp_path):
    file = tmp_path / "polygons.obj"
    file.write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nf 1 2 3\n")
    V, (offsets, corners) = meshhood.read_mesh(file)
    assert offsets.tolist() == [0, 4, 7]
    assert corners.tolist() == [0, 1, 2, 3, 0, 1, 2]
    assert len(meshhood.MeshIndex(V, (offsets, corners))) == 4


def test_progress(tmp_path):
    file = tmp_path / "triangle.off"
    file.write_text(TRIANGLE)
    calls = []
    meshhood.read_mesh(file, progress=lambda done, total: calls.append((done, total)))
    assert calls[0] == (0, len(TRIANGLE))
    assert calls[-1] == (len(TRIANGLE), len(TRIANGLE))


def test_malformed(tmp_path):
    file = tmp_path / "short.off"
    file.write_text(TRIANGLE[:-4])
    with pytest.raises(ValueError, match="short.off"):
        meshhood.read_mesh(file)


def test_warning(tmp_path):
    file = tmp_path / "long.off"
    file.write_text(TRIANGLE + "3 0 1 2\n")
    with pytest.warns(UserWarning, match="long.off"):
        assert len(meshhood.read_mesh(file).faces) == 1


UTM = np.array([451234.5, 5412345.2, 0])


def utm_file(folder):
    """A grid of 60 by 60 vertices, 0.1 m apart, and its positions."""
    V, quads = meshes.grid(60)
    V = UTM + 0.1 * V.astype(np.float64)
    file = folder / "utm.obj"
    rows = [f"v {x:.1f} {y:.1f} {z:.1f}" for x, y, z in V] + [f"f {a} {b} {c} {d}" for a, b, c, d in quads + 1]
    file.write_text("\n".join(rows))
    return file, V


def test_text_keeps_its_digits(tmp_path):
    file, V = utm_file(tmp_path)
    read = meshhood.read_mesh(file)  # no warning
    assert read.vertices.dtype == np.float64
    np.testing.assert_array_equal(read.vertices, np.round(V, 1))
    assert len(np.unique(read.vertices, axis=0)) == 3600
    index = meshhood.MeshIndex(read)  # no warning
    assert index.count(1830, 0.31) == 29


@pytest.mark.parametrize("dtype", (np.float32, "float32"))
def test_float32_that_is_coarse_warns(tmp_path, dtype):
    file, _ = utm_file(tmp_path)
    with pytest.warns(UserWarning, match=r"utm.obj: the mean edge is .* floats are 0.5 apart at 5.41e\+06; read"):
        V, F = meshhood.read_mesh(file, dtype=dtype)
    assert V.dtype == np.float32
    assert len(np.unique(V, axis=0)) == 780
    for make in (meshhood.MeshIndex, meshhood.MeshIndex.of_faces):
        with pytest.warns(UserWarning, match="V: the mean edge is .*float64"):
            make(V, F)
    with pytest.warns(UserWarning, match="P: the link is 0.1, but floats are 0.5 apart"):
        meshhood.MeshIndex.from_points(V, link=0.1)
    meshhood.MeshIndex(V - V[0], F)  # no warning
    meshhood.MeshIndex.from_points(V[:0], link=0.1)  # no warning


@pytest.mark.parametrize("dtype", (np.float64, "float64"))
def test_the_type_of_the_positions_can_be_chosen(tmp_path, dtype):
    file = tmp_path / "triangle.off"
    file.write_text(TRIANGLE.replace("1 0 0", "0.1 0 0"))
    assert meshhood.read_mesh(file).vertices[1, 0] == np.float32(0.1)
    assert meshhood.read_mesh(file, dtype=dtype).vertices[1, 0] == 0.1
    with pytest.raises(ValueError, match="dtype: int32, expected float32 or float64"):
        meshhood.read_mesh(file, dtype=np.int32)


def test_shared_mesh(tmp_path):
    mesh = meshhood.read_mesh(meshes.shared("scan/cortex_left_41k.ply.zst", tmp_path))
    assert mesh.vertices.shape == (40_962, 3)
    assert mesh.faces.shape == (81_920, 3)


def test_the_number_of_workers_does_not_change_the_mesh(tmp_path):
    file = tmp_path / "many.obj"
    rows = [f"v {i} {i % 7}.5 -{i}e-3" for i in range(30_000)] + [f"f {i} {i + 1} {i + 2}" for i in range(1, 29_999)]
    file.write_text("\n".join(rows), encoding="ascii")
    alone = meshhood.read_mesh(file, workers=1)
    for workers in (2, 3, -1):
        for one, other in zip(alone, meshhood.read_mesh(file, workers=workers)):
            assert one.tobytes() == other.tobytes()
    with pytest.raises(ValueError, match="workers: 0"):
        meshhood.read_mesh(file, workers=0)
