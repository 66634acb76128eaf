# SPDX-License-Identifier: MIT
"""Regions as meshes: their faces, submeshes and outlines."""

from __future__ import annotations

from typing import Any, Literal, NamedTuple, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _convert, _core
from ._aggregate import vertex_areas
from ._held import Held
from ._mesh import mesh_arrays

Ids = NDArray[np.int32]
Corners = Literal["all", "any"]


class Submesh(NamedTuple):
    """Some faces of a mesh, as a mesh of their own.

    >>> index = meshhood.MeshIndex(V, F)
    >>> part = index.submesh(index.neighborhood(42, 0.5))
    >>> np.array_equal(part.V, V[part.vertices]) and np.array_equal(part.vertices[part.F], F[part.faces])
    True
    """

    V: Union[NDArray[np.float32], NDArray[np.float64]]  #: the positions of its vertices
    F: Union[Ids, tuple[NDArray[np.int64], Ids]]  #: (#F, 3), or (offsets, corners) if the mesh has polygons; rows of V
    vertices: Ids  #: its vertices by their ids in the whole mesh, ascending; then -1 for points where faces are clipped
    faces: NDArray[np.int64]  #: its faces by their rows in the whole mesh, ascending

    @property
    def area(self) -> float:
        """The sum of the areas of its faces, in the square of the unit of V."""
        return float(vertex_areas(self.V, self.F).sum())


class RimLine(NamedTuple):
    """A polyline along which a surface leaves a ball.

    >>> index = meshhood.MeshIndex(V, F)
    >>> line = index.rim(index.neighborhood(42, 0.5), 42, 0.5)[0]
    >>> np.allclose(np.linalg.norm(line.points - V[42], axis=1), 0.5)
    True
    """

    points: NDArray[np.float64]  #: (n, 3)
    edges: Ids  #: (n, 2): of each point, the end of its edge inside the region, and the other
    closed: bool  #: a loop, whose last point is joined to its first


class RegionMesh:
    """Makes meshes and outlines of the regions of a mesh, for drawing, remeshing and patches.

    V, F : the mesh, as for `MeshIndex`. Both are copied.

    `ids` are the vertices of a region, in any order, as the queries of `MeshIndex` return them; or a bool mask (#V,).
    Builds an index of the mesh, if there is none: `MeshIndex.submesh` needs no other.
    The cost of a call is that of sorting the faces around them. Raises ValueError or TypeError, naming the argument and
    the element.

    >>> mesher = meshhood.RegionMesh(V, F)
    >>> part = mesher.submesh(meshhood.MeshIndex(V, F).neighborhood(42, 0.5))
    """

    def __init__(self, V: Any, F: Any = None) -> None:
        positions, corners, offsets = mesh_arrays(V, F)
        self._hold(positions.copy(), _core.surface_of_mesh(positions, corners, offsets), offsets is None)

    def _hold(self, positions: Any, surface: Any, is_triangles: bool) -> None:
        self._positions = positions
        self._surface = surface
        self._triangles = is_triangles

    def __repr__(self) -> str:
        return f"<meshhood.RegionMesh: {len(self._positions)} vertices, {self._surface.face_count} faces>"

    def faces(self, ids: ArrayLike, corners: Corners = "all") -> NDArray[np.int64]:
        """The faces with all corners in `ids`, or with at least one; ascending.

        >>> meshhood.RegionMesh(V, F).faces(F[7]).tolist()
        [7]
        """
        return self._surface.faces(self._ids(ids), self._all(corners))

    def submesh(
        self, ids: ArrayLike, corners: Corners = "all", *, clip: Optional[tuple[Any, Any]] = None
    ) -> Submesh:
        """These faces as a mesh. With corners="all", faces that the surface of the ball cuts are left out, and so is
        their area.

        clip : (start, r), if `ids` is the region of `start` and `r`, as for `rim`: the faces are clipped at the ball
            instead, with exact points on the sides that leave the region. Two such points of a face are joined by a
            straight chord, not along the sphere, so that `area` is a little too small. V is then float64, F a tuple
            (offsets, corners), and a face of which the ball has several parts occurs several times. What of a face lies
            in the ball without a corner in `ids` is left out.

        >>> mesher, ids = meshhood.RegionMesh(V, F), meshhood.MeshIndex(V, F).neighborhood(42, 0.5)
        >>> mesher.submesh(ids).area < mesher.submesh(ids, clip=(42, 0.5)).area < mesher.submesh(ids, "any").area
        True
        """
        if clip is not None:
            return self._clipped(self._ids(ids), self._all(corners), clip)
        vertices, faces, offsets, flat = self._surface.submesh(self._ids(ids), self._all(corners))
        triangles = flat.reshape(-1, 3) if self._triangles else (offsets, flat)
        return Submesh(self._positions[vertices], triangles, vertices, faces)

    def rim(self, ids: ArrayLike, start: Any, r: Any) -> list[RimLine]:
        """Where the surface leaves a region: polylines whose points lie on edges, at the distance `r` from `start`.

        ids : the region of `start` and `r` (see `MeshIndex.neighborhood`).
        start : the center of the ball, a vertex or a point in space (3 numbers).

        On a manifold mesh without border all polylines are closed. The others end at the border of the mesh, or where
        three or more of them meet. If the faces are consistently oriented, the region lies to the left. If an edge
        leads from the region to a wall inside the ball, the point on this edge is the wall.

        >>> ids = meshhood.MeshIndex(V, F).neighborhood(42, 0.5)
        >>> [line.closed for line in meshhood.RegionMesh(V, F).rim(ids, 42, 0.5)]
        [True]
        """
        points, edges, offsets, closed = self._surface.rim(self._ids(ids), self._center(start), _convert.radius(r))
        parts = [slice(begin, end) for begin, end in zip(offsets[:-1], offsets[1:])]
        return [RimLine(points[part], edges[part], bool(is_closed)) for part, is_closed in zip(parts, closed)]

    def _clipped(self, ids: Ids, is_all: bool, clip: Any) -> Submesh:
        if not is_all:
            raise ValueError("corners: 'any', expected 'all' with clip")
        if not isinstance(clip, (tuple, list)) or len(clip) != 2:
            raise ValueError("clip: expected a tuple (start, r)")
        points, edges, faces, offsets, flat = self._surface.clip(ids, self._center(clip[0]), _convert.radius(clip[1]))
        vertices = np.where(edges[:, 0] == edges[:, 1], edges[:, 0], np.int32(-1))
        return Submesh(points, (offsets, flat), vertices, faces)

    def _center(self, start: Any) -> tuple[float, float, float]:
        if np.ndim(start) == 0:
            center = self._positions[_convert.vertex(start, len(self._positions), "start")].astype(np.float64)
        else:
            center = _convert.point(start, "start", "a call for each")[0]
        x, y, z = (float(value) for value in center)
        return x, y, z

    def _ids(self, ids: Any) -> Ids:
        return _convert.vertices(ids, len(self._positions), "ids")

    def _all(self, corners: Any) -> bool:
        return _convert.choice(corners, "corners", ("all", "any")) == "all"


class Regions(Held):
    """The part of `MeshIndex` that makes meshes of regions."""

    def submesh(
        self, ids: ArrayLike, corners: Corners = "all", *, clip: Optional[tuple[Any, Any]] = None, F: Any = None
    ) -> Submesh:
        """The faces with all corners in `ids`, or with at least one, as a mesh: see `RegionMesh.submesh`.

        ids : the vertices of a region, in any order, or a bool mask (#V,).
        clip : (start, r), to cut the faces at the ball. Without it, those that the surface of the ball cuts are left
            out with "all" and whole with "any": the area of a patch is off by a share of its rim.
        F : other faces than those that the index keeps.

        >>> index = meshhood.MeshIndex(V, F)
        >>> ids = index.neighborhood(42, 0.5)
        >>> part = index.submesh(ids)
        >>> len(part.V) == len(part.vertices)
        True
        >>> index.submesh(ids, clip=(42, 0.5)).area > part.area
        True
        """
        return self._region_mesh(F).submesh(ids, corners, clip=clip)

    def rim(self, ids: ArrayLike, start: Any, r: Any, *, F: Any = None) -> list[RimLine]:
        """Where the surface leaves a region: see `RegionMesh.rim`.

        >>> index = meshhood.MeshIndex(V, F)
        >>> [line.closed for line in index.rim(index.neighborhood(42, 0.5), 42, 0.5)]
        [True]
        """
        return self._region_mesh(F).rim(ids, start, r)

    def _region_mesh(self, F: Any) -> RegionMesh:
        mesh = RegionMesh.__new__(RegionMesh)
        key, arrays = self._keyed_faces(F)
        mesh._hold(self._methods.positions, self._surface_of(key, arrays), arrays[1] is None)
        return mesh
