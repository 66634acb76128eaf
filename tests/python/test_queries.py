# SPDX-License-Identifier: MIT
"""More kinds of queries: regions around any point, nested radii, connecting radii, filters, path distances, rims."""

import numpy as np
import pytest
from meshes import folded, grid, shared, triangles, two_plates
from oracle import triangle_graph
from scipy.sparse.csgraph import connected_components, dijkstra

import meshhood

# Many of the starts below are drawn at random.
pytestmark = pytest.mark.filterwarnings("ignore:.*point is farther than r")


@pytest.fixture(params=[two_plates, folded], ids=["plates", "folded"])
def mesh(request):
    V, F = request.param(12)
    return V, F, meshhood.MeshIndex(V, F), triangle_graph(len(V), F)


def distances(V, p):
    dx, dy, dz = (V.astype(np.float64) - np.asarray(p, np.float64)).T
    return np.sqrt((dx * dx + dy * dy) + dz * dz)


def region(V, graph, p, seeds, r, walls=None, ignored=None):
    """Sorted, by the connected components of SciPy."""
    inside = distances(V, p) <= r
    if walls is not None:
        inside &= ~walls
    ids = np.flatnonzero(inside)
    labels = connected_components(graph[ids][:, ids], directed=False)[1] if len(ids) else np.empty(0, int)
    own = np.isin(labels, labels[np.isin(ids, seeds)])
    found = ids[own]
    return found if ignored is None else found[~ignored[found]]


def random_starts(V, F, random, count):
    for _ in range(count):
        face = F[random.integers(len(F))]
        weights = random.dirichlet(np.ones(3))
        yield weights @ V[face].astype(np.float64), face


def test_region_of_a_point_on_a_face_is_that_of_scipy(mesh):
    V, F, index, graph = mesh
    random = np.random.default_rng(1)
    for p, face in random_starts(V, F, random, 40):
        for r in (0.3, 1.0, 2.5, 7.0):
            found, lengths = index.neighborhood(p, r, seeds=face, sort="id", return_distance=True)
            np.testing.assert_array_equal(found, region(V, graph, p, face, r))
            np.testing.assert_array_equal(lengths, distances(V, p)[found])


def test_region_of_a_vertex_is_its_neighborhood(mesh):
    V, _, index, _ = mesh
    for v in range(0, len(V), 17):
        np.testing.assert_array_equal(index.neighborhood(v, 3.0, sort="id"), index.neighborhood(v, 3.0, sort="id"))


def test_walls_are_not_passed_and_ignored_vertices_are(mesh):
    V, F, index, graph = mesh
    random = np.random.default_rng(2)
    for p, face in random_starts(V, F, random, 30):
        walls, ignored = random.random(len(V)) < 0.2, random.random(len(V)) < 0.3
        found = index.neighborhood(p, 4.0, seeds=face, walls=walls, ignored=ignored, sort="id")
        np.testing.assert_array_equal(found, region(V, graph, p, face, 4.0, walls, ignored))


def test_seeds_are_by_default_the_nearest_vertex(mesh):
    V, _, index, graph = mesh
    p = V[30] + [0.2, 0.1, 0]
    vertex, distance = index.nearest(p)
    assert vertex == np.argmin(distances(V, p)) and distance == distances(V, p).min()
    np.testing.assert_array_equal(index.neighborhood(p, 3, sort="id"), region(V, graph, p, [vertex], 3))
    for none in ([], np.empty((0, 3))):
        assert [len(found) for found in index.nearest(none)] == [0, 0]
    vertices, _ = index.nearest(V[:50])
    np.testing.assert_array_equal(vertices, np.arange(50))


def test_stroke_is_the_union_of_its_regions(mesh):
    V, F, index, graph = mesh
    starts = list(random_starts(V, F, np.random.default_rng(3), 9))
    points = np.array([p for p, _ in starts])
    seeds = np.array([face for _, face in starts])
    parts = [region(V, graph, p, face, 1.5) for p, face in starts]
    found = index.stroke(points, 1.5, seeds=seeds, sort="id")
    np.testing.assert_array_equal(found, np.unique(np.concatenate(parts)))
    parts = [index.neighborhood(p, 1.5) for p in points]
    np.testing.assert_array_equal(index.stroke(points, 1.5, sort="id"), np.unique(np.concatenate(parts)))
    assert len(index.stroke(np.empty((0, 3)), 1.5)) == 0


def test_nested_radii_give_each_region(mesh):
    V, _, index, graph = mesh
    radii = [0, 1, 1.5, 4, 9, np.inf]
    counts, ids = index.nested(5, radii)
    for r, count in zip(radii, counts):
        np.testing.assert_array_equal(np.sort(ids[:count]), region(V, graph, V[5], [5], r))


def test_connecting_radius_is_the_first_that_contains(mesh):
    V, _, index, graph = mesh
    for w in range(0, len(V), 13):
        r = index.connecting_radius(7, w)
        radii = np.unique(distances(V, V[7]))
        expected = [one for one in radii if w in region(V, graph, V[7], [7], one)]
        assert r == (expected[0] if expected else np.inf)
        assert index.contains(7, w, r) == bool(expected)
        assert not index.contains(7, w, np.nextafter(r, 0)) or r == 0


def test_nearest_connected_vertices_ascend_by_connecting_radius(mesh):
    _, _, index, _ = mesh
    ids, radii = index.nearest_connected(7, 40)
    assert len(ids) == len(set(ids)) == 40 and ids[0] == 7
    assert (np.diff(radii) >= 0).all()
    assert [index.connecting_radius(7, w) for w in ids] == list(radii)
    nearer = index.neighborhood(7, np.nextafter(radii[-1], 0))
    assert set(nearer) <= set(ids)


def lengths_graph(V, graph):
    edges = graph.tocoo()
    edges.sum_duplicates()
    edges.data = np.array([distances(V[[j]], V[i])[0] for i, j in zip(edges.row, edges.col)])
    return edges.tocsr()


def test_path_distances_are_those_of_scipy_to_the_last_bit(mesh):
    V, _, index, graph = mesh
    matrix = lengths_graph(V, graph)
    for v in (0, 77):
        expected = dijkstra(matrix, directed=False, indices=v, limit=6)
        ids, lengths = index.neighborhood(v, 6, metric="path", return_distance=True)
        np.testing.assert_array_equal(np.sort(ids), np.flatnonzero(np.isfinite(expected)))
        np.testing.assert_array_equal(lengths, expected[ids])
        assert (np.diff(lengths) >= 0).all()


def test_paths_do_not_pass_walls(mesh):
    V, _, index, graph = mesh
    random = np.random.default_rng(4)
    for v in (3, 60):
        walls, ignored = random.random(len(V)) < 0.2, random.random(len(V)) < 0.3
        walls[v] = False
        free = np.flatnonzero(~walls)
        matrix = lengths_graph(V, graph)[free][:, free]
        expected = np.full(len(V), np.inf)
        expected[free] = dijkstra(matrix, directed=False, indices=np.searchsorted(free, v), limit=5)
        options = {"metric": "path", "walls": walls, "ignored": ignored, "return_distance": True}
        ids, lengths = index.neighborhood(v, 5, **options)
        np.testing.assert_array_equal(np.sort(ids), np.flatnonzero(np.isfinite(expected) & ~ignored))
        np.testing.assert_array_equal(lengths, expected[ids])
        by_id, lengths = index.neighborhood(v, 5, sort="id", **options)
        np.testing.assert_array_equal(by_id, np.sort(ids))
        np.testing.assert_array_equal(lengths, expected[by_id])


def test_batch_along_edges_has_the_rows_of_single_queries(mesh):
    _, _, index, _ = mesh
    rows = [3, 50, 3, 99]
    indptr, indices, lengths = index.neighborhoods(3, rows, metric="path", return_distance=True, sort="id")
    for i, v in enumerate(rows):
        ids, expected = index.neighborhood(v, 3, metric="path", return_distance=True, sort="id")
        np.testing.assert_array_equal(indices[indptr[i] : indptr[i + 1]], ids)
        np.testing.assert_array_equal(lengths[indptr[i] : indptr[i + 1]], expected)
    np.testing.assert_array_equal(index.counts(3, rows, metric="path"), np.diff(indptr))


def test_rings_count_edges(mesh):
    _, _, index, graph = mesh
    hops = dijkstra(graph, directed=False, unweighted=True, indices=20)
    counts, ids = index.nested(20, range(5), metric="rings")
    for i, count in enumerate(counts):
        np.testing.assert_array_equal(np.sort(ids[:count]), np.flatnonzero(hops <= i))


def test_cut_edges_are_not_crossed():
    V, quads = grid(6)
    cut = [(12 + i, 18 + i) for i in range(6)]
    index = meshhood.MeshIndex(V, quads, cut=cut)
    assert len(index.neighborhood(0, np.inf)) == 18
    assert len(meshhood.MeshIndex(V, quads).neighborhood(0, np.inf)) == 36


def test_faces_and_submesh_of_a_region(mesh):
    V, F, index, _ = mesh
    mesher = meshhood.RegionMesh(V, F)
    ids = index.neighborhood(5, 3.2)
    inside = np.isin(F, ids)
    np.testing.assert_array_equal(mesher.faces(ids), np.flatnonzero(inside.all(axis=1)))
    np.testing.assert_array_equal(mesher.faces(ids, "any"), np.flatnonzero(inside.any(axis=1)))
    part = mesher.submesh(ids, "any")
    np.testing.assert_array_equal(part.vertices[part.F], F[part.faces])
    np.testing.assert_array_equal(part.V, V[part.vertices])


def test_rim_lies_at_the_radius(mesh):
    V, F, index, _ = mesh
    p, face = next(random_starts(V, F, np.random.default_rng(8), 1))
    lines = meshhood.RegionMesh(V, F).rim(index.neighborhood(p, 2.7, seeds=face), p, 2.7)
    assert lines
    for line in lines:
        np.testing.assert_allclose(np.linalg.norm(line.points - p, axis=1), 2.7, rtol=1e-12)
        assert line.edges.shape == (len(line.points), 2)


def test_rim_of_polygons_on_a_sheet_is_one_loop():
    V, quads = grid(12)
    index = meshhood.MeshIndex(V, quads)
    center = 6 * 12 + 6
    (line,) = meshhood.RegionMesh(V, quads).rim(index.neighborhood(center, 3.3), center, 3.3)
    assert line.closed


def test_rims_on_a_scan_are_loops_where_the_mesh_is_closed(tmp_path):
    V, F = meshhood.read_mesh(shared("scan/armadillo_43k.ply.zst", tmp_path))
    index = meshhood.MeshIndex(V, F)
    mesher = meshhood.RegionMesh(V, F)
    r = 12 * index.mean_edge_length
    for v in range(0, len(V), 4321):
        lines = mesher.rim(index.neighborhood(v, r), v, r)
        assert lines and all(line.closed for line in lines)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda i: i.neighborhood([0.0, 0.0], 1), r"start: expected 3 numbers"),
        (lambda i: i.neighborhood(np.zeros((2, 3)), 1), r"start: expected a vertex or 3 numbers"),
        (lambda i: i.neighborhood([0, np.nan, 0], 1), r"start: row 0: coordinate 1 is nan"),
        (lambda i: i.neighborhood(144, 1), r"start: vertex 144, but the mesh has 36 vertices"),
        (lambda i: i.neighborhood(3, 1, seeds=[3]), r"seeds: expected None"),
        (lambda i: i.neighborhood([0.0, 0.0, 0.0], 1, seeds=[0, 36]), r"seeds: row 1: vertex 36"),
        (lambda i: i.neighborhood(0, -1), r"r: radius -1"),
        (lambda i: i.neighborhood(0, 1, metric="geodesic"), r"metric: 'geodesic'"),
        (lambda i: i.neighborhood([0.0, 0.0, 0.0], 1, metric="path"), r"start: expected a vertex with metric='path'"),
        (lambda i: i.neighborhood(0, 1, walls=np.zeros(36)), r"walls: expected integers, not float64"),
        (lambda i: i.neighborhood(0, 1, ignored=np.zeros(35, bool)), r"ignored: a bool mask of shape \(35,\)"),
        (lambda i: i.stroke([[0, 0, 0]], 1, seeds=[[0], [1]]), r"seeds: expected \(1,\) or \(1, k\)"),
        (lambda i: i.stroke([[0, 0, 0]], [1, 2]), r"r: expected one number, or one for each of 1 rows"),
        (lambda i: i.nested(0, [1, 1]), r"radii: value 1: radius 1.0, expected more than 1.0"),
        (lambda i: i.nested(0, [np.nan]), r"radii: value 0: radius nan"),
        (lambda i: i.contains(0, 36, 1), r"w: vertex 36"),
        (lambda i: i.connecting_radius(0, -1), r"w: vertex -1"),
        (lambda i: i.nearest_connected(0, -1), r"k: -1"),
        (lambda i: i.nested(36, range(2), metric="rings"), r"start: vertex 36"),
        (lambda i: i.nearest([1, 2]), r"points: expected 3 numbers"),
        (lambda i: meshhood.RegionMesh(*grid(3)).rim([8], [], 1), r"start: expected a vertex or 3 numbers, not .* \(0,\)"),
        (lambda i: meshhood.RegionMesh(*grid(3)).rim([8], np.zeros((4, 3)), 1), r"start: expected a vertex .* \(4, 3\)"),
        (lambda i: i.neighborhood(np.zeros((1, 3)), 1), r"start: expected a vertex or 3 numbers, not .* \(1, 3\)"),
        (lambda i: i.neighborhood(0, 1, metric="geodesic"), r"metric: 'geodesic'"),
        (lambda i: i.neighborhood(0, 1, metric="path", method="bfs"), r"method: 'bfs', expected 'exact'"),
        (lambda i: meshhood.MeshIndex(*grid(3), cut=[(0, 1), (0, 8)]), r"cut: edge 1: vertices 0 and 8"),
        (lambda i: meshhood.MeshIndex(*grid(3), cut=[(0, 9)]), r"^cut: edge 0: vertex 9, but the mesh has 9 vertices"),
        (lambda i: meshhood.MeshIndex(*grid(3), cut=[0, 1]), r"cut: expected an array \(n, 2\)"),
        (lambda i: meshhood.RegionMesh(*grid(3)).faces([9]), r"ids: row 0: vertex 9"),
        (lambda i: meshhood.RegionMesh(*grid(3)).faces([0], "some"), r"corners: 'some'"),
        (lambda i: meshhood.RegionMesh(*grid(3)).rim([8], 0, 1), r"vertex 8 is not within the radius 1"),
    ],
)
def test_wrong_arguments_are_refused_by_name(call, message):
    with pytest.raises((ValueError, TypeError), match=message):
        call(meshhood.MeshIndex(*grid(6)))


FAR = "point is farther than r from the vertices where its search starts"


@pytest.mark.filterwarnings("error")
def test_a_point_farther_from_the_mesh_than_the_radius_causes_a_warning():
    V, quads = grid(5)
    index = meshhood.MeshIndex(V, quads)
    above = [2.0, 2.0, 3.0]
    for ask in (
        lambda r: index.neighborhood(above, r),
        lambda r: index.neighborhood(above, r, seeds=[0, 12]),
        lambda r: index.nested(above, [0.5, r])[1],
        lambda r: index.stroke([above], r),
    ):
        with pytest.warns(UserWarning, match=FAR) as caught:
            assert len(ask(2.9)) == 0
        assert caught[0].filename == __file__
        assert 12 in ask(3.0)  # at exactly 3; no warning
    assert len(index.neighborhood(above, 3.0, walls=np.ones(25, bool))) == 0  # no warning: a wall lies in the ball
    assert len(index.neighborhood(above, 1.0, seeds=np.empty(0, int))) == 0  # no seed is far
