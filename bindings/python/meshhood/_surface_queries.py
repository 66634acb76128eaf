# SPDX-License-Identifier: MIT
"""Nearest vertices and points for many rows: on the surface, connected, and not connected."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _convert, _core
from ._aggregate import area_weights
from ._held import Held
from ._mesh import points_of, warn_if_coarse, warn_if_link_is_coarse, whole_mesh_arrays
from ._progress import Progress, reporter
from ._repr import shown_in_a_line
from ._rows import Rows, read_rows
from ._types import AnyVertices, Ids, Mask, Metric, Number, Offsets, Radii, Reals, Scales, Unit, Weights

if TYPE_CHECKING:
    from typing_extensions import Self

# Memory for an edge while an index is built, at most.
_BYTES_OF_EDGE = 64


@shown_in_a_line
class Unconnected(NamedTuple):
    """What is near but not connected (see `MeshIndex.nearest_unconnected`).

    >>> vertex, distance = meshhood.MeshIndex(V, F).nearest_unconnected(0.5)
    """

    vertex: Union[int, Ids]
    distance: Union[float, Reals]


@shown_in_a_line
class ClosestPoint(NamedTuple):
    """A point of the surface, or several (see `MeshIndex.closest_point`).

    >>> meshhood.MeshIndex(V, F).closest_point(2 * V[:5]).face.shape
    (5,)
    """

    face: Union[int, NDArray[np.int64]]
    barycentric: Reals
    point: Reals
    distance: Union[float, Reals]


@shown_in_a_line
class FirstHit(NamedTuple):
    """The first point of the surface on a ray, or on several (see `MeshIndex.first_hit`).

    >>> meshhood.MeshIndex(V, F).first_hit([0, 0, 0], [0, 0, 1]).point.shape
    (3,)
    """

    face: Union[int, NDArray[np.int64]]
    barycentric: Reals
    point: Reals
    distance: Union[float, Reals]


@shown_in_a_line
class Nearest(NamedTuple):
    """The nearest connected vertices of each row (see `MeshIndex.k_nearest`).

    >>> ids, distances = meshhood.MeshIndex(V, F).k_nearest(20)
    """

    ids: Ids
    distances: Reals


@shown_in_a_line
class Discs(NamedTuple):
    """Discs of fixed area: row i is ids[indptr[i]:indptr[i + 1]] (see `MeshIndex.discs`).

    >>> indptr, ids, distances = meshhood.MeshIndex(V, F).discs(0.3)
    """

    indptr: Offsets
    ids: Ids
    distances: Reals


class SurfaceQueries(Held):
    """The part of `MeshIndex` that finds what is nearest."""

    @classmethod
    def from_points(
        cls, P: Any, link: Number, *, max_edges: Optional[int] = None, workers: int = -1, progress: Progress = None
    ) -> Self:
        """The index of points without faces: any two points at most `link` apart are joined by an edge.

        P : (#V, 3) float32 or float64, the points, as V of `MeshIndex`; or a `Submesh`, a point cloud of trimesh,
            Open3D, PyVista, VTK or vedo, or another mesh that `MeshIndex` takes, whose faces do not count.
        link : a finite number >= 0, in the unit of P. Points at exactly this distance, and at the same place, are
            joined. A link less than about a millionth of the extent of all points takes long.
        max_edges : refuse a graph with more edges; by default, as many as the memory of the machine may hold.
        workers, progress : as for `MeshIndex`. The index does not depend on `workers`.

        Everything that needs no faces works as for a mesh. The normals that curvature needs can be given.

        >>> index = meshhood.MeshIndex.from_points(V, link=0.1)
        """
        points = points_of(P)
        distance = _convert.finite(link, "link", or_zero=True)
        edges = max_edges
        if edges is None:
            edges = _convert.max_bytes(None, _BYTES_OF_EDGE * len(points) ** 2) // _BYTES_OF_EDGE
        options = {
            "max_edges": _convert.integer(edges, "max_edges", 0, 2**64 - 1),
            "threads": _convert.threads(workers),
        }
        with reporter(progress, "from_points") as report:
            exact = _core.exact_of_points(points, link=distance, **options, progress=report)
        warn_if_link_is_coarse(points, distance, stacklevel=3)
        return cls._holding(exact)

    @classmethod
    def of_faces(cls, V: Any, F: Any = None, *, workers: int = -1, progress: Progress = None) -> Self:
        """The index of the faces of a mesh, for data that lies on faces: its vertices are the faces, at the mean of
        their corners, and two faces are joined if they have an edge in common. So ids are rows of F, and `positions`
        the centers (#F, 3), float64. The arguments are as for `MeshIndex`.

        >>> index = meshhood.MeshIndex.of_faces(V, F)
        >>> smooth = index.smooth(index.positions[:, 2], fwhm=0.3)
        """
        mesh = whole_mesh_arrays(V, F)
        threads = _convert.threads(workers)
        with reporter(progress, "of_faces") as report:
            exact = _core.exact_of_faces(mesh, threads=threads, progress=report)
        warn_if_coarse(mesh, stacklevel=3)
        return cls._holding(exact)

    def nearest_unconnected(
        self,
        r: Optional[Radii] = None,
        vertices: AnyVertices = None,
        *,
        scales: Optional[Scales] = None,
        metric: Metric = "straight",
        walls: Mask = None,
        ignored: Mask = None,
        unit: Unit = "mesh",
        workers: int = -1,
        progress: Progress = None,
    ) -> Unconnected:
        """The nearest vertex within `r` in space that is not in the neighborhood with radius `r`, and its distance:
        `Unconnected(vertex, distance)`, both (#rows,) or (#scales, #rows), or an int and a float for one vertex and
        one radius; -1 and inf where there is none. Of several at the same distance, the one with the smallest id.

        r : one radius, or one for each row. A vertex at exactly `r` counts.
        vertices, scales, walls, ignored, unit, workers, progress : see `MeshIndex`. Walls and ignored vertices are never
            the nearest, and for a wall there is none.
        metric : see `MeshIndex`: what is connected. With "path", the ball is that of radius `r` in space, too; with
            "rings", all of space.

        The distance is that of folds or sheets that nearly touch, between vertices. `gaps` measures to the surface, and
        `thickness` across a wall. *Not connected* is meant at the scale of `r`: a vertex to which only a way outside the
        ball leads is not connected, so a surface that bends back into the ball counts as well as another component. With
        r=inf only other components count.

        >>> index = meshhood.MeshIndex(V, F)
        >>> vertex, distance = index.nearest_unconnected(0.5)
        >>> thin = distance < 0.1
        """
        rows = read_rows(self, vertices, r, scales, metric, walls, ignored, unit, workers, progress)
        vertex, distance = map(rows.shaped, rows.ask(_core.nearest_unconnected, rows.index._exact))
        return Unconnected(vertex, distance) if vertex.ndim else Unconnected(int(vertex), float(distance))

    def closest_point(
        self, q: ArrayLike, *, F: Any = None, workers: int = -1, progress: Progress = None
    ) -> ClosestPoint:
        """The point of the surface nearest to a point in space: `ClosestPoint(face, barycentric, point, distance)`. For
        points (n, 3) or [], four arrays.

        q : 3 numbers, or (n, 3).
        F, workers, progress : see `MeshIndex`; workers are for many points.

        face : an int, or (n,) int64, the row of F. Of several faces at the same distance, the one with the smallest
            number; faces that meet at a side or a corner have the same distance there, bit for bit.
        barycentric : (3,) or (n, 3) float64, >= 0, the weight of each corner of the face. Exactly 0 off a side. For
            polygons there is a column for each corner of the largest face of the mesh; at most three have a weight.
            A convex polygon is the fan of the triangles of its corners 0, i and i + 1; any other is divided so that
            they cover what it covers. A face with fewer than three corners has no points.
        point : (3,) or (n, 3) float64.
        distance : a float, or (n,) float64, from `q` to `point`, in the unit of V: it has no sign.

        Use it for picks, instead of the nearest vertex, which may lie on another sheet:

        >>> index = meshhood.MeshIndex(V, F)
        >>> face, barycentric, point, distance = index.closest_point([0.1, 0.2, 2.0])
        >>> region = index.neighborhood(point, 0.3, face=face)
        """
        points = _convert.points(q, "q")
        with reporter(progress, "closest_point", "points", len(points)) as report:
            found = self._surface_columns("closest", F, workers, report, points)
        return ClosestPoint(*(_of_one(found) if _convert.is_point(q, "q") else found))

    def first_hit(
        self, origins: ArrayLike, directions: ArrayLike, *, F: Any = None, workers: int = -1, progress: Progress = None
    ) -> FirstHit:
        """The first point of the surface on the ray from a point along a direction:
        `FirstHit(face, barycentric, point, distance)`. For rays (n, 3) or [], four arrays.

        origins, directions : 3 numbers each, or (n, 3). Directions are not 0, of any length.
        F, workers, progress : as for `closest_point`.

        face : an int, or (n,) int64, the row of F; -1 where the ray meets nothing. Of several faces at the same
            distance, the one with the smallest number. Either side of a face is met; one that is seen exactly from its
            side is not, but those that it meets are. No ray slips through between faces.
        barycentric, point : as for `closest_point`; NaN where nothing is met.
        distance : a float, or (n,) float64, in the unit of V; inf where nothing is met, 0 for an origin on the surface.

        >>> index = meshhood.MeshIndex(V, F)
        >>> face, barycentric, point, distance = index.first_hit([0, 0, 3.0], [0, 0, -1])
        >>> region = index.neighborhood(point, 0.3, face=face)
        """
        starts, ways = _convert.points(origins, "origins"), _convert.points(directions, "directions")
        with reporter(progress, "first_hit", "rays", len(starts)) as report:
            found = self._surface_columns("first_hits", F, workers, report, starts, ways)
        return FirstHit(*(_of_one(found) if _convert.is_point(origins, "origins") else found))

    def _surface_columns(self, name: str, F: Any, workers: int, report: Any, *points: Any) -> Any:
        """Faces, barycentric coordinates in them, points and distances, as a call of the surface of `F` finds them."""
        key, (corners, offsets) = self._keyed_faces(F)
        find = getattr(self._surface_of(key, (corners, offsets)), name)
        distances, faces, places, weights, found = find(*points, threads=_convert.threads(workers), progress=report)
        if offsets is not None:
            weights = _of_polygons(places, weights, int(np.diff(offsets).max()))
        return faces, weights, found, distances

    def thickness(
        self,
        vertices: AnyVertices = None,
        *,
        points: Optional[ArrayLike] = None,
        face: Optional[ArrayLike] = None,
        method: Literal["ray", "sphere"] = "ray",
        F: Any = None,
        workers: int = -1,
        progress: Progress = None,
    ) -> Union[float, Reals]:
        """The thickness of the wall at each vertex, or at points of faces, in the unit of V: (#rows,) float64, or a float
        for a single vertex or point.

        vertices, workers, progress : see `MeshIndex`.
        points, face : in place of vertices, 3 numbers and the face, or (n, 3) and (n,), as `closest_point` has them. The
            point of the face nearest to each of them counts, with the normal of the face.
        method : "ray", the way against the normal of the vertex or of the face to the surface; or "sphere", the diameter
            of the largest ball that touches the surface there from inside and has no point of an opposite face in it. A
            face is opposite if its normal turns from that of the vertex, or of the face of the point, by more than 53
            degrees (by a shrinking ball; Ma, Bae, Choi 2012).
        F : other faces than those that the index keeps. They are oriented counterclockwise, seen from outside.

        The normal is that of the faces of the vertex, weighted by their areas. With other normals, such as that of one of
        the faces, which trimesh takes unless given some, the values of uneven meshes differ.

        Faces with the vertex as a corner do not count. For a point, its face does not count, nor does another face that
        has the point on a side, up to rounding: at a sharp edge, the ball is as large as the rest of the surface allows.
        The thickness is inf where nothing else is met, or the radius of the ball exceeds the diagonal of the box around
        the faces, and NaN for a vertex without a normal or a face without an area. A call for several rows warns if more
        than half are inf.

        >>> across = meshhood.MeshIndex(V, F).thickness()
        >>> bool((abs(across - 2) < 0.02).all())  # of the unit sphere
        True
        """
        by_sphere = _convert.choice(method, "method", ("ray", "sphere")) == "sphere"
        surface = self._surface(F)
        rows = read_rows(
            self, vertices, 0.0, None, "straight", None, None, "mesh", workers, progress,
            points=points, face=face, F=F,
        )  # fmt: skip
        found = rows.ask(surface.thickness, by_sphere=by_sphere)
        if rows.shape == ():
            return float(found[0])
        open_rows, measured = np.count_nonzero(np.isinf(found)), np.count_nonzero(~np.isnan(found))
        if len(found) > 1 and 2 * open_rows > measured:
            warnings.warn(
                f"thickness: inf for {open_rows} of {measured} rows, behind which there is no surface; if the faces are "
                "clockwise, seen from outside, pass F=F[:, ::-1]; an open sheet has no thickness",
                stacklevel=2,
            )
        return found

    def k_nearest(
        self,
        k: int,
        vertices: AnyVertices = None,
        *,
        r: Number = np.inf,
        fill: int = -1,
        metric: Metric = "straight",
        walls: Mask = None,
        ignored: Mask = None,
        unit: Unit = "mesh",
        max_bytes: Optional[int] = None,
        workers: int = -1,
        progress: Progress = None,
    ) -> Nearest:
        """The `k` nearest connected vertices of each vertex, itself included: `Nearest(ids, distances)`, both (#rows, k),
        or (k,) for a single vertex.

        k : how many, at least 1. A row for a smaller `k` is the beginning of that for a larger one.
        r : only vertices within this connecting radius, path length or number of edges.
        metric : "straight": the nearest by connecting radius, the smallest radius whose neighborhood has the vertex,
            then by distance, then by id, as for `nearest_connected`; the distances are the connecting radii. "path": by
            the length of the shortest path along edges; "surface": by that of the shortest way, which may also cross
            faces; "rings": by the number of edges; each then by place in index order.
        fill : the id where a row has fewer than `k` vertices; the distance there is inf.
        vertices, walls, ignored, unit, max_bytes, workers, progress : see `MeshIndex`. A row whose vertex is a wall is
            empty. The distances have the unit of V.

        >>> index = meshhood.MeshIndex(V, F)
        >>> ids, distances = index.k_nearest(20)
        """
        rows = read_rows(self, vertices, r, None, metric, walls, ignored, unit, workers, progress)
        k = _convert.integer(k, "k")
        limit = _limit(rows, max_bytes, k)
        fill = _convert.integer(fill, "fill", -(2**31), 2**31 - 1)
        ids, distances = rows.ask(_core.k_nearest, rows.index._exact, max_bytes=limit, k=k)
        if fill != -1:
            ids[ids == -1] = fill
        return Nearest(ids[0], distances[0]) if rows.shape == () else Nearest(ids, distances)

    def discs(
        self,
        area: Number,
        vertices: AnyVertices = None,
        *,
        r: Number = np.inf,
        weights: Weights = "area",
        F: Any = None,
        metric: Metric = "straight",
        walls: Mask = None,
        ignored: Mask = None,
        unit: Unit = "mesh",
        max_bytes: Optional[int] = None,
        workers: int = -1,
        progress: Progress = None,
    ) -> Discs:
        """Discs of a fixed area: of each vertex the first vertices, in the order of `k_nearest`, whose weights add up to
        at least `area`; all where they do not. Returns `Discs(indptr, ids, distances)`.

        area : > 0, in the square of the unit of V.
        weights : (#V,), or "area" for `vertex_areas`, of `F` (see `MeshIndex`).
        max_bytes : refuse a larger result with MemoryError; by default, one larger than half of the memory that is free,
            because it is held twice. A sample of the rows usually shows this within a second.
        The other arguments are those of `k_nearest`.

        >>> index = meshhood.MeshIndex(V, F)
        >>> indptr, ids, distances = index.discs(0.3, [4, 7], metric="path")
        """
        rows = read_rows(self, vertices, r, None, metric, walls, ignored, unit, workers, progress)
        limit = _limit(rows, max_bytes, self._count, 2)
        areas = area_weights(self, weights, F)
        if areas is None:
            raise ValueError("weights: expected 'area' or (#V,) numbers")
        least = _convert.finite(area, "area", or_zero=False)
        return Discs(*rows.ask(_core.discs, rows.index._exact, max_bytes=limit, area=least, areas=areas))


def _limit(rows: Rows, max_bytes: Any, longest: int, copies: int = 1) -> int:
    """Returns the most bytes that the lists of rows of one radius may have."""
    if not isinstance(rows.radii[0], float):
        raise ValueError("r: expected one radius for all rows")
    return rows.limit(max_bytes, longest, copies)


def _of_polygons(places: Any, weights: Any, corners: int) -> Reals:
    """The barycentric coordinates of triangles, by the places of their corners, as those of polygons of up to `corners`
    corners."""
    wide = np.where(np.isnan(weights[:, :1]), np.nan, np.zeros((len(places), corners)))
    np.put_along_axis(wide, places, weights, axis=1)
    return wide


def _of_one(found: Any) -> Any:
    """Face, barycentric coordinates, point and distance of one point, without the axis of rows."""
    face, barycentric, point, distance = (part[0] for part in found)
    return int(face), barycentric, point, float(distance)
