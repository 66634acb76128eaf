# SPDX-License-Identifier: MIT
"""Neighborhoods on a mesh in parts, on Dask: on the threads of this machine, or on a cluster.

    >>> parts = meshhood.partition("scan.ply", "scan.parts", parts=8, halo=6, unit="edge")
    >>> counts = parts.counts(5, unit="edge").compute()

A part is one task. Without a `dask.distributed.Client`, tasks run on the threads of this machine; with one, on its
workers, which must see the folder under the same path. Retries and the dashboard are those of Dask.
"""

from __future__ import annotations

import functools
import math
import os
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, DTypeLike

from . import _convert, _core
from ._aggregate import Kernel, Reductions, read_reductions
from ._curvature import Curvature
from ._index import MeshIndex
from ._open_part import OpenPart, PartName, PartSize
from ._part_tasks import (
    CURVATURE_COLUMNS,
    PartFunction,
    aggregate_values,
    count_vertices,
    curvature_rows,
    in_mesh_order,
    is_area,
    on_mesh,
    on_part,
    owned_ids,
    result_rows,
    run_all,
    save_neighborhoods,
    save_rows,
    shape_of,
)
from ._optional import optional
from ._progress import Progress
from ._result_files import ResultFile, result_folder
from ._types import Unit

if TYPE_CHECKING:
    import dask.array as da

__all__ = ["OpenPart", "PartSize", "Parts", "map_meshes", "open_parts"]

Folder = Union[str, "os.PathLike[str]"]


class Parts:
    """The parts of a mesh, written by `meshhood.partition` and opened by `open_parts`.

    Every method takes a radius `r` up to `halo`, in `unit`: "mesh" is the unit of the positions, "edge" is
    `mean_edge_length`. A larger radius is an error, which names the halo that it needs. Results are those of one index of the
    whole mesh; `map` says which calls in a function of your own give these.

    >>> meshhood.partition("scan.ply", "scan.parts", parts=2, halo=0.5)
    <meshhood.distributed.Parts: 642 vertices in 2 parts, halo 0.5>
    """

    folder: str
    """Where the parts are, absolute."""

    n_vertices: int
    """The number of vertices of the mesh."""

    halo: float
    """The largest radius, in the unit of the positions."""

    mean_edge_length: float
    """Of the whole mesh, in the unit of the positions; 0 if it has no edges."""

    sizes: list[PartSize]
    """The size of each part."""

    def __init__(self, folder: Folder) -> None:
        self.folder = _convert.absolute(folder, "folder")
        manifest = _core.read_manifest(self.folder)
        self.n_vertices = manifest["vertices"]
        self.halo = manifest["halo"]
        self.mean_edge_length = manifest["mean_edge_length"]
        self.sizes = [PartSize(*size) for size in manifest["parts"]]
        self._checksum = manifest["checksum"]

    def __len__(self) -> int:
        """The number of parts."""
        return len(self.sizes)

    def __repr__(self) -> str:
        return f"<meshhood.distributed.Parts: {self.n_vertices} vertices in {len(self)} parts, halo {self.halo:.6g}>"

    def open(self, number: int) -> OpenPart:
        """Part `number`, verified and mapped. Raises ValueError, naming the file, if a file has been changed or is of
        another mesh, and naming the folder if other parts have replaced these; OSError.

        >>> parts = meshhood.partition("scan.ply", "scan.parts", parts=2, halo=0.5)
        >>> parts.open(1).number
        1
        """
        return self._name(_convert.integer(number, "number", 0, len(self) - 1)).open()

    def counts(self, r: float, *, unit: Unit = "mesh", order: Literal["mesh", "parts"] = "mesh") -> da.Array:
        """The number of vertices of each neighborhood: a dask.array (#V,) int64. See `map` for `order`.

        >>> parts = meshhood.partition("scan.ply", "scan.parts", parts=2, halo=0.5)
        >>> counts = parts.counts(0.3).compute()
        """
        return self.map(functools.partial(count_vertices, self._radius(r, unit)), r, unit=unit, dtype=np.int64, order=order)

    def aggregate(
        self,
        values: Union[ArrayLike, Path],
        r: float,
        reduce: Reductions = "mean",
        *,
        weights: Union[Literal["area"], ArrayLike, Path, None] = None,
        kernel: Optional[Kernel] = None,
        nan: Literal["propagate", "omit"] = "propagate",
        ddof: int = 0,
        q: float = 0.5,
        unit: Unit = "mesh",
        order: Literal["mesh", "parts"] = "mesh",
    ) -> da.Array:
        """A sum, a mean or another aggregate of values over the neighborhood of each vertex, as `MeshIndex.aggregate`:
        a dask.array (#V, ...) float64. See `map` for `order`.

        values : (#V, ...), by vertex id; or the `pathlib.Path` of a `.npy` file, of which each task reads the rows of
            its part. An array is sent to every task, so use a path on a cluster.
        weights : None, "area", or (#V,) as `values`. Areas are those of the whole mesh.

        Minima, maxima and counts are those of one index. The last digits of sums may differ, because their order does.

        >>> parts = meshhood.partition("scan.ply", "scan.parts", parts=2, halo=0.5)
        >>> parts.aggregate(V, 0.3, "std").compute().shape
        (642, 3)
        """
        radius = self._radius(r, unit)
        values = self._per_vertex(values, "values")
        if weights is not None and not is_area(weights):
            weights = self._per_vertex(weights, "weights")
        names, axis = read_reductions(reduce)
        options = {"reduce": names if axis else names[0], "kernel": kernel, "nan": nan, "ddof": ddof, "q": q}
        function = functools.partial(aggregate_values, radius, values, weights, options)
        return self.map(function, r, unit=unit, shape=shape_of(values)[1:] + axis, order=order)

    def curvature(
        self,
        r: float,
        *,
        like: Literal[None, "libigl"] = None,
        fit: Literal["quadric", "jet"] = "quadric",
        filter: bool = True,
        unit: Unit = "mesh",
        order: Literal["mesh", "parts"] = "mesh",
    ) -> Curvature:
        """Principal curvatures at every vertex, as `MeshIndex.curvature`: a `Curvature` whose arrays are dask.arrays with
        #V rows. See `map` for `order`.

        Normals are those of the whole mesh, because each part has all faces around the vertices within its halo. The
        last digits may differ from those of one index, because the order of the sums does. A row is refused, with state
        5 and NaN for its values, if fewer than six vertices are within `r` and the fit to the nearest ones needs edges
        beyond the halo, which its part may not have. Compute all arrays together, by `dask.compute(found.k1, found.k2)`.
        Raises ValueError if the mesh has no faces.

        >>> parts = meshhood.partition("scan.ply", "scan.parts", parts=2, halo=0.5)
        >>> mean = parts.curvature(0.3).mean.compute()
        """
        if not any(size.faces for size in self.sizes):
            raise ValueError("the mesh has no faces, expected faces")
        options = {"like": like, "fit": fit, "filter": bool(filter)}
        function = functools.partial(curvature_rows, self._radius(r, unit), self.halo, options)
        rows = self.map(function, r, unit=unit, shape=(CURVATURE_COLUMNS,), order=order)
        state, count = rows[:, 8].astype(np.uint8), rows[:, 9].astype(np.uint32)
        return Curvature(rows[:, 0], rows[:, 1], rows[:, 2:5], rows[:, 5:8], state, count)

    def _per_vertex(self, values: Any, name: str) -> Any:
        """`values` as an array, or as the text of a path."""
        if isinstance(values, str):
            raise TypeError(f"{name}: {values!r}, expected an array or a pathlib.Path")
        values = os.path.abspath(values) if isinstance(values, os.PathLike) else _convert.as_array(values, name).copy()
        if shape_of(values)[:1] != (self.n_vertices,):
            raise ValueError(f"{name}: an array of shape {shape_of(values)}, expected {self.n_vertices} rows")
        return values

    def map(
        self,
        function: PartFunction,
        r: float,
        *,
        unit: Unit = "mesh",
        dtype: DTypeLike = float,
        shape: tuple[int, ...] = (),
        order: Literal["mesh", "parts"] = "mesh",
    ) -> da.Array:
        """The results of a function on every part: a dask.array (#V, *shape) of `dtype`.

        function : called as `function(part, index, owned)`, with `part` an `OpenPart`, `index` its index and `owned`
            the vertices that it owns, numbered as in the index. It returns an array with a row for each of `owned`. It
            must be picklable for a cluster of processes, and may use radii up to `r`. Tasks run side by side, so it
            should use `workers=1`.
        r : the largest radius that `function` uses.
        order : "mesh", by vertex id, one block; or "parts", one block for each part, with the vertices of `ids`. For a
            mesh whose results do not fit into the memory of one worker, use "parts" or `write`.

        Nothing is computed before `compute()`, `persist()` or `store`. Errors of `function` are passed on.

        Up to `r`, calls on neighborhoods and patches give the results of the whole mesh, and so do those with
        `F=part.mesh`: areas, volumes, gaps, normals. `corrected_curvature` does so if the halo is larger than its radius
        by the longest edge, and `curvature` where `Parts.curvature` refuses no row. `thickness`, `first_hit` and
        `closest_point` look farther than any halo; they see the faces of the part alone.

        >>> parts = meshhood.partition("scan.ply", "scan.parts", parts=2, halo=0.5)
        >>> heights = lambda part, index, owned: index.positions[owned, 2]
        >>> np.allclose(parts.map(heights, 0).compute(), V[:, 2])
        True
        """
        da = optional("dask.array", "Parts")
        self._radius(r, unit)
        _convert.choice(order, "order", ("mesh", "parts"))
        dtype = np.dtype(dtype)
        blocks = self._blocks(functools.partial(result_rows, function, dtype=dtype, shape=shape))
        if order == "mesh":
            dask = optional("dask", "Parts")
            in_order = dask.delayed(in_mesh_order)(self._blocks(owned_ids), blocks, self.n_vertices)
            return da.from_delayed(in_order, (self.n_vertices, *shape), dtype)
        return self._array(blocks, dtype, shape)

    def ids(self) -> da.Array:
        """The id in the mesh of each row of results in the order of the parts: a dask.array (#V,) int64.

        >>> parts = meshhood.partition("scan.ply", "scan.parts", parts=2, halo=0.5)
        >>> np.array_equal(np.sort(parts.ids().compute()), np.arange(642))
        True
        """
        return self._array(self._blocks(owned_ids), np.dtype(np.int64), ())

    def write(
        self, function: PartFunction, r: float, to: Folder, *, unit: Unit = "mesh", progress: Progress = None
    ) -> list[str]:
        """As `map`, but computes at once and writes the result of each part to a file of the folder `to`:
        part-00000.npy, ... Returns the paths.

        A file appears whole or not at all. Files that an earlier call with the same parts, radius and function name (and
        arguments of a `functools.partial`) has written are kept, so that a call that was stopped can be continued. A
        folder with other results, or into which another call writes, is refused. The rows are in the order of
        `part.owned`.
        progress : True shows a bar of tqdm; a function is called as progress(done, total), in parts.

        >>> parts = meshhood.partition("scan.ply", "scan.parts", parts=2, halo=0.5)
        >>> paths = parts.write(lambda part, index, owned: index.counts(0.3, owned, workers=1), 0.3, "counts")
        >>> sum(len(np.load(path)) for path in paths)
        642
        """
        radius = self._radius(r, unit)
        what = {"map": _name_of(function), "r": radius}
        return self._write(functools.partial(save_rows, function), to, ".npy", what, progress)

    def neighborhoods(
        self,
        r: float,
        to: Folder,
        *,
        format: Literal["npz", "zarr"] = "npz",
        return_distance: bool = False,
        unit: Unit = "mesh",
        progress: Progress = None,
    ) -> list[str]:
        """Computes all neighborhoods and writes them to the folder `to`, a file for each part. Returns the paths.

        format : "npz" or "zarr" (needs zarr 3, and so Python 3.11). Each has the arrays `vertices` (int64: the query
            vertex of each row), `indptr` (int64) and `indices` (int64): row i is indices[indptr[i]:indptr[i + 1]],
            ascending. All ids are those of the mesh. With `return_distance` also `distances` (float64), in the order of `indices`.

        The memory of a task is small, whatever the size of the result. `to` and `progress` as in `write`.

        >>> parts = meshhood.partition("scan.ply", "scan.parts", parts=2, halo=0.5)
        >>> with np.load(parts.neighborhoods(0.3, "near")[0]) as rows:
        ...     first = rows["indices"][: rows["indptr"][1]]
        """
        radius = self._radius(r, unit)
        _convert.choice(format, "format", ("npz", "zarr"))
        if format == "zarr":
            zarr = optional("zarr", "format: 'zarr'")  # missing here rather than on the workers
            if not hasattr(zarr.Group, "create_array"):
                raise ImportError(f"format: 'zarr' needs zarr 3, found {zarr.__version__}")
        task = functools.partial(save_neighborhoods, radius, format, bool(return_distance))
        what = {"neighborhoods": format, "distances": bool(return_distance), "r": radius}
        return self._write(task, to, f".{format}", what, progress)

    def _radius(self, r: float, unit: Unit) -> float:
        """The radius in the unit of the positions."""
        radius = _convert.radius(r)
        if _convert.choice(unit, "unit", ("mesh", "edge")) == "edge":
            radius *= self.mean_edge_length
        if radius > self.halo:
            advice = "" if math.isinf(radius) else f"; partition the mesh with halo={radius:.17g}"
            raise ValueError(
                f"r: the radius {radius:.17g} is larger than the halo {self.halo:.17g} of these parts{advice}"
            )
        return radius

    def _name(self, number: int) -> PartName:
        return PartName(self.folder, number, self._checksum)

    def _blocks(self, task: Callable[[OpenPart], Any]) -> list[Any]:
        dask = optional("dask", "Parts")
        return [dask.delayed(on_part)(task, self._name(number)) for number in range(len(self))]

    def _array(self, blocks: list[Any], dtype: np.dtype[Any], shape: tuple[int, ...]) -> da.Array:
        da = optional("dask.array", "Parts")
        rows = [size.owned for size in self.sizes]
        return da.concatenate([da.from_delayed(block, (n, *shape), dtype) for block, n in zip(blocks, rows)])

    def _write(self, task: Any, to: Folder, extension: str, what: dict[str, Any], progress: Progress) -> list[str]:
        target = _convert.absolute(to, "to")
        described = {"parts": self._checksum, **what}
        with result_folder(target, described) as call:
            paths = [os.path.join(target, f"part-{number:05}{extension}") for number in range(len(self))]
            left = [number for number, path in enumerate(paths) if not os.path.exists(path)]
            files = [ResultFile(paths[number], call) for number in left]
            tasks = [functools.partial(on_part, functools.partial(task, file)) for file in files]
            run_all(list(zip(tasks, map(self._name, left))), progress)
        return paths


def open_parts(folder: Folder) -> Parts:
    """Opens the parts that `meshhood.partition` or the command `meshhood partition` has written to a folder.

    The manifest is verified here, the files of a part when it is first used in a process. Raises ValueError, naming the
    file, if one has been changed, is truncated or is of another mesh; OSError.

    >>> np.save("V.npy", V), np.save("F.npy", F)
    (None, None)
    >>> parts = meshhood.partition(("V.npy", "F.npy"), "parts", parts=2, halo=0.3)
    >>> counts = meshhood.open_parts("parts").counts(0.3).compute()
    """
    return Parts(folder)


def map_meshes(
    paths: Sequence[Folder],
    function: Callable[[MeshIndex], Any],
    *,
    to: Optional[Folder] = None,
    progress: Progress = None,
) -> list[Any]:
    """Calls a function with the index of each of many meshes, one task for each, on the threads of this machine or on a
    cluster.

    paths : mesh files, or index files that `MeshIndex.save` or `meshhood build` has written.
    function : called as `function(index)`, picklable for a cluster of processes. Tasks run side by side, so it should
        use `workers=1`.
    to : a folder. Results, which must be arrays, are then written there, each as soon as it is computed and whole or not
        at all: 00000-NAME.npy for the first of `paths`. Those of an earlier call with the same paths and function, as in
        `Parts.write`, are kept.
    progress : as in `Parts.write`, in meshes.

    Returns the results in the order of `paths`, or the paths of the written files. An error names its mesh.

    >>> meshhood.distributed.map_meshes(["hand.ply", "scan.ply"], len)
    [642, 642]
    """
    meshes = [_convert.absolute(path, "paths") for path in paths]
    if to is None:
        return run_all([(functools.partial(on_mesh, function, None), mesh) for mesh in meshes], progress)
    target = _convert.absolute(to, "to")
    with result_folder(target, {"map_meshes": _name_of(function), "paths": meshes}) as call:
        files = [os.path.join(target, f"{i:05}-{Path(mesh).stem}.npy") for i, mesh in enumerate(meshes)]
        left = [(ResultFile(file, call), mesh) for file, mesh in zip(files, meshes) if not os.path.exists(file)]
        run_all([(functools.partial(on_mesh, function, file), mesh) for file, mesh in left], progress)
    return files


def _name_of(function: Any) -> str:
    """Of a `functools.partial` with Dask's digest of its arguments, which a set or an object of no known content may have
    anew in each process: the call is then another."""
    if isinstance(function, functools.partial):
        digest = optional("dask.base", "a functools.partial").tokenize(function.args, function.keywords)
        return f"{_name_of(function.func)} {digest}"
    return getattr(function, "__qualname__", type(function).__qualname__)
