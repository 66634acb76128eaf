# SPDX-License-Identifier: MIT
"""Meshes and arrays of other libraries. A library that is not installed is skipped by name."""

import meshes
import meshhood
import numpy as np
import pytest

V, QUADS = meshes.grid(8)
V[:, 2] = V[:, 0] * V[:, 1] / 16
F = meshes.triangles(QUADS)
WANTED = meshhood.MeshIndex(V, F).query_ball(None, 2.0, sort="id")[1]


def expect_same(index):
    np.testing.assert_array_equal(index.query_ball(None, 2.0, sort="id")[1], WANTED)


def test_arrays_of_igl_in_either_order_are_read():
    for order in "CF":
        for ids in (np.int32, np.int64):
            expect_same(meshhood.MeshIndex(np.asarray(V, order=order), np.asarray(F, dtype=ids, order=order)))


class WithInterface:
    """An array of another library: only NumPy's older protocol."""

    def __init__(self, array):
        self._array = array
        self.__array_interface__ = array.__array_interface__


class WithDlpack:
    """A tensor of another library: only DLPack."""

    def __init__(self, array):
        self._array = array

    def __dlpack__(self, **options):
        return self._array.__dlpack__(**options)

    def __dlpack_device__(self):
        return self._array.__dlpack_device__()


@pytest.mark.parametrize("kind", (WithInterface, WithDlpack))
def test_other_arrays_are_read_in_place_of_every_array(kind):
    index = meshhood.MeshIndex(kind(V), kind(F))
    expect_same(index)
    expect_same(meshhood.MeshIndex(kind(np.asfortranarray(V)), kind(np.asfortranarray(F))))
    expect_same(index.refit(kind(V)))
    expect_same(index.refit(kind(V), kind(np.arange(9))))
    rows = np.array([3, 9, 27])
    counts = index.count(kind(rows), kind(np.array([1.0, 2.0, 3.0])))
    np.testing.assert_array_equal(counts, index.count(rows, [1.0, 2.0, 3.0]))


class OnAnotherDevice(WithDlpack):
    def __dlpack__(self, **options):
        raise BufferError("the tensor is on another device")


def test_a_tensor_on_another_device_is_refused_by_name():
    with pytest.raises(ValueError, match="V: the tensor is on another device"):
        meshhood.MeshIndex(OnAnotherDevice(V), F)


def test_tensors_of_pytorch_are_read():
    torch = pytest.importorskip("torch")
    index = meshhood.MeshIndex(torch.tensor(V), torch.tensor(F))
    expect_same(index)
    expect_same(index.refit(torch.tensor(V)))
    with pytest.raises(TypeError, match="V: .*detach"):
        meshhood.MeshIndex(torch.tensor(V, requires_grad=True), F)


def test_a_mesh_of_open3d_is_read():
    open3d = pytest.importorskip("open3d")
    legacy = open3d.geometry.TriangleMesh(
        open3d.utility.Vector3dVector(V), open3d.utility.Vector3iVector(F.astype(np.int32))
    )
    expect_same(meshhood.MeshIndex(legacy))
    expect_same(meshhood.MeshIndex(open3d.t.geometry.TriangleMesh.from_legacy(legacy)))


class Open3dLike:
    """The attributes of open3d.geometry.TriangleMesh."""

    def __init__(self):
        self.vertices, self.triangles = V.tolist(), F.tolist()


class Open3dTensor:
    def __init__(self, array):
        self._array = array

    def cpu(self):
        return self

    def numpy(self):
        return self._array


class Open3dTensors:
    """The attributes of open3d.t.geometry.TriangleMesh."""

    def __init__(self):
        self.vertex = type("TensorMap", (), {"positions": Open3dTensor(V)})()
        self.triangle = type("TensorMap", (), {"indices": Open3dTensor(F)})()


@pytest.mark.parametrize("kind", (Open3dLike, Open3dTensors))
def test_objects_with_the_attributes_of_open3d_are_read(kind):
    index = meshhood.MeshIndex(kind())
    expect_same(index)
    expect_same(index.refit(kind()))


def test_a_mesh_of_vtk_is_read():
    vtk = pytest.importorskip("vtk")
    from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray

    points, polygons, mesh = vtk.vtkPoints(), vtk.vtkCellArray(), vtk.vtkPolyData()
    points.SetData(numpy_to_vtk(V, deep=True))
    offsets = np.arange(0, 3 * len(F) + 1, 3)
    polygons.SetData(
        numpy_to_vtkIdTypeArray(offsets, deep=True), numpy_to_vtkIdTypeArray(F.ravel().astype(np.int64), deep=True)
    )
    with pytest.raises(ValueError, match="V: has no points"):
        meshhood.MeshIndex(mesh)
    mesh.SetPoints(points)
    mesh.SetPolys(polygons)
    index = meshhood.MeshIndex(mesh)
    expect_same(index)
    expect_same(index.refit(mesh))
    lines = vtk.vtkCellArray()
    lines.InsertNextCell(2, [0, 1])
    mesh.SetLines(lines)
    with pytest.raises(ValueError, match="V: has 1 lines, expected only polygons"):
        meshhood.MeshIndex(mesh)


def test_a_mesh_of_vedo_is_read():
    vedo = pytest.importorskip("vedo")
    index = meshhood.MeshIndex(vedo.Mesh([V, F]))
    expect_same(index)
    expect_same(index.refit(vedo.Mesh([V, F])))


def test_a_surface_of_nibabel_is_read(tmp_path):
    nibabel = pytest.importorskip("nibabel")

    def gifti(*arrays):
        return nibabel.GiftiImage(
            darrays=[
                nibabel.gifti.GiftiDataArray(np.asarray(data, kind), intent=intent) for data, kind, intent in arrays
            ]
        )

    points, triangles = (V, np.float32, "NIFTI_INTENT_POINTSET"), (F, np.int32, "NIFTI_INTENT_TRIANGLE")
    nibabel.save(gifti(points, triangles), tmp_path / "surface.gii")
    index = meshhood.MeshIndex(nibabel.load(tmp_path / "surface.gii"))
    expect_same(index)
    expect_same(index.refit(gifti(points, triangles)))
    with pytest.raises(ValueError, match="V: has 0 arrays of intent 'triangle', expected one"):
        meshhood.MeshIndex(gifti(points))
    with pytest.raises(ValueError, match="V: has 2 arrays of intent 'pointset', expected one"):
        meshhood.MeshIndex(gifti(points, points, triangles))
