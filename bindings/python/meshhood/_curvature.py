# SPDX-License-Identifier: MIT
"""Curvature at a scale: the shape of the surface in the neighborhood of a vertex."""

from __future__ import annotations

import hashlib
import warnings
from typing import Any, NamedTuple, Optional

import numpy as np
from numpy.typing import NDArray

from . import _convert, _core
from ._mesh import face_arrays
from ._progress import reporter

FITTED, RANK_DEFICIENT, TOO_FEW, NO_NORMAL = range(4)


class Curvature(NamedTuple):
    """Principal curvatures k1 >= k2 in 1 / unit of the positions, their directions, and the state of each row.

    k1, k2 : (#rows,) float64. Positive where the surface is convex, seen from the side of the normals: 1 / R on a
        sphere with normals outward.
    d1, d2 : (#rows, 3) float64, unit vectors, with the sign that makes the component of largest magnitude positive.
    state : (#rows,) uint8. 0: fitted. 1: the points determine no unique quadric; the values are those of the one with
        the smallest coefficients. 2: fewer than six vertices are connected with the vertex; all values are 0. 3: the
        vertex has no normal, as it belongs to no face with an area; all values are 0.

    With a list of radii each array has a leading axis of radii.
    """

    k1: NDArray[np.float64]
    k2: NDArray[np.float64]
    d1: NDArray[np.float64]
    d2: NDArray[np.float64]
    state: NDArray[np.uint8]

    @property
    def ok(self) -> NDArray[np.bool_]:
        """Whether the row has a unique fit."""
        return self.state == FITTED

    @property
    def mean(self) -> NDArray[np.float64]:
        """H = (k1 + k2) / 2."""
        return (self.k1 + self.k2) / 2

    @property
    def gaussian(self) -> NDArray[np.float64]:
        """K = k1 k2."""
        return self.k1 * self.k2

    @property
    def shape_index(self) -> NDArray[np.float64]:
        """Koenderink's shape index: 1 on a dome, 0.5 on a ridge, 0 on a saddle, -0.5 in a valley, -1 in a bowl. NaN
        where both curvatures are 0."""
        index = 2 / np.pi * np.arctan2(self.k1 + self.k2, self.k1 - self.k2)
        return np.where((self.k1 == 0) & (self.k2 == 0), np.nan, index)

    @property
    def curvedness(self) -> NDArray[np.float64]:
        """Koenderink's curvedness, the square root of (k1^2 + k2^2) / 2."""
        return np.hypot(self.k1, self.k2) / np.sqrt(2)


class Surfaces:
    """The normals of an index. Those made from faces are kept until other faces are given."""

    def __init__(self, exact: Any) -> None:
        self._exact = exact
        self._kept = (b"", None)  # replaced as a whole: no lock, which a fork could copy while it is held

    def of(self, F: Any, normals: Any) -> Any:
        if (F is None) == (normals is None):
            raise ValueError("F: expected the faces of the mesh, or the argument normals, and not both")
        if normals is not None:
            return _of_normals(self._exact, normals)
        arrays = face_arrays(F)
        key = _digest(arrays)
        kept, surface = self._kept
        if kept != key:
            surface = _core.surface_of_faces(self._exact, *arrays)
            self._kept = (key, surface)
        return surface


def _digest(arrays: Any) -> bytes:
    digest = hashlib.blake2b(digest_size=16)
    for array in arrays:
        if array is not None:
            digest.update(f"{array.dtype} {len(array)};".encode())
            digest.update(array)
    return digest.digest()


def _of_normals(exact: Any, normals: Any) -> Any:
    count = exact.vertex_count
    array = np.array(_convert.as_array(normals, "normals"))
    if array.dtype.kind not in "iuf":
        raise TypeError(f"normals: expected numbers, not {array.dtype}")
    if array.shape != (count, 3):
        raise ValueError(f"normals: expected an array of shape ({count}, 3), not {array.shape}")
    try:
        return _core.surface_of_normals(exact, array.astype(np.float64).ravel())
    except ValueError as error:
        raise ValueError(f"normals: {error}") from None


def curvature(surface: Any, rows: Any, radii: Any, several: bool, options: dict[str, Any], progress: Any) -> Curvature:
    """The curvatures of `rows` for the radius `radii`, or for each of them if they are `several`."""
    with reporter(progress) as report:
        if not several:
            return Curvature(*surface.curvatures(rows, radii, progress=report, **options))
        parts = [Curvature(*surface.curvatures(rows, float(r), progress=report, **options)) for r in radii]
    return Curvature(*(np.stack(arrays) for arrays in zip(*parts)))


def principal_curvature(
    V: Any, F: Any, radius: int = 5, useKring: bool = False, *, workers: int = -1
) -> tuple[
    NDArray[np.float64], NDArray[np.float64], NDArray[np.float64], NDArray[np.float64], NDArray[np.int32]
]:
    """As `igl.principal_curvature(V, F, radius, False)` of libigl, with the same results: PD1, PD2 (#V, 3), PV1, PV2
    (#V,), and the vertices without a result.

    V : (#V, 3); F : (#F, 3).
    radius : of the neighborhood, in mean lengths of the sides of all faces; an integer of at least 2.
    useKring : must be False: the neighborhood is that of a ball, not the vertices within a number of edges. In libigl
        the default is True.
    workers : number of threads, -1 for one per processor.

    Differences from libigl: the list includes vertices without a normal; directions have the sign that makes the
    component of largest magnitude positive; isolated vertices at the end of V do not end the program. See
    `MeshIndex.curvature` for a shape operator without libigl's error.
    """
    from ._index import MeshIndex

    if useKring:
        raise ValueError("useKring: True, expected False: rings of edges are not searched")
    radius = _convert.positive(radius, "radius")
    if radius < 2:
        warnings.warn("radius: 1, which libigl raises to 2", stacklevel=2)
        radius = 2
    index = MeshIndex(V, F, workers=workers)
    length = _core.libigl_radius(index.positions, *face_arrays(F), edges=float(radius))
    found = index.curvature(length, F=F, like="libigl", workers=workers)
    bad = np.flatnonzero(found.state >= TOO_FEW).astype(np.int32)
    return found.d1, found.d2, found.k1, found.k2, bad
