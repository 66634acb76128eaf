# SPDX-License-Identifier: MIT
"""Mesh files and index files."""

from __future__ import annotations

import os
import warnings
from typing import NamedTuple, Union

import numpy as np

from . import _core
from ._index import MeshIndex
from ._progress import Progress, watcher


class Mesh(NamedTuple):
    """Positions and faces, as `MeshIndex` takes them."""

    vertices: np.ndarray
    faces: Union[np.ndarray, tuple[np.ndarray, np.ndarray]]


def read_mesh(path: str | os.PathLike, *, progress: Progress = None) -> Mesh:
    """Reads a PLY, OBJ, OFF or STL file, told apart by content.

    progress : as for `MeshIndex`; parts are bytes, and their total is 0 where nobody knows it (a pipe).

    Returns `Mesh(vertices, faces)`: positions (#V, 3), float64 where the file declares them so, else float32; triangles
    (#F, 3) uint32, or polygons as a tuple (offsets, corners). Vertices and faces are those of the file, in its order;
    STL corners of equal position are one vertex. What is odd but was read gives a warning.

    Raises OSError, ValueError that names file, place and element, and KeyboardInterrupt on Ctrl-C.
    """
    os.stat(path)  # for FileNotFoundError, as everybody expects it
    with watcher(progress) as watch:
        vertices, corners, offsets, oddities = _core.read_mesh(path, progress=watch)
    for oddity in oddities:
        warnings.warn(f"{path}: {oddity}", stacklevel=2)
    return Mesh(vertices, (offsets, corners) if len(offsets) else corners.reshape(-1, 3))


def load(
    path: str | os.PathLike, *, mmap: bool = False, trusted: bool = False, progress: Progress = None
) -> MeshIndex:
    """The index in a file that `MeshIndex.save`, or the C++ library, has written: an exact one, not the paper's.

    mmap : leave it in the file, whose pages are then read as queries need them, and shared by all processes that map
        it. The file may be replaced by `save`, but whoever truncates or overwrites it in place ends those processes.
    trusted : with `mmap`, do not verify what stands in the file but its header and where its parts lie, so that no
        page is read before a query needs it. Bytes that have been changed then lead to anything: wrong answers, a
        crash, a query that does not end. Only for files that nobody but oneself can write.
    progress : as for `read_mesh`.

    Unless the file is trusted, everything is verified, so that even a forged file is refused, or answers within its
    arrays; the answers may then be wrong. The index is the one that was saved, for every method. Cost: of reading the
    file once, or nothing to speak of where it is trusted.

    Raises OSError, ValueError that names file, place and what was expected, and KeyboardInterrupt on Ctrl-C.
    """
    if trusted and not mmap:
        raise ValueError("trusted: expected with mmap=True alone, for what is copied is read anyway")
    os.stat(path)
    with watcher(progress) as watch:
        return MeshIndex._holding(_core.load(path, mmap=bool(mmap), trusted=bool(trusted), progress=watch))
