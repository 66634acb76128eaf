# SPDX-License-Identifier: MIT
"""The index of the mesh of an object, in world space."""

from __future__ import annotations

import sys
from typing import Any

import bpy
import numpy as np

# The arrays of the last mesh and its index: a redo with another radius needs no other.
_last: tuple[Any, Any] = (None, None)


def forget_index() -> None:
    global _last
    _last = (None, None)


def index_of(obj: Any, progress: Any = None) -> Any:
    """The `meshhood.MeshIndex` of the mesh of `obj`, without modifiers, with the vertices where the world has them: in
    edit mode, after `update_from_editmode`, those of the active shape key, and otherwise those without shape keys.
    Raises ImportError that says how to install meshhood, and ValueError without faces and edges."""
    global _last
    arrays = _world_positions(obj), *_polygons(obj)
    kept, index = _last
    if kept is None or not all(map(np.array_equal, kept, arrays)):
        if len(arrays[2]) == 0:
            raise ValueError(f"{obj.name} has no edges")
        index = _package().MeshIndex(arrays[0], arrays[1:], progress=progress)
        _last = (arrays, index)
    return index


def _package() -> Any:
    try:
        import meshhood
    except ImportError as error:
        folder = bpy.utils.user_resource("SCRIPTS", path="modules")
        raise ImportError(
            f"The Python package meshhood is missing ({error}). Install it, then start Blender again: "
            f'"{sys.executable}" -m pip install --no-deps --target "{folder}" meshhood (or the folder of a checkout)'
        ) from None
    return meshhood


def _world_positions(obj: Any) -> Any:
    positions = np.empty(3 * len(obj.data.vertices), np.float32)
    edited = obj.active_shape_key if obj.mode == "EDIT" else None
    (edited.data if edited else obj.data.vertices).foreach_get("co", positions)
    matrix = np.array(obj.matrix_world)
    return positions.reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3]


def _polygons(obj: Any) -> tuple[Any, Any]:
    """Offsets and corners of the faces, and of each edge without a face as a polygon of two corners."""
    mesh = obj.data
    corners = _integers(mesh.loops, "vertex_index")
    edges = _integers(mesh.edges, "vertices", 2).reshape(-1, 2)
    loose = edges[np.bincount(_integers(mesh.loops, "edge_index"), minlength=len(edges)) == 0]
    offsets = np.append(_integers(mesh.polygons, "loop_start"), len(corners))
    if obj.matrix_world.determinant() < 0:  # a mirrored object shows its faces the other way round
        corners, offsets = corners[::-1], len(corners) - offsets[::-1]
    return (
        np.append(offsets, len(corners) + 2 * np.arange(1, len(loose) + 1)).astype(np.int64),
        np.append(corners, loose.ravel()),
    )


def _integers(rows: Any, name: str, width: int = 1) -> Any:
    values = np.empty(width * len(rows), np.int32)
    rows.foreach_get(name, values)
    return values
