# SPDX-License-Identifier: MIT
"""A part of a mesh, opened: its index and its lists of vertices."""

from __future__ import annotations

import functools
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import DTypeLike, NDArray

from . import _core
from ._files import Mesh, load
from ._index import MeshIndex

_OPEN_PARTS = 8  # mapped at once in a process


class PartSize(NamedTuple):
    """The size of a part: `vertices` includes its halo, `owned` does not."""

    vertices: int
    owned: int
    faces: int


class OpenPart:
    """A part of a mesh. Its index is mapped, its lists of vertices are read. Immutable; any number of threads may use it.

    Within a part, vertices are numbered from 0 in ascending order of their ids in the mesh.
    """

    def __init__(self, folder: Path, number: int) -> None:
        self.number = number
        """The number of the part."""
        self._folder = folder
        self.index: MeshIndex = load(folder / "index.mhi", mmap=True)
        """The index of the part, with its halo."""
        self.vertices: NDArray[np.int64] = self._array("vertices", np.int64)
        """(#vertices,) The id in the mesh of each vertex of the part. Ascending."""
        self.owned: NDArray[np.int32] = self._array("owned", np.int32)
        """(#owned,) The vertices that the part owns, numbered as in the part. Ascending."""
        self._check()

    def __repr__(self) -> str:
        return f"<meshhood.distributed.OpenPart {self.number}: {len(self.vertices)} vertices, owns {len(self.owned)}>"

    @property
    def mesh(self) -> Mesh:
        """The positions and faces of the part, as `meshhood.MeshIndex` takes them. The faces are complete around every
        vertex within the halo of an owned one."""
        corners = self._array("face_corners", np.int32)
        offsets = self._array("face_offsets", np.int64)
        return Mesh(self.index.positions, (offsets, corners) if len(offsets) else corners.reshape(-1, 3))

    def _array(self, name: str, dtype: DTypeLike) -> NDArray[Any]:
        path = self._folder / f"{name}.npy"
        array = np.load(path, allow_pickle=False)
        if array.ndim != 1 or array.dtype != dtype:
            raise ValueError(f"{path}: an array of {array.dtype}, shape {array.shape}, expected one row of {dtype}")
        array.flags.writeable = False
        return array

    def _check(self) -> None:
        vertices, owned = self.vertices, self.owned
        if len(vertices) != len(self.index) or np.any(np.diff(vertices) <= 0) or np.any(vertices[:1] < 0):
            raise ValueError(f"{self._folder}: vertices.npy does not number the {len(self.index)} vertices of the index")
        if np.any(np.diff(owned) <= 0) or np.any(owned[:1] < 0) or np.any(owned[-1:] >= len(vertices)):
            raise ValueError(f"{self._folder}: owned.npy names vertices that the part does not have")


@functools.lru_cache(maxsize=_OPEN_PARTS)
def _opened(folder: str, number: int, content_hash: str) -> OpenPart:
    """A part is verified once in each process and then shared by its threads. All processes share the pages of its
    index."""
    return OpenPart(Path(_core.verified_part(folder, number, content_hash)), number)


class PartName(NamedTuple):
    """What identifies a part; sent to the workers."""

    folder: str
    number: int
    content_hash: str

    def open(self) -> OpenPart:
        return _opened(*self)
