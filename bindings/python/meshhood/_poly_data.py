# SPDX-License-Identifier: MIT
"""A mesh of PyVista. The module is an argument, because it may not be installed."""

from __future__ import annotations

from typing import Any

import numpy as np


def poly_data(pyvista: Any, positions: Any, corners: Any, offsets: Any) -> Any:
    """A pyvista.PolyData. `corners`, `offsets`: as `mesh_arrays` returns them."""
    if offsets is None:
        offsets = np.arange(0, len(corners) + 1, 3)
    mesh = pyvista.PolyData()
    mesh.points = positions
    mesh.SetPolys(pyvista.CellArray.from_arrays(np.asarray(offsets, np.int64), np.asarray(corners, np.int64)))
    return mesh
