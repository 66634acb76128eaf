# SPDX-License-Identifier: MIT
"""Mesh files."""

from __future__ import annotations

import os
import warnings
from typing import NamedTuple, Union

import numpy as np

from . import _core


class Mesh(NamedTuple):
    """Positions and faces, as `MeshIndex` takes them."""

    vertices: np.ndarray
    faces: Union[np.ndarray, tuple[np.ndarray, np.ndarray]]


def read_mesh(path: str | os.PathLike) -> Mesh:
    """Reads a PLY, OBJ, OFF or STL file, told apart by content.

    Returns `Mesh(vertices, faces)`: positions (#V, 3), float64 where the file declares them so, else float32; triangles
    (#F, 3) uint32, or polygons as a tuple (offsets, corners). Vertices and faces are those of the file, in its order;
    STL corners of equal position are one vertex. What is odd but was read gives a warning.

    Raises OSError, or ValueError that names file, place and element.
    """
    vertices, corners, offsets, oddities = _core.read_mesh(path)
    for oddity in oddities:
        warnings.warn(f"{path}: {oddity}", stacklevel=2)
    return Mesh(vertices, (offsets, corners) if len(offsets) else corners.reshape(-1, 3))
