# SPDX-License-Identifier: MIT
"""Converts a mesh, in any accepted form, to the arrays that an index is built from. Errors name the argument. What is
not checked here, the C++ library checks."""

import itertools
import os
import warnings

import numpy as np

from . import _core
from ._convert import as_array, integers


def mesh_arrays(V, F):
    """A mesh as the library takes it: positions (#V by 3, float32 or float64), corners, and the offsets of the polygons or
    None for triangles."""
    if F is None:
        V, F = _parts(V)
    positions = positions_of(V)
    if hasattr(F, "tocoo"):
        return positions, *_edges(F, len(positions))
    return positions, *face_arrays(F)


def whole_mesh_arrays(V, F):
    """The same of a mesh whose vertices all have a position: `MeshIndex` alone takes others."""
    mesh = mesh_arrays(V, F)
    found = _core.place(mesh)
    if found is not None:
        raise ValueError(f"V: {text_of_unplaced(found[1])}, {without_them('meshhood.MeshIndex(V, F)')}")
    return mesh


def face_arrays(F):
    """The corners of faces, or of a mesh, and the offsets of the polygons or None for triangles."""
    if hasattr(F, "tocoo"):
        raise ValueError("F: a graph, expected faces")
    if _is_mesh(F):
        F = _parts(F)[1]
    return _polygons(F) if isinstance(F, tuple) else _faces(F)


def kept_faces(faces):
    """The arrays above, compact and read-only, for vertices that int32 can number; no offsets if all faces are
    triangles. Arrays of this size are not copied."""
    corners, offsets = faces
    if offsets is not None and len(corners) == 3 * (len(offsets) - 1) and np.all(np.diff(offsets) == 3):
        offsets = None
    wide = np.int32 if len(corners) < 2**31 else np.int64
    return _read_only(corners, np.int32), None if offsets is None else _read_only(offsets, wide)


def _read_only(array, dtype):
    # Valid ids and offsets are the same numbers in a signed and an unsigned type of the same size.
    array = array.view(dtype) if array.itemsize == np.dtype(dtype).itemsize else array.astype(dtype)
    array.flags.writeable = False
    return array


def moved_positions(V):
    """Positions as above, also of a mesh."""
    return positions_of(_parts(V)[0] if _is_mesh(V) else V)


def positions_of(V, name="V"):
    """`V` as float32 or float64 (#V, 3) in C order."""
    _refuse_path(V, name)
    array = as_array(V, name)
    if array.dtype.kind in "iu" or array.dtype == np.float16:
        array = _as_float64(array, name)
    if array.dtype not in (np.float32, np.float64):
        raise TypeError(f"{name}: expected float32 or float64, not {array.dtype}")
    if array.ndim != 2 or array.shape[1] != 3:
        hint = f"; {name}.T has it" if array.ndim == 2 and len(array) == 3 else ""
        raise ValueError(f"{name}: expected an array of shape (#V, 3), not {array.shape}{hint}")
    return np.ascontiguousarray(array)


def _refuse_path(V, name):
    if isinstance(V, (str, bytes, os.PathLike)):
        raise TypeError(f"{name}: a path, expected arrays or a mesh; read_mesh(path) reads a mesh file")


def _as_float64(array, name):
    if array.dtype.itemsize == 8 and ((array > 2**53) | (array < -(2**53))).any():
        raise TypeError(f"{name}: has integers beyond 2^53, which float64 does not hold")
    return array.astype(np.float64)


def _faces(F):
    """(#F, k): polygons of k corners each; one dimension: VTK's padded faces."""
    try:
        array = integers(F, "F")
    except ValueError as error:
        is_ragged = "rows of different lengths" in str(error)
        hint = "; expected (#F, k), or polygons as a tuple (offsets, corners)" if is_ragged else ""
        raise ValueError(f"{error}{hint}") from None
    if array.ndim == 1:
        return _padded(array)
    if array.ndim != 2 or array.shape[1] == 0:
        raise ValueError(
            f"F: expected (#F, k), a tuple (offsets, corners), or padded faces (one dimension), not shape {array.shape}"
        )
    count, corners = array.shape
    # Three or four polygons that have all vertices, some repeatedly, are triangles or quadrilaterals in columns.
    if count in (3, 4) and corners > 16 and len(np.unique(array[0])) < corners:
        raise ValueError(f"F: expected (#F, {count}), not shape {array.shape}; F.T has it")
    if corners == 3:
        return array.ravel(), None
    return array.ravel(), np.arange(count + 1, dtype=np.int64) * corners


def _padded(array):
    """`[k, a, b, c, ..., k, a, ...]`: the number of corners before each face."""
    starts = []
    at = 0
    while at < len(array):
        starts.append(at)
        corners = int(array[at])
        if corners < 0 or at + corners >= len(array):
            raise ValueError(
                f"F: face {len(starts) - 1} begins at {at} with {corners} corners, but the array ends at {len(array)}"
            )
        at += corners + 1
    starts = np.array([*starts, len(array)], np.int64)
    keep = np.ones(len(array), bool)
    keep[starts[:-1]] = False
    return array[keep], starts - np.arange(len(starts))


def _polygons(F):
    if len(F) != 2:
        raise ValueError(
            f"F: a tuple means (offsets, corners), but this has {len(F)} parts; for rows of corners use a list"
        )
    offsets, corners = (integers(part, name) for part, name in zip(F, ("F[0]", "F[1]")))
    for part, name in ((offsets, "F[0]"), (corners, "F[1]")):
        if part.ndim != 1:
            raise ValueError(f"{name}: expected one dimension, not shape {part.shape}")
    return corners, offsets


def _edges(graph, vertex_count):
    """Each stored entry of a sparse matrix as a polygon of two corners. Read from its arrays: the conversions of SciPy
    trust them, and may read beyond their ends."""
    if graph.shape != (vertex_count, vertex_count):
        raise ValueError(f"F: a graph of shape {graph.shape}, expected {(vertex_count, vertex_count)}")
    if hasattr(graph, "indptr"):
        rows, columns = _compressed_entries(graph, vertex_count)
    elif getattr(graph, "format", None) == "lil":
        rows, columns = _list_entries(graph, vertex_count)
    elif getattr(graph, "format", None) == "dia":
        rows, columns = _diagonal_entries(graph, vertex_count)
    else:
        rows, columns = _coordinate_entries(graph)
    corners = np.column_stack([rows, columns]).ravel()
    return integers(corners, "F"), np.arange(len(rows) + 1, dtype=np.int64) * 2


def _compressed_entries(graph, vertex_count):
    """The entries of a CSR, CSC or BSR matrix."""
    block_rows, block_columns = getattr(graph, "blocksize", (1, 1))
    indptr, indices = integers(graph.indptr, "F.indptr"), integers(graph.indices, "F.indices")
    major = "column" if graph.format == "csc" else "row"
    _check_indptr(indptr, indices, vertex_count // max(block_rows, 1), major)
    blocks = np.repeat(np.arange(len(indptr) - 1), np.diff(indptr))
    rows, columns = np.broadcast_arrays(
        blocks[:, None, None] * block_rows + np.arange(block_rows)[:, None],
        indices[: len(blocks), None, None].astype(np.int64) * block_columns + np.arange(block_columns),
    )
    rows, columns = rows.ravel(), columns.ravel()
    wrong = np.flatnonzero((columns < 0) | (columns >= vertex_count))
    if wrong.size:
        at = wrong[0]
        raise ValueError(f"F: {major} {rows[at]}: an edge to {columns[at]}, but the mesh has {vertex_count} vertices")
    return rows, columns


def _check_indptr(indptr, indices, count, major):
    if indptr.shape != (count + 1,) or indices.ndim != 1:
        raise ValueError(
            f"F: indptr of shape {indptr.shape} and indices of shape {indices.shape}, "
            f"expected ({count + 1},) and one dimension"
        )
    if indptr[0] != 0:
        raise ValueError(f"F: {major} 0: indptr begins with {indptr[0]}, expected 0")
    wrong = np.flatnonzero((indptr[1:] < indptr[:-1]) | (indptr[1:] > len(indices)))
    if wrong.size:
        at = wrong[0]
        raise ValueError(
            f"F: {major} {at}: indptr goes from {indptr[at]} to {indptr[at + 1]}, "
            f"expected ascending values up to the {len(indices)} entries"
        )


def _list_entries(graph, vertex_count):
    """The entries of a LIL matrix."""
    if graph.rows.shape != (vertex_count,):
        raise ValueError(f"F: rows of shape {graph.rows.shape}, expected ({vertex_count},)")
    lists = [list(row) for row in graph.rows]
    columns = integers(list(itertools.chain.from_iterable(lists)), "F")
    return np.repeat(np.arange(vertex_count), [len(row) for row in lists]), columns


def _diagonal_entries(graph, vertex_count):
    """The nonzero entries of a DIA matrix, which stores whole diagonals."""
    offsets, data = np.array(graph.offsets), np.array(graph.data)
    if offsets.ndim != 1 or data.ndim != 2 or len(data) != len(offsets):
        raise ValueError(f"F: offsets of shape {offsets.shape} and data of shape {data.shape}, expected a row for each")
    diagonals, columns = np.nonzero(data)
    rows = columns - offsets[diagonals]
    inside = (rows >= 0) & (rows < vertex_count) & (columns < vertex_count)
    return rows[inside], columns[inside]


def _coordinate_entries(graph):
    try:
        entries = graph.tocoo()
        rows, columns = np.array(entries.row), np.array(entries.col)
    except (ValueError, IndexError) as error:
        raise ValueError(f"F: {error}") from None
    if rows.ndim != 1 or rows.shape != columns.shape:
        raise ValueError(f"F: {rows.shape} rows and {columns.shape} columns, expected one of each for every entry")
    return rows, columns


def _is_mesh(V):
    names = ("points", "vertices", "vertex", "dataset", "GetPolys", "agg_data", "coordinates", "parts", "mesh")
    return any(hasattr(V, name) for name in names)


def points_of(P):
    """The positions of an array, or of points or a mesh of another library or of this package."""
    if not any(hasattr(P, name) for name in ("__array__", "__array_interface__", "__dlpack__")):
        P = _unwrapped(P, "P")
        if hasattr(P, "agg_data"):
            P = _gifti_data(P, "pointset", "P")
        elif hasattr(P, "GetPoints") and not hasattr(P, "n_points"):  # not PyVista's own class
            P = _vtk_points(P, "P")
        elif hasattr(P, "vertex"):  # Open3D's tensors
            P = P.vertex.positions.cpu().numpy()
        else:  # of some, such as a Submesh or a hull of SciPy, `vertices` are ids
            P = next((getattr(P, name) for name in ("V", "coordinates", "points", "vertices") if hasattr(P, name)), P)
    return positions_of(P, "P")


def _unwrapped(mesh, name):
    """What nilearn and vedo have a mesh in."""
    _refuse_path(mesh, name)
    if hasattr(mesh, "mesh") and hasattr(mesh, "data"):  # nilearn's SurfaceImage
        mesh = mesh.mesh
    if hasattr(mesh, "parts"):
        mesh = only_part(mesh.parts, name)
    return getattr(mesh, "dataset", mesh)  # vedo's


def _parts(mesh):
    """Positions and faces of a mesh of another library or of this package."""
    mesh = _unwrapped(mesh, "V")
    if hasattr(mesh, "coordinates") and hasattr(mesh, "faces"):  # nilearn's InMemoryMesh and FileMesh
        return mesh.coordinates, mesh.faces
    if hasattr(mesh, "agg_data"):
        return _gifti_data(mesh, "pointset", "V"), _gifti_data(mesh, "triangle", "V")
    if hasattr(mesh, "GetPolys") and not hasattr(mesh, "n_points"):  # not PyVista's own class
        return _vtk_parts(mesh)
    if hasattr(mesh, "triangle") and hasattr(mesh, "vertex"):  # Open3D's tensors
        return mesh.vertex.positions.cpu().numpy(), mesh.triangle.indices.cpu().numpy()
    if hasattr(mesh, "points") and isinstance(getattr(mesh, "cells", None), list):
        return mesh.points, _meshio_polygons(mesh)
    if hasattr(mesh, "points") and (hasattr(mesh, "GetPolys") or hasattr(mesh, "faces")):
        for kind in ("strips", "lines"):
            _refuse_cells(getattr(mesh, f"n_{kind}", 0), kind, "mesh.triangulate()")
        return mesh.points, _pyvista_faces(mesh)
    if all(hasattr(mesh, name) for name in ("V", "F", "vertices", "faces")):  # Submesh, whose `faces` are rows
        return mesh.V, mesh.F
    if hasattr(mesh, "vertices") and hasattr(mesh, "faces"):
        return mesh.vertices, mesh.faces
    if hasattr(mesh, "vertices") and hasattr(mesh, "triangles"):  # Open3D
        return mesh.vertices, np.asarray(mesh.triangles)
    for attribute, call in _SURFACES.items():
        if hasattr(mesh, attribute):
            raise TypeError(f"V: {type(mesh).__name__}, expected one surface: {call}")
    if isinstance(mesh, (np.ndarray, list, tuple)):
        raise TypeError(
            "F: missing, expected the faces after V; for points without faces, use MeshIndex.from_points(V, link=...)"
        )
    raise TypeError(
        "V: expected a mesh of trimesh, PyVista, VTK, vedo, meshio, Open3D, nilearn or nibabel if F is omitted, "
        f"not {type(mesh).__name__}; for points without faces, use MeshIndex.from_points(V, link=...)"
    )


# What makes a surface of other classes of PyVista, VTK and trimesh, by an attribute that these have.
_SURFACES = {
    "extract_surface": "mesh.extract_surface()",
    "GetCellTypes": "vtkGeometryFilter makes it",
    "geometry": "scene.to_mesh(), or of an older trimesh scene.dump(concatenate=True)",
}


def _refuse_cells(count, kind, call):
    if count:
        raise ValueError(f"V: has {count} {kind}, expected only polygons: {call} makes triangles of strips, and drops lines")


def only_part(parts, name):
    """The one part of a mesh or of data of nilearn, which may have one for each hemisphere."""
    if len(parts) != 1:
        first = next(iter(parts), "left")
        raise ValueError(f"{name}: has the parts {', '.join(map(repr, parts))}, expected one: .parts[{first!r}]")
    return next(iter(parts.values()))


def _gifti_data(image, intent, name):
    """The one array of this intent in an image of nibabel. Coordinates are not transformed."""
    found = [array.data for array in image.darrays if array.intent == _GIFTI_INTENTS[intent]]
    if len(found) != 1:
        raise ValueError(f"{name}: has {len(found)} arrays of intent {intent!r}, expected one")
    return found[0]


_GIFTI_INTENTS = {"pointset": 1008, "triangle": 1009}  # NIFTI_INTENT_POINTSET, NIFTI_INTENT_TRIANGLE


def _vtk_parts(mesh):
    """Of vtkPolyData."""
    for kind in ("Strips", "Lines"):
        _refuse_cells(getattr(mesh, f"GetNumberOf{kind}")(), kind.lower(), "vtkTriangleFilter with PassLinesOff()")
    points = _vtk_points(mesh, "V")
    from vtkmodules.util.numpy_support import vtk_to_numpy

    polygons = mesh.GetPolys()
    faces = vtk_to_numpy(polygons.GetOffsetsArray()), vtk_to_numpy(polygons.GetConnectivityArray())
    return points, faces


def _vtk_points(mesh, name):
    if mesh.GetPoints() is None:
        raise ValueError(f"{name}: has no points")
    from vtkmodules.util.numpy_support import vtk_to_numpy

    return vtk_to_numpy(mesh.GetPoints().GetData())


def _pyvista_faces(mesh):
    """The offsets and corners that VTK stores. To make the padded array `faces` of them, PyVista trusts the offsets and
    may read beyond the corners."""
    if hasattr(mesh, "GetPolys"):
        polygons = mesh.GetPolys()
        return np.asarray(polygons.GetOffsetsArray()), np.asarray(polygons.GetConnectivityArray())
    return mesh.faces


_MESHIO_CORNERS = {"vertex": 1, "line": 2, "triangle": 3, "quad": 4, "polygon": None}


def _meshio_polygons(mesh):
    offsets, corners = [np.zeros(1, np.int64)], []
    end = 0
    for block in mesh.cells:
        data = _meshio_block(block)
        count, sides = data.shape
        offsets.append(end + sides * np.arange(1, count + 1, dtype=np.int64))
        corners.append(data.ravel().astype(np.int64, copy=False))
        end += count * sides
    return np.concatenate(offsets), np.concatenate([np.zeros(0, np.int64), *corners])


def _meshio_block(block):
    """(#cells, #corners)"""
    if block.type not in _MESHIO_CORNERS:
        raise ValueError(f"V: has cells of type {block.type!r}, expected a surface: triangle, quad or polygon")
    data = integers(block.data, "V")
    sides = _MESHIO_CORNERS[block.type]
    if data.ndim != 2 or sides not in (None, data.shape[1]):
        raise ValueError(f"V: has cells of type {block.type!r} in an array of shape {data.shape}")
    return data


def poly_data(pyvista, positions, corners, offsets):
    """A pyvista.PolyData of what `mesh_arrays` returns. The module is an argument, because it may not be
    installed."""
    if offsets is None:
        offsets = np.arange(0, len(corners) + 1, 3)
    mesh = pyvista.PolyData()
    mesh.points = positions
    mesh.SetPolys(pyvista.CellArray.from_arrays(np.asarray(offsets, np.int64), np.asarray(corners, np.int64)))
    return mesh


def placed(mesh, stacklevel):
    """The mesh with the positions of vertices without one (NaN), in no face, at another vertex; and the mask of these, or
    None. Warns about them."""
    found = _core.place(mesh)
    if found is None:
        return mesh, None
    positions, walls = found
    warnings.warn(f"V: {text_of_walls(walls)}", stacklevel=stacklevel)
    return (positions, *mesh[1:]), walls


def text_of_walls(walls):
    return f"{text_of_unplaced(walls)}, are walls"


def text_of_unplaced(walls):
    count, first = np.count_nonzero(walls), walls.argmax()
    return f"{count} vertices without a position (NaN), the first of which is {first}"


def without_them(index):
    """What an error for vertices without a position says to do."""
    return (
        f"expected the mesh without them: `part = {index}.submesh(np.isfinite(V).all(axis=1))` has part.V, part.F, and "
        "part.vertices, the row of V of each of its vertices"
    )


def warn_if_no_faces(mesh, stacklevel):
    """Warns if there is nothing that connects the vertices."""
    positions, corners, _ = mesh
    if len(positions) > 1 and len(corners) == 0:
        warnings.warn(
            f"F: no faces, so each of the {len(positions)} vertices is a neighborhood of its own; for points without "
            "faces, meshhood.MeshIndex.from_points(V, link=...) joins those at most `link` apart",
            stacklevel=stacklevel,
        )


def warn_if_coarse(mesh, stacklevel):
    """Warns if the positions are float32 and their edges are only a few times as long as its resolution."""
    why = _core.why_coarse(mesh) if mesh[0].dtype == np.float32 else None
    if why is not None:
        warnings.warn(f"V: {why}; {_KEEP_DIGITS}", stacklevel=stacklevel)


def warn_if_link_is_coarse(points, link, stacklevel):
    """The same of points, none of whose edges is longer than `link`."""
    if points.dtype != np.float32 or len(points) == 0:
        return
    largest = np.abs(points).max()
    if largest > 0 and link < 64 * np.spacing(largest):
        step = f"floats are {np.spacing(largest):.3g} apart at {largest:.3g}"
        warnings.warn(f"P: the link is {link:.3g}, but {step}; {_KEEP_DIGITS}", stacklevel=stacklevel)


_KEEP_DIGITS = (
    "pass positions that have been float64 from the beginning, or subtract an offset before they become float32"
)


def warn_if_unwelded(mesh, stacklevel):
    """Warns if the faces are separate although their corners coincide or differ by rounding, as in an STL file that was
    read without welding."""
    positions, corners, offsets = mesh
    faces = len(corners) // 3 if offsets is None else len(offsets) - 1
    triangles = len(corners) - 2 * faces
    # A connected surface of n vertices has at least n - 2 triangles; separate polygons have a third of n to nearly n.
    if faces < 2 or not 0.3 * len(positions) <= triangles < 0.9 * len(positions):
        return
    axes = positions.T.astype(np.float64, copy=False)
    distinct = count_distinct(axes)
    eps = 0.0
    if 2 * distinct > len(positions):
        starts = offsets[:-1] if offsets is not None else np.arange(0, len(corners), 3)
        starts = starts[starts + 1 < len(corners)]
        first, second = positions[corners[starts]].astype(np.float64), positions[corners[starts + 1]]
        side = np.linalg.norm(first - second, axis=1).mean()
        tolerances = [float(f"{side * share:.0e}") for share in 10.0 ** np.arange(-7, -2)]

        def kept(eps):
            return len(_core.weld(mesh, eps=eps)[0])

        # Tolerances grow by 10, so that a weld keeps no more than by a smaller one.
        if 2 * count_apart(axes, tolerances[-1]) > len(positions) or 2 * kept(tolerances[-1]) > len(positions):
            return
        for eps in tolerances:  # the smallest that is enough: a larger one may join what is apart
            distinct = kept(eps)
            if 2 * distinct <= len(positions):
                break
    places, tolerance = ("nearly equal", f", eps={eps:g}") if eps else ("different", "")
    warnings.warn(
        f"V: {len(positions)} vertices at {distinct} {places} positions: the faces are not connected, and a "
        "neighborhood cannot cross from one to the next. Weld the mesh first: V, F, ids = "
        f"meshhood.weld(V, F{tolerance})",
        stacklevel=stacklevel,
    )


def count_distinct(axes):
    """Returns how many points differ, or a few less."""
    x, y, z = axes
    return len(np.unique(x + 0.7548776662466927 * y + 0.5698402909980532 * z))


def count_apart(axes, eps):
    """Returns how many vertices a weld by `eps` keeps at least, much faster than the weld: one in each cell of a grid
    that has a vertex farther than `eps` from all other cells."""
    with np.errstate(all="ignore"):  # an `eps` of 0, or so small that quotients overflow: no vertex is inside
        cells = axes / (32 * eps)
        corners = np.floor(cells)
        cells -= corners
        inside = (np.abs(cells - 0.5) < 0.5 - 1.01 / 32).all(axis=0)  # a hundredth for rounding
    return count_distinct(corners[:, inside])
