# SPDX-License-Identifier: MIT
"""Arguments that are accepted as a mesh, and arguments that are refused (reliability row P1)."""

import meshes
import meshhood
import numpy as np
import pytest
from scipy.sparse import coo_matrix, csr_array

V, QUADS = meshes.grid(6)
F = meshes.triangles(QUADS)
R = 1.5


def answers(index):
    return [a.tolist() for a in index.neighborhoods(R, sort="id")]


TRIANGLES = answers(meshhood.MeshIndex(V, F))
POLYGONS = answers(meshhood.MeshIndex(V, QUADS))


def padded(faces):
    return np.column_stack([np.full(len(faces), faces.shape[1]), faces]).ravel()


def read_only(array):
    array = array.copy()
    array.flags.writeable = False
    return array


def spread(array):
    """Every other row and column of a larger array."""
    larger = np.full((2 * len(array), 2 * array.shape[1]), 99, array.dtype)
    larger[::2, ::2] = array
    return larger[::2, ::2]


LAYOUTS = {
    "C": np.ascontiguousarray,
    "Fortran": np.asfortranarray,
    "reversed": lambda a: np.ascontiguousarray(a[::-1])[::-1],
    "spread": spread,
    "read-only": read_only,
    "other byte order": lambda a: a.astype(a.dtype.newbyteorder()),
    "list": lambda a: a.tolist(),
}


@pytest.mark.parametrize("layout", LAYOUTS)
@pytest.mark.parametrize("real", (np.float16, np.float32, np.float64, np.int8, np.int64))
def test_positions(layout, real):
    assert answers(meshhood.MeshIndex(LAYOUTS[layout](V.astype(real)), F)) == TRIANGLES


@pytest.mark.parametrize("layout", LAYOUTS)
@pytest.mark.parametrize("integer", (np.uint8, np.int16, np.int32, np.int64, np.uint32, np.uint64))
def test_faces(layout, integer):
    assert answers(meshhood.MeshIndex(V, LAYOUTS[layout](F.astype(integer)))) == TRIANGLES
    assert answers(meshhood.MeshIndex(V, LAYOUTS[layout](QUADS.astype(integer)))) == POLYGONS


def test_polygons():
    offsets = 4 * np.arange(len(QUADS) + 1)
    assert answers(meshhood.MeshIndex(V, (offsets, QUADS.ravel()))) == POLYGONS
    assert answers(meshhood.MeshIndex(V, padded(QUADS))) == POLYGONS
    assert answers(meshhood.MeshIndex(V, np.concatenate([padded(QUADS[:9]), padded(F)]))) == TRIANGLES


@pytest.mark.parametrize("kind", (csr_array, coo_matrix))
def test_graph(kind):
    rows, columns = QUADS.ravel(), np.roll(QUADS, -1, axis=1).ravel()
    shape = (len(V), len(V))
    one_way = kind((np.zeros(len(rows)), (rows, columns)), shape=shape)
    assert answers(meshhood.MeshIndex(V, one_way)) == POLYGONS
    both_ways = kind((np.ones(2 * len(rows)), (np.r_[rows, columns], np.r_[columns, rows])), shape=shape)
    assert answers(meshhood.MeshIndex(V, both_ways)) == POLYGONS


def test_trimesh():
    trimesh = pytest.importorskip("trimesh")
    mesh = trimesh.Trimesh(V, F, process=False)
    assert answers(meshhood.MeshIndex(mesh)) == TRIANGLES


def test_meshio():
    meshio = pytest.importorskip("meshio")
    half = len(QUADS) // 2
    mixed = meshio.Mesh(V, [("quad", QUADS[:half]), ("triangle", F)])
    assert answers(meshhood.MeshIndex(mixed)) == TRIANGLES
    assert answers(meshhood.MeshIndex(meshio.Mesh(V, [("quad", QUADS)]))) == POLYGONS
    with pytest.raises(ValueError, match="V: .*tetra"):
        meshhood.MeshIndex(meshio.Mesh(V, [("tetra", QUADS)]))


def test_pyvista():
    pyvista = pytest.importorskip("pyvista")
    assert answers(meshhood.MeshIndex(pyvista.PolyData.from_regular_faces(V, F))) == TRIANGLES
    assert answers(meshhood.MeshIndex(pyvista.PolyData(V, padded(QUADS)))) == POLYGONS
    with pytest.raises(ValueError, match="V: .*lines"):
        meshhood.MeshIndex(pyvista.PolyData(V, lines=[2, 0, 1]))


@pytest.mark.parametrize("faces", (np.zeros((0, 3), int), np.zeros((0, 4), int), np.zeros(0, int), [], ([0], [])))
def test_nothing(faces):
    empty = meshhood.MeshIndex(np.zeros((0, 3)), faces)
    assert len(empty) == 0
    assert empty.permutation.shape == (0,)
    assert [len(a) for a in empty.neighborhoods(1.0, return_distance=True)] == [1, 0, 0]
    assert empty.counts(1.0, []).shape == (0,)
    assert empty.radius_neighbors_graph(1.0).shape == (0, 0)
    assert list(empty.iter_neighborhoods(1.0)) == []
    lonely = meshhood.MeshIndex(V, faces)
    np.testing.assert_array_equal(lonely.neighborhood(3, np.inf), [3])


class Unreadable:
    def __array__(self, dtype=None, copy=None):
        raise ValueError("the file is closed")


def with_value(array, at, value):
    array = array.copy()
    array[at] = value
    return array


MASKED = np.ma.masked_greater(V, 3)


@pytest.mark.parametrize(
    ("positions", "faces", "error", "message"),
    (
        (V.ravel(), F, ValueError, r"V: .*\(108,\)"),
        (np.float64(1), F, ValueError, r"V: .*\(\)"),
        ([[0, 0, 0], [1, 1]], F, ValueError, "V: "),
        (V.astype(complex), F, TypeError, "V: .*complex128"),
        (V.astype(bool), F, TypeError, "V: .*bool"),
        (V.astype(object), F, TypeError, "V: .*object"),
        (V.astype(np.longdouble), F, TypeError, "V: .*float128"),
        (with_value(V.astype(int), (3, 1), 2**53 + 1), F, TypeError, "V: .*2.53"),
        (with_value(V.astype(int), (3, 1), -(2**63)), F, TypeError, "V: .*2.53"),
        (with_value(V.astype(np.uint64), (3, 1), 2**64 - 1), F, TypeError, "V: .*2.53"),
        (MASKED, F, TypeError, "V: .*mask"),
        (with_value(V, (8, 2), np.inf), F, ValueError, "V: vertex 8: z is inf"),
        (V, F.astype(bool), TypeError, "F: .*bool"),
        (V, F.astype(object), TypeError, "F: .*object"),
        (V, F[None], ValueError, r"F: .*\(1, 50, 3\)"),
        (V, np.int64(3), ValueError, r"F: .*\(\)"),
        (V, with_value(F, (4, 1), -1), ValueError, "F: face 4: corner 1 is vertex -1"),
        (V, with_value(F, (4, 1), 2**40), ValueError, "F: face 4: corner 1 is vertex 1099511627776"),
        (V, ([0, 3, 2, 4], [0, 1, 2, 3]), ValueError, "F: face 1 ends at corner 2"),
        (V, ([1, 4], [0, 1, 2, 3]), ValueError, "F: face offsets begin with 1"),
        (V, ([0.0, 3.0], [0, 1, 2]), TypeError, r"F\[0\]: .*float64"),
        (V, ([0, 3], [[0, 1, 2]]), ValueError, r"F\[1\]: .*\(1, 3\)"),
        (V, (0, 1, 2), ValueError, "F: .*3 parts"),
        (V, [[0, 1, 2], [3, 4, 5, 6]], ValueError, r"F: rows of different lengths; .* tuple \(offsets, corners\)"),
        (V, Unreadable(), ValueError, "^F: the file is closed$"),
        (V, [3, 0, 1, 2, 3, 0, 1], ValueError, "F: face 1 begins at 4 with 3 corners"),
        (V, [3, 0, 1, 2, -1], ValueError, "F: face 1 begins at 4 with -1 corners"),
        (V, csr_array((3, 3)), ValueError, r"F: .*\(3, 3\), expected \(36, 36\)"),
    ),
)
def test_refused_meshes(positions, faces, error, message):
    with pytest.raises(error, match=message):
        meshhood.MeshIndex(positions, faces)


INDEX = meshhood.MeshIndex(V, F)


@pytest.mark.parametrize(
    ("v", "r", "error", "message"),
    (
        (-1, 1, ValueError, "start: vertex -1"),
        (2**70, 1, ValueError, "start: vertex 1180591620717411303424"),
        ([0, 1, 36], 1, ValueError, "vertices: row 2: vertex 36"),
        (np.array([0, 2**32], np.uint64), 1, ValueError, "vertices: row 1: vertex 4294967296"),
        ([0.0], 1, TypeError, "vertices: .*float64"),
        (True, 1, TypeError, "start: .*bool"),
        (np.True_, 1, TypeError, "start: .*bool"),
        (np.array(True), 1, TypeError, "start: "),
        ([0, True], 1, TypeError, "vertices: .*bool"),
        ([True], 1, ValueError, r"vertices: a bool mask of shape \(1,\), expected \(36,\)"),
        (np.ones((len(V), 1), bool), 1, ValueError, r"vertices: a bool mask of shape \(36, 1\)"),
        ([[0, 1]], 1, ValueError, r"vertices: .*\(1, 2\)"),
        (0, -1, ValueError, "r: .*-1"),
        (0, np.nan, ValueError, "r: .*nan"),
        (0, True, TypeError, "r: .*bool"),
        ([0, 1], [True, True], TypeError, "r: .*bool"),
        ([0, 1], [1.0, True], TypeError, "r: .*bool"),
        ([], -1, ValueError, "r: .*-1"),
        ([], np.nan, ValueError, "r: .*nan"),
        (0, None, TypeError, "r: "),
        (0, "1", TypeError, "r: "),
        (0, 10**400, TypeError, "r: "),
        (0, [1], ValueError, r"r: .*\(1,\)"),
        ([0, 1], [1, -1], ValueError, "r: row 1: .*-1"),
        ([0, 1], [1, 2, 3], ValueError, r"r: .* 2 rows.*\(3,\)"),
        ([0, 1], ["1", "2"], TypeError, "r: "),
    ),
)
@pytest.mark.parametrize("method", ("exact", "paper", "bfs", "ball"))
def test_refused_queries(v, r, error, message, method):
    of_one = INDEX.neighborhood, INDEX.count
    of_many = INDEX.neighborhoods, INDEX.counts, INDEX.iter_neighborhoods
    for call in of_many if np.ndim(v) else of_one:
        with pytest.raises(error, match=message):
            call(*((r, v) if call in of_many else (v, r)), method=method)


@pytest.mark.parametrize(
    ("call", "error", "message"),
    (
        (lambda: INDEX.neighborhood(0, 1, method=["exact"]), TypeError, "method: .*list"),
        (lambda: meshhood.Paper(levels=65), ValueError, "levels: 65"),
        (lambda: meshhood.Paper(levels=2.0), TypeError, "levels: .*float"),
        (lambda: meshhood.Paper(levels=True), TypeError, "levels: .*bool"),
        (lambda: meshhood.Paper(discard=-1), ValueError, "discard: -1, expected 0 to 64"),
        (lambda: meshhood.Paper(fusion_growth=-0.5), ValueError, "fusion_growth: -0.5, expected .* >= 0"),
        (lambda: meshhood.Paper(fusion_growth=np.inf), ValueError, "fusion_growth: inf"),
        (lambda: meshhood.Paper(radius_ratio=0), ValueError, "radius_ratio: 0.0, expected .* > 0"),
        (lambda: meshhood.Paper(radius_ratio=np.nan), ValueError, "radius_ratio: nan"),
        (lambda: meshhood.Paper(radius_ratio="10"), TypeError, "radius_ratio: text, expected a number"),
        (lambda: INDEX.neighborhoods(1, [0], workers=10**30), ValueError, "workers: 10"),
        (lambda: INDEX.neighborhoods(1, [0], workers=1.5), TypeError, "workers: .*float"),
        (lambda: INDEX.neighborhoods(1, [0], workers=True), TypeError, "workers: .*bool"),
        (lambda: INDEX.radius_neighbors_graph(1, mode="far"), ValueError, "mode: 'far'"),
        (lambda: INDEX.neighborhoods(1, [0], unit=["edge"]), ValueError, r"unit: \['edge'\]"),
        (lambda: INDEX.iter_neighborhoods(1, chunk=0), ValueError, "chunk: 0, expected at least 1$"),
        (lambda: INDEX.iter_neighborhoods(1, order="file"), ValueError, "order: 'file'"),
        (lambda: meshhood.MeshIndex(V, F, workers=5000), ValueError, "workers: 5000"),
        *((call, TypeError, r"^vertices: one vertex, expected a list: \[3\]") for call in (
            lambda: INDEX.neighborhoods(1, 3),
            lambda: INDEX.iter_neighborhoods(1, np.int32(3)),
            lambda: INDEX.radius_neighbors_graph(1, 3),
            lambda: INDEX.smooth(V[:, 0], 6, vertices=3),
            lambda: INDEX.smoothing_matrix([6], vertices=3),
        )),
        *((call, ValueError, "^vertices: expected a list of vertices, or a bool mask of 36, not") for call in (
            lambda: INDEX.neighborhoods(1, [[0]]),
            lambda: INDEX.iter_neighborhoods(1, np.zeros((1, 1), int)),
            lambda: INDEX.smooth(V[:, 0], 6, vertices=[[0]]),
        )),
        (lambda: INDEX.neighborhoods(1, {1, 2}), TypeError, "vertices: expected an integer, not set"),
        (lambda: INDEX.neighborhoods(1, slice(0, 5)), TypeError, "vertices: expected an integer, not slice"),
        (lambda: INDEX.neighborhoods(1, np.array(3.0)), TypeError, "vertices: expected an integer, not float64"),
        (lambda: INDEX.k_nearest(np.array([1, 2])), TypeError, "k: expected an integer, not ndarray"),
        (lambda: INDEX.counts(1, walls=((1, 2), (3, 4))), ValueError, r"walls: expected a list .* shape \(2, 2\)$"),
        (lambda: INDEX.nested(3, [1, 2, 2]), ValueError, "radii: value 2: radius 2.0, expected more than 2.0"),
        (lambda: INDEX.nested(3, [1, np.nan]), ValueError, "radii: value 1: radius nan, expected a number >= 0"),
        (lambda: INDEX.smooth(V[:, 0], [6, 8]), ValueError, "^fwhm: expected one number, or one for each of 36 rows"),
        (lambda: INDEX.stroke(V[:3], [1, 2]), ValueError, r"r: .* one for each of 3 rows, not an array of shape \(2,\)$"),
    ),
)
def test_refused_options(call, error, message):
    with pytest.raises(error, match=message):
        call()


OF_START = INDEX.neighborhood, INDEX.count, lambda start, r, **words: INDEX.nested(start, [r], **words)


@pytest.mark.parametrize("value", (np.array(["exact", "bfs"]), np.array([1, 2])), ids=("names", "numbers"))
@pytest.mark.parametrize("option", ("metric", "unit", "method"))
def test_options_that_are_arrays_are_refused_by_name(option, value):
    for call, start in ((call, start) for call in OF_START for start in (3, V[3] + 0.1)):
        if (call, option) != (OF_START[2], "method"):
            with pytest.raises((TypeError, ValueError), match=f"^{option}: "):
                call(start, 1.0, **{option: value})
    with pytest.raises((TypeError, ValueError), match=f"^{option}: "):
        INDEX.counts(1.0, **{option: value})


@pytest.mark.parametrize(
    ("call", "name"),
    (
        (lambda rows: INDEX.counts(1.0, rows), "vertices"),
        (lambda rows: INDEX.neighborhoods(1.0, rows), "vertices"),
        (lambda rows: INDEX.neighborhood(rows, 1.0), "start"),
        (lambda rows: INDEX.neighborhood(V[3], 1.0, seeds=rows), "seeds"),
        (lambda rows: INDEX.counts(1.0, walls=rows), "walls"),
        (lambda rows: INDEX.stroke(rows, 1.0), "points"),
        (lambda rows: INDEX.stroke(V[:2], 1.0, seeds=rows), "seeds"),
        (lambda rows: INDEX.stroke(V[:2], 1.0, face=rows), "face"),
        (lambda rows: INDEX.nearest(rows), "points"),
        (lambda rows: INDEX.closest_point(rows), "q"),
        (lambda rows: INDEX.rim([3], rows, 1.0), "start"),
        (lambda rows: INDEX.gap(rows, 1.0), "start"),
        (lambda rows: INDEX.clip(rows, 1.0, face=0), "start"),
        (lambda rows: INDEX.gaps(1.0, points=V[:2], face=rows), "face"),
        (lambda rows: INDEX.thickness(points=V[:2], face=rows), "face"),
        (lambda rows: INDEX.smooth(V[:, 0], rows), "fwhm"),
    ),
)
def test_rows_of_different_lengths_are_refused_by_name(call, name):
    with pytest.raises(ValueError, match=f"^{name}: rows of different lengths"):
        call([[1, 2], [3]])
