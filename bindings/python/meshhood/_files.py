# SPDX-License-Identifier: MIT
"""Mesh files and index files."""

from __future__ import annotations

import os
import warnings
from typing import NamedTuple, Union

import numpy as np
from numpy.typing import NDArray

from . import _convert, _core
from ._index import MeshIndex
from ._mesh import kept_faces
from ._progress import Progress, reporter


class Mesh(NamedTuple):
    """Positions and faces, as `MeshIndex` takes them."""

    vertices: Union[NDArray[np.float32], NDArray[np.float64]]
    faces: Union[NDArray[np.int32], tuple[NDArray[np.int64], NDArray[np.int32]]]


def read_mesh(path: Union[str, os.PathLike[str]], *, workers: int = -1, progress: Progress = None) -> Mesh:
    """Reads a PLY, OBJ, OFF or STL file. The format is recognized by content.

    workers : as for `MeshIndex`. The result does not depend on it.
    progress : as for `MeshIndex`; the parts are bytes. Their total is 0 if the size is unknown (a pipe).

    Returns `Mesh(vertices, faces)`: positions (#V, 3), float64 if the file declares that, else float32; triangles
    (#F, 3) int32, or polygons as a tuple (offsets int64, corners int32). Vertices and faces are in the order of the
    file; STL corners with equal positions become one vertex. Irregularities that could be read cause a warning.

    Raises OSError, with errno and filename; ValueError, naming the file, place and element; KeyboardInterrupt on Ctrl-C.
    """
    path, threads = _convert.path(path), _convert.threads(workers)
    with reporter(progress, "read_mesh", "bytes") as report:
        vertices, corners, offsets, irregularities = _core.read_mesh(path, threads=threads, progress=report)
    for irregularity in irregularities:
        warnings.warn(f"{path}: {irregularity}", stacklevel=2)
    return Mesh(vertices, (offsets, corners) if len(offsets) else corners.reshape(-1, 3))


def load(
    path: Union[str, os.PathLike[str]], *, mmap: bool = False, trusted: bool = False, progress: Progress = None
) -> MeshIndex:
    """Loads an exact index that `MeshIndex.save` or the C++ library has written.

    mmap : leave the data in the file. Pages are read when queries need them, and are shared by all processes that map
        the file. The file may be replaced by `save`; truncating or overwriting it in place ends those processes.
    trusted : with `mmap`, verify only the header and the layout of the file, so that no other page is read before a
        query needs it. Altered data can then have any effect: wrong results, a crash, an endless query. Only for files
        that no other user can write.
    progress : as for `read_mesh`.

    Unless `trusted`, all data is verified: a damaged file is refused; a forged one is refused or gives wrong results
    within its arrays. The loaded index supports every method, and has the faces if they were saved (`MeshIndex.save`
    with faces=True). Cost: that of reading the file once; almost nothing if `trusted`.

    Raises OSError, with errno and filename; ValueError, naming the file, place and what was expected;
    KeyboardInterrupt on Ctrl-C.
    """
    if trusted and not mmap:
        raise ValueError("trusted: expected only with mmap=True")
    path = _convert.path(path)
    with reporter(progress, "load", "bytes") as report:
        exact = _core.load(path, mmap=bool(mmap), trusted=bool(trusted), progress=report)
    faces = exact.faces
    return MeshIndex._holding(exact, faces and kept_faces(*faces))
