# SPDX-License-Identifier: MIT
"""Vertices of NaN, as scanners and depth cameras mark holes, are walls if no face has them."""

import pickle

import numpy as np
import pytest
from meshes import grid

import meshhood

POSITIONS, FACES = grid(9)
POSITIONS = POSITIONS.astype(np.float64)
RANDOM = np.random.default_rng(3)
HOLES = np.sort(RANDOM.choice(9 * 9 + 12, 12, replace=False))
IDS = np.setdiff1d(np.arange(9 * 9 + 12), HOLES)  # of the vertices of the grid


def scan():
    V = np.full((9 * 9 + 12, 3), np.nan, POSITIONS.dtype)
    V[IDS] = POSITIONS
    return V, IDS[FACES].astype(np.int32)


def scanned():
    with pytest.warns(UserWarning, match=f"V: 12 vertices without a position .*the first of which is {HOLES[0]}, are walls"):
        return meshhood.MeshIndex(*scan())


@pytest.mark.parametrize("metric", ("straight", "path", "surface", "rings", "space"))
@pytest.mark.parametrize("walls", (None, [40, 41]))
def test_answers_are_those_of_the_mesh_without_them(metric, walls):
    index, rest = scanned(), meshhood.MeshIndex(POSITIONS, FACES)
    given = {} if walls is None else {"walls": IDS[walls]}
    expected = {} if walls is None else {"walls": walls}
    indptr, indices = index.neighborhoods(2.5, metric=metric, sort="id", **given)
    assert not np.isin(indices, HOLES).any()
    assert (np.diff(indptr)[HOLES] == 0).all()
    found = [IDS[ids] for ids in np.split(*reversed(rest.neighborhoods(2.5, metric=metric, sort="id", **expected)))]
    rows = np.split(indices, indptr)
    for v in range(len(POSITIONS)):
        np.testing.assert_array_equal(rows[IDS[v] + 1], found[v + 1])
        np.testing.assert_array_equal(np.sort(index.neighborhood(IDS[v], 2.5, metric=metric, **given)), found[v + 1])


def test_nothing_near_a_point_is_one_of_them():
    index = scanned()
    nearest, distances = index.nearest(POSITIONS)
    np.testing.assert_array_equal(nearest, IDS)
    assert (distances == 0).all()
    assert not np.isin(index.neighborhood(POSITIONS[0].astype(float), np.inf, metric="space"), HOLES).any()
    assert not np.isin(index.closest_point(POSITIONS[:3]).face, HOLES).any()
    assert np.isin(index.neighborhood(POSITIONS[0].astype(float), 3), IDS).all()


def test_masked_adds_walls_to_them():
    index = scanned().masked(walls=IDS[[40]])
    assert index.counts(9.0)[HOLES].sum() == 0 and index.count(IDS[40], 9.0) == 0
    assert index.count(IDS[0], 99.0) == 80


@pytest.mark.parametrize(
    "done, call",
    [
        ("saved", lambda index: index.save("a.mhi")),
        ("pickled", pickle.dumps),
        ("refitted", lambda index: index.refit(scan()[0])),
    ],
)
def test_what_would_lose_the_walls_is_refused(done, call, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    said = rf"^an index with vertices without a position \(NaN\) is not {done}, expected the mesh without them: `part = index\."
    with pytest.raises(ValueError, match=said):
        call(scanned())


@pytest.mark.parametrize("call", (meshhood.weld, meshhood.vertex_areas, meshhood.MeshIndex.of_faces))
def test_the_way_out_that_an_error_names_leads_out(call, tmp_path):
    V, F = scan()
    with pytest.raises(ValueError, match=rf"^V: 12 vertices .* \(NaN\), the first of which is {HOLES[0]}, expected") as error:
        call(V, F)
    names = {"meshhood": meshhood, "np": np, "V": V, "F": F}
    with pytest.warns(UserWarning, match="walls"):
        exec(str(error.value).split("`")[1], names)
    part = names["part"]
    np.testing.assert_array_equal(part.V, V[part.vertices])
    np.testing.assert_array_equal(part.vertices, IDS)
    np.testing.assert_array_equal(part.vertices[part.F[1]], F.ravel())
    call(part.V, part.F)
    index = meshhood.MeshIndex(part.V, part.F)
    index.save(tmp_path / "scan.mhi")
    np.testing.assert_array_equal(index.counts(2.5), scanned().counts(2.5)[part.vertices])


def test_a_face_of_no_vertex_is_still_named():
    V, F = scan()
    F[3, 2] = len(V)
    with pytest.raises(ValueError, match=f"F: face 3: corner 2 is vertex {len(V)}"):
        meshhood.MeshIndex(V, F)


def test_all_vertices_may_be_such():
    with pytest.warns(UserWarning):
        index = meshhood.MeshIndex(np.full((5, 3), np.nan), np.empty((0, 3), np.int32))
    assert (index.counts(np.inf, metric="space") == 0).all()
    with pytest.raises(ValueError, match="all vertices of the mesh are walls"):
        index.nearest([0, 0, 0])


def test_a_file_gives_them_as_it_has_them(tmp_path):
    V, F = scan()
    rows = [" ".join(map(str, p)) for p in V] + ["4 " + " ".join(map(str, f)) for f in F]
    (tmp_path / "scan.off").write_text(f"OFF\n{len(V)} {len(F)} 0\n" + "\n".join(rows) + "\n")
    with pytest.warns(UserWarning, match=r"line \d+: vertices without a position.*\(12 times\)"):
        mesh = meshhood.read_mesh(tmp_path / "scan.off")
    np.testing.assert_array_equal(mesh.vertices, V.astype(np.float32))
    with pytest.warns(UserWarning, match="walls"):
        index = meshhood.MeshIndex(mesh)
    np.testing.assert_array_equal(index.counts(2.5), scanned().counts(2.5))


@pytest.mark.parametrize("extension", (".ply", ".vtk"))
def test_a_mesh_with_holes_that_was_read_is_written_and_read_again(tmp_path, extension):
    V, F = scan()
    path = tmp_path / f"scan{extension}"
    meshhood.write_mesh(path, V, F, values={"height": np.arange(len(V))})
    with pytest.warns(UserWarning, match="vertices without a position .* are walls .12 times"):
        read = meshhood.read_mesh(path)
    np.testing.assert_array_equal(read.vertices, np.where(np.isnan(V).any(axis=1, keepdims=True), np.nan, V))
    np.testing.assert_array_equal(read.faces[1], F.ravel())


@pytest.mark.parametrize(("extension", "library"), ((".ply", None), (".vtk", None), (".vtp", "pyvista"), (".gii", "nibabel"), (".glb", "trimesh")))
def test_no_format_has_a_face_with_such_a_vertex_or_an_infinite_coordinate(tmp_path, extension, library):
    if library:
        pytest.importorskip(library)
    V, F = scan()
    used = np.array([[IDS[0], HOLES[0], IDS[1]]])
    with pytest.raises(ValueError, match=rf"vertex {HOLES[0]} has no position \(NaN\), but face 0 has it as corner 1"):
        meshhood.write_mesh(tmp_path / f"a{extension}", V, used)
    V = np.where(np.isnan(V), 0, V)
    V[4, 1] = np.inf
    with pytest.raises(ValueError, match="^V: vertex 4: y is inf, expected a finite number"):
        meshhood.write_mesh(tmp_path / f"a{extension}", V, used)
    assert not list(tmp_path.iterdir())


def test_gltf_has_no_such_vertices(tmp_path):
    pytest.importorskip("trimesh")
    V, F = scan()
    with pytest.raises(ValueError, match="V: 12 vertices without a position .*, which glTF does not know, expected the mesh without them"):
        meshhood.write_mesh(tmp_path / "a.glb", V, F)
