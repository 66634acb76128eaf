# SPDX-License-Identifier: MIT
"""More kinds of queries: around any point, with masks, for several radii, along the edges."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Literal, Optional, TypedDict, Union, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _convert, _core
from ._held import Held
from ._rows import check_unit, check_words, sort_of, sorted_rows
from ._types import METRICS, Counts, Ids, Mask, Metric, Number, Reals, Sort, Unit

if TYPE_CHECKING:
    from typing_extensions import Unpack

Face = Union[int, "np.integer[Any]", None]
Seeds = Union[int, "np.integer[Any]", Sequence[int], "NDArray[np.integer[Any]]", None]


class RegionWords(TypedDict, total=False):
    """The words of `MeshIndex.query_region` besides `return_distance`, on which the type of the result depends."""

    seeds: Seeds
    face: Face
    walls: Mask
    ignored: Mask
    sort: Optional[Sort]
    metric: Metric
    unit: Unit


class Queries(Held):
    """The part of `MeshIndex` that searches regions. `query_region` describes the arguments that all calls share."""

    @overload
    def query_region(
        self, start: ArrayLike, r: Number, *, return_distance: Literal[False] = False, **words: Unpack[RegionWords]
    ) -> Ids: ...

    @overload
    def query_region(
        self, start: ArrayLike, r: Number, *, return_distance: Literal[True], **words: Unpack[RegionWords]
    ) -> tuple[Ids, Reals]: ...

    def query_region(self, start: Any, r: Any, *, return_distance: bool = False, **words: Any) -> Any:
        """The region of `start` and the radius `r`: the vertices that are connected to a seed by edges between vertices
        within `r` of `start`. For a vertex as start it is the neighborhood that `query_ball` returns.

        start : a vertex, or a point in space (3 floats). It is the center of the ball.
        seeds : if `start` is a point: the vertices from which the search starts, for example the corners of the face
            on which the point lies; None for the vertex nearest to the point. A seed outside the ball does not count.
            If all seeds are outside, the region is empty, and a warning says so: the point is too far from the mesh.
        face : if `start` is a point: the face on which it lies, as `closest_point` returns it; its corners are the
            seeds. Prefer this for picks: the nearest vertex may lie on another sheet than the nearest point.
        metric : "path" and "rings" need a vertex as start.
        walls, ignored, unit : see `MeshIndex`.
        r, return_distance, sort : as for one vertex of `query_ball`, and so is the result. Distances are float64.

        An answer depends on the index, the start, the radius and the masks alone. Without `sort`, its ids are in index
        order, or with "path" sorted by path length. The cost grows with the size of the region.

        >>> index = meshhood.MeshIndex(V, F)
        >>> ids = index.query_region([0.0, 0.0, 1.1], 0.3)
        >>> ids = index.query_region(42, 0.5, walls=V[:, 2] > 0.9)
        """
        check_words(words, RegionWords)
        sort = sort_of(words)
        center, first = self._start(start, words.get("seeds"), words.get("face"), "query_ball(vertices, r)")
        radius = self._scale(words.get("unit", "mesh")) * _convert.radius(r)
        check_unit(words)
        index = self._with_masks(words.get("walls"), words.get("ignored"))
        metric = _convert.choice(words.get("metric", "straight"), "metric", METRICS)
        if metric != "straight":
            if center is not None:
                raise ValueError(f"start: expected a vertex with metric={metric!r}, because a point has no edges")
            indices, distances = index._method(words).neighborhood_and_distances(int(first[0]), radius)
        else:
            indices, distances, has_seed = index._queries.region(_core.Metric.straight, center, first, radius)
            _warn_unless(has_seed or not len(first), "start: the")
        if sort is not None:
            indices, distances = sorted_rows(self, sort, np.array([0, len(indices)]), indices, distances)
        return (indices, distances) if return_distance else indices

    def query_stroke(
        self,
        points: ArrayLike,
        r: Any,
        *,
        seeds: Any = None,
        face: Any = None,
        walls: Mask = None,
        ignored: Mask = None,
        sort: Literal["index", "id"] = "index",
        unit: Unit = "mesh",
    ) -> Ids:
        """The union of the regions of many points, such as those of a brush stroke; each vertex once, in index order,
        or ascending with sort="id".

        points : (n, 3).
        r : one radius, or one for each point.
        seeds : (n,) or (n, k), those of each point; None for the vertex nearest to each. A warning says that all seeds
            of a point are farther than its radius.
        face : (n,), the face on which each point lies, as `closest_point` returns them; its corners are the seeds.

        >>> index = meshhood.MeshIndex(V, F)
        >>> ids = index.query_stroke([[0.0, 0.0, 1.0], [0.1, 0.0, 1.0]], 0.2)
        """
        by_id = _convert.choice(sort, "sort", ("index", "id")) == "id"
        centers = _convert.points(points, "points")
        radii = np.array(np.broadcast_to(_convert.radii(r, len(centers)), len(centers))) * self._scale(unit)
        if face is not None:
            rows = self._corners_of(face, len(centers), seeds)
        else:
            if seeds is None:
                seeds = self._queries.nearest(centers)[0] if len(centers) else np.empty(0, np.int32)
            rows = _convert.seed_rows(seeds, len(centers), self._count)
        indices, has_seeds = self._with_masks(walls, ignored)._queries.stroke(_core.Metric.straight, centers, rows, radii)
        _warn_unless(has_seeds, "points: a")
        if by_id:
            indices.sort()
        return indices

    def query_nested(
        self,
        start: ArrayLike,
        radii: Any,
        *,
        seeds: Seeds = None,
        face: Face = None,
        walls: Mask = None,
        ignored: Mask = None,
        unit: Unit = "mesh",
    ) -> tuple[Counts, Ids]:
        """The regions of several radii, each vertex once: `counts, indices`. The region of radii[i] is
        indices[:counts[i]].

        start, seeds, face, walls, ignored, unit : see `query_region`.
        radii : strictly ascending.

        So indices[counts[i - 1]:counts[i]] is ring i: the vertices of the region of radii[i] that are not in that of
        radii[i - 1]. A near vertex belongs to a late ring if only a wider ball connects it. Each ring is in index
        order. The sum over a region is the sum over its rings: `np.add.reduceat`, then `np.cumsum`.

        >>> index = meshhood.MeshIndex(V, F)
        >>> counts, ids = index.query_nested(42, [0.2, 0.4])
        >>> len(ids) == index.count(42, 0.4)
        True
        """
        center, first = self._start(start, seeds, face, "query_ball(vertices, scales=radii)")
        values = _convert.ascending(radii, "radii") * self._scale(unit)
        counts, indices, has_seed = self._with_masks(walls, ignored)._queries.nested(_core.Metric.straight, center, first, values)
        _warn_unless(has_seed or not len(first), "start: the")
        return counts, indices

    def query_rings(self, v: Any, k: Any, *, walls: Mask = None, ignored: Mask = None) -> tuple[Counts, Ids]:
        """The vertices that at most `k` edges separate from vertex `v`: `counts, indices`. The first counts[i] of the
        indices are at most i edges away; `counts` ends with the last ring that is not empty, or with ring k.
        Each ring is in index order.

        >>> index = meshhood.MeshIndex(V, F)
        >>> counts, ids = index.query_rings(42, 2)
        """
        v = _convert.vertex(v, self._count, "v")
        counts, indices = self._with_masks(walls, ignored)._queries.rings(v, _convert.integer(k, "k", 0, 2**63 - 1))
        return counts, indices

    def contains(
        self,
        start: ArrayLike,
        w: Any,
        r: Number,
        *,
        seeds: Seeds = None,
        face: Face = None,
        walls: Mask = None,
        ignored: Mask = None,
        unit: Unit = "mesh",
    ) -> bool:
        """Whether the region of `start` and the radius `r` has vertex `w`. The other words are those of `query_region`.

        >>> meshhood.MeshIndex(V, F).contains(42, 163, 0.3)
        True
        """
        center, first = self._start(start, seeds, face, "a call for each")
        w, r = _convert.vertex(w, self._count, "w"), self._scale(unit) * _convert.radius(r)
        return bool(self._with_masks(walls, ignored)._queries.contains(_core.Metric.straight, center, first, w, r))

    def connecting_radius(
        self,
        start: ArrayLike,
        w: Any,
        *,
        seeds: Seeds = None,
        face: Face = None,
        walls: Mask = None,
        ignored: Mask = None,
    ) -> float:
        """The smallest radius whose region has vertex `w`; inf if there is none. It is the minimum, over all paths of
        edges from a seed to `w`, of the largest distance between a vertex of the path and `start`.
        The other words are those of `query_region`.

        >>> index = meshhood.MeshIndex(V, F)
        >>> index.contains(42, 77, index.connecting_radius(42, 77))
        True
        """
        center, first = self._start(start, seeds, face, "a call for each")
        w = _convert.vertex(w, self._count, "w")
        return float(self._with_masks(walls, ignored)._queries.connecting_radius(_core.Metric.straight, center, first, w))

    def nearest_connected(
        self,
        start: ArrayLike,
        k: Any,
        *,
        seeds: Seeds = None,
        face: Face = None,
        walls: Mask = None,
        ignored: Mask = None,
    ) -> tuple[Ids, Reals]:
        """The `k` >= 1 nearest connected vertices and their connecting radii: the first k, ordered by connecting radius,
        then by distance from `start`, then by id. Fewer if no more are connected. The other words are those of
        `query_region`.

        >>> ids, radii = meshhood.MeshIndex(V, F).nearest_connected(42, 20)
        >>> int(ids[0])
        42
        """
        center, first = self._start(start, seeds, face, "query_knn(vertices, k), or seeds= around a point")
        k = _convert.integer(k, "k", 1, 2**63 - 1)
        indices, radii = self._with_masks(walls, ignored)._queries.nearest_connected(_core.Metric.straight, center, first, k)
        return indices, radii

    @overload
    def nearest(self, points: Sequence[float]) -> tuple[int, float]: ...

    @overload
    def nearest(self, points: Sequence[Sequence[float]]) -> tuple[Ids, Reals]: ...

    @overload
    def nearest(self, points: ArrayLike) -> Union[tuple[int, float], tuple[Ids, Reals]]: ...

    def nearest(self, points: Any) -> Any:
        """The vertex nearest to a point, and its distance: `vertex, distance`. For points (n, 3) or [], two arrays. Of
        several vertices at the same distance, the one with the smallest id.

        >>> index = meshhood.MeshIndex(V, F)
        >>> vertex, distance = index.nearest([0.0, 0.0, 2.0])
        >>> vertices, distances = index.nearest(2 * V[:5])
        """
        rows = _convert.points(points, "points")
        if self._count == 0:
            raise ValueError("points: the mesh has no vertices")
        vertices, distances = self._queries.nearest(rows)
        is_one = np.ndim(points) == 1 and len(rows) == 1
        return (int(vertices[0]), float(distances[0])) if is_one else (vertices, distances)

    def _start(self, start: Any, seeds: Any, face: Any, meant: str) -> tuple[tuple[float, float, float] | None, Ids]:
        """The center and the seeds; for a vertex, None and the vertex. `meant`: the call for several vertices."""
        if np.ndim(start) == 0:
            if face is not None:
                raise ValueError("face: expected None, because the start is a vertex")
            if seeds is not None:
                raise ValueError("seeds: expected None, because the start is a vertex")
            v = _convert.vertex(start, self._count, "start")
            return None, np.array([v], np.int32)
        point = _convert.point(start, "start", meant)
        if face is not None:
            corners = self._corners_of([_convert.integer(face, "face", 0, 2**63 - 1)], 1, seeds)[0]
            first = corners[corners >= 0]
        elif seeds is None:
            first = self._queries.nearest(point)[0] if self._count else np.empty(0, np.int32)
        else:
            first = _convert.vertices(np.atleast_1d(seeds), self._count, "seeds")
        x, y, z = point[0]
        return (float(x), float(y), float(z)), first

    def _corners_of(self, face: Any, rows: int, seeds: Any) -> Ids:
        """The corners of each face, a row for each, filled up with -1."""
        if seeds is not None:
            raise ValueError("seeds: expected None, because the face is given")
        corners, offsets = self._own_faces("face: given, but")
        count = len(corners) // 3 if offsets is None else len(offsets) - 1
        faces = _convert.faces([face] if np.ndim(face) == 0 else face, count, "face")
        if len(faces) != rows:
            raise ValueError(f"face: expected one for each of {rows} points, not {len(faces)}")
        if offsets is None:
            return corners.reshape(-1, 3)[faces]
        begin, sizes = offsets[faces], offsets[faces + 1] - offsets[faces]
        places = np.arange(sizes.max(initial=0))
        at = np.minimum(begin[:, None] + places, max(len(corners) - 1, 0))
        return np.where(places < sizes[:, None], corners[at], np.int32(-1))


def _warn_unless(has_seed: bool, which: str) -> None:
    """The text is always the same, so that a loop over points warns once."""
    if not has_seed:
        warnings.warn(
            f"{which} point is farther than r from the vertices where its search starts, so its region is empty; "
            "MeshIndex.nearest returns the nearest vertex and its distance",
            stacklevel=3,
        )
