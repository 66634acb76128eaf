# SPDX-License-Identifier: MIT
"""Containers whose type is trusted and whose content is wrong. They are refused with one error that names the argument,
before another library reads beyond its arrays."""

import meshes
import meshhood
import numpy as np
import pytest
from scipy.sparse import bsr_array, coo_array, csc_array, csr_array, dia_array, dok_array, lil_array

V, QUADS = meshes.grid(6)
F = meshes.triangles(QUADS)
ENDS = QUADS.ravel(), np.roll(QUADS, -1, axis=1).ravel()
SHAPE = (len(V), len(V))
KINDS = (csr_array, csc_array, bsr_array, coo_array, dia_array, dok_array, lil_array)
WANTED = meshhood.MeshIndex(V, QUADS).neighborhoods(1.5, sort="id")[1]


def graph(kind):
    return kind(coo_array((np.ones(len(ENDS[0])), ENDS), shape=SHAPE))


@pytest.mark.parametrize("kind", KINDS)
def test_every_sparse_format_is_read(kind):
    index = meshhood.MeshIndex(V, graph(kind))
    np.testing.assert_array_equal(index.neighborhoods(1.5, sort="id")[1], WANTED)


def test_blocks_are_read():
    dense = np.zeros(SHAPE)
    dense[ENDS] = 1
    blocks = bsr_array(dense, blocksize=(4, 3))
    rows, columns = blocks.tocoo().coords  # a block stores all of its entries
    wanted = meshhood.MeshIndex(V, coo_array((np.ones(len(rows)), (rows, columns)), shape=SHAPE))
    got = meshhood.MeshIndex(V, blocks)
    np.testing.assert_array_equal(got.neighborhoods(1.5, sort="id")[1], wanted.neighborhoods(1.5, sort="id")[1])


def set_value(name, at, value):
    def change(matrix):
        getattr(matrix, name)[at] = value

    return change


def set_array(name, value):
    def change(matrix):
        setattr(matrix, name, value(getattr(matrix, name)))

    return change


@pytest.mark.parametrize(
    ("kind", "change", "message"),
    (
        (csr_array, set_value("indptr", 5, 10**6), "F: row 4: indptr goes from .* to 1000000"),
        (csr_array, set_value("indptr", 5, 2**31 - 1), "F: row 4: indptr"),
        (csr_array, set_value("indptr", 5, -3), "F: row 4: indptr goes from .* to -3"),
        (csr_array, set_value("indptr", 0, 2), "F: row 0: indptr begins with 2"),
        (csr_array, set_value("indptr", -1, 10**9), "F: row 35: indptr"),
        (csr_array, set_array("indptr", lambda a: a[:-3]), r"F: indptr of shape \(34,\)"),
        (csr_array, set_array("indptr", lambda a: np.r_[a, a[-1]]), r"F: indptr of shape \(38,\)"),
        (csr_array, set_array("indices", lambda a: a[:-3]), "F: row 3[0-9]: indptr goes from"),
        (csr_array, set_array("indices", lambda a: a.reshape(2, -1)), r"F: indptr .* indices of shape \(2, "),
        (csr_array, set_value("indices", 0, 36), "F: row 0: an edge to 36, but the mesh has 36"),
        (csr_array, set_value("indices", 0, -1), "F: row 0: an edge to -1"),
        (csc_array, set_value("indptr", 5, 10**6), "F: column 4: indptr"),
        (csc_array, set_value("indices", 0, 99), "F: column 0: an edge to 99"),
        (bsr_array, set_value("indptr", 5, 10**6), "F: row 4: indptr"),
        (bsr_array, set_value("indices", 0, 10**6), "F: row 0: an edge to"),
        (lil_array, set_array("rows", lambda a: a[:-1]), r"F: rows of shape \(35,\)"),
        (lil_array, lambda m: m.rows[3].append(77), "F: face .*vertex 77"),
        (dia_array, set_array("offsets", lambda a: a[:-1]), "F: "),
    ),
)
def test_sparse_matrices_with_wrong_content_are_refused(kind, change, message):
    matrix = graph(kind)
    change(matrix)
    with pytest.raises(ValueError, match=message):
        meshhood.MeshIndex(V, matrix)


def test_coordinates_of_different_lengths_are_refused():
    matrix = graph(coo_array)
    matrix.coords = (matrix.coords[0], matrix.coords[1][:-1])
    with pytest.raises(ValueError, match=r"F: .*rows.*columns"):
        meshhood.MeshIndex(V, matrix)
    matrix.coords = (np.full(4, 10**6), np.full(4, 3))
    with pytest.raises(ValueError, match="F: face 0: corner 0 is vertex 1000000"):
        meshhood.MeshIndex(V, matrix)


@pytest.mark.parametrize("cells", ("offsets", "corners", "end"))
def test_vtk_cells_with_wrong_content_are_refused(cells):
    pyvista = pytest.importorskip("pyvista")
    vtk = pytest.importorskip("vtk")
    from vtk.util.numpy_support import numpy_to_vtkIdTypeArray

    offsets, corners = np.arange(0, 4 * len(QUADS) + 1, 4), QUADS.ravel().copy()
    if cells == "offsets":
        offsets[3] = 2**40
    elif cells == "corners":
        corners[5] = 10**9
    else:
        offsets[-1] += 400
    polygons = vtk.vtkCellArray()
    polygons.SetData(numpy_to_vtkIdTypeArray(offsets, deep=True), numpy_to_vtkIdTypeArray(corners, deep=True))
    mesh = pyvista.PolyData(V)
    mesh.SetPolys(polygons)
    with pytest.raises(ValueError, match="F: "):
        meshhood.MeshIndex(mesh)


@pytest.mark.parametrize(
    ("kind", "data", "message"),
    (
        ("triangle", QUADS, "V: has cells of type 'triangle' in an array of shape"),
        ("quad", QUADS.ravel(), "V: has cells of type 'quad' in an array of shape"),
        ("quad", QUADS + 30, "F: face 0: corner 2 is vertex 37"),
        ("quad", QUADS - 1, "F: face 0: corner 0 is vertex -1"),
    ),
)
def test_meshio_cells_with_wrong_content_are_refused(kind, data, message):
    meshio = pytest.importorskip("meshio")
    mesh = meshio.Mesh(V, [("quad", QUADS)])
    mesh.cells[0].type, mesh.cells[0].data = kind, data
    with pytest.raises(ValueError, match=message):
        meshhood.MeshIndex(mesh)


def test_a_trimesh_whose_cached_faces_are_wrong_is_refused():
    trimesh = pytest.importorskip("trimesh")
    mesh = trimesh.Trimesh(V.copy(), F.copy(), process=False)
    assert mesh.face_normals.shape == (len(F), 3)  # fills the cache
    mesh.faces[7, 1] = 36
    with pytest.raises(ValueError, match="F: face 7: corner 1 is vertex 36"):
        meshhood.MeshIndex(mesh)
    mesh.faces[7, 1] = 0
    mesh.vertices[3, 2] = np.nan
    with pytest.raises(ValueError, match=r"V: vertex 3 has no position \(NaN\)"):
        meshhood.MeshIndex(mesh)


def test_a_memory_map_may_be_replaced_after_the_call(tmp_path):
    """Changes after the call have no effect. (Truncating a map while it is read would end the process.)"""
    np.save(tmp_path / "V.npy", V)
    mapped = np.load(tmp_path / "V.npy", mmap_mode="r+")
    index = meshhood.MeshIndex(mapped, QUADS)
    mapped[:] = np.nan
    (tmp_path / "V.npy").write_bytes(b"")
    np.testing.assert_array_equal(index.neighborhoods(1.5, sort="id")[1], WANTED)


@pytest.mark.parametrize("faces", (F, QUADS), ids=("triangles", "quads"))
def test_an_unwelded_mesh_causes_a_warning_whose_advice_welds_it(faces):
    apart, separate = meshes.soup(V, faces)
    with pytest.warns(UserWarning, match="(100|150) vertices at 36 different positions.*meshhood.weld") as caught:
        meshhood.MeshIndex(apart, separate)
    assert caught[0].filename == __file__
    names = {"meshhood": meshhood, "V": apart, "F": separate}
    exec(str(caught[0].message).split("Weld the mesh first: ")[1], names)
    welded = meshhood.MeshIndex(names["V"], names["F"])  # no warning
    assert len(welded) == len(V)
    assert welded.counts(np.inf).min() == len(V)


def test_quads_that_are_split_but_not_welded_cause_a_warning():
    apart, separate = meshes.soup(V, QUADS)
    with pytest.warns(UserWarning, match="Weld"):
        meshhood.MeshIndex(apart, meshes.triangles(separate))


@pytest.mark.parametrize(
    "mesh",
    (
        (V, F),
        (V, QUADS),
        (V, graph(csr_array)),
        (V[:3], [[0, 1, 2]]),
        (np.arange(30.0).reshape(10, 3), [[0, 1, 2], [3, 4, 5], [6, 7, 8]]),
        (np.concatenate([V, V]), np.concatenate([F, F + 36])),
        (np.zeros((9, 3)), np.zeros((0, 3), int)),
    ),
    ids=("triangles", "quads", "graph", "one face", "faces far apart", "twice the same", "no faces"),
)
def test_other_meshes_cause_no_warning(mesh):
    meshhood.MeshIndex(*mesh)
