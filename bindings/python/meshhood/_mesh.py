# SPDX-License-Identifier: MIT
"""What callers have as a mesh, as the arrays that the index is made from. What is not checked here is in the C++
library; each error names the argument."""

import numpy as np

from ._convert import as_array


def mesh_arrays(V, F):
    """Positions (#V by 3, float32 or float64), corners, and the offsets of the polygons or None for triangles."""
    if F is None:
        V, F = _parts(V)
    positions = _positions(V)
    if hasattr(F, "tocoo"):
        return positions, *_edges(F, len(positions))
    if isinstance(F, tuple):
        return positions, *_polygons(F)
    return positions, *_faces(F)


def _positions(V):
    array = as_array(V, "V")
    if array.dtype.kind in "iu" or array.dtype == np.float16:
        array = _as_float64(array)
    if array.dtype not in (np.float32, np.float64):
        raise TypeError(f"V: expected float32 or float64, not {array.dtype}")
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"V: expected an array of shape (#V, 3), not {array.shape}")
    return np.ascontiguousarray(array)


def _as_float64(array):
    if array.dtype.itemsize == 8 and ((array > 2**53) | (array < -(2**53))).any():
        raise TypeError("V: has integers beyond 2^53, which float64 does not hold")
    return array.astype(np.float64)


def _integers(F, name):
    array = as_array(F, name)
    if array.size == 0 and not isinstance(F, np.ndarray):
        array = array.astype(np.int32)
    if array.dtype.kind not in "iu":
        raise TypeError(f"{name}: expected integers, not {array.dtype}")
    if array.dtype.itemsize < 4:
        array = array.astype(np.int32)
    return np.asarray(array, order="C")


def _faces(F):
    """(#F, k): polygons of k corners each; one dimension: VTK's padded faces."""
    array = _integers(F, "F")
    if array.ndim == 1:
        return _padded(array)
    if array.ndim != 2 or array.shape[1] == 0:
        raise ValueError(
            f"F: expected (#F, k), a tuple (offsets, corners), or padded faces (one dimension), not shape {array.shape}"
        )
    count, corners = array.shape
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
    offsets, corners = (_integers(part, name) for part, name in zip(F, ("F[0]", "F[1]")))
    for part, name in ((offsets, "F[0]"), (corners, "F[1]")):
        if part.ndim != 1:
            raise ValueError(f"{name}: expected one dimension, not shape {part.shape}")
    return corners, offsets


def _edges(graph, vertex_count):
    """Every entry that a sparse matrix stores, as a polygon of two corners."""
    if graph.shape != (vertex_count, vertex_count):
        raise ValueError(f"F: a graph of shape {graph.shape}, expected {(vertex_count, vertex_count)}")
    entries = graph.tocoo()
    corners = np.column_stack([entries.row, entries.col]).ravel()
    return _integers(corners, "F"), np.arange(len(entries.row) + 1, dtype=np.int64) * 2


def _parts(mesh):
    """Positions and faces of an object of trimesh, PyVista, meshio or this package."""
    if hasattr(mesh, "points") and isinstance(getattr(mesh, "cells", None), list):
        return mesh.points, _meshio_polygons(mesh)
    if hasattr(mesh, "points") and hasattr(mesh, "faces"):
        for kind in ("n_strips", "n_lines"):
            if getattr(mesh, kind, 0):
                raise ValueError(f"V: has {getattr(mesh, kind)} {kind[2:]}, expected polygons alone")
        return mesh.points, _pyvista_faces(mesh)
    if hasattr(mesh, "vertices") and hasattr(mesh, "faces"):
        return mesh.vertices, mesh.faces
    raise TypeError(f"V: expected a mesh of trimesh, PyVista or meshio where F is not given, not {type(mesh).__name__}")


def _pyvista_faces(mesh):
    """VTK keeps offsets and corners; where this object shows them, no padded array is made."""
    if hasattr(mesh, "GetPolys"):
        polygons = mesh.GetPolys()
        offsets, corners = np.asarray(polygons.GetOffsetsArray()), np.asarray(polygons.GetConnectivityArray())
        return offsets, corners
    return mesh.faces


def _meshio_polygons(mesh):
    offsets, corners = [np.zeros(1, np.int64)], []
    end = 0
    for block in mesh.cells:
        if block.type not in ("vertex", "line", "triangle", "quad", "polygon"):
            raise ValueError(f"V: has cells of type {block.type!r}, expected a surface: triangle, quad or polygon")
        data = np.asarray(block.data)
        count, sides = data.shape
        offsets.append(end + sides * np.arange(1, count + 1, dtype=np.int64))
        corners.append(data.ravel().astype(np.int64, copy=False))
        end += count * sides
    return np.concatenate(offsets), np.concatenate([np.zeros(0, np.int64), *corners])
