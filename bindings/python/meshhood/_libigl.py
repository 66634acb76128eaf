# SPDX-License-Identifier: MIT
"""Curvature by the interface of libigl."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _convert, _core
from ._curvature import NO_NORMAL, TOO_FEW
from ._index import MeshIndex


def principal_curvature(
    V: Any, F: Any, radius: int = 5, useKring: bool = False, *, workers: int = -1
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64], NDArray[np.float64], NDArray[np.int32]]:
    """As `igl.principal_curvature` of libigl, with the same results: PD1, PD2 (#V, 3), PV1, PV2 (#V,), and the vertices
    without a result. libigl's default is useKring=True.

    V : (#V, 3); F : (#F, 3).
    radius : of the neighborhood, in mean lengths of the sides of all faces; an integer of at least 2.
    useKring : take the vertices within `radius` edges instead of those in a ball.
    workers : number of threads, -1 for one per processor.

    Differences from libigl: the list includes vertices without a normal; directions have the sign that makes the
    component of largest magnitude positive; isolated vertices at the end of V do not end the program. See
    `MeshIndex.curvature` for a shape operator without libigl's error.

    >>> PD1, PD2, PV1, PV2, bad = meshhood.principal_curvature(V, F, radius=3)
    """
    radius = _convert.integer(radius, "radius")
    if radius < 2:
        warnings.warn("radius: 1, which libigl raises to 2", stacklevel=2)
        radius = 2
    index = MeshIndex(V, F, workers=workers)
    if useKring:
        found = index.curvature(radius, metric="rings", like="libigl", workers=workers)
    else:
        length = _core.libigl_radius((index.positions, *index._face_arrays(None)), edges=float(radius))
        found = index.curvature(length, like="libigl", workers=workers)
    bad = np.flatnonzero(np.isin(found.state, (TOO_FEW, NO_NORMAL))).astype(np.int32)
    return found.d1, found.d2, found.k1, found.k2, bad
