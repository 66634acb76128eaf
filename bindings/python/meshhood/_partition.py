# SPDX-License-Identifier: MIT
"""A mesh of any size, cut into parts with a halo."""

from __future__ import annotations

import os
import re
import warnings
from typing import Literal, Optional, Union

from . import _convert, _core
from ._other_files import as_ply
from ._progress import Progress, reporter
from .distributed import Parts

Path = Union[str, "os.PathLike[str]"]

_UNITS = {"": 1, "k": 10**3, "m": 10**6, "g": 10**9, "t": 10**12, "ki": 2**10, "mi": 2**20, "gi": 2**30, "ti": 2**40}


def partition(
    mesh: Union[Path, tuple[Path, Path]],
    folder: Path,
    *,
    parts: Optional[int] = None,
    vertices_per_part: Optional[int] = None,
    halo: float,
    unit: Literal["mesh", "edge"] = "mesh",
    memory: Union[int, str] = "1GiB",
    workers: int = -1,
    resume: bool = True,
    progress: Progress = None,
) -> Parts:
    """Cuts a mesh into parts with a halo, in bounded memory, and writes them to a folder.

    mesh : a binary PLY file, or a tuple (V, F) of `.npy` files, positions (#V, 3) and faces (#F, k); these are read in
        chunks and may be larger than the memory. A mesh file of another format is read into memory.
    folder : a new or an empty one, or that of an earlier run.
    parts, vertices_per_part : the number of parts, or the approximate number of vertices of a part without its halo.
        Give one of them.
    halo : the largest radius that the parts will answer, finite, >= 0.
    unit : of `halo`: "mesh" is that of the positions, "edge" is the mean edge length of the mesh.
    memory : the most bytes of memory, a number or a text such as "4GiB"; at least 64 MiB. A part that needs more is
        an error, which says how to avoid it.
    workers, progress : as for `MeshIndex`.
    resume : keep the parts that an earlier run on the same mesh with the same `halo` and `parts` has finished. Otherwise
        they are removed; if one has files of others, that is an error, and nothing is removed.

    Each vertex is owned by one part. A part also has every vertex and every face within the halo of one that it owns. So it
    answers queries of the vertices that it owns exactly, without the other parts.

    Returns the parts, as `open_parts`. Raises ValueError, naming the file and element; OSError, also if another run
    writes into the folder; KeyboardInterrupt on Ctrl-C. Finished parts then stay, and the next run continues.

    >>> np.save("V.npy", V), np.save("F.npy", F)
    (None, None)
    >>> meshhood.partition(("V.npy", "F.npy"), "parts", parts=2, halo=0.3)
    <meshhood.distributed.Parts: 642 vertices in 2 parts, halo 0.3>
    """
    if isinstance(mesh, tuple) and len(mesh) != 2:
        raise ValueError(f"mesh: a tuple of {len(mesh)}, expected a path, or a tuple of those of positions and faces")
    vertices, faces = mesh if isinstance(mesh, tuple) else (mesh, None)
    folder = _convert.path(folder, "folder")
    options = {
        "parts": 0 if parts is None else _convert.integer(parts, "parts"),
        "vertices_per_part": 0 if vertices_per_part is None else _convert.integer(vertices_per_part, "vertices_per_part"),
        "halo": _convert.finite(halo, "halo", or_zero=True),
        "halo_in_edges": _convert.choice(unit, "unit", ("mesh", "edge")) == "edge",
        "memory": _bytes(memory),
        "threads": _convert.threads(workers),
        "resume": bool(resume),
    }
    if (parts is None) == (vertices_per_part is None):
        raise ValueError("parts, vertices_per_part: expected one of them")
    file = _convert.path(vertices, "mesh")
    corners = None if faces is None else _convert.path(faces, "mesh")
    other = as_ply(os.fsdecode(file)) if faces is None else None
    ply, notes = other or (None, [])
    with reporter(progress, "partition") as report:
        noted = _core.partition(file, corners, folder, **options, ply=ply, progress=report)
    for note in [*(f"{os.fsdecode(file)}: {note}" for note in notes), *noted]:
        warnings.warn(note, stacklevel=2)
    return Parts(folder)


def _bytes(memory):
    if isinstance(memory, str):
        match = re.fullmatch(r"(\d+)\s*([kmgt]i?)?b?", memory.strip().lower())
        if match is None:
            raise ValueError(f"memory: {memory!r}, expected a number of bytes or a text such as '4GiB'")
        memory = int(match[1]) * _UNITS[match[2] or ""]
    return _convert.integer(memory, "memory", 0, 2**63)
