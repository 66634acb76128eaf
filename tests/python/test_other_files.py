# SPDX-License-Identifier: MIT
"""Mesh files that other libraries read and write, and those of other programs that the C++ library reads."""

import base64
import gzip
import importlib.util
import json
import os
import struct
import threading
import warnings
from pathlib import Path

import meshes
import meshhood
import numpy as np
import pytest

V, F = meshes.grid(6)
F = np.concatenate([F[:, [0, 1, 2]], F[:, [0, 2, 3]]]).astype(np.int32)
V = np.column_stack([V[:, :2], np.sin(V[:, 0])]).astype(np.float32)


def expect(read, faces=F, points=V):
    np.testing.assert_array_equal(read.vertices, points)
    np.testing.assert_array_equal(read.faces, faces)
    assert read.faces.dtype == np.int32
    assert meshhood.MeshIndex(read).count(0, 1.5) == meshhood.MeshIndex(points, faces).count(0, 1.5)


def renamed(file):
    """The same under a name that says nothing."""
    return Path(file.rename(file.parent / "mesh_without_a_name"))


@pytest.mark.parametrize("binary", (True, False))
def test_polygons_of_pyvista(tmp_path, binary):
    pyvista = pytest.importorskip("pyvista")
    file = tmp_path / "a.vtk"
    pyvista.PolyData.from_regular_faces(V, F).save(file, binary=binary)
    if binary:
        expect(meshhood.read_mesh(renamed(file)))
    else:
        np.testing.assert_allclose(meshhood.read_mesh(file).vertices, V, rtol=1e-5)


def test_a_grid_of_meshio(tmp_path):
    meshio = pytest.importorskip("meshio")
    file = tmp_path / "a.vtk"
    for form in ("vtk42", "vtk51"):
        meshio.write_points_cells(file, V, [("triangle", F)], file_format=form)
        expect(meshhood.read_mesh(file))


@pytest.mark.parametrize("kind", ("vtp", "vtu"))
def test_xml_of_vtk(tmp_path, kind):
    pyvista = pytest.importorskip("pyvista")
    file = tmp_path / f"a.{kind}"
    mesh = pyvista.PolyData.from_regular_faces(V, F) if kind == "vtp" else pyvista.UnstructuredGrid({5: F}, V)
    mesh.save(file)
    expect(meshhood.read_mesh(renamed(file)))


def test_quads_stay_quads(tmp_path):
    pyvista = pytest.importorskip("pyvista")
    file = tmp_path / "a.vtp"
    points, quads = meshes.grid(3)
    pyvista.PolyData.from_regular_faces(points, quads).save(file)
    offsets, corners = meshhood.read_mesh(file).faces
    assert (offsets.dtype, corners.dtype) == (np.int64, np.int32)
    np.testing.assert_array_equal(offsets, 4 * np.arange(len(quads) + 1))
    np.testing.assert_array_equal(corners, quads.ravel())


@pytest.mark.parametrize("end", ("vtk", "vtp"))
@pytest.mark.parametrize("kind", ("strips", "lines"))
def test_values_are_left_out_and_strips_and_lines_refused(tmp_path, end, kind):
    pyvista = pytest.importorskip("pyvista")
    mesh = pyvista.PolyData.from_regular_faces(V, F)
    mesh.point_data["height"] = np.where(mesh.points[:, 2] > 0, np.inf, np.nan)
    mesh.save(tmp_path / f"values.{end}")
    expect(meshhood.read_mesh(tmp_path / f"values.{end}"))
    pyvista.PolyData(V, **{kind: np.array([4, 0, 1, 6, 7])}).save(tmp_path / f"{kind}.{end}")
    with pytest.raises(ValueError, match=rf"{kind}\.{end}.*{kind}.*expected only polygons|{kind}.*expected only POLYGONS"):
        meshhood.read_mesh(tmp_path / f"{kind}.{end}")


def test_cells_that_are_no_faces_are_refused(tmp_path):
    pyvista = pytest.importorskip("pyvista")
    file = tmp_path / "a.vtu"
    pyvista.UnstructuredGrid({10: np.array([[0, 1, 2, 7]])}, V).save(file)
    with pytest.raises(ValueError, match="a.vtu: a file of VTK's XML that pyvista cannot read: .*extract_surface"):
        meshhood.read_mesh(file)


def test_msh(tmp_path):
    meshio = pytest.importorskip("meshio")
    file = tmp_path / "a.msh"
    meshio.write_points_cells(file, V.astype(float), [("triangle", F)], file_format="gmsh")
    expect(meshhood.read_mesh(renamed(file)))
    meshio.write_points_cells(file, V.astype(float), [("line", F[:1, :2]), ("triangle", F)], file_format="gmsh22")
    with pytest.warns(UserWarning, match="a.msh: points and lines, as of the boundary, are left out"):
        expect(meshhood.read_mesh(file))
    meshio.write_points_cells(file, V.astype(float), [("tetra", np.array([[0, 1, 2, 7]]))], file_format="gmsh")
    with pytest.raises(ValueError, match="a.msh: an MSH file that meshio cannot read: .*'tetra', expected a surface"):
        meshhood.read_mesh(file)


@pytest.mark.parametrize("kind", ("glb", "gltf"))
def test_a_scene_is_transformed(tmp_path, kind):
    trimesh = pytest.importorskip("trimesh")
    scene, moved = trimesh.Scene(), np.diag([2.0, 2, 2, 1])
    moved[:3, 3] = [10, 0, 0]
    for transform in (np.eye(4), moved):
        scene.add_geometry(trimesh.Trimesh(V, F, process=False), transform=transform)
    files = scene.export(file_type=kind)
    for name, data in (files if kind == "gltf" else {"model.glb": files}).items():
        (tmp_path / name).write_bytes(data)
    file = tmp_path / f"model.{kind}"
    read = meshhood.read_mesh(file, dtype=np.float32)
    there = 2 * V + np.float32([10, 0, 0])
    both = [V, there] if read.vertices[0, 0] == 0 else [there, V]  # in any order
    expect(read, np.concatenate([F, F + len(V)]), np.concatenate(both))
    assert meshhood.read_mesh(renamed(file)).vertices.dtype == np.float64


def test_the_word_that_tells_gltf_may_come_late(tmp_path):
    trimesh = pytest.importorskip("trimesh")
    files = trimesh.Scene([trimesh.Trimesh(V, F, process=False)]).export(file_type="gltf")
    scene = json.loads(files["model.gltf"])
    scene["accessors"] *= 30
    files["model.gltf"] = json.dumps(scene, sort_keys=True).encode()
    assert files["model.gltf"].index(b'"asset"') > 4096
    for name, data in files.items():
        (tmp_path / name).write_bytes(data)
    expect(meshhood.read_mesh(tmp_path / "model.gltf", dtype=np.float32))


def test_a_comment_tells_no_format(tmp_path):
    (tmp_path / "a.obj").write_text('# an "asset", no <GIFTI\nv 0 0 0\n')
    assert len(meshhood.read_mesh(tmp_path / "a.obj").vertices) == 1


def test_a_pipe_is_refused_with_what_to_do(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    writer = threading.Thread(target=(tmp_path / "pipe").write_bytes, args=(b"glTF",))
    writer.start()
    with pytest.raises(ValueError, match="pipe: is GLB, which only the Python package reads, from a file: write it to one"):
        meshhood.read_mesh(tmp_path / "pipe")
    writer.join()


def test_3mf(tmp_path):
    trimesh = pytest.importorskip("trimesh")
    pytest.importorskip("lxml")
    pytest.importorskip("networkx")
    file = tmp_path / "a.3mf"
    trimesh.Trimesh(V, F, process=False).export(file)
    read = meshhood.read_mesh(renamed(file))
    np.testing.assert_allclose(read.vertices, V, atol=1e-6)
    np.testing.assert_array_equal(read.faces, F)


def gifti(nibabel, file, xform=None):
    system = nibabel.gifti.GiftiCoordSystem(2, 3, np.eye(4) if xform is None else xform)
    arrays = [
        nibabel.gifti.GiftiDataArray(V, intent="NIFTI_INTENT_POINTSET", coordsys=system),
        nibabel.gifti.GiftiDataArray(F, intent="NIFTI_INTENT_TRIANGLE"),
    ]
    nibabel.save(nibabel.gifti.GiftiImage(darrays=arrays), file)
    return file


@pytest.mark.parametrize("end", ("gii", "gii.gz"))
def test_gifti(tmp_path, end):
    nibabel = pytest.importorskip("nibabel")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        expect(meshhood.read_mesh(gifti(nibabel, tmp_path / f"a.{end}")))
        expect(meshhood.read_mesh(renamed(tmp_path / f"a.{end}")))
    with pytest.warns(UserWarning, match="b.gii: the coordinates are in the space 'aligned'; .* to 'talairach' is not"):
        expect(meshhood.read_mesh(gifti(nibabel, tmp_path / "b.gii", np.diag([2.0, 2, 2, 1]))))


def test_a_gifti_file_unpacks_to_a_bounded_size(tmp_path, monkeypatch):
    nibabel = pytest.importorskip("nibabel")
    file = gifti(nibabel, tmp_path / "a.gii")
    (tmp_path / "b.gii.gz").write_bytes(gzip.compress(file.read_bytes() + b" " * 10**7))
    expect(meshhood.read_mesh(tmp_path / "b.gii.gz"))
    monkeypatch.setattr(meshhood._other_files, "_UNPACKED", 1 << 20)
    with pytest.raises(ValueError, match=r"b.gii.gz: .* unpacks to more than 1048576 bytes; gunzip unpacks it"):
        meshhood.read_mesh(tmp_path / "b.gii.gz")
    for old, new, message in (
        ('Dim0="', 'Dim0="99999', r"an array of shape \(99999\d+, 3\), beyond the limit of 1048576 bytes"),
        ('Dim0="', 'Dim0="-', r"an array of shape \(-\d+, 3\), beyond the limit"),
        (f'Dim0="{len(V)}"', 'Dim0="2"', r"an array of shape \(2, 3\) that unpacks to more than \d+ bytes"),
        (f'Dim0="{len(F)}"', 'Dim0="1"', r"an array of shape \(1, 3\) that unpacks to more than 12 bytes"),
    ):
        assert old in file.read_text()
        (tmp_path / "c.gii").write_text(file.read_text().replace(old, new))
        with pytest.raises(ValueError, match=f"c.gii: a GIFTI surface that nibabel cannot read: has {message}"):
            meshhood.read_mesh(tmp_path / "c.gii")


def test_surfaces_of_freesurfer(tmp_path):
    freesurfer = pytest.importorskip("nibabel.freesurfer")
    file = tmp_path / "lh.white"
    freesurfer.write_geometry(file, V, F)
    expect(meshhood.read_mesh(file))
    info = {"head": [2, 0, 20], "valid": "1", "filename": "a", "volume": np.ones(3, int), "voxelsize": np.ones(3)}
    axes = {f"{axis}ras": np.array([0.0, 1, 2]) for axis in "xyzc"}
    freesurfer.write_geometry(file, V, F, volume_info={**info, **axes})
    with pytest.warns(UserWarning, match="the center of the scan, 'cras   = .*1 .*2', is not added"):
        expect(meshhood.read_mesh(file))
    quads = b"\xff\xff\xff" + bytes([0, 0, 4, 0, 0, 1])
    quads += struct.pack(">12h", 0, 0, 0, 100, 0, 0, 100, 100, 0, 0, 100, 0) + bytes([0, 0, 0, 0, 0, 1, 0, 0, 2, 0, 0, 3])
    file.write_bytes(quads)
    read = meshhood.read_mesh(file)
    np.testing.assert_array_equal(read.vertices, [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
    assert len(read.faces) == 2


def write_with(library, file, points):
    if library == "meshio":
        pytest.importorskip("meshio").write_points_cells(file, points.astype(float), [("triangle", F + 2)], file_format="gmsh")
    elif file.suffix == ".vtu":
        pytest.importorskip(library).UnstructuredGrid({5: F + 2}, points).save(file)
    elif file.suffix in (".3mf", ".glb"):
        if file.suffix == ".3mf":
            pytest.importorskip("lxml")
            pytest.importorskip("networkx")
        pytest.importorskip(library).Trimesh(points, F + 2, process=False).export(file)
    elif file.suffix == ".vtp":
        pytest.importorskip(library).PolyData.from_regular_faces(points, F + 2).save(file)
    else:
        gifti = pytest.importorskip(library).gifti
        arrays = ((points, "NIFTI_INTENT_POINTSET"), ((F + 2).astype(np.int32), "NIFTI_INTENT_TRIANGLE"))
        pieces = [gifti.GiftiDataArray(array, intent=intent, datatype=str(array.dtype)) for array, intent in arrays]
        file.write_bytes(gifti.GiftiImage(darrays=pieces).to_bytes())


HOLED_FILES = (("vtp", "pyvista"), ("vtu", "pyvista"), ("msh", "meshio"), ("glb", "trimesh"), ("3mf", "trimesh"), ("gii", "nibabel"))


@pytest.mark.parametrize(("end", "library"), HOLED_FILES)
def test_vertices_of_nan_are_walls_if_no_face_has_them(tmp_path, end, library):
    points = np.concatenate([np.full((2, 3), np.nan, np.float32), V])
    file = tmp_path / f"a.{end}"
    write_with(library, file, points)
    with pytest.warns(UserWarning, match=f"a.{end}: 2 vertices without a position .*, the first of which is 0, are walls"):
        read = meshhood.read_mesh(file)
    np.testing.assert_allclose(read.vertices, points, atol=1e-6)
    np.testing.assert_array_equal(read.faces, F + 2)
    with pytest.warns(UserWarning, match="V: 2 vertices without a position"):
        index = meshhood.MeshIndex(read)
    np.testing.assert_array_equal(index.counts(1.5), [0, 0, *meshhood.MeshIndex(V, F).counts(1.5)])


@pytest.mark.parametrize(("end", "library"), HOLED_FILES)
def test_a_vertex_of_nan_in_a_face_is_refused(tmp_path, end, library):
    points = np.concatenate([np.full((2, 3), np.nan, np.float32), V])
    points[2 + F[7, 1]] = np.nan
    write_with(library, tmp_path / f"a.{end}", points)
    with pytest.raises(ValueError, match=rf"a.{end}: vertex {2 + F[7, 1]} has no position \(NaN\), but face \d+ has it as corner \d"):
        meshhood.read_mesh(tmp_path / f"a.{end}")


@pytest.mark.parametrize(("end", "library"), [file for file in HOLED_FILES if file[0] not in ("vtu", "msh")])
def test_no_corner_without_a_vertex_and_no_coordinate_that_is_not_finite_is_read(tmp_path, end, library):
    file = tmp_path / f"a.{end}"
    far = np.concatenate([V[:2], V])
    far[2 + F[7, 1], 1] = np.inf
    for points, message in (
        (V, rf"face \d+: corner \d is vertex {len(V)}, but the mesh has {len(V)} vertices"),
        (far, rf"vertex {2 + F[7, 1]}: y is inf, expected a finite number"),
    ):
        write_with(library, file, points)
        with pytest.raises(ValueError, match=rf"a\.{end}: {message}"):
            meshhood.read_mesh(file)


def save_gltf(file, change):
    """What trimesh writes, in one file, with a change of its JSON."""
    trimesh = pytest.importorskip("trimesh")
    files = trimesh.Scene([trimesh.Trimesh(V, F, process=False)]).export(file_type="gltf")
    scene = json.loads(files.pop("model.gltf"))
    for buffer in scene["buffers"]:
        buffer["uri"] = "data:;base64," + base64.b64encode(files[buffer["uri"]]).decode()
    change(scene)
    text = json.dumps(scene).encode()
    if file.suffix == ".glb":
        text += b" " * (-len(text) % 4)
        text = struct.pack("<4s4I", b"glTF", 2, 20 + len(text), len(text), 0x4E4F534A) + text
    file.write_bytes(text)


def with_primitive(**settings):
    return lambda scene: scene["meshes"][0]["primitives"][0].update(settings)


def with_positions(**settings):
    return lambda scene: scene["accessors"][scene["meshes"][0]["primitives"][0]["attributes"]["POSITION"]].update(settings)


@pytest.mark.parametrize("kind", ("glb", "gltf"))
def test_gltf_that_trimesh_does_not_decode_is_refused(tmp_path, kind):
    file = tmp_path / f"a.{kind}"
    save_gltf(file, lambda scene: scene.update(extensionsRequired=["KHR_materials_unlit", "KHR_mesh_quantization"]))
    expect(meshhood.read_mesh(file))
    for change, message in (
        (lambda scene: scene.update(extensionsRequired=["EXT_meshopt_compression"]), "requires EXT_meshopt_compression"),
        (with_primitive(extensions={"KHR_draco_mesh_compression": {}}), "needs DracoPy: pip install DracoPy"),
        (with_primitive(mode=6), "mesh 0 has a triangle fan"),
        (with_positions(sparse={"count": 1}), "mesh 0 has a sparse accessor"),
        (with_positions(normalized=True), "mesh 0 has normalized positions"),
        (lambda scene: scene.pop("scenes"), "has meshes, but no scene"),
        (lambda scene: scene.update(scenes=[]), "has meshes, but no scene"),
    ):
        if "DracoPy" in message and importlib.util.find_spec("DracoPy"):
            continue
        save_gltf(file, change)
        with pytest.raises((ValueError, ModuleNotFoundError), match=f"a.{kind}: a .* {message}"):
            meshhood.read_mesh(file)
    save_gltf(file, lambda scene: (all_of := scene["meshes"][0]["primitives"]).append({**all_of[0], "mode": 1}))
    with pytest.warns(UserWarning, match=f"a.{kind}: points and lines are left out"):
        meshhood.read_mesh(file)


def test_the_extension_tells_what_comes_late(tmp_path):
    save_gltf(tmp_path / "a.gltf", lambda scene: scene.update(asset=scene.pop("asset")))
    text = (tmp_path / "a.gltf").read_text()
    (tmp_path / "late.gltf").write_text('{"extras": "' + 70000 * "x" + '",' + text[1:])
    expect(meshhood.read_mesh(tmp_path / "late.gltf"))
    surface = gifti(pytest.importorskip("nibabel"), tmp_path / "a.gii").read_text()
    (tmp_path / "late.gii").write_text(surface.replace("<GIFTI", f"<!-- {70000 * 'x'} --><GIFTI", 1))
    expect(meshhood.read_mesh(tmp_path / "late.gii"))


XML = """<?xml version="1.0"?><VTKFile type="PolyData" version="1.0" byte_order="LittleEndian"><PolyData>
<Piece NumberOfPoints="3" NumberOfPolys="1"><Points><DataArray type="Float32" NumberOfComponents="3" format="ascii">
0 0 0 1 0 0 0 1 0</DataArray></Points><Polys><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">3</DataArray></Polys></Piece></PolyData></VTKFile>"""


@pytest.mark.parametrize(
    ("old", "new", "message"),
    (
        (" 1 0</Data", "</Data", "Cannot read points array from Points in piece 0"),
        (">3</Data", ">30</Data", "Cannot read cell connectivity"),
        ("</Piece>", "", "[^\n]*XML[^\n]*"),
        ("PolyData", "ImageData", "type ImageData, expected PolyData or UnstructuredGrid$"),
        ("PolyData", "PPolyData", "type PPolyData, expected"),
        ("PolyData", "vtkMultiBlockDataSet", "type vtkMultiBlockDataSet, expected"),
    ),
)
def test_a_damaged_or_other_file_of_vtk_is_refused_in_a_line(tmp_path, old, new, message):
    pytest.importorskip("pyvista")
    file = tmp_path / "a.vtp"
    file.write_text(XML)
    assert len(meshhood.read_mesh(file).faces) == 1
    assert old in XML
    file.write_text(XML.replace(old, new))
    with pytest.raises(ValueError, match=f"a.vtp: a file of VTK's XML that pyvista cannot read: {message}") as refused:
        meshhood.read_mesh(file)
    assert "\n" not in str(refused.value)


def test_quotes_of_xml_may_be_single(tmp_path):
    pyvista = pytest.importorskip("pyvista")
    pyvista.UnstructuredGrid({5: F}, V).save(tmp_path / "a.vtu", binary=False)
    text = (tmp_path / "a.vtu").read_text()
    assert 'type="UnstructuredGrid"' in text
    (tmp_path / "b").write_text(text.replace('type="UnstructuredGrid"', "type = 'UnstructuredGrid'"))
    expect(meshhood.read_mesh(tmp_path / "b"))


def test_numbers_beyond_float32_are_refused(tmp_path):
    for library in ("pyvista", "trimesh", "nibabel"):
        pytest.importorskip(library)
    points = np.eye(3)
    points[1, 2] = 1e39
    faces = np.array([[0, 1, 2]])
    for end in ("gii", "glb"):
        with pytest.raises(ValueError, match=rf"V: vertex 1: 1e\+39, but a \.{end} file holds numbers of at most 3\.4e\+38"):
            meshhood.write_mesh(tmp_path / f"a.{end}", points, faces)
    meshhood.write_mesh(tmp_path / "a.vtp", points, faces)
    np.testing.assert_array_equal(meshhood.read_mesh(tmp_path / "a.vtp").vertices, points)
    with pytest.raises(ValueError, match=r"a\.vtp: vertex 1: 1e\+39, but float32 holds numbers of at most"):
        meshhood.read_mesh(tmp_path / "a.vtp", dtype=np.float32)


def test_what_is_partitioned_may_be_of_any_reader(tmp_path):
    nibabel = pytest.importorskip("nibabel")
    gifti(nibabel, tmp_path / "a.gii", np.diag([2.0, 2, 2, 1]))
    with pytest.warns(UserWarning, match="a.gii: the coordinates are in the space 'aligned'"):
        parts = meshhood.partition(tmp_path / "a.gii", tmp_path / "parts", parts=2, halo=1.5)
    np.testing.assert_array_equal(parts.counts(1.5).compute(), meshhood.MeshIndex(V, F).counts(1.5))


@pytest.mark.parametrize("content", (b"<VTKFile>", b"<GIFTI", b"glTF", b'{"asset": 1', b"PK\x03\x04", b"$MeshFormat"))
def test_a_broken_file_is_an_error_that_names_it(tmp_path, content):
    for library in ("pyvista", "nibabel", "trimesh", "meshio"):
        pytest.importorskip(library)
    file = tmp_path / "broken"
    file.write_bytes(content)
    with pytest.raises((ValueError, ModuleNotFoundError), match="broken: .* (that .* cannot read|needs)"):
        meshhood.read_mesh(file)


# Writing


@pytest.mark.parametrize("extension", ("vtk", "vtp", "glb", "gii", "surf.gii"))
def test_what_is_written_is_read(tmp_path, extension):
    for library in ("pyvista", "trimesh", "nibabel"):
        pytest.importorskip(library)
    file = tmp_path / f"a.{extension}"
    meshhood.write_mesh(file, V, F)
    expect(meshhood.read_mesh(renamed(file)))


def test_values_of_vtp(tmp_path):
    pyvista = pytest.importorskip("pyvista")
    colors = np.arange(3 * len(V), dtype=np.uint8).reshape(-1, 3)
    polygons = np.array([0, 3, 7]), np.array([0, 1, 2, 0, 1, 7, 6])
    meshhood.write_mesh(tmp_path / "a.vtp", V, polygons, values={"h": V[:, 2], "n": V}, colors=colors)
    mesh = pyvista.read(tmp_path / "a.vtp")
    np.testing.assert_array_equal(mesh["h"], V[:, 2])
    np.testing.assert_array_equal(mesh["n"], V)
    np.testing.assert_array_equal(mesh["RGB"], colors)
    np.testing.assert_array_equal(meshhood.read_mesh(tmp_path / "a.vtp").faces[1], polygons[1])
    for letter in '"&<>':
        with pytest.raises(ValueError, match=r"values\['a.b'\]: expected a name without .* for .vtp"):
            meshhood.write_mesh(tmp_path / "b.vtp", V, F, values={f"a{letter}b": V[:, 2]})
    assert not (tmp_path / "b.vtp").exists()


@pytest.mark.parametrize("extension", ("vtk", "vtp"))
def test_values_of_vertices_without_faces_are_read_by_vtk(tmp_path, extension):
    pyvista = pytest.importorskip("pyvista")
    file = tmp_path / f"a.{extension}"
    meshhood.write_mesh(file, V, np.empty((0, 3), np.int32), values={"h": V[:, 2]})
    np.testing.assert_array_equal(pyvista.read(file)["h"], V[:, 2])
    assert len(meshhood.read_mesh(file).vertices) == len(V)


def test_values_and_colors_of_glb(tmp_path):
    trimesh = pytest.importorskip("trimesh")
    colors = np.arange(3 * len(V), dtype=np.uint8).reshape(-1, 3)
    meshhood.write_mesh(tmp_path / "a.glb", V, F, values={"h": V[:, 2]}, colors=colors)
    mesh = trimesh.load_scene(tmp_path / "a.glb").to_mesh()
    np.testing.assert_array_equal(mesh.vertex_attributes["_h"].ravel(), V[:, 2])
    np.testing.assert_array_equal(mesh.visual.vertex_colors[:, :3], colors)


@pytest.mark.parametrize("kind", ("shape", "func"))
def test_maps_of_gifti(tmp_path, kind):
    nibabel = pytest.importorskip("nibabel")
    file = tmp_path / f"a.{kind}.gii"
    meshhood.write_mesh(file, V, F, values={"h": V[:, 2], "x": V[:, 0]})
    arrays = nibabel.load(file).darrays
    assert [array.meta["Name"] for array in arrays] == ["h", "x"]
    np.testing.assert_array_equal(arrays[0].data, V[:, 2])
    with pytest.raises(ValueError, match=f"values: expected some for .{kind}.gii"):
        meshhood.write_mesh(file, V, F)
    with pytest.raises(ValueError, match=r"values\['n'\]: vectors"):
        meshhood.write_mesh(file, V, F, values={"n": V})


def test_what_a_format_has_not_is_refused(tmp_path):
    for library in ("trimesh", "nibabel"):
        pytest.importorskip(library)
    quads = meshes.grid(6)[1]
    for extension in ("gii", "glb"):
        with pytest.raises(ValueError, match=f"F: polygons, expected triangles for .{extension}"):
            meshhood.write_mesh(tmp_path / f"a.{extension}", V, quads)
    with pytest.raises(ValueError, match="values: expected None for a surface"):
        meshhood.write_mesh(tmp_path / "a.gii", V, F, values={"h": V[:, 2]})
    with pytest.raises(ValueError, match="colors: expected None for .gii"):
        meshhood.write_mesh(tmp_path / "a.gii", V, F, colors=np.zeros((len(V), 3), np.uint8))
    with pytest.raises(ValueError, match="F: no faces, which .glb cannot do without"):
        meshhood.write_mesh(tmp_path / "a.glb", V, F[:0])
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("extension", ("ply", "vtk", "vtp", "glb", "shape.gii"))
def test_names_of_values_are_the_same_for_all_formats(tmp_path, extension):
    for library in ("pyvista", "trimesh", "nibabel"):
        pytest.importorskip(library)
    for name in ("", "two words", "höhe", "line\n"):
        with pytest.raises(ValueError, match="property '.*': expected printable ASCII without blanks"):
            meshhood.write_mesh(tmp_path / f"a.{extension}", V, F, values={name: V[:, 2]})
    colors = np.zeros((len(V), 3), np.uint8)
    taken = {"ply": "red", "vtp": "RGB"}.get(extension)
    if taken:
        with pytest.raises(ValueError, match=f"property '{taken}' occurs twice, or is one that the file has of itself"):
            meshhood.write_mesh(tmp_path / f"a.{extension}", V, F, values={taken: V[:, 2]}, colors=colors)
    assert not list(tmp_path.iterdir())


def test_names_of_values_are_decoded(tmp_path):
    pyvista = pytest.importorskip("pyvista")
    names = ["5%", "%41", "a\"b"]
    meshhood.write_mesh(tmp_path / "a.vtk", V, F, values=dict.fromkeys(names, V[:, 2]))
    assert pyvista.read(tmp_path / "a.vtk").array_names == names
    mesh = pyvista.PolyData.from_regular_faces(V, F)
    mesh.field_data["names"] = ["two words", "", 100 * "long"]
    for binary in (True, False):
        mesh.save(tmp_path / "b.vtk", binary=binary)
        assert len(meshhood.read_mesh(tmp_path / "b.vtk").faces) == len(F)


def test_files_of_float32_warn_where_digits_are_lost(tmp_path):
    pytest.importorskip("nibabel")
    far = np.array([[0, 0, 0], [0.1, 0, 0], [0, 0.1, 0]]) + [5e5, 4.5e6, 0]
    with pytest.warns(UserWarning, match="floats are 0.5 apart at 4.5e"):
        meshhood.write_mesh(tmp_path / "far.surf.gii", far, np.array([[0, 1, 2]]))
    with pytest.warns(UserWarning, match="floats are 0.5 apart at 4.5e"):
        meshhood.read_mesh(tmp_path / "far.surf.gii")
    with pytest.raises(ValueError, match=r"path: \.label\.gii, expected \.surf\.gii"):
        meshhood.write_mesh(tmp_path / "near.label.gii", np.eye(3), np.array([[0, 1, 2]]))
