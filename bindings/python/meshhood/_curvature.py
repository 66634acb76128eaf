# SPDX-License-Identifier: MIT
"""The shape of the surface in neighborhoods: curvature, principal components, and features over many radii."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import _convert, _core
from ._repr import shown_in_a_line
from ._types import Floats, Reals

FITTED, RANK_DEFICIENT, TOO_FEW, NO_NORMAL, EXTENDED, BEYOND_HALO = range(6)
FEWEST_POINTS = 6  # of a fit


class Curvature(NamedTuple):
    """Principal curvatures k1 >= k2 in 1 / unit of the positions, their directions, and the state of each row.

    k1, k2 : (#rows,), in the type `dtype` of the call. Positive where the surface is convex, seen from the side of the
        normals: 1 / R on a sphere with normals outward.
    d1, d2 : (#rows, 3), unit vectors, with the sign that makes the component of largest magnitude positive. Views of
        one array, so that either keeps the memory of both.
    state : (#rows,) uint8. 0: fitted. 1: the points determine no unique quadric; the values are those of the one with
        the smallest coefficients. 2: fewer than six vertices are in the ball or joined to these by edges, not across
        ignored vertices; all values are 0. 3: the vertex has no normal, as it belongs to no face with an area; all
        values are 0. 4: fewer than six vertices are in the ball; the fit is to these and to the nearest joined ones. 5:
        only of `Parts.curvature`, see there.
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


@shown_in_a_line
class PrincipalComponents(NamedTuple):
    """How the vertices of each neighborhood are distributed. With areas as weights, `weight`, `center` and `variances`
    are integral invariants of the surface in the neighborhood: its area, barycenter and covariance.

    weight : (#rows,) the sum of the weights.
    center : (#rows, 3) the weighted mean of the positions, relative to the query vertex.
    variances : (#rows, 3) ascending: the eigenvalues of the weighted covariance about `center`.
    axes : (#rows, 3, 3) axes[i, j] is the direction of variances[i, j], a unit vector, with the sign that makes the
        component of largest magnitude positive.

    All but `weight` are NaN where the weights sum to 0.

    >>> found = meshhood.MeshIndex(V, F).principal_components(0.3)
    >>> bool((abs(np.sum(found.normal * V, axis=1)) > 0.99).all())  # on the unit sphere
    True
    """

    weight: Floats
    center: Floats
    variances: Floats
    axes: Floats

    @property
    def normal(self) -> Floats:
        """The normal of the plane that fits best."""
        return self.axes[..., 0, :]

    @property
    def surface_variation(self) -> Floats:
        """The least variance divided by the sum of the three (Pauly, Gross, Kobbelt 2002): 0 on a plane, at most
        1/3."""
        with np.errstate(invalid="ignore"):
            shares = self.variances / self.variances[..., 2:]
            return shares[..., 0] / shares.sum(axis=-1)


@shown_in_a_line
class CorrectedCurvature(NamedTuple):
    """Curvature from measures (see `MeshIndex.corrected_curvature`). All but the area and the measures are NaN where
    the area is 0.

    area, mean, gaussian : (#rows,) area of the neighborhood, corrected by the normals; H and K.
    k1, k2 : (#rows,) principal curvatures, k1 >= k2. Their mean is not exactly `mean`.
    d1, d2 : (#rows, 3) their directions in the plane of the vertex normal.
    measures : (#rows, 12) the sums from which the others follow: the area; twice the integral of H; the integral of K;
        and the anisotropic measure, a matrix of 3 by 3, row by row.

    >>> found = meshhood.MeshIndex(V, F).corrected_curvature(0.3)
    >>> bool(abs(found.gaussian - 1).max() < 0.1)  # on the unit sphere
    True
    """

    area: Floats
    mean: Floats
    gaussian: Floats
    k1: Floats
    k2: Floats
    d1: Floats
    d2: Floats
    measures: Floats


@shown_in_a_line
class Persistence(NamedTuple):
    """Over how many scales a feature lasts (see `persistence`).

    scales : (#rows,) int32, the length of the longest run of radii at which the feature is strong and keeps its sign;
        times -1 if the feature is negative there; 0 if there is none.
    strength : (#rows,) the feature of largest magnitude in this run; 0 if there is none.
    radius : (#rows,) the radius at which it has this strength; 0 if there is none.

    >>> creases = meshhood.MeshIndex(V, F).features(scales=[0.2, 0.4])
    >>> found = meshhood.persistence(creases, [0.2, 0.4], threshold=0.1)
    >>> bool((found.radius == 0.4).all())
    True
    """

    scales: NDArray[np.int32]
    strength: Reals
    radius: Reals


def geometric_radii(smallest: float, largest: float, count: int) -> Reals:
    """`count` radii from `smallest` to `largest` with a constant ratio.

    >>> [float(radius) for radius in meshhood.geometric_radii(1.0, 4.0, 3)]
    [1.0, 2.0, 4.0]
    """
    smallest = _convert.finite(smallest, "smallest", or_zero=False)
    largest = _convert.finite(largest, "largest", or_zero=False)
    if smallest > largest:
        raise ValueError(f"smallest: {smallest}, expected at most largest, {largest}")
    return _core.geometric_radii(smallest, largest, _convert.integer(count, "count", 1, 1000))


def persistence(values: Any, radii: Any, threshold: float) -> Persistence:
    """Over how many scales a feature lasts: the length of the longest run of consecutive radii at which it is at least
    as strong as `threshold` and keeps its sign; times -1 if the feature is negative there. If several runs have this
    length, the one with the smallest radii counts.

    values : (#radii, #rows), one kind of feature. A NaN ends a run.
    radii : (#radii,), >= 0, each larger than the one before.
    threshold : > 0.

    >>> crease = meshhood.MeshIndex(V, F).features(scales=[0.2, 0.4])
    >>> int(meshhood.persistence(crease, [0.2, 0.4], threshold=0.1).scales.max())
    2
    """
    array = np.array(_convert.numbers(values, "values"), np.float64)
    scales = _convert.ascending(radii, "radii")
    if not len(scales):
        raise ValueError("radii: there are none, expected at least one")
    if array.ndim != 2 or len(array) != len(scales):
        raise ValueError(f"values: expected an array of shape (#radii, #rows), not {array.shape}, for {len(scales)} radii")
    threshold = _convert.finite(threshold, "threshold", or_zero=False)
    return Persistence(*_core.persistence(array.ravel(), scales, threshold))


def normals_of(normals: Any, count: int) -> Any:
    """`normals`: (count, 3)."""
    array = _convert.numbers(normals, "normals")
    if array.shape != (count, 3):
        raise ValueError(f"normals: expected an array of shape ({count}, 3), not {array.shape}")
    return array.astype(np.float64).ravel()
