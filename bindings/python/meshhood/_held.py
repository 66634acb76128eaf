# SPDX-License-Identifier: MIT
"""What an index holds, and what its queries have in common."""

from __future__ import annotations

from typing import Any

from . import _convert, _core
from ._curvature import KeptOfFaces, Surfaces
from ._mesh import face_arrays
from ._methods import Methods


class Held:
    """The base of the classes that make up `MeshIndex`."""

    _exact: Any
    _faces: Any  # corners and offsets, as `face_arrays` returns them, or None
    _methods: Methods
    _surfaces: Surfaces
    _face_index: KeptOfFaces
    _queries: Any
    _count: int

    def _hold(self, exact: Any, faces: Any) -> None:
        self._exact = exact
        self._faces = faces
        self._methods = Methods(exact)
        self._surfaces = Surfaces(exact)
        self._face_index = KeptOfFaces(exact, _core.face_index)
        self._queries = _core.queries(exact)
        self._count = exact.vertex_count

    def _method(self, method: Any, metric: Any) -> Any:
        if _convert.choice(metric, "metric", ("straight", "path")) == "path":
            if method != "exact":
                raise ValueError(f"method: {method!r}, expected 'exact' with metric='path'")
            return self._methods.along_edges
        try:
            return self._methods[method]
        except TypeError:
            if method.__hash__ is not None:
                raise
            raise TypeError(f"method: expected a name or a Paper, not {type(method).__name__}") from None

    def _scale(self, unit: Any) -> float:
        """The factor from `unit` to the unit of the positions."""
        if unit == "mesh":
            return 1.0
        _convert.choice(unit, "unit", ("mesh", "edge"))
        length = self._methods.mean_edge_length
        if length == 0:
            raise ValueError("unit: 'edge', but the mesh has no edges of positive length")
        return length

    def _batch(self, v: Any, r: Any, scale: float, workers: Any) -> Any:
        rows = None if v is None else _convert.vertices(v, self._count)
        radius = _convert.radii(r, self._count if rows is None else len(rows))
        return rows, scale * radius, _convert.threads(workers)

    def _face_arrays(self, F: Any) -> tuple[Any, Any]:
        """Corners and offsets of `F`, or of the faces that the index keeps."""
        if F is not None:
            return face_arrays(F)
        return self._own_faces("F: expected the faces, because")

    def _own_faces(self, wish: str) -> tuple[Any, Any]:
        """Corners and offsets of the faces that the index keeps. `wish`: the beginning of the error if it has none."""
        if self._faces is None:
            raise ValueError(
                f"{wish} this index has none: it was built with keep_faces=False or from a graph, or loaded from a file "
                "without faces; index.save(path, faces=True) saves an index with its faces"
            )
        return self._faces

    def _surface(self, F: Any, normals: Any) -> Any:
        """The normals of the faces, or `normals`."""
        if normals is None:
            return self._surfaces.of_faces(self._face_arrays(F), is_own=F is None)
        if F is not None:
            raise ValueError("F: expected None, because the normals are given")
        return self._surfaces.of_normals(normals)
