# SPDX-License-Identifier: MIT
"""The surface in a ball, rather than its vertices: areas, volumes and gaps that do not depend on the triangles."""

from __future__ import annotations

from typing import Any, Literal, NamedTuple, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _convert
from ._held import Held
from ._progress import Progress
from ._regions import Submesh
from ._repr import shown_in_a_line
from ._rows import check_size, read_rows
from ._types import AnyVertices, Ids, Mask, Radii, Reals, Scales, Unit


@shown_in_a_line
class Invariants(NamedTuple):
    """Area and volume of the surface in each ball (see `MeshIndex.invariants`).

    area : (#rows,) of the patch, in the square of the unit of V.
    volume : (#rows,) of the part of the ball behind the patch. NaN where a border of the mesh, a side at which the
        orientation changes, or one of a face that is listed twice lies in the patch, or where there is no patch.

    With `scales` each array has a leading axis.

    >>> r = 0.5
    >>> area, volume = meshhood.MeshIndex(V, F).invariants(r)
    >>> mean = (2 * np.pi / 3 * r**3 - volume) * 4 / (np.pi * r**4)
    >>> bool(abs(mean - 1).max() < 0.1)  # on the unit sphere
    True
    """

    area: Reals
    volume: Reals


@shown_in_a_line
class Gaps(NamedTuple):
    """The nearest point that is not of the patch (see `MeshIndex.gaps`). With `scales` each array has a leading axis.

    distance : (#rows,) inf where there is none.
    face : (#rows,) int64, the row of F; -1 where there is none.
    vertices : (#rows, 3) int32, of the triangle of the face that has the point.
    barycentric : (#rows, 3) its coordinates in this triangle.
    point : (#rows, 3) in space.

    >>> two = np.concatenate([V, 1.25 * V]), np.concatenate([F, F + len(V)])  # a ball in a shell
    >>> gaps = meshhood.MeshIndex(*two).gaps(0.4)
    >>> bool((abs(gaps.distance - 0.25) < 0.02).all())
    True
    """

    distance: Reals
    face: NDArray[np.int64]
    vertices: Ids
    barycentric: Reals
    point: Reals


@shown_in_a_line
class Measure(NamedTuple):
    """Area and volume of the surface in one ball, as a row of `Invariants` (see `MeshIndex.measure`).

    >>> area, volume = meshhood.MeshIndex(V, F).measure(42, 0.5)
    """

    area: float
    volume: float


@shown_in_a_line
class Gap(NamedTuple):
    """The nearest point that is not of one patch, as a row of `Gaps` (see `MeshIndex.gap`).

    >>> meshhood.MeshIndex(V, F).gap(42, 0.5).face
    -1
    """

    distance: float
    face: int
    vertices: Ids
    barycentric: Reals
    point: Reals


class Patches(Held):
    """The part of `MeshIndex` that answers with the surface.

    The **patch** of a point of the surface and a radius r is the component, with the point, of the surface in the ball.
    It is a set of faces: those with a point in the ball, joined where a corner or a side that they share has one. It
    has the neighborhood of a vertex, and does not change if faces are divided. Faces are oriented counterclockwise,
    seen from outside; one with a wall is not there.
    """

    def invariants(
        self,
        r: Optional[Radii] = None,
        vertices: AnyVertices = None,
        *,
        points: Optional[ArrayLike] = None,
        face: Optional[ArrayLike] = None,
        scales: Optional[Scales] = None,
        F: Any = None,
        walls: Mask = None,
        ignored: Mask = None,
        metric: Literal["straight"] = "straight",
        unit: Unit = "mesh",
        workers: int = -1,
        progress: Progress = None,
    ) -> Invariants:
        """The area of the patch of each vertex, and the volume of the part of the ball behind it: the integral
        invariants of a surface (Manay et al. 2004; Pottmann et al. 2009). They are accurate to 1e-12 of pi r^2 and of
        the ball, and do not depend on how the surface is divided into triangles.

        r : one radius, or one for each row. A point at exactly `r` counts.
        vertices, scales, F, walls, ignored, unit, workers, progress : see `MeshIndex`. Ignored vertices have no effect.
        points, face : in place of vertices, 3 numbers and the face, or (n, 3) and (n,), as `closest_point` has them. Each
            is searched alone, as `measure` and `gap` do. There is no patch if a point is farther than `r` from its face.
        metric : "straight" alone, as a patch is in a ball.

        Returns `Invariants`: area, volume. A row depends on the index, the faces, its vertex or point and the
        radius alone.

        >>> index = meshhood.MeshIndex(V, F)
        >>> area, volume = index.invariants(0.5)
        >>> index.invariants(scales=[0.2, 0.4]).volume.shape
        (2, 642)
        >>> face, _, points, _ = index.closest_point(1.1 * V[:5])
        >>> index.invariants(0.5, points=points, face=face).area.shape
        (5,)
        """
        metric = _convert.choice(metric, "metric", ("straight",))
        rows = read_rows(
            self, vertices, r, scales, metric, walls, ignored, unit, workers, progress,
            points=points, face=face, F=F,
        )  # fmt: skip
        check_size((*rows.shape, 2), 8, None)
        return Invariants(*map(rows.shaped, rows.ask(rows.index._surface(F).invariants)))

    def gaps(
        self,
        r: Optional[Radii] = None,
        vertices: AnyVertices = None,
        *,
        points: Optional[ArrayLike] = None,
        face: Optional[ArrayLike] = None,
        scales: Optional[Scales] = None,
        F: Any = None,
        walls: Mask = None,
        ignored: Mask = None,
        metric: Literal["straight"] = "straight",
        unit: Unit = "mesh",
        workers: int = -1,
        progress: Progress = None,
    ) -> Gaps:
        """The nearest point of the surface within `r` of each vertex, or point of a face, that is not of its patch: the gap
        between sheets, folds and parts, whatever the triangles. A point to which only a way outside the ball leads counts,
        too.

        The arguments are those of `invariants`. Returns `Gaps`: distance, face, vertices, barycentric, point. Of several
        faces at the same distance, it is the one with the smallest number.

        >>> index = meshhood.MeshIndex(V, F)
        >>> bool(np.isinf(index.gaps(0.3).distance).all())  # a sphere has no gap
        True
        """
        metric = _convert.choice(metric, "metric", ("straight",))
        rows = read_rows(
            self, vertices, r, scales, metric, walls, ignored, unit, workers, progress,
            points=points, face=face, F=F,
        )  # fmt: skip
        check_size((*rows.shape, 10), 8, None)
        return Gaps(*map(rows.shaped, rows.ask(rows.index._surface(F).gaps)))

    def patch(
        self,
        start: Union[int, "np.integer[Any]", ArrayLike],
        r: float,
        *,
        face: Optional[int] = None,
        F: Any = None,
        walls: Mask = None,
        unit: Unit = "mesh",
    ) -> NDArray[np.int64]:
        """The rows of F that have a point in the patch of `start` and the radius `r`, ascending.

        start : a vertex; or, with `face`, a point of that face, 3 numbers, as `closest_point` returns them. There is no
            patch if the point is farther than `r` from the face.
        F, walls, unit : as for `invariants`.

        >>> index = meshhood.MeshIndex(V, F)
        >>> faces = index.patch(42, 0.3)
        >>> face, _, point, _ = index.closest_point([0, 0, 2.0])
        >>> face in index.patch(point, 0.3, face=face)
        True
        """
        surface, *one = self._one_patch(start, r, face, F, walls, unit)
        return surface.patch(*one)

    def clip(
        self,
        start: Union[int, "np.integer[Any]", ArrayLike],
        r: float,
        *,
        face: Optional[int] = None,
        tolerance: float = 1e-3,
        F: Any = None,
        walls: Mask = None,
        unit: Unit = "mesh",
    ) -> Submesh:
        """The patch of `start` and the radius `r` as a mesh of triangles that end at the sphere. Its border is where the
        surface leaves the ball, and the border of the surface.

        start, face, F, walls, unit : as for `patch`.
        tolerance : the arcs along which faces leave the ball become chords that are at most `tolerance * r` off; from
            1e-12 to 1. All chords have their ends on the sphere.

        The first rows of V are the vertices in the ball, all others new points on the sphere: first those on sides, of
        which `corners` has the end beyond the ball, and the other end twice; then those on arcs. `faces` are the rows
        of F of which the triangles are parts. `area` is that of the patch, as `invariants` returns it but for rounding;
        that of the triangles is less by at most `tolerance * r` times the length of the arcs.

        >>> index = meshhood.MeshIndex(V, F)
        >>> part = index.clip(42, 0.5)
        >>> bool(np.isclose(part.area, index.invariants(0.5, 42).area))
        True
        >>> np.allclose(np.linalg.norm(part.V[len(part.vertices):] - V[42], axis=1), 0.5)
        True
        """
        surface, *one = self._one_patch(start, r, face, F, walls, unit)
        limit = _convert.finite(tolerance, "tolerance", or_zero=False)
        points, corners, weights, faces, triangles, area = surface.clip(*one, limit)
        count = int(np.count_nonzero((corners == corners[:, :1]).all(axis=1)))  # of vertices, which come first
        new = corners[count:], weights[count:]
        return Submesh(points, triangles, corners[:count, 0].copy(), faces, area, *new, self._count)

    def measure(
        self,
        start: Union[int, "np.integer[Any]", ArrayLike],
        r: float,
        *,
        face: Optional[int] = None,
        F: Any = None,
        walls: Mask = None,
        unit: Unit = "mesh",
    ) -> Measure:
        """The area of the patch of `start` and the radius `r`, and the volume of the part of the ball behind it: a row of
        `invariants`, but for rounding, and the same for a point on a face.

        start, face, F, walls, unit : as for `patch`. A point at exactly `r` counts. A vertex or a face that the mesh
            does not have, and a negative radius, are a ValueError, a point without its face a TypeError.

        Returns `Measure`: area, in the square of the unit of V, and volume, in its cube; NaN as in `Invariants`. They
        are as accurate as `invariants`, which is faster for many vertices. O(k) for k triangles near the sphere.

        >>> index = meshhood.MeshIndex(V, F)
        >>> bool(np.isclose(index.measure(42, 0.5), index.invariants(0.5, 42)).all())
        True
        >>> face, _, point, _ = index.closest_point([0, 0, 2.0])
        >>> area, volume = index.measure(point, 0.3, face=face)
        """
        surface, *one = self._one_patch(start, r, face, F, walls, unit)
        return Measure(*surface.measure(*one))

    def gap(
        self,
        start: Union[int, "np.integer[Any]", ArrayLike],
        r: float,
        *,
        face: Optional[int] = None,
        F: Any = None,
        walls: Mask = None,
        unit: Unit = "mesh",
    ) -> Gap:
        """The nearest point of the surface within `r` of `start` that is not of its patch: a row of `gaps`, but for
        rounding, and the same for a point on a face.

        start, face, F, walls, unit : as for `patch`. A point at exactly `r` counts. Errors, and the cost, are those of
            `measure`.

        Returns `Gap`: distance, in the unit of V, face, and of its triangle the vertices (3,), the barycentric
        coordinates (3,) and the point (3,). Of several faces at the same distance, it is the one with the smallest
        number. Where there is none, as where there is no patch: inf, -1, and arrays of -1 and NaN.

        >>> two = np.concatenate([V, 1.25 * V]), np.concatenate([F, F + len(V)])  # a ball in a shell
        >>> index = meshhood.MeshIndex(*two)
        >>> face, _, point, _ = index.closest_point([0, 0, 0.9])
        >>> bool(abs(index.gap(point, 0.4, face=face).distance - 0.25) < 0.02)
        True
        """
        surface, *one = self._one_patch(start, r, face, F, walls, unit)
        distance, number, *arrays = (column[0] for column in surface.gap(*one))
        return Gap(float(distance), int(number), *arrays)

    def _one_patch(self, start: Any, r: Any, face: Any, F: Any, walls: Any, unit: Any) -> tuple[Any, Any, float]:
        """The surface, and the start and the radius of a patch."""
        radius = self._scale(unit) * _convert.radius(r)
        surface = self._with_masks(walls, None)._surface(F)
        if face is None:
            if not _convert.is_single(start, "start"):
                raise TypeError("start: a point, expected its face, too: face=, as closest_point or first_hit returns it")
            return surface, _convert.vertex(start, self._count, "start"), radius
        point = _convert.point(start, "start", "invariants, gaps")[0].tolist()
        return surface, (_convert.integer(face, "face", 0, 2**63 - 1), point), radius
