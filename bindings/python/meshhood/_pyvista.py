# SPDX-License-Identifier: MIT
"""`mesh.meshhood` of PyVista's PolyData. PyVista finds this module by its entry point and imports it at first use."""

from __future__ import annotations

from typing import Any

import pyvista

from ._index import MeshIndex


@pyvista.register_dataset_accessor("meshhood", pyvista.PolyData)
class Accessor:
    """The index of a mesh of polygons, with all calls of `MeshIndex`: `mesh["H"] = mesh.meshhood.curvature(2.0).mean`.

    The index is built at the first call, and again after points or faces have changed.
    """

    def __init__(self, mesh: pyvista.PolyData) -> None:
        self._mesh = mesh
        self._built: tuple[Any, Any] = (None, None)

    @property
    def index(self) -> MeshIndex:
        state = self._mesh.GetPoints().GetMTime(), self._mesh.GetPolys().GetMTime()
        built, index = self._built
        if built != state:
            index = MeshIndex(self._mesh)
            self._built = (state, index)
        return index

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        return getattr(self.index, name)

    def __dir__(self) -> list[str]:
        return ["index", *(name for name in dir(MeshIndex) if not name.startswith("_"))]
