# SPDX-License-Identifier: MIT
"""Curvature at a scale: the shape of the surface in the neighborhood of a vertex."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import _convert
from ._types import Floats

FITTED, RANK_DEFICIENT, TOO_FEW, NO_NORMAL, EXTENDED, BEYOND_HALO = range(6)
FEWEST_POINTS = 6  # of a fit


class Curvature(NamedTuple):
    """Principal curvatures k1 >= k2 in 1 / unit of the positions, their directions, and the state of each row.

    k1, k2 : (#rows,), in the type `dtype` of the call. Positive where the surface is convex, seen from the side of the
        normals: 1 / R on a sphere with normals outward.
    d1, d2 : (#rows, 3), unit vectors, with the sign that makes the component of largest magnitude positive. Views of
        one array, so that either keeps the memory of both.
    state : (#rows,) uint8. 0: fitted. 1: the points determine no unique quadric; the values are those of the one with
        the smallest coefficients. 2: fewer than six vertices are connected with the vertex; all values are 0. 3: the
        vertex has no normal, as it belongs to no face with an area; all values are 0. 4: fewer than six vertices are in
        the ball; the fit is to these and to the nearest connected ones. 5: only of `Parts.curvature`, see there.
    count : (#rows,) uint32, the vertices within the radius to which the quadric is fitted, without those that the
        filter leaves out. If they are fewer than six, the state is not 0.

    With `scales` each array has a leading axis.

    >>> found = meshhood.MeshIndex(V, F).curvature(0.3)
    >>> bool(found.ok.all() and abs(found.mean - 1).max() < 0.1)  # on the unit sphere
    True
    """

    k1: Floats
    k2: Floats
    d1: Floats
    d2: Floats
    state: NDArray[np.uint8]
    count: NDArray[np.uint32]  # type: ignore[assignment]

    def __repr__(self) -> str:
        if not self.k1.shape:
            return f"<meshhood.Curvature: k1 {self.k1}, k2 {self.k2}>"
        rows = " by ".join(map(str, self.k1.shape))
        fitted = f", {np.count_nonzero(self.ok)} ok" if isinstance(self.state, np.ndarray) else ""
        return f"<meshhood.Curvature: {rows} rows{fitted}>"

    @property
    def ok(self) -> NDArray[np.bool_]:
        """Whether the row has a unique fit to the vertices of its ball alone: state 0."""
        return self.state == FITTED

    @property
    def mean(self) -> Floats:
        """H = (k1 + k2) / 2."""
        return (self.k1 + self.k2) / 2

    @property
    def gaussian(self) -> Floats:
        """K = k1 k2."""
        return self.k1 * self.k2

    @property
    def shape_index(self) -> Floats:
        """Koenderink's shape index: 1 on a dome, 0.5 on a ridge, 0 on a saddle, -0.5 in a valley, -1 in a bowl. NaN
        where both curvatures are 0."""
        index = 2 / np.pi * np.arctan2(self.k1 + self.k2, self.k1 - self.k2)
        return np.where((self.k1 == 0) & (self.k2 == 0), np.nan, index)

    @property
    def curvedness(self) -> Floats:
        """Koenderink's curvedness, the square root of (k1^2 + k2^2) / 2."""
        return np.hypot(self.k1, self.k2) / math.sqrt(2)  # a float of Python keeps float32


def normals_of(normals: Any, count: int) -> Any:
    """`normals`: (count, 3)."""
    array = _convert.numbers(normals, "normals")
    if array.shape != (count, 3):
        raise ValueError(f"normals: expected an array of shape ({count}, 3), not {array.shape}")
    return array.astype(np.float64).ravel()
