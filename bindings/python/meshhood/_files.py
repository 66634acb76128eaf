# SPDX-License-Identifier: MIT
"""Mesh files and index files."""

from __future__ import annotations

import os
import warnings
from collections.abc import Mapping
from typing import Any, NamedTuple, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from . import _convert, _core
from ._index import MeshIndex
from ._mesh import face_arrays, kept_faces, mesh_arrays, text_of_unplaced, warn_if_coarse, without_them
from ._other_files import WRITERS, Writing, bytes_of, read_other
from ._progress import Progress, reporter
from ._repr import shown_in_a_line


@shown_in_a_line
class Mesh(NamedTuple):
    """Positions and faces, as `MeshIndex` takes them.

    >>> index = meshhood.MeshIndex(meshhood.read_mesh("hand.ply"))
    """

    vertices: Union[NDArray[np.float32], NDArray[np.float64]]
    faces: Union[NDArray[np.int32], tuple[NDArray[np.int64], NDArray[np.int32]]]


def read_mesh(
    path: Union[str, os.PathLike[str]], *, dtype: DTypeLike = None, workers: int = -1, progress: Progress = None
) -> Mesh:
    """Reads a PLY, OBJ, OFF or STL file, polygons of VTK's legacy format, or triangles of FreeSurfer; and with a library
    that must be installed (`pip install meshhood[files]` installs all) GIFTI surfaces and FreeSurfer's quads (nibabel),
    VTP and VTU (pyvista), MSH (meshio), GLB, glTF and 3MF (trimesh). The format is recognized by content.

    dtype : of the positions, float32 or float64. Without it, what the file declares (PLY, binary STL, VTK) or the
        library gives; of other text, float32 if that keeps what is written, else float64.
    workers : as for `MeshIndex`. The result does not depend on it.
    progress : as for `MeshIndex`; the parts are bytes. Their total is 0 if the size is unknown (a pipe).

    Returns `Mesh(vertices, faces)`: positions (#V, 3); triangles (#F, 3) int32, or polygons as a tuple (offsets int64,
    corners int32). A vertex without a position in the file is NaN, with a warning; one of a face is refused.
    Vertices and faces are in the order of the file; STL corners with equal positions become one vertex. Values and colors
    are left out; triangle strips and lines of VTK are refused.
    The meshes of a scene (GLB, glTF, 3MF) are one, transformed as the scene says. Irregularities that could be read cause
    a warning, such as more numbers in a line of a PLY file than its header declares, and so do a transform that is not
    applied (GIFTI, FreeSurfer) and float32 where the mesh is too fine for it. `workers` and `progress` are for files that
    need no library.

    Raises OSError, with errno and filename; ValueError, naming the file, place and element; KeyboardInterrupt on Ctrl-C.

    >>> V, F = meshhood.read_mesh("hand.ply")
    """
    path, threads = _convert.path(path), _convert.threads(workers)
    real = None if dtype is None else _convert.real_type(dtype)
    read = read_other(os.fsdecode(path))
    if read is not None:
        vertices, faces, notes = read
        for note in notes:
            warnings.warn(f"{os.fsdecode(path)}: {note}", stacklevel=2)
        with np.errstate(over="ignore"):
            single = np.asarray(vertices, np.float32)  # as these files have them, though a library may return float64
        if np.array_equal(single, vertices, equal_nan=True):
            warn_if_coarse((single, *face_arrays(faces)), 3)
        if real == np.float32:
            vertices = _convert.as_float32(vertices, os.fsdecode(path), "float32")
        return Mesh(vertices.astype(real or vertices.dtype, copy=False), faces)
    with reporter(progress, "read_mesh", "bytes") as report:
        vertices, corners, offsets, irregularities = _core.read_mesh(
            path, scalar_bytes=real.itemsize if real else 0, threads=threads, progress=report
        )
    for irregularity in irregularities:
        warnings.warn(f"{path}: {irregularity}", stacklevel=2)
    return Mesh(vertices, (offsets, corners) if len(offsets) else corners.reshape(-1, 3))


def write_mesh(
    path: Union[str, os.PathLike[str]],
    V: Any,
    F: Any = None,
    *,
    values: Optional[Mapping[str, ArrayLike]] = None,
    colors: Optional[ArrayLike] = None,
) -> None:
    """Writes a mesh with values of its vertices: PLY (.ply) for MeshLab, meshio and plyfile, or VTK's legacy format (.vtk)
    for ParaView and PyVista, which ignore the values of PLY. Both are binary. With a library that must be installed also
    VTP (.vtp, pyvista), GLB (.glb, trimesh), and GIFTI (nibabel): a surface (.gii, .surf.gii), or the values alone as maps
    (.shape.gii, .func.gii).

    V, F : as for `MeshIndex`, but not a graph. A vertex of no face may be NaN, but not for GLB, which has no vertices
        without faces. GIFTI and GLB have triangles and float32.
    values : by name, numbers (#V,) or vectors (#V, 3), written as float32. A name is printable ASCII without blanks.
        MeshLab shows the one named "quality" as colors.
    colors : (#V, 3) uint8, red, green and blue; not for VTK's legacy format and GIFTI.

    The file appears whole or not at all. Raises OSError, with errno and filename; ValueError or TypeError, naming the
    argument.

    >>> index = meshhood.MeshIndex(V, F)
    >>> meshhood.write_mesh("curved.ply", V, F, values={"quality": index.curvature(0.3).mean})
    >>> len(meshhood.read_mesh("curved.ply").vertices)
    642
    """
    path = _convert.path(path)
    extension = os.path.splitext(os.fsdecode(path))[1].lower()
    if extension not in (".ply", ".vtk", *WRITERS):
        raise ValueError(f"path: the extension {extension!r}, expected .ply, .vtk, {', '.join(WRITERS)}")
    if colors is not None and extension in (".vtk", ".gii"):
        raise ValueError(f"colors: expected None for {extension}")
    mesh = mesh_arrays(V, F)
    positions = mesh[0]
    if values is not None and not isinstance(values, Mapping):
        raise TypeError(f"values: {type(values).__name__}, expected a dict of arrays by name, as {{'height': array}}")
    unnamed = [name for name in values or {} if not isinstance(name, str)]
    if unnamed:
        raise TypeError(f"values: the name {unnamed[0]!r}, expected text")
    named = [(name, _scalars(numbers, f"values[{name!r}]", len(positions))) for name, numbers in (values or {}).items()]
    if colors is not None:
        colors = np.ascontiguousarray(_convert.as_array(colors, "colors"))
        if colors.dtype != np.uint8 or colors.shape != (len(positions), 3):
            raise ValueError(f"colors: {colors.dtype} of shape {colors.shape}, expected uint8 ({len(positions)}, 3)")
    placed, walls = _core.place(mesh) or (positions, None)
    whole = placed, *mesh[1:]
    _core.check_mesh(whole)  # as other libraries write anything
    if extension in WRITERS:
        if walls is not None and extension == ".glb":
            way_out = without_them("meshhood.MeshIndex(V, F)")
            raise ValueError(f"V: {text_of_unplaced(walls)}, which glTF does not know, {way_out}")
        _core.check_values(named, len(positions), ["RGB"] if extension == ".vtp" and colors is not None else [])
        if extension != ".vtp" and not os.fsdecode(path).lower().endswith((".shape.gii", ".func.gii")):
            mesh = (_convert.as_float32(positions, "V", f"a {extension} file"), *mesh[1:])
            warn_if_coarse(mesh, 3)
        content = bytes_of(extension, Writing(*mesh, named, colors), os.fsdecode(path))
        with _core.FileWriter(path) as file:
            file.write(content)
        return
    _core.write_mesh(path, whole, values=named, colors=colors, walls=walls, vtk=extension == ".vtk")


def _scalars(numbers: Any, name: str, count: int) -> NDArray[np.float32]:
    array = _convert.numbers(numbers, name, "biuf")
    if array.shape not in ((count,), (count, 3)):
        raise ValueError(f"{name}: expected an array of shape ({count},) or ({count}, 3), not {array.shape}")
    return _convert.as_float32(array, name, "a file")


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

    >>> meshhood.MeshIndex(V, F).save("hand.mhi")
    >>> index = meshhood.load("hand.mhi", mmap=True)
    """
    if trusted and not mmap:
        raise ValueError("trusted: expected only with mmap=True")
    path = _convert.path(path)
    with reporter(progress, "load", "bytes") as report:
        try:
            exact = _core.load(path, mmap=bool(mmap), trusted=bool(trusted), progress=report)
        except ValueError as error:
            if str(error).endswith("not a saved index"):
                raise ValueError(f"{error}, as MeshIndex.save writes it; a mesh file is read by read_mesh") from None
            raise
    faces = exact.faces
    return MeshIndex._holding(exact, faces and kept_faces(faces))
