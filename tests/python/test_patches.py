# SPDX-License-Identifier: MIT
"""Areas, volumes and gaps of the surface in a ball."""

import meshhood
import numpy as np
import pytest

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


def test_the_corner_an_edge_and_a_side_of_a_cube_are_exact():
    V, F = box((2, 2, 2))
    index = meshhood.MeshIndex(V, F)
    area, volume = index.invariants(scales=[0.5, 1])
    for row, r in enumerate((0.5, 1)):
        on = (V == 1).sum(axis=1)
        assert area[row] == pytest.approx(np.choose(on, [0.75, 1, 1]) * PI * r**2, rel=1e-14)
        assert volume[row] == pytest.approx(np.choose(on, [1 / 6, 1 / 3, 2 / 3]) * PI * r**3, rel=1e-14)


def test_features_are_invariants_and_gaps_without_unit():
    V, F = box((2, 2, 2))
    index = meshhood.MeshIndex(np.vstack([V, V + [0, 0, 2.5]]), np.vstack([F, F + len(V)]))
    found = index.features(scales=[0.25, 1], kinds=("area", "volume", "gap"))
    area, volume = index.invariants(scales=[0.25, 1])
    r = np.array([[0.25], [1]])
    np.testing.assert_allclose(found[..., 0], area / (PI * r**2), rtol=1e-15)
    np.testing.assert_allclose(found[..., 1], volume / (4 / 3 * PI * r**3), rtol=1e-15)
    assert np.isnan(found[0, :, 2]).all()
    near = np.flatnonzero(V[:, 2] == 2)
    assert found[1, near, 2] == pytest.approx(0.5)
    np.testing.assert_array_equal(index.features(1, [3], kinds="volume"), found[1, [3], 1])
    walls = index.invariants(1, walls=[0]).area / PI
    np.testing.assert_allclose(index.features(1, kinds="area", walls=[0]), np.where(walls > 0, walls, np.nan), rtol=1e-15)
    with pytest.raises(ValueError, match="expected the straight metric"):
        index.features(1, kinds=("crease", "gap"), metric="path")


def test_a_row_depends_on_its_vertex_and_radius_alone():
    V, F = box((3, 4, 5))
    index = meshhood.MeshIndex(V, F)
    radii = np.linspace(0.1, 3, len(V))
    whole = index.invariants(radii, workers=2)
    gaps = index.gaps(radii, workers=2)
    for v in (0, 7, len(V) - 1):
        one = index.invariants(radii[v], v)
        assert one.area.shape == ()
        assert (one.area, one.volume) == (whole.area[v], whole.volume[v])
        assert index.gaps(radii[v], [v]).distance[0] == gaps.distance[v]
    edge = index.mean_edge_length
    np.testing.assert_array_equal(index.invariants(2, unit="edge").area, index.invariants(2 * edge).area)


def test_the_gap_of_a_plate_is_its_thickness_whatever_its_triangles():
    V, F = box((1, 1, 1))
    V *= [100, 100, 1]
    index = meshhood.MeshIndex(V, F)
    face, _, point = index.closest_point([30, 60, 2.0])
    faces = index.patch(point, 2, face=face)
    assert face in faces
    assert (V[F[faces]][:, :, 2] == 1).all()
    V, F = box((20, 20, 1))
    V *= [1, 1, 0.5]
    gaps = meshhood.MeshIndex(V, F).gaps(1.0)
    inner = (abs(V[:, :2] - 10) < 8.5).all(axis=1)
    assert (gaps.distance[inner] == 0.5).all()
    np.testing.assert_allclose(np.einsum("ij,ijk->ik", gaps.barycentric[inner], V[gaps.vertices[inner]]), gaps.point[inner])
    np.testing.assert_array_equal(np.sort(gaps.vertices[inner]), np.sort(F[gaps.face[inner]]))


def test_rows_without_a_gap():
    V, F = box((2, 2, 2))
    gaps = meshhood.MeshIndex(V, F).gaps(0.5, [0, 3])
    assert np.isinf(gaps.distance).all()
    assert (gaps.face == -1).all()
    assert (gaps.vertices == -1).all()
    assert np.isnan(gaps.barycentric).all()
    assert np.isnan(gaps.point).all()


def test_faces_with_a_wall_are_not_there():
    V, F = box((4, 4, 4))
    index = meshhood.MeshIndex(V, F)
    wall = int(np.flatnonzero((V == [2, 2, 0]).all(axis=1))[0])
    vertex = int(np.flatnonzero((V == [1, 2, 0]).all(axis=1))[0])
    kept = ~(F == wall).any(axis=1)
    other = meshhood.MeshIndex(V, F[kept])
    area, volume = index.invariants(0.9, walls=[wall])
    assert area == pytest.approx(other.invariants(0.9).area, rel=1e-13)
    assert area[wall] == 0
    assert np.isnan(volume[[wall, vertex]]).all()
    assert wall not in F[index.patch(vertex, 0.9, walls=[wall])]
    masked = index.masked(walls=[wall])
    np.testing.assert_array_equal(masked.invariants(0.9).area, area)
    np.testing.assert_array_equal(index.invariants(0.9).area, meshhood.MeshIndex(V, F).invariants(0.9).area)


def test_polygons_and_other_faces():
    V, F = box((2, 2, 2))
    quads = np.concatenate([F[::2], F[1::2, 2:]], axis=1)
    index = meshhood.MeshIndex(V, quads)
    np.testing.assert_allclose(index.invariants(0.8).volume, meshhood.MeshIndex(V, F).invariants(0.8).volume)
    bare = meshhood.MeshIndex(V, F, keep_faces=False)
    np.testing.assert_array_equal(bare.invariants(0.8, F=F).area, meshhood.MeshIndex(V, F).invariants(0.8).area)
    moved = meshhood.MeshIndex(V, F).refit(2 * V)
    np.testing.assert_allclose(moved.invariants(1.6).area, 4 * meshhood.MeshIndex(V, F).invariants(0.8).area)


@pytest.mark.parametrize(
    ("call", "error", "cause"),
    [
        (lambda index: index.invariants(), TypeError, "r: missing"),
        (lambda index: index.invariants(-1), ValueError, "r: radius"),
        (lambda index: index.invariants(1, [99]), ValueError, "vertices: row 0: vertex 99"),
        (lambda index: index.gaps(1, walls=[99]), ValueError, "walls"),
        (lambda index: index.patch(99, 1), ValueError, "start: vertex 99"),
        (lambda index: index.patch([0.0, 0.0, 0.0], 1, face=99), ValueError, "face 99"),
        (lambda index: index.patch(0, 1, face=0), TypeError, "start"),
        (lambda index: index.gaps(1, F=[[0, 1, 99]]), ValueError, "F"),
        (lambda index: index.invariants(1, unit="m"), ValueError, "unit"),
    ],
)
def test_arguments_that_are_wrong_are_named(call, error, cause):
    with pytest.raises(error, match=cause):
        call(meshhood.MeshIndex(*box((1, 1, 1))))
