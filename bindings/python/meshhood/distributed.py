# SPDX-License-Identifier: MIT
"""Neighborhoods on a mesh in parts, on Dask: on the threads of this machine, or on a cluster.

    parts = meshhood.partition("scan.ply", "scan.parts", parts=32, halo=65, unit="edge")
    counts = parts.counts(5, unit="edge").compute()

A part is one task. Without a scheduler, tasks run on the threads of this machine; with a `dask.distributed.Client`, on
its workers, which must see the folder under the same path. Retries and the dashboard are those of Dask.
"""

from __future__ import annotations

import contextlib
import functools
import json
import os
import shutil
import tempfile
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from . import _convert, _core
from ._aggregate import Kernel, Reduce
from ._files import Mesh, load, read_mesh
from ._index import MeshIndex
from ._progress import Progress, reporter

try:
    import fcntl
except ImportError:  # Windows, where nothing keeps two calls apart
    fcntl = None  # type: ignore[assignment]

if TYPE_CHECKING:
    import dask.array as da

__all__ = ["OpenPart", "PartSize", "Parts", "map_meshes", "open_parts"]

Unit = Literal["mesh", "edge"]
Folder = Union[str, "os.PathLike[str]"]

_OPEN_PARTS = 8  # mapped at once in a process
_ROWS = 4096  # searched at once, so that a part of any size takes little memory
_RESULT = "result.json"


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
    """Verified once in each process, then shared by its threads; the pages of the index by all processes."""
    return OpenPart(Path(_core.verified_part(folder, number, content_hash)), number)


class _PartName(NamedTuple):
    """A part as it travels to a worker."""

    folder: str
    number: int
    content_hash: str

    def open(self) -> OpenPart:
        return _opened(*self)


PartFunction = Callable[[OpenPart, MeshIndex, "NDArray[np.int32]"], Any]


class Parts:
    """The parts of a mesh, which `meshhood.partition` has written. Made by `open_parts`.

    Every method takes a radius `r` up to `halo`, in `unit`: "mesh" is the unit of the positions, "edge" is
    `mean_edge_length`. A larger radius is refused, with the halo that would do. Results are those of one index of the
    whole mesh.
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
        self.folder = os.path.abspath(os.fspath(folder))
        manifest = _core.read_manifest(_convert.path(self.folder))
        self.n_vertices = manifest["vertices"]
        self.halo = manifest["halo"]
        self.mean_edge_length = manifest["mean_edge_length"]
        self.sizes = [PartSize(*size) for size in manifest["parts"]]
        self._content_hash = manifest["content_hash"]

    def __len__(self) -> int:
        """The number of parts."""
        return len(self.sizes)

    def __repr__(self) -> str:
        return f"<meshhood.distributed.Parts: {self.n_vertices} vertices in {len(self)} parts, halo {self.halo:.6g}>"

    def open(self, number: int) -> OpenPart:
        """Part `number`, verified and mapped. Raises ValueError, naming the file, if a file has been changed or is of
        another mesh; OSError."""
        return self._name(_convert.integer(number, "number", 0, len(self) - 1)).open()

    def counts(self, r: float, *, unit: Unit = "mesh", order: Literal["mesh", "parts"] = "mesh") -> da.Array:
        """The number of vertices of each neighborhood: a dask.array (#V,) int64. See `map` for `order`."""
        return self.map(functools.partial(_count, self._radius(r, unit)), r, unit=unit, dtype=np.int64, order=order)

    def aggregate(
        self,
        values: Union[ArrayLike, Path],
        r: float,
        reduce: Reduce = "mean",
        *,
        weights: Union[Literal["area"], ArrayLike, Path, None] = None,
        kernel: Optional[Kernel] = None,
        nan: Literal["propagate", "omit"] = "propagate",
        ddof: int = 0,
        unit: Unit = "mesh",
        order: Literal["mesh", "parts"] = "mesh",
    ) -> da.Array:
        """A sum, a mean or the like of values over the neighborhood of each vertex, as `MeshIndex.aggregate`: a
        dask.array (#V, ...) float64. See `map` for `order`.

        values : (#V, ...), by vertex id; or the `pathlib.Path` of a `.npy` file, of which each task reads the rows of
            its part. An array travels to every task, so a cluster should be given a path.
        weights : None, "area", or (#V,) as `values`. Areas are those of the whole mesh.

        Minima, maxima and counts are those of one index. The last digits of sums may differ, as the order does.
        """
        radius = self._radius(r, unit)
        values = self._per_vertex(values, "values")
        if weights is not None and not _is_area(weights):
            weights = self._per_vertex(weights, "weights")
        options = {"reduce": reduce, "kernel": kernel, "nan": nan, "ddof": ddof}
        function = functools.partial(_aggregate, radius, values, weights, options)
        return self.map(function, r, unit=unit, shape=_shape_of(values)[1:], order=order)

    def _per_vertex(self, values: Any, name: str) -> Any:
        """`values` as an array, or as the text of a path."""
        if isinstance(values, str):
            raise TypeError(f"{name}: {values!r}, expected an array or a pathlib.Path")
        values = os.path.abspath(values) if isinstance(values, os.PathLike) else _convert.as_array(values, name).copy()
        if _shape_of(values)[:1] != (self.n_vertices,):
            raise ValueError(f"{name}: an array of shape {_shape_of(values)}, expected {self.n_vertices} rows")
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
            must be picklable for a cluster of processes, and asks for radii up to `r`. Tasks run side by side, so it
            should use `workers=1`.
        r : the largest radius that `function` asks for.
        order : "mesh", by vertex id, one block; or "parts", one block for each part, with the vertices of `ids`. For a
            mesh whose results do not fit into the memory of one worker, use "parts" or `write`.

        Nothing is computed before `compute()`, `persist()` or `store`. Errors of `function` are passed on.
        """
        import dask.array as da

        self._radius(r, unit)
        _convert.choice(order, "order", ("mesh", "parts"))
        dtype = np.dtype(dtype)
        blocks = self._blocks(functools.partial(_rows, function, dtype=dtype, shape=shape))
        if order == "mesh":
            import dask

            in_order = dask.delayed(_in_mesh_order)(self._blocks(_owned_ids), blocks, self.n_vertices)
            return da.from_delayed(in_order, (self.n_vertices, *shape), dtype)
        return self._array(blocks, dtype, shape)

    def ids(self) -> da.Array:
        """The id in the mesh of each row of results in the order of the parts: a dask.array (#V,) int64."""
        return self._array(self._blocks(_owned_ids), np.dtype(np.int64), ())

    def write(
        self, function: PartFunction, r: float, to: Folder, *, unit: Unit = "mesh", progress: Progress = None
    ) -> list[str]:
        """As `map`, but computes at once and writes the result of each part to a file of the folder `to`:
        part-00000.npy, ... Returns the paths.

        A file appears whole or not at all. Files that an earlier call with the same parts, function name and radius has
        written are kept, so that a call that was stopped goes on; a folder with other results is refused, as is one into
        which another call writes. The rows are in the order of `part.owned`.
        progress : True shows a bar of tqdm; a function is called as progress(done, total), in parts.
        """
        radius = self._radius(r, unit)
        what = {"map": _name_of(function), "r": radius}
        return self._write(functools.partial(_save_rows, function), to, ".npy", what, progress)

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

        format : "npz" or "zarr" (needs the package zarr). Each has the arrays `vertices` (int64: the query vertex of
            each row), `indptr` (int64) and `indices` (int64): row i is indices[indptr[i]:indptr[i + 1]], ascending. All
            ids are those of the mesh. With `return_distance` also `distances` (float64), in the order of `indices`.

        The memory of a task is small, whatever the size of the result. `to` and `progress` as in `write`.
        """
        radius = self._radius(r, unit)
        _convert.choice(format, "format", ("npz", "zarr"))
        if format == "zarr":
            import zarr  # noqa: F401  # missing here rather than on the workers
        task = functools.partial(_save_neighborhoods, radius, format, bool(return_distance))
        what = {"neighborhoods": format, "distances": bool(return_distance), "r": radius}
        return self._write(task, to, f".{format}", what, progress)

    def _radius(self, r: float, unit: Unit) -> float:
        """The radius in the unit of the positions."""
        radius = _convert.radius(r)
        if _convert.choice(unit, "unit", ("mesh", "edge")) == "edge":
            radius *= self.mean_edge_length
        if radius > self.halo:
            raise ValueError(
                f"r: the radius {radius:.17g} is larger than the halo {self.halo:.17g} of these parts; partition the mesh "
                f"with halo={radius:.17g}"
            )
        return radius

    def _name(self, number: int) -> _PartName:
        return _PartName(self.folder, number, self._content_hash)

    def _blocks(self, task: Callable[[OpenPart], Any]) -> list[Any]:
        import dask

        return [dask.delayed(_on_part)(task, self._name(number)) for number in range(len(self))]

    def _array(self, blocks: list[Any], dtype: np.dtype[Any], shape: tuple[int, ...]) -> da.Array:
        import dask.array as da

        rows = [size.owned for size in self.sizes]
        return da.concatenate([da.from_delayed(block, (n, *shape), dtype) for block, n in zip(blocks, rows)])

    def _write(self, task: Any, to: Folder, extension: str, what: dict[str, Any], progress: Progress) -> list[str]:
        target = os.path.abspath(os.fspath(to))
        described = {"content_hash": self._content_hash, "halo": self.halo, "parts": len(self), **what}
        with _result_folder(target, described):
            paths = [os.path.join(target, f"part-{number:05}{extension}") for number in range(len(self))]
            left = [number for number, path in enumerate(paths) if not os.path.exists(path)]
            tasks = [(functools.partial(_on_part, functools.partial(task, paths[n])), self._name(n)) for n in left]
            _run_all(tasks, progress)
        return paths


def open_parts(folder: Folder) -> Parts:
    """Opens the parts that `meshhood.partition` or the command `meshhood partition` has written to a folder.

    The manifest is verified here, the files of a part when it is first used in a process. Raises ValueError, naming the
    file, if one has been changed, is truncated or is of another mesh; OSError.
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
        at all: 00000-NAME.npy for the first of `paths`. Those of an earlier call with the same paths and function name
        are kept.
    progress : as in `Parts.write`, in meshes.

    Returns the results in the order of `paths`, or the paths of the written files. An error names its mesh.
    """
    meshes = [os.path.abspath(os.fspath(path)) for path in paths]
    if to is None:
        return _run_all([(functools.partial(_on_mesh, function, None), mesh) for mesh in meshes], progress)
    target = os.path.abspath(os.fspath(to))
    with _result_folder(target, {"map_meshes": _name_of(function), "paths": meshes}):
        files = [os.path.join(target, f"{i:05}-{Path(mesh).stem}.npy") for i, mesh in enumerate(meshes)]
        left = [(file, mesh) for file, mesh in zip(files, meshes) if not os.path.exists(file)]
        _run_all([(functools.partial(_on_mesh, function, file), mesh) for file, mesh in left], progress)
    return files


# What runs on a worker.


def _on_part(task: Callable[[OpenPart], Any], name: _PartName) -> Any:
    return task(name.open())


def _on_mesh(function: Callable[[MeshIndex], Any], file: Optional[str], mesh: str) -> Any:
    try:
        with open(mesh, "rb") as opened:
            is_index = opened.read(8) == b"\x8bMHI\r\n\x1a\n"
        index = load(mesh, mmap=True) if is_index else MeshIndex(*read_mesh(mesh), workers=1)
        result = function(index)
    except Exception as error:
        if hasattr(error, "add_note"):
            error.add_note(f"in {mesh}")
        raise
    if file is not None:
        with _atomic_file(file) as target:
            np.save(target, np.asarray(result), allow_pickle=False)
    return result if file is None else None


def _owned_ids(part: OpenPart) -> NDArray[np.int64]:
    return part.vertices[part.owned]


def _count(radius: float, part: OpenPart, index: MeshIndex, owned: NDArray[np.int32]) -> NDArray[np.int64]:
    return index.query_ball_count(owned, radius, workers=1)


def _aggregate(
    radius: float, values: Any, weights: Any, options: dict[str, Any], part: OpenPart, index: MeshIndex, owned: Any
) -> NDArray[np.float64]:
    is_area = _is_area(weights)
    return index.aggregate(
        _rows_of(values, part),
        radius,
        weights=weights if weights is None or is_area else _rows_of(weights, part),
        F=part.mesh.faces if is_area else None,
        vertices=owned,
        workers=1,
        **options,
    )


def _is_area(weights: Any) -> bool:
    return isinstance(weights, str) and weights == "area"


def _rows_of(values: Any, part: OpenPart) -> Any:
    return _array_of(values)[part.vertices]


def _array_of(values: Any) -> Any:
    return np.load(values, mmap_mode="r", allow_pickle=False) if isinstance(values, str) else values


def _shape_of(values: Any) -> tuple[int, ...]:
    return tuple(_array_of(values).shape)


def _rows(function: PartFunction, part: OpenPart, *, dtype: np.dtype[Any], shape: tuple[int, ...]) -> NDArray[Any]:
    rows = np.asarray(function(part, part.index, part.owned), dtype)
    if rows.shape != (len(part.owned), *shape):
        expected = (len(part.owned), *shape)
        raise ValueError(f"function: an array of shape {rows.shape} for part {part.number}, expected {expected}")
    return rows


def _in_mesh_order(ids: list[NDArray[np.int64]], blocks: list[NDArray[Any]], count: int) -> NDArray[Any]:
    """The permutation from the order of the parts."""
    result = np.empty((count, *blocks[0].shape[1:]), blocks[0].dtype)
    for rows, block in zip(ids, blocks):
        result[rows] = block
    return result


def _save_rows(function: PartFunction, path: str, part: OpenPart) -> None:
    rows = np.asarray(function(part, part.index, part.owned))
    if rows.shape[:1] != (len(part.owned),):
        raise ValueError(f"function: an array of shape {rows.shape} for part {part.number}, expected {len(part.owned)} rows")
    with _atomic_file(path) as target:
        np.save(target, rows, allow_pickle=False)


def _save_neighborhoods(radius: float, format: str, distances: bool, path: str, part: OpenPart) -> None:
    owned = np.asarray(part.owned)
    sizes = part.index.query_ball_count(owned, radius, workers=1)
    indptr = np.concatenate([[0], np.cumsum(sizes)]).astype(np.int64)

    def chunks(return_distance: bool) -> Iterator[NDArray[Any]]:
        for chunk in part.index.iter_neighborhoods(
            owned, radius, chunk=_ROWS, return_distance=return_distance, sort=True, workers=1
        ):
            # The numbering of a part ascends as that of the mesh does, so that the rows stay sorted.
            yield chunk.distances if return_distance else part.vertices[chunk.indices]

    arrays: list[tuple[str, Any, int, Callable[[], Iterator[NDArray[Any]]]]] = [
        ("vertices", np.int64, len(owned), lambda: iter([_owned_ids(part)])),
        ("indptr", np.int64, len(indptr), lambda: iter([indptr])),
        ("indices", np.int64, int(indptr[-1]), lambda: chunks(False)),
    ]
    if distances:
        arrays.append(("distances", np.float64, int(indptr[-1]), lambda: chunks(True)))
    _SAVERS[format](path, arrays)


def _save_npz(path: str, arrays: Any) -> None:
    import zipfile

    with _atomic_file(path) as target, zipfile.ZipFile(target, "w", zipfile.ZIP_STORED) as archive:
        for name, dtype, count, pieces in arrays:
            header = {"descr": np.dtype(dtype).str, "fortran_order": False, "shape": (count,)}
            with archive.open(f"{name}.npy", "w", force_zip64=True) as member:
                np.lib.format.write_array_header_1_0(member, header)
                for piece in pieces():
                    member.write(np.ascontiguousarray(piece, dtype).data)


def _save_zarr(path: str, arrays: Any) -> None:
    import zarr

    folder = tempfile.mkdtemp(dir=os.path.dirname(path), prefix=".", suffix=".tmp")
    try:
        group = zarr.open_group(os.path.join(folder, "zarr"), mode="w")
        for name, dtype, count, pieces in arrays:
            array = group.create_array(name, shape=(count,), dtype=np.dtype(dtype), chunks=(max(1, min(count, 2**20)),))
            begin = 0
            for piece in pieces():
                array[begin : begin + len(piece)] = piece
                begin += len(piece)
        os.rename(os.path.join(folder, "zarr"), path)
    finally:
        shutil.rmtree(folder, ignore_errors=True)


_SAVERS = {"npz": _save_npz, "zarr": _save_zarr}


@contextlib.contextmanager
def _atomic_file(path: str) -> Iterator[Any]:
    """A file that appears under `path` whole or not at all."""
    descriptor, temporary = tempfile.mkstemp(dir=os.path.dirname(path), prefix=".", suffix=".tmp")
    try:
        with os.fdopen(descriptor, "wb") as target:
            yield target
            target.flush()
            os.fsync(target.fileno())
        os.replace(temporary, path)
    except BaseException:
        with contextlib.suppress(FileNotFoundError):
            os.unlink(temporary)
        raise


# What runs where the call was made.


@contextlib.contextmanager
def _result_folder(folder: str, described: dict[str, Any]) -> Iterator[None]:
    """Creates the folder, or finds that it holds results of the same call, and keeps others from writing into it."""
    os.makedirs(folder, exist_ok=True)
    with _lock(folder):
        path = os.path.join(folder, _RESULT)
        if os.path.exists(path):
            _check_same(path, described)
        elif os.listdir(folder):
            raise ValueError(f"{folder}: expected an empty folder, or one with results of the same call")
        else:
            with _atomic_file(path) as target:
                target.write(json.dumps(described, indent=1).encode())
        for left in Path(folder).glob(".*.tmp"):  # of a worker that was killed
            shutil.rmtree(left) if left.is_dir() else left.unlink()
        yield


@contextlib.contextmanager
def _lock(folder: str) -> Iterator[None]:
    """The right to write into the folder. The system takes it back when the process ends, however it ends."""
    if fcntl is None:
        yield
        return
    descriptor = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
    try:
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError as error:
            raise BlockingIOError(error.errno, "another call writes into this folder", folder) from None
        yield
    finally:
        os.close(descriptor)


def _name_of(function: Any) -> str:
    while isinstance(function, functools.partial):
        function = function.func
    return getattr(function, "__qualname__", type(function).__qualname__)


def _check_same(path: str, described: dict[str, Any]) -> None:
    try:
        with open(path, encoding="utf-8") as file:
            found = json.load(file)
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from None
    if found != described:
        different = [key for key in described if not isinstance(found, dict) or found.get(key) != described[key]]
        raise ValueError(f"{path}: the folder has results of another call, which differs in {', '.join(different)}")


def _run_all(tasks: list[tuple[Callable[[Any], Any], Any]], progress: Progress) -> list[Any]:
    """The results of `function(argument)` for all tasks: on the cluster of the current client, else on threads."""
    client = _client()
    with reporter(progress) as report:
        if report:
            report(0, len(tasks))
        if client is None:
            return _run_here(tasks, report)
        return _run_on(client, tasks, report)


def _client() -> Any:
    try:
        from distributed import get_client
    except ImportError:
        return None
    try:
        return get_client()
    except ValueError:
        return None


def _run_here(tasks: Any, report: Any) -> list[Any]:
    import dask
    from dask.callbacks import Callback

    class Count(Callback):
        done = 0

        def _posttask(self, *_: Any) -> None:
            Count.done += 1
            if report:
                report(min(Count.done, len(tasks)), len(tasks))

    with Count():
        return list(dask.compute(*(dask.delayed(function)(argument) for function, argument in tasks)))


def _run_on(client: Any, tasks: Any, report: Any) -> list[Any]:
    from distributed import as_completed

    futures = [client.submit(function, argument, pure=False) for function, argument in tasks]
    try:
        for done, _ in enumerate(as_completed(futures), 1):
            if report:
                report(done, len(tasks))
        return list(client.gather(futures))
    finally:
        client.cancel(futures)
