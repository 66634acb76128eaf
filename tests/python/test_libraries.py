# SPDX-License-Identifier: MIT
"""Meshes and arrays of other libraries. A library that is not installed is skipped by name."""

import meshes
import meshhood
import numpy as np
import pytest

V, QUADS = meshes.grid(8)
V[:, 2] = V[:, 0] * V[:, 1] / 16
F = meshes.triangles(QUADS)
INDEX = meshhood.MeshIndex(V, F)
WANTED = meshhood.MeshIndex(V, F).neighborhoods(2.0, sort="id")[1]


def expect_same(index):
    np.testing.assert_array_equal(index.neighborhoods(2.0, sort="id")[1], WANTED)


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
    counts = index.counts(kind(np.array([1.0, 2.0, 3.0])), kind(rows))
    np.testing.assert_array_equal(counts, index.counts([1.0, 2.0, 3.0], rows))


@pytest.mark.parametrize(
    ("call", "given"),
    (
        (lambda points: [INDEX.stroke(points, 1.5)], np.array([1, 9, 20])),
        (lambda points: [INDEX.stroke(points, 1.5)], V[:4]),
        (lambda points: INDEX.nearest(points), V[3]),
        (lambda points: INDEX.nearest(points), V[3:4]),
        (lambda points: INDEX.closest_point(points), V[3]),
        (lambda points: INDEX.first_hit(points, [0, 0, 1.0]), V[3] - [0, 0, 5]),
        (lambda start: [INDEX.neighborhood(start, 1.5)], V[3] + 0.1),
        (lambda start: [INDEX.neighborhood(start, 1.5)], np.array(3)),
        (lambda seeds: [INDEX.neighborhood(V[3] + 0.1, 1.5, seeds=seeds)], np.array([3, 4])),
        (lambda seeds: [INDEX.neighborhood(V[3] + 0.1, 1.5, seeds=seeds)], np.array(3)),
        (lambda seeds: [INDEX.stroke(V[:2], 1.5, seeds=seeds)], np.array([0, 1])),
        (lambda face: [INDEX.stroke(V[:2], 1.5, face=face)], np.array([0, 1])),
        (lambda face: [INDEX.thickness(points=V[3], face=face)], np.array(2)),
        (lambda face: [INDEX.thickness(points=V[:2], face=face)], np.array([0, 1])),
        (lambda start: INDEX.rim([0], start, 0.5)[0], np.array(0)),
        (lambda start: INDEX.rim([0], start, 0.5)[0], V[0] + 0.0),
        (lambda fwhm: [INDEX.smooth(V[:, 2], fwhm)], np.array(1.5)),
    ),
)
def test_a_tensor_is_one_or_many_as_the_array_is(call, given):
    for found, wanted in zip(call(WithDlpack(given)), call(given)):
        assert np.shape(found) == np.shape(wanted)
        np.testing.assert_array_equal(found, wanted)


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


class Part:
    """A mesh of nilearn, as far as it is read."""

    def __init__(self, coordinates, faces):
        self.coordinates, self.faces = coordinates, faces


class Several:
    """A PolyMesh of nilearn, or the data of a SurfaceImage."""

    def __init__(self, **parts):
        self.parts = parts


class Image:
    """A SurfaceImage of nilearn."""

    def __init__(self, mesh, data):
        self.mesh, self.data = mesh, data


def test_meshes_and_images_of_nilearn():
    mesh = Several(left=Part(V, F))
    image = Image(mesh, Several(left=V[:, :2]))
    for given in (Part(V, F), mesh, image):
        expect_same(meshhood.MeshIndex(given))
    index = meshhood.MeshIndex(image)
    np.testing.assert_array_equal(index.smooth(image, 2.0), index.smooth(V[:, :2], 2.0))
    np.testing.assert_array_equal(index.curvature(2.0, F=mesh).k1, index.curvature(2.0).k1)
    both = Several(left=Part(V, F), right=Part(V, F))
    with pytest.raises(ValueError, match=r"V: has the parts 'left', 'right', expected one: .parts\['left'\]"):
        meshhood.MeshIndex(both)


def test_a_surface_of_nilearn():
    surface = pytest.importorskip("nilearn.surface")
    expect_same(meshhood.MeshIndex(surface.InMemoryMesh(V, F)))


def test_values_are_written_by_name(tmp_path):
    pyvista = pytest.importorskip("pyvista")
    values = {"quality": V[:, 0], "direction": V.astype(np.float32)}
    meshhood.write_mesh(tmp_path / "a.ply", V, F, values=values, colors=np.full((len(V), 3), 7, np.uint8))
    text = (tmp_path / "a.ply").read_bytes()
    assert all(f"property float {name}\n".encode() in text for name in ("quality", "direction_x", "direction_z"))
    back = meshhood.read_mesh(tmp_path / "a.ply")
    np.testing.assert_array_equal(back.vertices, V)
    np.testing.assert_array_equal(back.faces, F)
    meshhood.write_mesh(tmp_path / "a.vtk", V, F, values=values)
    np.testing.assert_array_equal(pyvista.read(tmp_path / "a.vtk")["quality"], V[:, 0].astype(np.float32))
    for words, message in (
        ({"values": {"k": V[1:, 0]}}, r"values\['k'\]: expected an array of shape"),
        ({"values": {"a b": V[:, 0]}}, "a b"),
        ({"colors": V}, "colors: float"),
    ):
        with pytest.raises(ValueError, match=message):
            meshhood.write_mesh(tmp_path / "b.ply", V, F, **words)
    with pytest.raises(ValueError, match="path: the extension '.obj', expected .ply, .vtk"):
        meshhood.write_mesh(tmp_path / "b.obj", V, F)
    assert not (tmp_path / "b.ply").exists()


def test_the_accessor_of_pyvista():
    pyvista = pytest.importorskip("pyvista", minversion="0.48")
    import meshhood._pyvista  # noqa: F401: by its entry point, if the package is installed

    mesh = pyvista.PolyData.from_regular_faces(V, F)
    index = mesh.meshhood.index
    mesh["k1"] = mesh.meshhood.curvature(2.0).k1
    assert mesh.meshhood.index is index
    np.testing.assert_array_equal(mesh["k1"], meshhood.MeshIndex(V, F).curvature(2.0).k1)
    mesh.points *= 2
    assert mesh.meshhood.count(0, 2.0) == meshhood.MeshIndex(mesh.points, F).count(0, 2.0)
    assert "smooth" in dir(mesh.meshhood)
    with pytest.raises(AttributeError, match="sharpen"):
        mesh.meshhood.sharpen


@pytest.mark.filterwarnings("ignore:The default value of `algorithm`")
def test_what_is_no_surface_is_refused_with_the_call_that_makes_one():
    trimesh, pyvista = pytest.importorskip("trimesh"), pytest.importorskip("pyvista")
    plane = pyvista.Plane()
    strip = pyvista.PolyData(V[:4], strips=[4, 0, 1, 2, 3])
    for mesh, advice in (
        (trimesh.Scene(trimesh.creation.box()), r"scene\.to_mesh\(\)"),
        (plane.cast_to_unstructured_grid(), r"mesh\.extract_surface\(\)"),
        (strip, r"1 strips, .*mesh\.triangulate\(\)"),
    ):
        with pytest.raises((TypeError, ValueError), match=advice):
            meshhood.MeshIndex(mesh)
    boxes = trimesh.Scene([trimesh.creation.box(), trimesh.creation.box()])
    surfaces = boxes.to_mesh(), plane.cast_to_unstructured_grid().extract_surface(), strip.triangulate()
    assert [len(meshhood.MeshIndex(mesh)) for mesh in surfaces] == [16, plane.n_points, 4]


def test_what_vtk_does_not_call_polygons_is_refused_with_the_filter_that_makes_them():
    vtk = pytest.importorskip("vtk")
    with pytest.raises(TypeError, match="vtkUnstructuredGrid, expected one surface: vtkGeometryFilter"):
        meshhood.MeshIndex(vtk.vtkUnstructuredGrid())
