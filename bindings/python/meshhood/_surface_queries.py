# SPDX-License-Identifier: MIT
"""Nearest vertices and points for many rows: on the surface, connected, and not connected."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _convert, _core
from ._aggregate import area_weights
from ._held import Held
from ._mesh import mesh_arrays, positions_of
from ._progress import Progress, reporter
from ._types import Ids, Metric, Number, Radii, Reals, Unit, Vertex, Vertices

if TYPE_CHECKING:
    from typing_extensions import Self

Mask = Optional[NDArray[np.bool_]]

# Memory for an edge while an index is built, at most.
_BYTES_OF_EDGE = 64


class SurfaceQueries(Held):
    """The part of `MeshIndex` that finds what is nearest."""

    @classmethod
    def from_points(
        cls, P: Any, link: Number, *, max_edges: Optional[int] = None, workers: int = -1, progress: Progress = None
    ) -> Self:
        """The index of points without faces: any two points at most `link` apart are joined by an edge.

        P : (#V, 3) float32 or float64, the points, as V of `MeshIndex`.
        link : a finite number >= 0, in the unit of P. Points at exactly this distance, and at the same place, are
            joined. A link less than about a millionth of the extent of all points takes long.
        max_edges : refuse a graph with more edges; by default, as many as the memory of the machine may hold.
        workers, progress : as for `MeshIndex`. The index does not depend on `workers`.

        Everything that needs no faces works as for a mesh. The normals that curvature needs can be given.

            index = meshhood.MeshIndex.from_points(P, link=0.9)
        """
        points = positions_of(P, "P")
        distance = _convert.finite(link, "link", or_zero=True)
        edges = _convert.max_bytes(None) // _BYTES_OF_EDGE if max_edges is None else max_edges
        options = {
            "max_edges": _convert.integer(edges, "max_edges", 0, 2**64 - 1),
            "threads": _convert.threads(workers),
        }
        with reporter(progress) as report:
            return cls._holding(_core.exact_of_points(points, link=distance, **options, progress=report))

    @classmethod
    def of_faces(cls, V: Any, F: Any = None, *, workers: int = -1, progress: Progress = None) -> Self:
        """The index of the faces of a mesh, for data that lies on faces: its vertices are the faces, at the mean of
        their corners, and two faces are joined if they have an edge in common. So ids are rows of F, and `positions`
        the centers (#F, 3), float64. The arguments are as for `MeshIndex`.

            index = meshhood.MeshIndex.of_faces(V, F)
            smooth = index.smooth(values_of_faces, fwhm=3.0)
        """
        positions, corners, offsets = mesh_arrays(V, F)
        threads = _convert.threads(workers)
        with reporter(progress) as report:
            return cls._holding(
                _core.exact_of_faces(positions, corners, offsets=offsets, threads=threads, progress=report)
            )

    def nearest_unconnected(
        self,
        vertices: Vertices,
        r: Radii,
        *,
        unit: Unit = "mesh",
        workers: int = -1,
        progress: Progress = None,
    ) -> tuple[Ids, Reals]:
        """The nearest vertex within `r` in space that is not in the neighborhood with radius `r`, and its distance:
        `other, gap`, both (#rows,); -1 and inf where there is none. Of several at the same distance, the one with the
        smallest id.

        vertices : a sequence of vertices, a bool mask (#V,), or None for all.
        r : one radius, or one for each row. A vertex at exactly `r` counts.
        unit, workers, progress : as for `query_ball`. The result does not depend on `workers`.

        It is the thickness of a wall, the gap between two folds or sheets that nearly touch. *Not connected* is meant at
        the scale of `r`: a vertex to which only a way outside the ball leads is not connected, so a surface that bends
        back into the ball counts as well as another component. With r=inf only other components count.

            other, gap = index.nearest_unconnected(None, 2.0)
            thin = gap < 0.5
        """
        rows, radius, threads = self._batch(vertices, r, self._scale(unit), workers)
        with reporter(progress) as report:
            return _core.nearest_unconnected(self._exact, rows, radius, threads=threads, progress=report)

    def closest_point(
        self, q: ArrayLike, *, F: Any = None, workers: int = -1, progress: Progress = None
    ) -> tuple[Any, Any, Any]:
        """The point of the surface nearest to a point in space: `face, barycentric, point`. For points (n, 3) or [],
        three arrays.

        q : 3 numbers, or (n, 3).
        F : other faces than those that the index keeps. What is made of the faces is kept for the next call with the
            same faces.
        workers, progress : as for `query_ball`, for many points.

        face : an int, or (n,) int64, the row of F. Of several faces at the same distance, the one with the smallest
            number; faces that meet at a side or a corner have the same distance there, bit for bit.
        barycentric : (3,) or (n, 3) float64, >= 0, the weight of each corner of the face. Exactly 0 off a side. For
            polygons there is a column for each corner of the largest face of the mesh. A polygon is the fan of the
            triangles of its corners 0, i and i + 1; the others have weight 0. A face with fewer than three corners has
            no points.
        point : (3,) or (n, 3) float64.

        Use it for picks, instead of the nearest vertex, which may lie on another sheet:

            face, barycentric, point = index.closest_point([0.1, 0.2, 0.3])
            region = index.query_region(point, 1.5, face=face)
        """
        points = _convert.points(q, "q")
        corners, offsets = self._face_arrays(F)
        surface = self._face_index.of_faces((corners, offsets), is_own=F is None)
        threads = _convert.threads(workers)
        with reporter(progress) as report:
            faces, second, weights, found = surface.closest(points, threads=threads, progress=report)
        if offsets is not None:
            weights = _of_polygons(second, weights, int(np.diff(offsets).max()))
        is_one = np.ndim(q) == 1 and len(points) == 1
        return (int(faces[0]), weights[0], found[0]) if is_one else (faces, weights, found)

    def query_knn(
        self,
        vertices: Union[Vertex, Vertices],
        k: Any = None,
        *,
        r: Number = np.inf,
        metric: Metric = "straight",
        fill: int = -1,
        until: Optional[Number] = None,
        weights: Any = "area",
        F: Any = None,
        walls: Mask = None,
        ignored: Mask = None,
        unit: Unit = "mesh",
        workers: int = -1,
        progress: Progress = None,
    ) -> Any:
        """The `k` nearest connected vertices of each of `vertices`, itself included: `ids, distances`, both (#rows, k),
        or (k,) for a single vertex.

        vertices : a vertex, a sequence of vertices, a bool mask (#V,), or None for all.
        k : how many. A row for a smaller `k` is the beginning of that for a larger one.
        r : only vertices within this connecting radius or path length.
        metric : "straight": the nearest by connecting radius, the smallest radius whose neighborhood has the vertex,
            then by distance, then by id, as for `nearest_connected`; the distances are the connecting radii. "path": by
            the length of the shortest path along edges, then by place in index order.
        fill : the id where a row has fewer than `k` vertices; the distance there is inf.
        until : instead of `k`, an area. Each row is then a disc of fixed area: the first vertices, in the same order,
            whose weights add up to at least `until`; all where they do not. Returns `indptr, ids, distances`.
        weights : (#V,), for `until`: "area" for `vertex_areas`.
        F : other faces than those that the index keeps, for weights="area".
        walls, ignored : as for `query_region`. A row whose vertex is a wall is empty.
        unit, workers, progress : as for `query_ball`. The result has the unit of V, `until` its square. It does not
            depend on `workers`.

            ids, distances = index.query_knn(None, 20)
            indptr, ids, distances = index.query_knn([4, 7], until=30.0, metric="path")
        """
        if (k is None) == (until is None):
            raise ValueError("k: expected a number of vertices, or an area as `until`, and not both")
        is_one = vertices is not None and _convert.is_single(vertices)
        rows = None if vertices is None else _convert.vertices([vertices] if is_one else vertices, self._count)
        options = {
            "path": _convert.choice(metric, "metric", ("straight", "path")) == "path",
            "radius": self._scale(unit) * _convert.radius(r),
            "walls": _convert.mask(walls, "walls", self._count),
            "ignored": _convert.mask(ignored, "ignored", self._count),
            "threads": _convert.threads(workers),
        }
        if until is not None:
            areas = area_weights(self, weights, F)
            if areas is None:
                raise ValueError("weights: expected 'area' or (#V,) numbers")
            area = _convert.finite(until, "until", or_zero=False)
            with reporter(progress) as report:
                return _core.discs(self._exact, rows, area=area, areas=areas, **options, progress=report)
        count = _convert.integer(k, "k", 0, 2**63 - 1)
        options["fill"] = _convert.integer(fill, "fill", -(2**31), 2**31 - 1)
        with reporter(progress) as report:
            ids, distances = _core.k_nearest(self._exact, rows, k=count, **options, progress=report)
        return (ids[0], distances[0]) if is_one else (ids, distances)


def _of_polygons(second: Any, weights: Any, corners: int) -> Reals:
    """The barycentric coordinates of triangles of fans as those of polygons of up to `corners` corners."""
    rows = np.arange(len(second))
    wide = np.zeros((len(second), corners))
    wide[rows, 0] = weights[:, 0]
    wide[rows, second] = weights[:, 1]
    wide[rows, second + 1] = weights[:, 2]
    return wide
