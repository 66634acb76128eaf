# SPDX-License-Identifier: MIT
"""What is nearest: on the surface, connected, and not connected; points without faces, faces as vertices, patches."""

import pathlib
import warnings
from types import SimpleNamespace

import numpy as np
import pytest
from meshes import folded, grid, triangles
from oracle import triangle_graph

import meshhood


def test_closest_point_lies_on_its_face(mesh):
    V, F, index = mesh
    random = np.random.default_rng(2)
    q = random.uniform(V.min(0) - 1, V.max(0) + 1, (60, 3))
    face, barycentric, point, distances = index.closest_point(q)
    np.testing.assert_allclose(distances, np.linalg.norm(point - q, axis=1), atol=1e-12)
    assert face.shape == (60,) and barycentric.shape == point.shape == (60, 3)
    np.testing.assert_allclose(np.einsum("nc,ncx->nx", barycentric, V[F[face]]), point, atol=1e-12)
    np.testing.assert_allclose(barycentric.sum(axis=1), 1)
    assert barycentric.min() >= 0
    one = index.closest_point(q[0])
    assert type(one[0]) is int and one[0] == face[0]
    np.testing.assert_array_equal(one[2], point[0])
    assert type(one.distance) is float and one.distance == distances[0]
    assert [part.shape for part in index.closest_point([])] == [(0,), (0, 3), (0, 3), (0,)]


def test_closest_point_of_polygons_has_a_weight_for_each_corner():
    V, quads = grid(4)
    corners = np.concatenate([quads.ravel(), [0, 1, 2]])
    offsets = np.array([*range(0, 4 * len(quads) + 1, 4), 4 * len(quads) + 3])
    index = meshhood.MeshIndex(V, (offsets, corners))
    face, barycentric, point, _ = index.closest_point([[1.25, 1.5, 3.0], [0.5, 0.0, 0.0]])
    assert barycentric.shape == (2, 4)
    assert face[0] == 4
    np.testing.assert_allclose(barycentric @ np.eye(4), barycentric)
    np.testing.assert_allclose(barycentric[0] @ V[quads[4]], point[0])
    np.testing.assert_array_equal(point[0], [1.25, 1.5, 0])


def test_first_hit_lies_on_the_ray_and_on_its_face(mesh):
    V, F, index = mesh
    random = np.random.default_rng(3)
    origins = random.uniform(V.min(0) - 1, V.max(0) + 1, (200, 3))
    directions = V[random.integers(len(V), size=200)] + random.uniform(-0.2, 0.2, (200, 3)) - origins
    face, barycentric, point, distance = index.first_hit(origins, directions)
    hit = face >= 0
    assert hit.sum() > 50
    np.testing.assert_allclose(np.einsum("nc,ncx->nx", barycentric[hit], V[F[face[hit]]]), point[hit], atol=1e-12)
    units = directions / np.linalg.norm(directions, axis=1, keepdims=True)
    np.testing.assert_allclose((origins + distance[:, None] * units)[hit], point[hit], atol=1e-9)
    assert np.isinf(distance[~hit]).all() and np.isnan(point[~hit]).all() and np.isnan(barycentric[~hit]).all()
    i = np.flatnonzero(hit)[0]
    one = index.first_hit(origins[i], directions[i])
    assert type(one.face) is int and type(one.distance) is float
    assert one.face == face[i] and one.distance == distance[i]
    assert [part.shape for part in index.first_hit([], [])] == [(0,), (0, 3), (0, 3), (0,)]
    with pytest.raises(ValueError, match="directions: row 1: it is 0"):
        index.first_hit(origins[:2], [[0, 0, 1], [0, 0, 0]])
    with pytest.raises(ValueError, match="1 directions, expected one for each of 2 origins"):
        index.first_hit(origins[:2], [[0, 0, 1]])


def test_first_hit_of_polygons_has_nan_where_nothing_is_met():
    V, quads = grid(4)
    offsets = np.arange(0, 4 * len(quads) + 1, 4)
    index = meshhood.MeshIndex(V, (offsets, quads.ravel()))
    face, barycentric, point, distance = index.first_hit([[1.25, 1.5, 3.0]] * 2, [[0, 0, -2], [0, 0, 2]])
    assert face.tolist() == [4, -1] and distance.tolist() == [3, np.inf]
    np.testing.assert_array_equal(barycentric[0] @ V[quads[4]], [1.25, 1.5, 0])
    assert np.isnan(barycentric[1]).all() and np.isnan(point[1]).all()


def plate():
    """Two sheets of 8 by 8 squares, 0.5 apart, that face away from each other."""
    V = np.array([[x, y, z] for z in (0, 0.5) for y in range(9) for x in range(9)], float)
    F = []
    for y in range(8):
        for x in range(8):
            a, b, c, d = 9 * y + x, 9 * y + x + 1, 9 * y + x + 10, 9 * y + x + 9
            F += [[a, c, b], [a, d, c], [a + 81, b + 81, c + 81], [a + 81, c + 81, d + 81]]
    return V, np.array(F)


def test_thickness_of_a_plate_by_both_methods():
    V, F = plate()
    index = meshhood.MeshIndex(V, F)
    inner = np.flatnonzero(((V[:, :2] > 0.5) & (V[:, :2] < 7.5)).all(axis=1))
    for method in ("ray", "sphere"):
        np.testing.assert_array_equal(index.thickness(inner, method=method), 0.5)
        assert index.thickness(int(inner[0]), method=method) == 0.5
    with pytest.warns(UserWarning, match=r"inf for \d+ of 162 rows.*F=F\[:, ::-1\]"):
        assert index.thickness(F=F[:, ::-1]).shape == (len(V),)
    with pytest.raises(ValueError, match="method"):
        index.thickness(method="cone")


def test_thickness_at_points_of_faces():
    V, F = plate()
    index = meshhood.MeshIndex(V, F)
    centers = V[F].mean(axis=1)
    hits = index.closest_point(centers[((centers[:, :2] > 0.5) & (centers[:, :2] < 7.5)).all(axis=1)])
    for method in ("ray", "sphere"):
        across = index.thickness(points=hits.point, face=hits.face, method=method)
        np.testing.assert_allclose(across, 0.5, rtol=1e-15)
        assert index.thickness(points=hits.point[7], face=int(hits.face[7]), method=method) == across[7]
        assert index.thickness(points=[], face=[], method=method).shape == (0,)
    for words, named in (
        ({"points": hits.point}, "points: expected points and the face of each"),
        ({"face": 3}, "points: expected points and the face of each"),
        ({"points": hits.point, "face": hits.face, "vertices": 7}, "points: expected points and the face"),
        ({"points": hits.point[:2], "face": [0]}, "face: expected one for each of 2 points, not 1"),
        ({"points": hits.point[:2], "face": [0, len(F)]}, f"face: row 1: face {len(F)}"),
        ({"points": [[0, 0, np.nan]], "face": [0]}, "points: row 0: coordinate 2 is nan"),
    ):
        with pytest.raises(ValueError, match=named):
            index.thickness(**words)


def test_closest_point_takes_other_faces_and_keeps_what_it_made():
    V, F = folded(8)
    bare = meshhood.MeshIndex(V, F, keep_faces=False)
    with pytest.raises(ValueError, match="F: expected the faces"):
        bare.closest_point([0, 0, 0])
    assert bare.closest_point([3.2, 3.1, 0], F=F)[0] == meshhood.MeshIndex(V, F).closest_point([3.2, 3.1, 0])[0]
    only = bare.closest_point([3.2, 3.1, 0], F=F[:1])
    assert only[0] == 0
    with pytest.raises(ValueError, match="q: row 1: coordinate 2 is nan"):
        bare.closest_point([[0, 0, 0], [0, 0, np.nan]], F=F)
    with pytest.raises(ValueError, match="no face of three corners"):
        bare.closest_point([0, 0, 0], F=np.empty((0, 3), int))


def test_a_region_of_a_polygon_starts_from_all_its_corners():
    V, quads = grid(4)
    corners = np.concatenate([quads.ravel(), [0, 1, 4]])
    offsets = np.array([*range(0, 4 * len(quads) + 1, 4), 4 * len(quads) + 3])
    index = meshhood.MeshIndex(V, (offsets, corners))
    np.testing.assert_array_equal(index.neighborhood([0.5, 0.5, 0], 0.8, face=0, sort="id"), [0, 1, 4, 5])
    stroke = index.stroke([[0.5, 0.5, 0], [0.2, 0.2, 0]], 0.8, face=[0, 9], sort="id")
    np.testing.assert_array_equal(stroke, [0, 1, 4, 5])


def test_a_face_as_start_is_refused_where_it_means_nothing(mesh):
    V, F, index = mesh
    for call in (
        lambda **start: index.neighborhood(3, 1.0, **start),
        lambda **start: index.nested(3, [1.0], **start),
        lambda **start: index.contains(3, 4, 1.0, **start),
        lambda **start: index.connecting_radius(3, 4, **start),
        lambda **start: index.nearest_connected(3, 4, **start),
    ):
        with pytest.raises(ValueError, match="face: expected None, because the start is a vertex"):
            call(face=2)
    with pytest.raises(ValueError, match="seeds: expected None, because the face is given"):
        index.neighborhood([0.0, 0.0, 0.0], 1.0, seeds=[1], face=2)
    with pytest.raises(ValueError, match=f"face: row 0: face {len(F)}, but the mesh has {len(F)} faces"):
        index.neighborhood([0.0, 0.0, 0.0], 1.0, face=len(F))
    with pytest.raises(ValueError, match="face: expected one for each of 2 points, not 1"):
        index.stroke([[0, 0, 0], [1, 1, 0]], 1.0, face=[1])
    with pytest.raises(ValueError, match="face: given, but this index has none"):
        meshhood.MeshIndex(V, F, keep_faces=False).neighborhood([0.0, 0.0, 0.0], 1.0, face=1)


def test_nearest_vertices_refuse_wrong_arguments(mesh):
    V, _, index = mesh
    with pytest.raises(ValueError, match="area: -1"):
        index.discs(-1)
    with pytest.raises(ValueError, match="metric: 'geodesic'"):
        index.k_nearest(3, metric="geodesic")
    with pytest.raises(ValueError, match="walls: a bool mask of shape"):
        index.k_nearest(3, walls=np.zeros(3, bool))
    for call in (
        lambda: index.k_nearest(10**9),
        lambda: index.k_nearest(3, max_bytes=36 * len(V) - 1),
        lambda: index.discs(1e9, max_bytes=12 * len(V)),
    ):
        with pytest.raises(MemoryError, match="exceeds max_bytes, .*; take fewer vertices at a time"):
            call()
    with pytest.raises(MemoryError, match="k: 4611686018427387904 vertices for each"):
        index.k_nearest(2**62)
    for call in (lambda: index.k_nearest(0, 3), lambda: index.nearest_connected(3, 0)):
        with pytest.raises(ValueError, match="k: 0, expected at least 1$"):
            call()
    with pytest.raises(ValueError, match="weights: vertex 2: -1.0, expected a finite number >= 0"):
        index.discs(1.0, weights=np.where(np.arange(len(V)) == 2, -1.0, 1.0))


def test_from_points_joins_the_pairs_of_a_tree():
    from scipy.spatial import cKDTree

    random = np.random.default_rng(5)
    P = random.uniform(0, 10, (1500, 3))
    index = meshhood.MeshIndex.from_points(P, 0.9)
    pairs = cKDTree(P).query_pairs(0.9, output_type="ndarray")
    rings = [index.nested(v, range(2), metric="rings")[1] for v in range(len(P))]
    found = {(v, int(w)) for v, ring in enumerate(rings) for w in ring if v < w}
    assert found == set(map(tuple, pairs.tolist()))
    assert index.faces is None
    np.testing.assert_array_equal(index.positions, P)
    assert meshhood.MeshIndex.from_points(P.astype(np.float32), 0.9).positions.dtype == np.float32


def test_from_points_refuses_wrong_arguments_and_a_dense_graph():
    P = np.zeros((100, 3))
    with pytest.raises(ValueError, match=r"^link: 1 joins the 100 points by more than 50 edges"):
        meshhood.MeshIndex.from_points(P, 1.0, max_edges=50)
    with pytest.raises(ValueError, match="link: inf"):
        meshhood.MeshIndex.from_points(P, np.inf)
    with pytest.raises(ValueError, match=r"P: expected an array of shape \(#V, 3\)"):
        meshhood.MeshIndex.from_points(P[:, :2], 1.0)
    P[3, 1] = np.nan
    with pytest.raises(ValueError, match="P: vertex 3"):
        meshhood.MeshIndex.from_points(P, 1.0)


def test_points_without_faces_given_as_a_mesh_warn_and_name_from_points():
    V, _ = grid(3)
    with pytest.warns(UserWarning, match="F: no faces.*from_points"):
        meshhood.MeshIndex(V, np.empty((0, 3), int))
    with pytest.raises(TypeError, match="from_points"):
        meshhood.MeshIndex(V)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        meshhood.MeshIndex(V, triangle_graph(len(V), np.empty((0, 3), int)))  # a graph may have no edges


@pytest.mark.parametrize(("library", "kind"), (("trimesh", "PointCloud"), ("pyvista", "PolyData")))
def test_from_points_takes_what_a_mesh_without_faces_is_refused_for(library, kind):
    cloud = getattr(pytest.importorskip(library), kind)(grid(3)[0])
    assert meshhood.MeshIndex.from_points(cloud, link=1.0).count(4, 1.0) == 5


def vtk_points(P):
    vtk = pytest.importorskip("vtk")
    points, mesh = vtk.vtkPoints(), vtk.vtkPolyData()
    for p in P:
        points.InsertNextPoint(p)
    mesh.SetPoints(points)
    return mesh


def open3d_tensors(P):
    tensor = SimpleNamespace(cpu=lambda: SimpleNamespace(numpy=lambda: P))
    return SimpleNamespace(vertex=SimpleNamespace(positions=tensor))


POINTS_OF = {
    "a submesh": lambda P: meshhood.MeshIndex(P, triangles(grid(3)[1])).submesh(range(9)),
    "a mesh": lambda P: meshhood.Mesh(P, grid(3)[1]),
    "what has vertices by id": lambda P: SimpleNamespace(points=P, vertices=np.arange(4)),
    "a frame": lambda P: pytest.importorskip("pandas").DataFrame(P, columns=["points", "vertices", "V"]),
    "VTK": vtk_points,
    "vedo": lambda P: pytest.importorskip("vedo").Points(P),
    "tensors": open3d_tensors,
    "a list": lambda P: P.tolist(),
}


@pytest.mark.parametrize("kind", POINTS_OF)
def test_from_points_takes_the_points_of_what_has_other_attributes_too(kind):
    P = grid(3)[0]
    np.testing.assert_array_equal(meshhood.MeshIndex.from_points(POINTS_OF[kind](P), link=1.0).positions, P)


def test_from_points_takes_the_points_of_scipy_and_of_clips():
    spatial = pytest.importorskip("scipy.spatial")
    P = np.random.default_rng(3).random((30, 3))
    for kind in (spatial.Voronoi, spatial.ConvexHull, spatial.Delaunay):
        np.testing.assert_array_equal(meshhood.MeshIndex.from_points(kind(P), link=0.5).positions, P)
    V, quads = grid(5)
    part = meshhood.MeshIndex(V, quads).clip(12, 1.3)
    np.testing.assert_array_equal(meshhood.MeshIndex.from_points(part, link=1.0).positions, part.V)
    with pytest.raises(TypeError, match="^P: a path"):
        meshhood.MeshIndex.from_points(pathlib.Path("a.ply"), link=1.0)


def test_of_faces_joins_faces_across_edges():
    V, quads = grid(5)
    F = triangles(quads)
    index = meshhood.MeshIndex.of_faces(V, F)
    assert len(index) == len(F)
    np.testing.assert_allclose(index.positions, V[F].mean(axis=1))
    for f in range(len(F)):
        shared = [g for g in range(len(F)) if len(set(F[f]) & set(F[g])) == 2]
        np.testing.assert_array_equal(np.sort(index.nested(f, range(2), metric="rings")[1]), np.sort([f, *shared]))
    polygons = meshhood.MeshIndex.of_faces(V, quads)
    np.testing.assert_allclose(polygons.positions, V[quads].mean(axis=1))
    with pytest.raises(ValueError, match="F: face 1 has no corners"):
        meshhood.MeshIndex.of_faces(V, (np.array([0, 3, 3]), np.array([0, 1, 2])))


def test_a_subclass_is_made_from_points_and_of_faces():
    class Mine(meshhood.MeshIndex):
        pass

    V, quads = grid(4)
    assert type(Mine.from_points(V, 1.0)) is Mine
    assert type(Mine.of_faces(V, quads)) is Mine


def test_a_submesh_is_handed_to_pyvista_and_trimesh():
    pyvista, trimesh = pytest.importorskip("pyvista"), pytest.importorskip("trimesh")
    V, quads = grid(9)
    for F in (quads, triangles(quads)):
        index = meshhood.MeshIndex(V, F)
        ids = index.neighborhood(40, 2.7)
        for part in (index.submesh(ids), index.clip(40, 2.7)):
            drawn, made = part.to_pyvista(), part.to_trimesh()
            assert isinstance(drawn, pyvista.PolyData) and isinstance(made, trimesh.Trimesh)
            np.testing.assert_array_equal(drawn.cell_data["faces"], part.faces)
            if not len(part.corners):
                np.testing.assert_array_equal(drawn.point_data["vertices"], part.vertices)
            for found in (drawn.points, made.vertices):
                np.testing.assert_array_equal(found, part.V)
            for area in (drawn.area, made.area):
                np.testing.assert_allclose(area, meshhood.vertex_areas(part.V, part.F).sum(), rtol=1e-6)
            sides = np.diff(part.F[0]) if isinstance(part.F, tuple) else np.full(len(part.F), 3)
            np.testing.assert_array_equal(made.face_attributes["faces"], np.repeat(part.faces, sides - 2))


def test_a_point_is_described_by_its_coordinates():
    V, quads = grid(9)
    index = meshhood.MeshIndex(V, np.array(quads)[:, :3])
    face, weights, point, _ = found = index.closest_point([2.0, 3.0, 1.0])
    assert repr(found) == f"<meshhood.ClosestPoint: face {face}, barycentric {weights}, point {point}, distance 1.0>"
    shown = "<meshhood.ClosestPoint: face 5 values, barycentric 5 by 3, point 5 by 3, distance 5 values>"
    assert repr(index.closest_point(V[:5])) == shown


def test_a_submesh_is_described_in_a_line():
    V, quads = grid(9)
    index = meshhood.MeshIndex(V, quads)
    ids = index.neighborhood(40, 1.0)
    assert repr(index.submesh(ids, "any")) == "<meshhood.Submesh: 12 faces, 21 vertices>"
    assert repr(index.clip(40, 1.2)).endswith("of them where faces are clipped>")
