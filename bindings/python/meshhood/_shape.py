# SPDX-License-Identifier: MIT
"""The shape of the surface in neighborhoods."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Literal, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _convert, _core
from ._aggregate import area_weights
from ._curvature import Curvature
from ._held import Held
from ._moments import CorrectedCurvature, PrincipalComponents
from ._progress import Progress, reporter
from ._types import Number, Radii, Reals, Unit, Vertices

_KINDS = (
    "crease", "mean", "gaussian", "k1", "k2", "curvedness", "shape_index", "area", "height", "variation",
)  # fmt: skip


class Shape(Held):
    """The part of `MeshIndex` that measures the surface."""

    def curvature(
        self,
        r: Union[Radii, Sequence[float]],
        vertices: Vertices = None,
        *,
        F: Any = None,
        normals: Any = None,
        like: Literal[None, "libigl"] = None,
        fit: Literal["quadric", "jet"] = "quadric",
        filter: bool = True,
        unit: Unit = "mesh",
        workers: int = -1,
        progress: Progress = None,
    ) -> Curvature:
        """Principal curvatures of `vertices` by a quadric that is fitted to their neighborhoods of radius `r`.

        r : a radius, or a list of radii: the arrays of the result then have a leading axis.
        vertices : a list of vertices, a bool mask, or None for all.
        F : other faces than those that the index keeps. The normals are kept for the next call with the same faces.
        normals : (#V, 3), instead of those of the faces; of any length. NaN where a vertex has none.
        like : "libigl" gives the values of igl.principal_curvature. Its shape operator is wrong where the fitted
            quadric is tilted against the normal, and its neighborhoods have the vertices nearer than `r`.
        fit : "quadric", through the vertex and over its tangent plane, or "jet", over the plane of the principal
            components of the neighborhood: with filter=False CGAL's Monge_via_jet_fitting of degrees 2 and 2.
        filter : fit only vertices whose normal makes an angle of less than 90 degrees with that of the query vertex, if
            there are at least six.
        unit, workers, progress : as for `query_ball`.

        A row depends on index, faces or normals, vertex and radius alone, bit for bit: not on the other rows or radii
        of the call, earlier calls, threads or the processor.
        Returns a `Curvature`: k1, k2, d1, d2, state, and as properties mean, gaussian, shape_index, curvedness, ok.
        Raises ValueError without faces and normals. See docs/curvature.md for what the numbers mean.
        """
        if like is not None:
            _convert.choice(like, "like", ("libigl",))
        rows = None if vertices is None else _convert.vertices(vertices, self._count)
        radii = np.array(_convert.as_array(r, "r"))
        several = radii.ndim > 0
        radii = self._scale(unit) * _convert.radii(radii, len(radii) if several else 1)
        options = {"libigl": like == "libigl", "jet": _convert.choice(fit, "fit", ("quadric", "jet")) == "jet"}
        options |= {"filter": bool(filter), "threads": _convert.threads(workers)}
        surface = self._surface(F, normals)
        with reporter(progress) as report:
            if not several:
                return Curvature(*surface.curvatures(rows, radii, progress=report, **options))
            each = [Curvature(*surface.curvatures(rows, float(r), progress=report, **options)) for r in radii]
        return Curvature(*(np.stack(arrays) for arrays in zip(*each)))

    def corrected_curvature(
        self,
        r: Number,
        vertices: Vertices = None,
        *,
        F: Any = None,
        normals: Any = None,
        unit: Unit = "mesh",
        workers: int = -1,
        progress: Progress = None,
    ) -> CorrectedCurvature:
        """Curvatures by the interpolated corrected curvature measures (Lachaud et al. 2020; in CGAL 6
        `interpolated_corrected_curvatures`): sums over the faces, without a fit.

        r : the radius of all rows. normals : (#V, 3), instead of those that follow from the faces. The faces are needed
        in any case. The other arguments are as for `curvature`. Returns a `CorrectedCurvature`: area, mean, gaussian,
        k1, k2, d1, d2, measures. As for `curvature`, a row does not depend on the others.
        """
        rows = None if vertices is None else _convert.vertices(vertices, self._count)
        radius = self._scale(unit) * _convert.radius(r)
        corners, offsets = self._face_arrays(F)
        surface = self._surface(F if normals is None else None, normals)
        with reporter(progress) as report:
            found = surface.corrected(
                corners, offsets=offsets, vertices=rows, radius=radius, threads=_convert.threads(workers), progress=report
            )
        return CorrectedCurvature(*found)

    def moments(
        self,
        r: Radii,
        vertices: Vertices = None,
        *,
        degree: int = 2,
        weights: Union[Literal["area"], ArrayLike, None] = None,
        F: Any = None,
        unit: Unit = "mesh",
        workers: int = -1,
        progress: Progress = None,
    ) -> Reals:
        """Sums of w x^i y^j z^k over each neighborhood for i + j + k <= degree, where x, y, z are the coordinates
        relative to the query vertex, and w the weights.

        r : a radius, or one for each row. degree : 0 to 4. weights, F : as for `aggregate`.
        Returns (#rows, 1, 4, 10, 20 or 35) float64: 1, x, y, z, x^2, xy, xz, y^2, yz, z^2, x^3, ..., the order of
        scikit-learn's PolynomialFeatures. They are accurate to 1e-13 of the sum of w |p|^(i + j + k). A row depends on
        index, weights, vertex and radius alone, bit for bit: not on the other rows of the call, earlier calls, threads
        or the processor. Only if the rows have different radii, those of the vertices nearby have an effect on the last
        bits.
        """
        rows, radii, threads = self._batch(vertices, r, self._scale(unit), workers)
        options = {"degree": _convert.integer(degree, "degree", 0, 4), "weights": area_weights(self, weights, F)}
        with reporter(progress) as report:
            return _core.moments(self._exact, rows, radii, **options, threads=threads, progress=report)

    def principal_components(
        self,
        r: Radii,
        vertices: Vertices = None,
        *,
        weights: Union[Literal["area"], ArrayLike, None] = None,
        F: Any = None,
        unit: Unit = "mesh",
        workers: int = -1,
        progress: Progress = None,
    ) -> PrincipalComponents:
        """The mean and the covariance of the positions of each neighborhood: normals, surface variation, and with
        weights="area" the integral invariants area, barycenter and covariance. The arguments are those of `moments`,
        and so is what a row depends on."""
        rows, radii, threads = self._batch(vertices, r, self._scale(unit), workers)
        options = {"weights": area_weights(self, weights, F), "threads": threads}
        with reporter(progress) as report:
            return PrincipalComponents(*_core.principal_components(self._exact, rows, radii, **options, progress=report))

    def features(
        self,
        r: Union[Number, Sequence[float], ArrayLike],
        vertices: Vertices = None,
        *,
        F: Any = None,
        kinds: Union[str, Sequence[str]] = "crease",
        filter: bool = True,
        unit: Unit = "mesh",
        workers: int = -1,
        progress: Progress = None,
    ) -> Reals:
        """Feature vectors over several radii, without unit, so that scales can be compared.

        r : radii, > 0, for example `geometric_radii(a, b, count)`.
        kinds : one name or several of crease, mean, gaussian, k1, k2, curvedness, shape_index, area, height, variation.
            See docs/curvature.md for what they mean.
        F, filter, unit, workers, progress : as for `curvature`.

        Returns (#radii, #rows, #kinds) float64, without the last axis if `kinds` is one name. NaN where there is no
        result. `persistence` finds over how many radii a feature lasts. As for
        `curvature`, a row does not depend on the others.
        """
        rows = None if vertices is None else _convert.vertices(vertices, self._count)
        array = np.atleast_1d(np.array(_convert.as_array(r, "r")))
        radii = self._scale(unit) * _convert.radii(array, len(array))
        names = (kinds,) if isinstance(kinds, str) else tuple(kinds)
        if not names:
            raise ValueError("kinds: there are none, expected at least one")
        options = {
            "radii": np.atleast_1d(radii),
            "kinds": [getattr(_core.Feature, _convert.choice(name, "kinds", _KINDS)) for name in names],
            "areas": area_weights(self, "area", F) if {"area", "height", "variation"} & set(names) else None,
            "filter": bool(filter),
            "threads": _convert.threads(workers),
        }
        with reporter(progress) as report:
            found = self._surface(F, None).features(rows, progress=report, **options)
        return found[..., 0] if isinstance(kinds, str) else found
