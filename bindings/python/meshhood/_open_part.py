# SPDX-License-Identifier: MIT
"""A part of a mesh, opened: its index and its lists of vertices."""

from __future__ import annotations

import functools
import io
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import DTypeLike, NDArray

from . import _core
from ._files import Mesh
from ._index import MeshIndex

_OPEN_PARTS = 8  # mapped at once in a process


class PartSize(NamedTuple):
    """The size of a part: `vertices` includes its halo, `owned` does not.

    >>> parts = meshhood.partition("scan.ply", "scan.parts", parts=2, halo=0.5)
    >>> sum(size.owned for size in parts.sizes) == parts.n_vertices
    True
    """

    vertices: int
    owned: int
    faces: int


class OpenPart:
    """A part of a mesh. Its index is mapped, its lists of vertices are read. Immutable; any number of threads may use it,
    also after another partition has replaced the files. Only `mesh` then raises ValueError or FileNotFoundError.

    Within a part, vertices are numbered from 0 in ascending order of their ids in the mesh.

    >>> part = meshhood.partition("scan.ply", "scan.parts", parts=2, halo=0.5).open(0)
    >>> near = part.vertices[part.index.neighborhood(part.owned[0], 0.5)]  # by their ids in the mesh
    """

    def __init__(self, files: Any, number: int) -> None:
        self.number = number
        """The number of the part."""
        self._files = files
        self.index: MeshIndex = MeshIndex._holding(files.index())
        """The index of the part, with its halo."""
        self.vertices: NDArray[np.int64] = self._array("vertices", np.int64)
        """(#vertices,) The id in the mesh of each vertex of the part. Ascending."""
        self.owned: NDArray[np.int32] = self._array("owned", np.int32)
        """(#owned,) The vertices that the part owns, numbered as in the part. Ascending."""
        self._check()
        self._faces()  # so that a damaged part is refused when it is opened

    def __repr__(self) -> str:
        return f"<meshhood.distributed.OpenPart {self.number}: {len(self.vertices)} vertices, owns {len(self.owned)}>"

    @property
    def mesh(self) -> Mesh:
        """The positions and faces of the part, as `meshhood.MeshIndex` takes them. They have every face within the halo of
        an owned vertex, and so all faces around each vertex there. A part of points alone has none, which calls that
        need faces refuse. See `Parts.map` for what is exact."""
        corners, offsets = self._faces()
        return Mesh(self.index.positions, (offsets, corners) if len(offsets) else corners.reshape(-1, 3))

    def _faces(self) -> tuple[NDArray[np.int32], NDArray[np.int64]]:
        return self._array("face_corners", np.int32), self._array("face_offsets", np.int64)

    def _array(self, name: str, dtype: DTypeLike) -> NDArray[Any]:
        path = Path(self._files.folder, f"{name}.npy")
        content = self._files.read(path.name)  # once: the file may be replaced between two reads
        try:
            array = np.load(io.BytesIO(content), allow_pickle=False)
        except (ValueError, EOFError) as error:
            raise ValueError(f"{path}: {error}") from None
        if array.ndim != 1 or array.dtype != dtype:
            raise ValueError(f"{path}: an array of {array.dtype}, shape {array.shape}, expected one row of {dtype}")
        array.flags.writeable = False
        return array

    def _check(self) -> None:
        vertices, owned, files = self.vertices, self.owned, self._files
        if len(vertices) != len(self.index) or np.any(np.diff(vertices) <= 0) or np.any(vertices[:1] < 0):
            raise ValueError(f"{files.folder}: vertices.npy does not number the {len(self.index)} vertices of the index")
        if np.any(np.diff(owned) <= 0) or np.any(owned[:1] < 0) or np.any(owned[-1:] >= len(vertices)):
            raise ValueError(f"{files.folder}: owned.npy names vertices that the part does not have")
        if (len(vertices), len(owned)) != (files.vertices, files.owned):
            raise ValueError(
                f"{files.folder}: owns {len(owned)} of {len(vertices)} vertices, but the manifest says {files.owned} of "
                f"{files.vertices}"
            )


@functools.lru_cache(maxsize=_OPEN_PARTS)
def _opened(folder: str, number: int, checksum: int) -> OpenPart:
    """A part is verified once in each process and then shared by its threads. All processes share the pages of its
    index."""
    return OpenPart(_core.part_files(folder, number, checksum), number)


class PartName(NamedTuple):
    """What identifies a part; sent to the workers. The checksum is that of the manifest, on which every byte of the part
    depends: the parts of another partition in the same folder have another."""

    folder: str
    number: int
    checksum: int

    def open(self) -> OpenPart:
        return _opened(*self)
