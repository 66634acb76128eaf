# SPDX-License-Identifier: MIT
"""Queries around one start: a vertex or any point."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, Optional, Union, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _convert
from ._held import Held
from ._methods import Method, is_exact
from ._progress import Progress, reporter
from ._repr import shown_in_a_line
from ._rows import needed_sort, result_dtype, sorted_rows
from ._types import METRICS, Counts, Floats, Ids, Mask, Metric, Number, Reals, Scales, Sort, Unit

if TYPE_CHECKING:
    from numpy.typing import DTypeLike

Face = Union[int, "np.integer[Any]", None]
Seeds = Union[int, "np.integer[Any]", Sequence[int], "NDArray[np.integer[Any]]", None]


@shown_in_a_line
class Nested(NamedTuple):
    """The neighborhoods of several radii, each vertex once: that of radii[i] is ids[:counts[i]] (see
    `MeshIndex.nested`).

    >>> counts, ids = meshhood.MeshIndex(V, F).nested(42, [0.2, 0.4])
    """

    counts: Counts
    ids: Ids


@shown_in_a_line
class Connected(NamedTuple):
    """The nearest connected vertices and their connecting radii (see `MeshIndex.nearest_connected`).

    >>> ids, radii = meshhood.MeshIndex(V, F).nearest_connected(42, 20)
    """

    ids: Ids
    radii: Reals


class Queries(Held):
    """The part of `MeshIndex` that queries around one start. `neighborhood` describes the arguments that all share."""

    @overload
    def neighborhood(
        self, start: ArrayLike, r: Number, *, seeds: Seeds = None, face: Face = None,
        return_distance: Literal[False] = False, sort: Optional[Sort] = None, metric: Metric = "straight",
        walls: Mask = None, ignored: Mask = None, unit: Unit = "mesh", method: Method = "exact",
        dtype: Optional[DTypeLike] = None,
    ) -> Ids: ...  # fmt: skip

    @overload
    def neighborhood(
        self, start: ArrayLike, r: Number, *, seeds: Seeds = None, face: Face = None,
        return_distance: Literal[True], sort: Optional[Sort] = None, metric: Metric = "straight",
        walls: Mask = None, ignored: Mask = None, unit: Unit = "mesh", method: Method = "exact",
        dtype: Optional[DTypeLike] = None,
    ) -> tuple[Ids, Floats]: ...  # fmt: skip

    def neighborhood(
        self,
        start: ArrayLike,
        r: Number,
        *,
        seeds: Seeds = None,
        face: Face = None,
        return_distance: bool = False,
        sort: Optional[Sort] = None,
        metric: Metric = "straight",
        walls: Mask = None,
        ignored: Mask = None,
        unit: Unit = "mesh",
        method: Method = "exact",
        dtype: Optional[DTypeLike] = None,
    ) -> Any:
        """The neighborhood of `start` with the radius `r`: the vertices that are connected to the start by edges between
        vertices within `r` of it. Returns `ids` (int32) or, with `return_distance`, `ids, distances`.

        start : a vertex, or a point in space (3 floats). It is the center of the ball, and a vertex is in its own
            neighborhood.
        seeds : if `start` is a point: the vertices from which the search starts, for example the corners of the face
            on which the point lies; None for the vertex nearest to the point that is no wall. A seed outside the ball
            does not count. If all are outside, the result is empty, and a warning says so: the point is too far away.
        face : if `start` is a point: the face on which it lies, as `closest_point` returns it; its corners are the
            seeds. Prefer this for picks: the nearest vertex may lie on another sheet than the nearest point.
        return_distance : also return the distance of each vertex from `start`: that of the straight line, or with
            metric="path" or "surface" the length of the path.
        sort : the order of the ids: "index", ascending places of `permutation`; "id", ascending; or "distance",
            ascending, and by id where equal. Without it they are not sorted: those of "exact" and "ball" are in index
            order, those of metric="path" and "surface" ascend by length, and those of "paper" and "bfs" have an order
            of their own, which is always the same.
        metric, walls, ignored, unit : see `MeshIndex`. By "path" and "surface", a path from a point begins with the
            straight line to a seed. "rings" need a vertex as start.
        method : "exact", the exact neighborhood, by the index;
                 "paper", the approximate neighborhood of the paper, a superset of "exact" and a subset of "ball", or
                 `Paper` with other parameters;
                 "bfs", the exact neighborhood by breadth-first search, for comparison;
                 "ball", another word for metric="space".
            "paper" builds an index of its own at the first use. Points and the other metrics need "exact", masks
            "exact" or "ball".
        dtype : of the distances, float64 unless given.

        The cost of "exact" grows with the part of the mesh at the surface of the ball rather than with the size of the
        neighborhood; around a point, with its size.

        >>> index = meshhood.MeshIndex(V, F)
        >>> near = index.neighborhood(42, 0.3)
        >>> near = index.neighborhood([0.0, 0.0, 1.1], 0.3)
        >>> near, distances = index.neighborhood(42, 0.5, walls=V[:, 2] > 0.9, return_distance=True)
        """
        if (
            None is seeds is face is sort is walls is ignored is dtype
            and type(metric) is type(unit) is type(method) is str  # an array is compared element by element
            and (return_distance, metric, unit, method) == (False, "straight", "mesh", "exact")
            and _convert.is_single(start, "start")
        ):  # a microsecond, of which the arguments below would be a half
            return self._exact.neighborhood(_convert.vertex(start, self._count, "start"), _convert.radius(r))
        numbers = result_dtype(dtype)
        center, seeds, radius, searcher = self._read(start, r, seeds, face, metric, walls, ignored, unit, method)
        sort = needed_sort(sort, method, metric)
        distances: Any = None
        if center is not None:
            indices, distances = _around_point(searcher, center, seeds, radius)
        elif return_distance or sort == "distance":
            indices, distances = searcher.neighborhood_and_distances(int(seeds[0]), radius)
        else:
            indices = searcher.neighborhood(int(seeds[0]), radius)
        if sort is not None:
            indices, distances = sorted_rows(self, sort, np.array([0, len(indices)]), indices, distances)
        return (indices, distances.astype(numbers, copy=False)) if return_distance else indices

    def count(
        self,
        start: ArrayLike,
        r: Number,
        *,
        seeds: Seeds = None,
        face: Face = None,
        metric: Metric = "straight",
        walls: Mask = None,
        ignored: Mask = None,
        unit: Unit = "mesh",
        method: Method = "exact",
    ) -> int:
        """The number of vertices of the neighborhood. The arguments are those of `neighborhood`.

        >>> index = meshhood.MeshIndex(V, F)
        >>> index.count(42, 0.3) == len(index.neighborhood(42, 0.3))
        True
        """
        center, seeds, radius, searcher = self._read(start, r, seeds, face, metric, walls, ignored, unit, method)
        if center is None:
            return int(searcher.count(int(seeds[0]), radius))
        return len(_around_point(searcher, center, seeds, radius)[0])

    def stroke(
        self,
        points: ArrayLike,
        r: Any,
        *,
        seeds: Any = None,
        face: Any = None,
        metric: Metric = "straight",
        walls: Mask = None,
        ignored: Mask = None,
        sort: Literal["index", "id"] = "index",
        unit: Unit = "mesh",
    ) -> Ids:
        """The union of the neighborhoods of many points, such as those of a brush stroke; each vertex once, in index
        order, or ascending with sort="id".

        points : (n, 3), or (n,) vertices.
        r : one radius, or one for each point.
        seeds : (n,) or (n, k), those of each point; None for the vertex nearest to each that is no wall. A warning says
            that all seeds of a point are farther than its radius.
        face : (n,), the face on which each point lies, as `closest_point` returns them; its corners are the seeds.

        >>> index = meshhood.MeshIndex(V, F)
        >>> ids = index.stroke([[0.0, 0.0, 1.0], [0.1, 0.0, 1.0]], 0.2)
        """
        by_id = _convert.choice(sort, "sort", ("index", "id")) == "id"
        centers, given = None, _convert.as_array(points, "points")
        if given.ndim == 1 and given.dtype.kind in "iu":
            if seeds is not None or face is not None:
                raise ValueError("seeds, face: expected None, because the points are vertices")
            seeds = _convert.vertex_rows(given, self._count, "points")
            count = len(seeds)
        else:
            centers = _convert.points(given, "points")
            count = len(centers)
        index = self._with_masks(walls, ignored)
        method = index._method_for(centers, metric, wanted="points: expected vertices")
        radii = np.array(np.broadcast_to(_convert.radii(r, count, advice=""), count)) * self._scale(unit, metric)
        if face is not None:
            rows = self._corners_of(face, count, seeds)
        else:
            if seeds is None:
                seeds = index._exact.nearest(centers)[0] if count and self._count else np.empty((count, 0), np.int32)
            rows = _convert.seed_rows(seeds, count, self._count)
        indices, has_seeds = method.stroke(centers, rows, radii)
        _warn_unless(has_seeds or not rows.size, "points: a")
        if by_id:
            indices.sort()
        return indices

    def nested(
        self,
        start: ArrayLike,
        radii: Scales,
        *,
        seeds: Seeds = None,
        face: Face = None,
        metric: Metric = "straight",
        walls: Mask = None,
        ignored: Mask = None,
        unit: Unit = "mesh",
    ) -> Nested:
        """The neighborhoods of several radii, each vertex once: `Nested(counts, ids)`. That of radii[i] is
        ids[:counts[i]].

        radii : strictly ascending.
        The other arguments are those of `neighborhood`.

        So ids[counts[i - 1]:counts[i]] is ring i: the vertices of the neighborhood of radii[i] that are not in that of
        radii[i - 1]. A near vertex belongs to a late ring if only a wider ball connects it. Each ring is in index
        order. The sum over a neighborhood is the sum over its rings: `np.add.reduceat`, then `np.cumsum`.

        >>> index = meshhood.MeshIndex(V, F)
        >>> counts, ids = index.nested(42, [0.2, 0.4])
        >>> len(ids) == index.count(42, 0.4)
        True
        >>> counts, ids = index.nested(42, range(3), metric="rings")  # itself, its neighbors, and theirs
        """
        meant = "neighborhoods(scales=radii, vertices=...)"
        center, seeds, method = self._read_start(start, seeds, face, metric, walls, ignored, meant)
        values = _convert.ascending(radii, "radii") * self._scale(unit, metric)
        counts, ids, has_seed = method.nested(center, seeds, values)
        _warn_unless(has_seed or not len(seeds), "start: the")
        return Nested(counts, ids)

    def contains(
        self,
        start: ArrayLike,
        w: Any,
        r: Number,
        *,
        seeds: Seeds = None,
        face: Face = None,
        metric: Metric = "straight",
        walls: Mask = None,
        ignored: Mask = None,
        unit: Unit = "mesh",
    ) -> bool:
        """Whether the neighborhood of `start` with the radius `r` has vertex `w`. The other arguments are those of
        `neighborhood`.

        >>> meshhood.MeshIndex(V, F).contains(42, 163, 0.3)
        True
        """
        center, seeds, method = self._read_start(start, seeds, face, metric, walls, ignored, "a call for each")
        w, r = _convert.vertex(w, self._count, "w"), self._scale(unit, metric) * _convert.radius(r)
        return bool(method.contains(center, seeds, w, r))

    def connecting_radius(
        self,
        start: ArrayLike,
        w: Any,
        *,
        seeds: Seeds = None,
        face: Face = None,
        metric: Metric = "straight",
        walls: Mask = None,
        ignored: Mask = None,
    ) -> float:
        """The smallest radius whose neighborhood has vertex `w`; inf if there is none. It is the minimum, over all paths of
        edges from a seed to `w`, of the largest distance between a vertex of the path and `start`; by another metric,
        the length of the path, or the number of edges.
        The other arguments are those of `neighborhood`.

        >>> index = meshhood.MeshIndex(V, F)
        >>> index.contains(42, 77, index.connecting_radius(42, 77))
        True
        """
        center, seeds, method = self._read_start(start, seeds, face, metric, walls, ignored, "a call for each")
        return float(method.connecting_radius(center, seeds, _convert.vertex(w, self._count, "w")))

    def nearest_connected(
        self,
        start: ArrayLike,
        k: Any,
        *,
        seeds: Seeds = None,
        face: Face = None,
        metric: Metric = "straight",
        walls: Mask = None,
        ignored: Mask = None,
    ) -> Connected:
        """The `k` >= 1 nearest connected vertices and their connecting radii, `Connected(ids, radii)`: the first k,
        ordered by connecting radius, then by distance from `start`, then by id; by another metric then in index order.
        Fewer if no more are connected. The other arguments are those of `neighborhood`.

        >>> ids, radii = meshhood.MeshIndex(V, F).nearest_connected(42, 20)
        >>> int(ids[0])
        42
        """
        meant = "k_nearest(k, vertices), or seeds= around a point"
        center, seeds, method = self._read_start(start, seeds, face, metric, walls, ignored, meant)
        return Connected(*method.nearest_connected(center, seeds, _convert.integer(k, "k")))

    @overload
    def nearest(
        self, points: Sequence[float], *, workers: int = ..., progress: Progress = ...
    ) -> tuple[int, float]: ...

    @overload
    def nearest(
        self, points: Sequence[Sequence[float]], *, workers: int = ..., progress: Progress = ...
    ) -> tuple[Ids, Reals]: ...

    @overload
    def nearest(
        self, points: ArrayLike, *, workers: int = ..., progress: Progress = ...
    ) -> Union[tuple[int, float], tuple[Ids, Reals]]: ...

    def nearest(self, points: Any, *, workers: int = -1, progress: Progress = None) -> Any:
        """The vertex nearest to a point, and its distance: `vertex, distance`. For points (n, 3) or [], two arrays. Of
        several vertices at the same distance, the one with the smallest id. To leave out walls, use `masked(walls=...)`.
        `workers` and `progress`: see `MeshIndex`.

        >>> index = meshhood.MeshIndex(V, F)
        >>> vertex, distance = index.nearest([0.0, 0.0, 2.0])
        >>> vertices, distances = index.nearest(2 * V[:5])
        """
        rows = _convert.points(points, "points")
        if self._count == 0:
            raise ValueError("points: the mesh has no vertices")
        with reporter(progress, "nearest", "points", len(rows)) as report:
            vertices, distances = self._exact.nearest(rows, threads=_convert.threads(workers), progress=report)
        is_one = _convert.is_point(points, "points")
        return (int(vertices[0]), float(distances[0])) if is_one else (vertices, distances)

    def _read(
        self, start: Any, r: Any, seeds: Any, face: Any, metric: Any, walls: Any, ignored: Any, unit: Any, method: Any
    ) -> tuple[Any, Ids, float, Any]:
        """The center, the seeds, the radius, and the method."""
        meant = "neighborhoods(r, vertices)"
        center, seeds, searcher = self._read_start(start, seeds, face, metric, walls, ignored, meant, method)
        return center, seeds, self._scale(unit, metric) * _convert.radius(r), searcher

    def _read_start(
        self, start: Any, seeds: Any, face: Any, metric: Any, walls: Any, ignored: Any, meant: str,
        method: Any = "exact",
    ) -> tuple[Any, Ids, Any]:  # fmt: skip
        """The center and the seeds, as `_start` returns them, and the method."""
        index = self._with_masks(walls, ignored)
        center, seeds = index._start(start, seeds, face, meant)
        return center, seeds, index._method_for(center, metric, method)

    def _method_for(
        self, center: Any, metric: Any, method: Any = "exact", wanted: str = "start: expected a vertex"
    ) -> Any:
        """The method for a point, or for a vertex if `center` is None."""
        metric = _convert.choice(metric, "metric", METRICS)
        if center is not None and metric == "rings":
            raise ValueError(f"{wanted} with metric={metric!r}, because a point has no edges")
        if center is not None and not is_exact(method):
            raise ValueError(f"method: {method!r}, expected 'exact' around a point")
        return self._searched(metric)._method(method, metric)

    def _start(self, start: Any, seeds: Any, face: Any, meant: str) -> tuple[tuple[float, float, float] | None, Ids]:
        """The center and the seeds; for a vertex, None and the vertex. `meant`: the call for several vertices."""
        if _convert.is_single(start, "start"):
            if face is not None:
                raise ValueError("face: expected None, because the start is a vertex")
            if seeds is not None:
                raise ValueError("seeds: expected None, because the start is a vertex")
            v = _convert.vertex(start, self._count, "start")
            return None, np.array([v], np.int32)
        point = _convert.point(start, "start", meant)
        if face is not None:
            corners = self._corners_of([_convert.integer(face, "face", 0, 2**63 - 1)], 1, seeds)[0]
            seeds = corners[corners >= 0]
        elif seeds is None:
            seeds = self._exact.nearest(point)[0] if self._count else np.empty(0, np.int32)
        else:
            seeds = _convert.vertices(_convert.listed(seeds, "seeds"), self._count, "seeds", "one vertex, ")
        x, y, z = point[0]
        return (float(x), float(y), float(z)), seeds

    def _corners_of(self, face: Any, rows: int, seeds: Any) -> Ids:
        """The corners of each face, a row for each, filled up with -1."""
        if seeds is not None:
            raise ValueError("seeds: expected None, because the face is given")
        corners, offsets = self._own_faces("face: given, but")
        count = len(corners) // 3 if offsets is None else len(offsets) - 1
        faces = _convert.faces_of_points(face, rows, count)
        if offsets is None:
            return corners.reshape(-1, 3)[faces]
        begin, sizes = offsets[faces], offsets[faces + 1] - offsets[faces]
        places = np.arange(sizes.max(initial=0))
        at = np.minimum(begin[:, None] + places, max(len(corners) - 1, 0))
        return np.where(places < sizes[:, None], corners[at], np.int32(-1))


def _around_point(searcher: Any, center: Any, seeds: Ids, radius: float) -> tuple[Ids, Reals]:
    ids, distances, has_seed = searcher.region(center, seeds, radius)
    _warn_unless(has_seed or not len(seeds), "start: the", stacklevel=4)
    return ids, distances


def _warn_unless(has_seed: bool, which: str, stacklevel: int = 3) -> None:
    """The text is always the same, so that a loop over points warns once."""
    if not has_seed:
        warnings.warn(
            f"{which} point is farther than r from the vertices where its search starts, so its neighborhood is empty; "
            "MeshIndex.nearest returns the nearest vertex and its distance",
            stacklevel=stacklevel,
        )
