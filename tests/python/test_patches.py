# SPDX-License-Identifier: MIT
"""Areas, volumes and gaps of the surface in a ball."""

import meshhood
import numpy as np
import pytest
from scale import scaled

PI = np.pi


def box(cells, size=1.0):
    """The surface of a box of cells of this size, each square of two triangles, with outward normals."""
    ids, faces = {}, []

    def vertex(p):
        return ids.setdefault(tuple(p), len(ids))

    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for i in range(cells[u]):
            for j in range(cells[v]):
                for high in (0, 1):
                    square = []
                    for di, dj in ((0, 0), (1, 0), (1, 1), (0, 1)):
                        p = [0, 0, 0]
                        p[axis] = cells[axis] * high
                        p[u], p[v] = (i + di, j + dj) if high else (i + dj, j + di)
                        square.append(vertex(p))
                    faces += [[square[0], square[1], square[2]], [square[0], square[2], square[3]]]
    return size * np.array(list(ids), float), np.array(faces)


def test_points_of_a_plate_of_twelve_triangles_have_area_volume_and_gap():
    V, F = box((1, 1, 1))
    V *= [100, 100, 1]
    index = meshhood.MeshIndex(V, F)
    for r in (0.5, 1, 3):
        for q in ([30, 60, 2.0], [50, 50, 2.0], [71, 4, -1.0]):  # the second is on a side that two faces share
            face, _, point, _ = index.closest_point(q)
            area, volume = index.measure(point, r, face=face)
            assert area == pytest.approx(PI * r**2, rel=1e-12)
            assert volume == pytest.approx(2 / 3 * PI * r**3, rel=1e-12)
            gap = index.gap(point, r, face=face)
            if r < 1:
                assert (gap.distance, gap.face, list(gap.vertices)) == (np.inf, -1, [-1, -1, -1])
                assert np.isnan(gap.barycentric).all() and np.isnan(gap.point).all()
                continue
            assert gap.distance == 1  # at exactly r, too
            np.testing.assert_array_equal(gap.point, [*q[:2], 1 - point[2]])
            np.testing.assert_array_equal(np.sort(gap.vertices), np.sort(F[gap.face]))
            np.testing.assert_allclose(gap.barycentric @ V[gap.vertices], gap.point, rtol=1e-14)
    assert index.measure(point, 3 / index.mean_edge_length, face=face, unit="edge") == pytest.approx(tuple(index.measure(point, 3, face=face)))
    assert repr(index.measure(point, 3, face=face)).startswith("<meshhood.Measure: area 28.27")
    above = [30, 60, 4.0]  # farther than the radius from its face, so without a patch
    face, *_ = index.closest_point(above)
    assert index.measure(above, 2.9, face=face) == pytest.approx((0, np.nan), nan_ok=True)
    assert index.patch(above, 2.9, face=face).size == 0 and index.gap(above, 2.9, face=face).face == -1
    assert repr(gap).startswith(f"<meshhood.Gap: distance 1.0, face {gap.face}, vertices [")


def test_area_volume_and_gap_of_a_vertex_are_rows_of_all():
    V, F = box((4, 3, 1), 0.5)
    index = meshhood.MeshIndex(V, F)
    walls = [7]
    rows, gaps = index.invariants(0.6, walls=walls), index.gaps(0.6, walls=walls)
    assert np.isfinite(gaps.distance).any() and np.isinf(gaps.distance).any() and np.isnan(rows.volume).any()
    for v in range(len(V)):
        area, volume = index.measure(v, 0.6, walls=walls)
        assert [type(area), type(volume)] == [float, float]
        assert (area, volume) == pytest.approx((rows.area[v], rows.volume[v]), rel=1e-12, nan_ok=True)
        gap = index.gap(v, 0.6, walls=walls)
        assert [type(gap.distance), type(gap.face)] == [float, int]
        for name, value in gap._asdict().items():
            np.testing.assert_allclose(value, getattr(gaps, name)[v], rtol=1e-14, atol=1e-15)
    assert tuple(index.measure(7, 0.6, walls=walls)) == pytest.approx((0, np.nan), nan_ok=True)
    assert index.gap(7, 0.6, walls=walls).face == -1


def test_area_and_volume_of_a_sphere_of_10242_vertices():
    sphere = pytest.importorskip("trimesh").creation.icosphere(subdivisions=5)
    area, volume = meshhood.MeshIndex(sphere.vertices, sphere.faces).invariants(0.5)
    assert len(area) == 10242
    assert np.allclose(area, 0.785307, rtol=0, atol=2e-5)  # of the round sphere: 0.785398
    assert np.allclose(volume, 0.212571, rtol=0, atol=6e-6)  # 0.212712


def winding_numbers(points, triangles):
    """How often the triangles wind around each of the points."""
    a, b, c = (triangles[None, :, k] - points[:, None] for k in range(3))
    la, lb, lc = (np.linalg.norm(x, axis=2) for x in (a, b, c))
    ab, bc, ca = ((x * y).sum(2) for x, y in ((a, b), (b, c), (c, a)))
    angles = np.arctan2((a * np.cross(b, c)).sum(2), la * lb * lc + ab * lc + bc * la + ca * lb)
    return angles.sum(1) / (2 * PI)


def test_volumes_of_a_folded_surface_are_those_of_random_points():
    """Where a ball has one patch, the part of it behind the patch is what the surface winds around."""
    trimesh = pytest.importorskip("trimesh")
    sphere, random = trimesh.creation.icosphere(subdivisions=3), np.random.default_rng(8)
    P = sphere.vertices
    V = P * (1 + 0.25 * np.sin(9 * P[:, :1]) * np.sin(8 * P[:, 1:2]) * np.cos(7 * P[:, 2:]))
    index = meshhood.MeshIndex(V, sphere.faces)
    r, count = 0.45, scaled(4000, 1000)
    volume, gap = index.invariants(r).volume, index.gaps(r).distance
    whole = np.flatnonzero(np.isinf(gap))[::100]
    assert len(whole) > 3
    for v in whole:
        directions = random.normal(size=(count, 3))
        directions /= np.linalg.norm(directions, axis=1, keepdims=True)
        points = V[v] + r * random.uniform(size=(count, 1)) ** (1 / 3) * directions
        inside = np.concatenate([winding_numbers(some, V[sphere.faces]) for some in np.array_split(points, count // 100)])
        share = (inside > 0.5).mean()
        assert abs(volume[v] / (4 / 3 * PI * r**3) - share) < 4 * np.sqrt(share * (1 - share) / count)


def test_polygons_and_other_faces():
    V, F = box((2, 2, 2))
    quads = np.concatenate([F[::2], F[1::2, 2:]], axis=1)
    index = meshhood.MeshIndex(V, quads)
    np.testing.assert_allclose(index.invariants(0.8).volume, meshhood.MeshIndex(V, F).invariants(0.8).volume)
    bare = meshhood.MeshIndex(V, F, keep_faces=False)
    np.testing.assert_array_equal(bare.invariants(0.8, F=F).area, meshhood.MeshIndex(V, F).invariants(0.8).area)
    moved = meshhood.MeshIndex(V, F).refit(2 * V)
    np.testing.assert_allclose(moved.invariants(1.6).area, 4 * meshhood.MeshIndex(V, F).invariants(0.8).area)


def plane(n):
    """A grid of n by n vertices, each square of two triangles."""
    at = np.arange(n * n).reshape(n, n)
    squares = np.stack([at[:-1, :-1], at[:-1, 1:], at[1:, 1:], at[1:, :-1]], axis=-1).reshape(-1, 4)
    V = np.stack([at % n, at // n, 0 * at], axis=-1).reshape(-1, 3).astype(float)
    return V, np.concatenate([squares[:, :3], squares[:, [0, 2, 3]]])


@pytest.mark.parametrize("size", (1e-150, 1.0, 1e149))
def test_a_clip_is_the_disc_and_carries_values(size):
    V, F = plane(9)
    V *= size
    index, r = meshhood.MeshIndex(V, F), 2.7 * size
    ids, before = index.neighborhood(40, r), 0
    for tolerance in (1e-2, 1e-4, 1e-6):
        part = index.clip(40, r, tolerance=tolerance)
        assert part.area == index.measure(40, r).area == pytest.approx(PI * r * r)
        assert np.isclose(part.area, index.invariants(r, 40).area, rtol=1e-12, atol=0)  # whose sums have another order
        triangles = meshhood.vertex_areas(part.V, part.F).sum()
        assert part.area - tolerance * r * 2 * PI * r <= triangles < part.area
        assert triangles > before
        before = triangles
    np.testing.assert_array_equal(part.vertices, np.sort(ids))
    count = len(part.vertices)
    np.testing.assert_array_equal(part.V[:count], V[part.vertices])
    np.testing.assert_allclose(np.linalg.norm(part.V[count:] / size - V[40] / size, axis=1), 2.7, rtol=1e-15)
    assert part.corners.shape == part.weights.shape == (len(part.V) - count, 3)
    np.testing.assert_allclose(part.weights.sum(axis=1), 1, rtol=1e-15)
    on_side = part.weights[:, 2] == 0
    np.testing.assert_array_equal(on_side, np.arange(len(on_side)) < on_side.sum())
    assert not np.isin(part.corners[on_side, 0], ids).any()
    np.testing.assert_allclose(part.carry(V), part.V, rtol=1e-14, atol=1e-15 * size)
    assert part.carry((V / size).astype(np.float32)).dtype == np.float32
    np.testing.assert_array_equal(np.unique(part.faces), index.patch(40, r))
    whole = index.submesh(ids)
    np.testing.assert_array_equal(whole.carry(np.arange(81)), whole.vertices)
    assert len(whole.corners) == len(whole.weights) == 0
    assert whole.area == pytest.approx(meshhood.vertex_areas(whole.V, whole.F).sum())
    with pytest.raises(TypeError, match="values: .* a clipped mesh, not int64, .*; take labels at `vertices`, and"):
        part.carry(np.arange(81))
    for wrong in (1.0, np.ones(40), np.ones(82)):
        with pytest.raises(ValueError, match="values: of shape .* a row for each of the 81 vertices of the whole mesh"):
            part.carry(wrong)


def test_a_clip_around_a_point_of_a_face_that_has_no_vertex_in_the_ball():
    index = meshhood.MeshIndex([[0, 0, 0], [9, 0, 0], [0, 9, 0.0]], [[0, 1, 2]])
    part = index.clip([2, 2, 0.0], 1.5, face=0)
    assert len(part.vertices) == 0
    assert part.area == pytest.approx(PI * 1.5**2)
    assert part.carry(np.array([0, 9, 0.0])) == pytest.approx(part.V[:, 0])
    assert len(index.clip([2, 2, 0.0], 1.5, face=0, tolerance=1e-5).V) > len(part.V)
    V, F = plane(9)
    index = meshhood.MeshIndex(V, F)
    assert not (F[index.clip(40, 2, walls=[41]).faces] == 41).any()
    none = index.clip(41, 2, walls=[41])
    assert (len(none.V), len(none.F), none.area) == (0, 0, 0)
    np.testing.assert_array_equal(index.clip(40, 2, unit="edge").V, index.clip(40, 2 * index.mean_edge_length).V)


def test_rows_of_points_are_those_of_single_calls():
    index = meshhood.MeshIndex(*box((5, 5, 1)))
    face, _, points, _ = index.closest_point(np.random.default_rng(4).normal(size=(30, 3)))
    radii, walls = np.linspace(0, 1.2, 30), [3, 70]
    words = {"points": points, "face": face, "walls": walls, "unit": "edge", "workers": 3}
    rows, gaps = index.invariants(radii, **words), index.gaps(radii, **words)
    for i, (start, r) in enumerate(zip(points, radii)):
        one, gap = (call(start, r, face=face[i], walls=walls, unit="edge") for call in (index.measure, index.gap))
        np.testing.assert_array_equal((rows.area[i], rows.volume[i]), one)
        for column, value in zip(gaps, gap):
            np.testing.assert_array_equal(column[i], value)
    calls = []
    scales = index.gaps(scales=[0.2, 0.4], points=points, face=face, progress=lambda *done: calls.append(done))
    assert scales.point.shape == (2, 30, 3) and calls[-1] == (60, 60)
    of_all = index.closest_point(1.01 * np.arange(3 * len(index)).reshape(-1, 3) % 5)  # as many as vertices
    words = {"points": of_all.point, "face": of_all.face}
    for rows in (index.invariants(0.4, **words).area, index.gaps(0.4, **words).face, index.thickness(**words)):
        assert rows.shape == (len(index),)
    single = index.invariants(0.4, points=points[7], face=face[7])
    assert single.area.shape == () and single == index.measure(points[7], 0.4, face=face[7])
    assert index.gaps(scales=[0.2, 0.4], points=points[7], face=face[7]).point.shape == (2, 3)
    for r, distance in zip((0.2, 0.4), scales.distance):
        np.testing.assert_array_equal(distance, index.gaps(r, points=points, face=face).distance)


# The outward faces of elements of the package overlap.
ELEMENTS = {
    "Tetrahedron": [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)],
    "Wedge": [(0, 2, 1), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5), (3, 4, 5)],
    "Hexahedron": [(0, 3, 2, 1), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (0, 4, 7, 3), (4, 5, 6, 7)],
}
CORNERS = {
    "Tetrahedron": [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)],
    "Wedge": [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (0, 1, 1)],
    "Hexahedron": [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)],
}


@pytest.mark.parametrize("kind", ELEMENTS)
def test_areas_of_facets_and_volumes_of_convex_pieces_are_those_of_overlap(kind):
    """Strobl, Formella, Poeschel, "Exact calculation of the overlap volume of spheres and mesh elements", J. Comput.
    Phys. 2016. The ball is around a corner, or a point of a face, which is then a fan. The areas of overlap 0.2 are off
    by up to 5e-7 of the disc; the reference of tests/patch is not."""
    overlap = pytest.importorskip("overlap")
    random = np.random.default_rng(1)
    pieces, whole = scaled(400, 40), 0
    for i in range(pieces):
        V = np.array(CORNERS[kind]) @ (np.eye(3) + random.uniform(-0.4, 0.4, (3, 3))) + random.uniform(-1, 1, 3)
        faces, owners = list(ELEMENTS[kind]), list(range(len(ELEMENTS[kind])))
        v = int(random.integers(len(V)))
        if i % 2:
            owner = int(random.integers(len(faces)))
            face = faces.pop(owner)
            owners.pop(owner)
            V = np.vstack([V, random.dirichlet(np.ones(len(face))) @ V[list(face)]])
            v = len(V) - 1
            faces += [(a, b, v) for a, b in zip(face, face[1:] + face[:1])]
            owners += [owner] * len(face)
        r = random.uniform(0.05, 1.5)
        index = meshhood.MeshIndex(V, (np.cumsum([0, *map(len, faces)]), np.concatenate(faces)))
        area, volume = index.invariants(r, v)
        ball = overlap.Sphere(V[v], r)
        piece = getattr(overlap, kind)(V[: len(CORNERS[kind])])
        areas = np.array(overlap.overlap_area(ball, piece))[1:-1]
        patch = np.unique(np.array(owners)[index.patch(v, r)])
        assert area == pytest.approx(areas[patch].sum(), abs=1e-6 * PI * r**2)
        if areas[patch].sum() == areas.sum():  # the patch is all that is in the ball
            whole += 1
            assert volume == pytest.approx(overlap.overlap_volume(ball, piece), abs=1e-13 * r**3)
    print(f"{pieces} areas, {whole} volumes")
    assert whole > pieces / 2


@pytest.mark.parametrize(
    ("call", "error", "cause"),
    [
        (lambda index: index.invariants(1, [99]), ValueError, "vertices: row 0: vertex 99"),
        (lambda index: index.gaps(1, walls=[99]), ValueError, "walls"),
        (lambda index: index.patch(99, 1), ValueError, "start: vertex 99"),
        (lambda index: index.patch([0.0, 0.0, 0.0], 1, face=99), ValueError, "face 99"),
        (lambda index: index.patch(0, 1, face=0), TypeError, "start"),
        (lambda index: index.clip([2, 2, 0.0], 1), TypeError, "start: a point, expected its face, too: face="),
        (lambda index: index.clip(99, 1), ValueError, "start: vertex 99"),
        (lambda index: index.measure([2, 2, 0.0], 1), TypeError, "start: a point, expected its face, too: face="),
        (lambda index: index.measure(99, 1), ValueError, "start: vertex 99"),
        (lambda index: index.gap([0.0, 0.0, 0.0], 1, face=99), ValueError, "face 99"),
        (lambda index: index.gap(0, -1), ValueError, "radius"),
        (lambda index: index.clip(0, 1, tolerance=0), ValueError, "tolerance: 0.0, expected a finite number > 0"),
        (lambda index: index.gaps(1, F=[[0, 1, 99]]), ValueError, "F"),
        (lambda index: index.features(1, kinds=("crease", "gap"), metric="path"), ValueError, "expected the straight metric"),
        (lambda index: index.invariants(1, unit="m"), ValueError, "unit"),
        (lambda index: index.invariants(1, points=np.zeros((2, 3))), ValueError, "points: expected points and the face of"),
        (lambda index: index.gaps(1, 0, points=np.zeros((1, 3)), face=[0]), ValueError, "points: .* or vertices"),
        (lambda index: index.gaps(1, points=np.zeros((2, 3)), face=[0]), ValueError, "face: expected one for each of 2"),
        (lambda index: index.gaps(1, points=np.zeros((2, 3)), face=[0, 12]), ValueError, "face: row 1: face 12"),
        (lambda index: index.gaps([1, -1], points=np.zeros((2, 3)), face=[0, 1]), ValueError, "r: row 1"),
    ],
)
def test_arguments_that_are_wrong_are_named(call, error, cause):
    with pytest.raises(error, match=cause):
        call(meshhood.MeshIndex(*box((1, 1, 1))))
