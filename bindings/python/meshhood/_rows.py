# SPDX-License-Identifier: MIT
"""The arguments that every call on many vertices has (see `MeshIndex`), read in one place."""

from __future__ import annotations

import math
from collections.abc import Callable
from contextlib import AbstractContextManager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Optional, Union

import numpy as np

from . import _convert, _core
from ._methods import core_metric
from ._progress import Progress, Report, reporter
from ._types import METRICS, Ids, Reals

if TYPE_CHECKING:
    from ._held import Held


@dataclass(frozen=True)
class Rows:
    """The rows of a call, as its arguments say."""

    count: int
    vertices: Optional[Ids]  # None for all
    face_points: Optional[tuple[Any, Any]]  # in place of vertices: faces, and a point of each
    radii: list[Union[float, Reals]]  # of each scale, in the unit of the positions
    has_scales: bool
    shape: tuple[int, ...]  # the leading axes of the result
    index: Any  # with the masks, along the surface by metric="surface"
    metric: str
    threads: int
    progress: Progress

    def reporter(self, title: str) -> AbstractContextManager[Report]:
        what = "points" if self.face_points else "vertices"
        return reporter(self.progress, title, what, self.count * len(self.radii))

    def call(self, report: Report, radius: Any, max_bytes: int = 2**64 - 1) -> Any:
        """As the library takes them."""
        metric = core_metric(self.metric)
        return _core.Call(self.vertices, self.face_points, radius, metric, self.threads, report, max_bytes)

    def ask(self, call: Callable[..., Any], *first: Any, max_bytes: int = 2**64 - 1, **options: Any) -> Any:
        """What a call of the library returns for these rows."""
        radius = self.radii if self.has_scales else self.radii[0]
        with self.reporter(call.__name__) as report:
            return call(*first, self.call(report, radius, max_bytes), **options)

    def limit(self, max_bytes: Any, longest: int, copies: int = 1) -> int:
        """Returns the most bytes that the lists of these rows may have, each of up to `longest` vertices with distances."""
        return _convert.max_bytes(max_bytes, 12 * longest * self.count * len(self.radii), copies)

    def shaped(self, array: Any) -> Any:
        """A result with a row for each vertex, of one scale after the other."""
        return array.reshape(self.shape + array.shape[1:])


def read_rows(
    index: Held, vertices: Any, r: Any, scales: Any, metric: Any, walls: Any, ignored: Any, unit: Any, workers: Any,
    progress: Any, *, points: Any = None, face: Any = None, F: Any = None,
) -> Rows:  # fmt: skip
    """points, face, F: of a call that takes points of faces in place of vertices."""
    is_one, ids, face_points, count = False, None, None, index._count
    if points is not None or face is not None:
        if points is None or face is None or vertices is not None:
            raise ValueError("points: expected points and the face of each, or vertices")
        array = _convert.points(points, "points")
        face_points = (_convert.faces_of_points(face, len(array), index._surface(F).face_count), array)
        is_one, count = _convert.is_single(face, "face"), len(array)
    elif vertices is not None:
        is_one, ids = _convert.one_or_many(vertices, index._count)
        count = len(ids)
    metric = _convert.choice(metric, "metric", METRICS)
    radii = _radii(r, scales, None if is_one else count, index._scale(unit, metric))
    shape = () if scales is None else (len(radii),)
    return Rows(
        count,
        ids,
        face_points,
        radii,
        scales is not None,
        shape if is_one else (*shape, count),
        index._searched(metric, walls, ignored),
        metric,
        _convert.threads(workers),
        progress,
    )


def result_dtype(dtype: Any, default: Any = np.float64) -> Any:
    """The type of the numbers of the result."""
    return _convert.real_type(default if dtype is None else dtype)


def needed_sort(sort: Any, method: Any, metric: str) -> Any:
    """`sort`, or None if the ids that the method finds have this order."""
    if sort is None or _convert.choice(sort, "sort", ("index", "id", "distance")) != "index":
        return sort
    return None if method in ("exact", "ball") and metric not in ("path", "surface") else sort


def sorted_rows(index: Held, sort: str, indptr: Any, indices: Any, distances: Any) -> tuple[Any, Any]:
    """The ids and distances, if there are any, with each row sorted: of one row, or in an order that the library itself
    does not know, for methods without the index and for paths."""
    keys = [indices]
    if sort == "index":
        keys.append(index._places()[indices])
    elif sort == "distance":
        keys.append(distances)
    if len(indptr) > 2:
        keys.append(np.repeat(np.arange(len(indptr) - 1), np.diff(indptr)))
    order = np.lexsort(keys)
    return indices[order], None if distances is None else distances[order]


def check_size(shape: tuple[int, ...], itemsize: int, max_bytes: Any) -> None:
    """Refuses a result of this shape that is too large."""
    size = itemsize * math.prod(shape)
    limit = _convert.max_bytes(max_bytes, size)
    if size > limit:
        most = "the free memory" if max_bytes is None else "max_bytes"
        raise MemoryError(
            f"the result of shape {shape}, {size} bytes, exceeds {most}, {limit}; take fewer vertices or scales"
        )


def check_one_given(r: Any, scales: Any, name: str) -> None:
    if r is None and scales is None:
        raise TypeError(f"{name}: missing, expected a number, or one for each row, or several for all rows as scales")
    if r is not None and scales is not None:
        raise TypeError(f"{name}: given, but so are scales; expected one of them")


def _radii(r: Any, scales: Any, rows: Optional[int], unit: float) -> list[Any]:
    """`rows`: None for a single vertex."""
    check_one_given(r, scales, "r")
    if scales is None:
        return [unit * (_convert.radius(r) if rows is None else _convert.radii(r, rows))]
    values = _convert.numbers(scales, "scales")
    if values.ndim != 1 or values.size == 0:
        raise ValueError(f"scales: expected a list of radii, not an array of shape {values.shape}")
    _convert.check_radii(values, "scales", "value")
    return [unit * float(value) for value in values]
