# SPDX-License-Identifier: MIT
"""The tasks of `distributed`: functions of one part, or of one mesh, which run on a worker; and what runs them, on the
threads of this machine or on the cluster of the current `dask.distributed.Client`."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any, Optional

import numpy as np
from numpy.typing import NDArray

from ._aggregate import read_weights
from ._curvature import BEYOND_HALO, FEWEST_POINTS, NO_NORMAL
from ._files import load, read_mesh
from ._index import MeshIndex
from ._open_part import OpenPart, PartName
from ._optional import optional
from ._progress import Progress, reporter
from ._result_files import SAVERS, ResultFile

_ROWS = 4096  # searched at once, so that a part of any size takes little memory

CURVATURE_COLUMNS = 10
"""k1, k2, the components of d1 and d2, the state and the count."""

PartFunction = Callable[[OpenPart, MeshIndex, "NDArray[np.int32]"], Any]


def on_part(task: Callable[[OpenPart], Any], name: PartName) -> Any:
    return task(name.open())


def on_mesh(function: Callable[[MeshIndex], Any], file: Optional[ResultFile], mesh: str) -> Any:
    try:
        with open(mesh, "rb") as opened:
            is_index = opened.read(8) == b"\x8bMHI\r\n\x1a\n"
        index = load(mesh, mmap=True) if is_index else MeshIndex(*read_mesh(mesh), workers=1)
        result = function(index)
        if file is None:
            return result
        with file.writer() as target:
            np.save(target, np.asarray(result), allow_pickle=False)
    except Exception as error:
        if hasattr(error, "add_note"):
            error.add_note(f"in {mesh}")
        elif not isinstance(error, OSError):  # Python 3.9 and 3.10; an OSError has numbers there, and names a file
            error.args = (f"{error}; in {mesh}",)
        raise


def owned_ids(part: OpenPart) -> NDArray[np.int64]:
    return part.vertices[part.owned]


def count_vertices(radius: float, part: OpenPart, index: MeshIndex, owned: NDArray[np.int32]) -> NDArray[np.int64]:
    return index.counts(radius, owned, workers=1)


def aggregate_values(
    radius: float, values: Any, weights: Any, options: dict[str, Any], part: OpenPart, index: MeshIndex, owned: Any
) -> NDArray[np.float64]:
    by_area = is_area(weights)
    return index.aggregate(
        _rows_of(values, part),
        radius,
        weights=weights if weights is None or by_area else read_weights(_rows_of(weights, part), part.vertices),
        F=part.mesh.faces if by_area else None,
        vertices=owned,
        workers=1,
        **options,
    )


def curvature_rows(
    radius: float, halo: float, options: dict[str, Any], part: OpenPart, index: MeshIndex, owned: Any
) -> NDArray[np.float64]:
    faces = part.mesh.faces
    # An index without faces has no normals to fit by, but a part without them is one of vertices that have none.
    surface = {"F": faces} if len(faces) else {"normals": np.zeros((len(index), 3))}
    found = index.curvature(radius, owned, workers=1, **surface, **options)
    rows = np.column_stack(found)
    few = np.flatnonzero((found.count < FEWEST_POINTS) & (found.state != NO_NORMAL))
    few = few[index.counts(halo, owned[few], workers=1) < FEWEST_POINTS - 1]  # else all that a fit needs is in the halo
    refused = few[[_needs_more(index, owned, int(owned[row]), radius, halo) for row in few]]
    rows[refused, :8], rows[refused, 8] = np.nan, BEYOND_HALO
    return rows


def _needs_more(index: MeshIndex, owned: Any, vertex: int, radius: float, halo: float) -> bool:
    """Whether the fit at a vertex, which is extended to six, needs edges that the part may not have. It adds the nearest
    of the vertices that an edge joins to those it has (see `curvatures` in C++), and the part has all edges of the
    vertices within the halo of one that it owns."""
    found = index.neighborhood(vertex, radius).tolist()
    while len(found) < FEWEST_POINTS:
        last = found[-1]  # those before it have been looked at, or are within the radius
        if not np.isin(index.neighborhood(last, halo, method="ball"), owned).any():
            return True
        linked = np.setdiff1d(index.neighborhoods(1, found, metric="rings")[1], found)
        if not len(linked):
            return False
        x, y, z = (index.positions[linked].astype(np.float64) - index.positions[vertex].astype(np.float64)).T
        found.append(int(linked[np.argmin(x * x + y * y + z * z)]))  # the first, of those as near as it
    return False


def is_area(weights: Any) -> bool:
    return isinstance(weights, str) and weights == "area"


def _rows_of(values: Any, part: OpenPart) -> Any:
    return _array_of(values)[part.vertices]


def _array_of(values: Any) -> Any:
    if not isinstance(values, str):
        return values
    try:
        return np.lib.format.open_memmap(values, mode="r")
    except ValueError as error:
        raise ValueError(f"{values}: {error}") from None


def shape_of(values: Any) -> tuple[int, ...]:
    return tuple(_array_of(values).shape)


def result_rows(function: PartFunction, part: OpenPart, *, dtype: np.dtype[Any], shape: tuple[int, ...]) -> NDArray[Any]:
    rows = np.asarray(function(part, part.index, part.owned), dtype)
    if rows.shape != (len(part.owned), *shape):
        expected = (len(part.owned), *shape)
        raise ValueError(f"function: an array of shape {rows.shape} for part {part.number}, expected {expected}")
    return rows


def in_mesh_order(ids: list[NDArray[np.int64]], blocks: list[NDArray[Any]], count: int) -> NDArray[Any]:
    """The permutation from the order of the parts."""
    owners = np.zeros(count, np.uint8)
    for rows in ids:
        owners[rows[rows < count]] += 1
    if sum(map(len, ids)) != count or not np.all(owners == 1):
        raise ValueError("the parts do not own each vertex of the mesh once")
    result = np.empty((count, *blocks[0].shape[1:]), blocks[0].dtype)
    for rows, block in zip(ids, blocks):
        result[rows] = block
    return result


def save_rows(function: PartFunction, file: ResultFile, part: OpenPart) -> None:
    rows = np.asarray(function(part, part.index, part.owned))
    if rows.shape[:1] != (len(part.owned),):
        raise ValueError(f"function: an array of shape {rows.shape} for part {part.number}, expected {len(part.owned)} rows")
    with file.writer() as target:
        np.save(target, rows, allow_pickle=False)


def save_neighborhoods(radius: float, format: str, distances: bool, file: ResultFile, part: OpenPart) -> None:
    owned = np.asarray(part.owned)
    sizes = part.index.counts(radius, owned, workers=1)
    indptr = np.concatenate([[0], np.cumsum(sizes)]).astype(np.int64)

    def chunks(return_distance: bool) -> Iterator[NDArray[Any]]:
        for chunk in part.index.iter_neighborhoods(radius, owned, chunk=_ROWS, return_distance=return_distance, sort="id", workers=1):
            # The numbering of a part ascends as that of the mesh does, so that the rows stay sorted.
            yield chunk.distances if return_distance else part.vertices[chunk.indices]

    arrays: list[tuple[str, Any, int, Callable[[], Iterator[NDArray[Any]]]]] = [
        ("vertices", np.int64, len(owned), lambda: iter([owned_ids(part)])),
        ("indptr", np.int64, len(indptr), lambda: iter([indptr])),
        ("indices", np.int64, int(indptr[-1]), lambda: chunks(False)),
    ]
    if distances:
        arrays.append(("distances", np.float64, int(indptr[-1]), lambda: chunks(True)))
    SAVERS[format](file, arrays)


def run_all(tasks: list[tuple[Callable[[Any], Any], Any]], progress: Progress) -> list[Any]:
    """The results of `function(argument)` for all tasks: on the cluster of the current client, else on threads."""
    client = _client()
    with reporter(progress, "parts", "tasks") as report:
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
    dask = optional("dask", "a task for each part")
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
