# SPDX-License-Identifier: MIT
"""Regions as meshes: their submeshes and outlines."""

from __future__ import annotations

from typing import Any, Literal, NamedTuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _convert
from ._aggregate import vertex_areas
from ._held import Held
from ._mesh import poly_data
from ._optional import optional
from ._repr import shown_in_a_line
from ._types import Ids

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
    vertices: Ids  #: its first vertices by their ids in the whole mesh, ascending; all, unless faces are clipped
    faces: NDArray[np.int64]  #: its faces by their rows in the whole mesh, ascending
    area: float  #: of its faces, in the square of the unit of V; of a clip, that of the patch: see `MeshIndex.clip`
    corners: Ids  #: (n, 3): of each further vertex, where a face is clipped, those of its triangle in the whole mesh
    weights: NDArray[np.float64]  #: (n, 3) of these corners, with the sum 1; 0 of the third on a side
    whole: int  #: the number of vertices of the whole mesh

    def __repr__(self) -> str:
        clipped = f", {len(self.corners)} of them where faces are clipped" if len(self.corners) else ""
        return f"<meshhood.Submesh: {len(self.faces)} faces, {len(self.V)} vertices{clipped}>"

    def carry(self, values: ArrayLike) -> NDArray[Any]:
        """Values of the vertices of the whole mesh, (#V, ...), at the vertices of this one; linear on the triangles
        that are clipped, for which they must be floats. Returns a new array of the same type.

        >>> index = meshhood.MeshIndex(V, F)
        >>> part = index.clip(42, 0.5)
        >>> np.allclose(part.carry(V), part.V)
        True
        """
        whole = _convert.as_array(values, "values")
        if whole.ndim == 0 or len(whole) != self.whole:
            rows = f"a row for each of the {self.whole} vertices of the whole mesh"
            raise ValueError(f"values: of shape {whole.shape}, expected {rows}")
        if not len(self.corners):
            return whole[self.vertices]
        if whole.dtype.kind != "f":
            raise TypeError(
                f"values: expected floats for a clipped mesh, not {whole.dtype}, because they are interpolated; take labels "
                "at `vertices`, and at the entry of each row of `corners` with the largest of `weights`"
            )
        weights = self.weights.reshape(*self.weights.shape, *[1] * (whole.ndim - 1))
        between = (weights * whole[self.corners]).sum(axis=1)
        return np.concatenate([whole[self.vertices], between.astype(whole.dtype)])

    def to_pyvista(self) -> Any:
        """A pyvista.PolyData with the same vertices and polygons, its array of cells `faces`, and unless faces are
        clipped that of points `vertices`. Needs PyVista.

        >>> index = meshhood.MeshIndex(V, F)
        >>> mesh = index.submesh(index.neighborhood(42, 0.5)).to_pyvista()
        """
        mesh = poly_data(optional("pyvista", "to_pyvista"), self.V, *self._corners())
        mesh.cell_data["faces"] = self.faces
        if not len(self.corners):
            mesh.point_data["vertices"] = self.vertices
        return mesh

    def to_trimesh(self) -> Any:
        """A trimesh.Trimesh with the same vertices; a polygon of k corners becomes k - 2 triangles around its first
        corner. Its `face_attributes["faces"]` are `faces`, one for each triangle. Needs trimesh.

        >>> index = meshhood.MeshIndex(V, F)
        >>> mesh = index.submesh(index.neighborhood(42, 0.5)).to_trimesh()
        """
        trimesh = optional("trimesh", "to_trimesh")
        corners, offsets = self._corners()
        faces = {"faces": self.faces}
        if offsets is not None:
            polygons, first = _fans(offsets)
            corners = np.stack([corners[offsets[polygons]], corners[first], corners[first + 1]], axis=1)
            faces = {"faces": self.faces[polygons]}
        return trimesh.Trimesh(self.V, corners.reshape(-1, 3), face_attributes=faces, process=False, validate=False)

    def _corners(self) -> tuple[Any, Any]:
        return (self.F[1], self.F[0]) if isinstance(self.F, tuple) else (self.F.ravel(), None)


def _fans(offsets: Any) -> tuple[Any, Any]:
    """Of each triangle: its polygon, and the place of its second corner; the third is the next."""
    counts = np.maximum(np.diff(offsets) - 2, 0)
    polygons = np.repeat(np.arange(len(counts)), counts)
    starts = np.cumsum(counts) - counts
    return polygons, offsets[polygons] + 1 + np.arange(len(polygons)) - starts[polygons]


@shown_in_a_line
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


class Regions(Held):
    """The part of `MeshIndex` that makes meshes and outlines of regions, for drawing, remeshing and patches."""

    def submesh(self, ids: ArrayLike, corners: Corners = "all", *, F: Any = None) -> Submesh:
        """The faces with all corners in `ids`, or with at least one, as a mesh. Those that the surface of a ball cuts,
        and their area, are left out with "all", and whole with "any"; `clip` cuts them.

        ids : the vertices of a region, in any order, or a bool mask (#V,).
        F : other faces than those that the index keeps.

        The cost is that of sorting the faces around the region. With `F`, all faces are read at each call, too; for
        many regions use an index that keeps them.

        >>> index = meshhood.MeshIndex(V, F)
        >>> ids = index.neighborhood(42, 0.5)
        >>> part = index.submesh(ids)
        >>> len(part.V) == len(part.vertices) and part.area < index.submesh(ids, "any").area
        True
        """
        region = _convert.vertices(ids, self._count, "ids")
        is_all = _convert.choice(corners, "corners", ("all", "any")) == "all"
        key, arrays = self._keyed_faces(F)
        vertices, faces, offsets, flat = self._surface_of(key, arrays).submesh(region, is_all)
        triangles = flat.reshape(-1, 3) if arrays[1] is None else (offsets, flat)
        points, none = self._methods.positions[vertices], (np.empty((0, 3), np.int32), np.empty((0, 3)))
        area = float(vertex_areas(points, triangles).sum())
        return Submesh(points, triangles, vertices, faces, area, *none, self._count)

    def rim(self, ids: ArrayLike, start: Any, r: Any, *, F: Any = None) -> list[RimLine]:
        """Where the surface leaves a region: polylines whose points lie on edges, at the distance `r` from `start`.

        ids, F : as for `submesh`; the region of `start` and `r` (see `neighborhood`).
        start : the center of the ball, a vertex or a point in space (3 numbers).

        On a manifold mesh without border all polylines are closed. The others end at the border of the mesh, or where
        three or more of them meet. If the faces are consistently oriented, the region lies to the left. If an edge
        leads from the region to a wall inside the ball, the point on this edge is the wall.

        >>> index = meshhood.MeshIndex(V, F)
        >>> [line.closed for line in index.rim(index.neighborhood(42, 0.5), 42, 0.5)]
        [True]
        """
        region = _convert.vertices(ids, self._count, "ids")
        points, edges, offsets, closed = self._surface(F).rim(region, self._center(start), _convert.radius(r))
        parts = [slice(begin, end) for begin, end in zip(offsets[:-1], offsets[1:])]
        return [RimLine(points[part], edges[part], bool(is_closed)) for part, is_closed in zip(parts, closed)]

    def _center(self, start: Any) -> tuple[float, float, float]:
        if _convert.is_single(start, "start"):
            center = self._methods.positions[_convert.vertex(start, self._count, "start")].astype(np.float64)
        else:
            center = _convert.point(start, "start", "a call for each")[0]
        x, y, z = (float(value) for value in center)
        return x, y, z
