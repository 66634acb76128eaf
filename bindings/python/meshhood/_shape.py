# SPDX-License-Identifier: MIT
"""The shape of the surface in neighborhoods."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Literal, Optional, Union, get_args

import numpy as np

from . import _convert, _core
from ._aggregate import area_weights
from ._curvature import CorrectedCurvature, Curvature, PrincipalComponents
from ._held import Held
from ._progress import Progress
from ._rows import check_size, read_rows, result_dtype
from ._types import AnyVertices, Floats, Mask, Metric, Radii, Scales, Unit, Weights

if TYPE_CHECKING:
    from numpy.typing import DTypeLike

Kind = Literal[
    "crease", "mean", "gaussian", "k1", "k2", "curvedness", "shape_index", "area", "volume", "gap", "height",
    "variation",
]  # fmt: skip


class Shape(Held):
    """The part of `MeshIndex` that measures the surface."""

    def curvature(
        self,
        r: Optional[Radii] = None,
        vertices: AnyVertices = None,
        *,
        scales: Optional[Scales] = None,
        F: Any = None,
        normals: Any = None,
        like: Literal[None, "libigl"] = None,
        fit: Literal["quadric", "jet"] = "quadric",
        filter: bool = True,
        metric: Metric = "straight",
        walls: Mask = None,
        ignored: Mask = None,
        unit: Unit = "mesh",
        dtype: Optional[DTypeLike] = None,
        workers: int = -1,
        progress: Progress = None,
    ) -> Curvature:
        """Principal curvatures of `vertices` by a quadric that is fitted to their neighborhoods.

        r, vertices, scales, F, walls, ignored, metric, unit, workers, progress : see `MeshIndex`.
        dtype : of the numbers of the result, float64 unless given. All is computed in float64.
        normals : (#V, 3), instead of those of the faces; of any length. NaN where a vertex has none.
        like : "libigl" gives the values of igl.principal_curvature. Its shape operator is wrong where the fitted
            quadric is tilted against the normal, and its neighborhoods have the vertices nearer than `r`.
        fit : "quadric", through the vertex and over its tangent plane, or "jet", over the plane of the principal
            components of the neighborhood: with filter=False CGAL's Monge_via_jet_fitting of degrees 2 and 2.
        filter : fit only vertices whose normal makes an angle of less than 90 degrees with that of the query vertex, if
            there are at least six.

        A row depends on index, faces or normals, vertex, radius and masks alone, bit for bit: not on the other rows or
        scales of the call, earlier calls, threads or the processor.
        Returns a `Curvature`: k1, k2, d1, d2, state, count, and as properties mean, gaussian, shape_index, curvedness,
        ok. Raises ValueError without faces and normals. See docs/curvature.md for what the numbers mean, and for when
        to choose `corrected_curvature`.

        >>> index = meshhood.MeshIndex(V, F)
        >>> index.curvature(0.3)
        <meshhood.Curvature: 642 rows, 642 ok>
        >>> index.curvature(scales=[0.3, 0.5]).mean.shape
        (2, 642)
        """
        if like is not None:
            _convert.choice(like, "like", ("libigl",))
        if like is not None and fit == "jet":
            raise ValueError(f"like: {like!r}, expected None with fit='jet'")
        dtype = result_dtype(dtype)
        rows = read_rows(self, vertices, r, scales, metric, walls, ignored, unit, workers, progress)
        options: Any = {"libigl": like == "libigl", "jet": _convert.choice(fit, "fit", ("quadric", "jet")) == "jet"}
        surface = rows.index._surface(F, normals, instead=" or normals=")
        check_size((*rows.shape, 9), 8, None)  # with state and count
        found = rows.ask(surface.curvature, filter=bool(filter), **options)
        return Curvature(*(_of_type(rows.shaped(array), dtype) for array in found))

    def corrected_curvature(
        self,
        r: Optional[Radii] = None,
        vertices: AnyVertices = None,
        *,
        scales: Optional[Scales] = None,
        F: Any = None,
        normals: Any = None,
        metric: Metric = "straight",
        walls: Mask = None,
        ignored: Mask = None,
        unit: Unit = "mesh",
        dtype: Optional[DTypeLike] = None,
        workers: int = -1,
        progress: Progress = None,
    ) -> CorrectedCurvature:
        """Curvatures by the interpolated corrected curvature measures (Lachaud et al. 2020; in CGAL 6
        `interpolated_corrected_curvatures`): sums over the faces, without a fit.

        normals : (#V, 3), instead of those that follow from the faces. The faces are needed in any case.
        The other arguments are those of `curvature`. Returns a `CorrectedCurvature`: area, mean, gaussian, k1, k2, d1, d2,
        measures. As for `curvature`, a row does not depend on the others.

        >>> index = meshhood.MeshIndex(V, F)
        >>> index.corrected_curvature(scales=[0.3, 0.5]).mean.shape
        (2, 642)
        """
        dtype = result_dtype(dtype)
        rows = read_rows(self, vertices, r, scales, metric, walls, ignored, unit, workers, progress)
        surface = rows.index._surface(F, normals, needs_faces=True)
        check_size((*rows.shape, 23), 8, None)
        found = rows.ask(surface.corrected_curvature)
        return CorrectedCurvature(*(_of_type(rows.shaped(array), dtype) for array in found))

    def moments(
        self,
        r: Optional[Radii] = None,
        vertices: AnyVertices = None,
        *,
        scales: Optional[Scales] = None,
        degree: int = 2,
        weights: Weights = None,
        F: Any = None,
        metric: Metric = "straight",
        walls: Mask = None,
        ignored: Mask = None,
        unit: Unit = "mesh",
        dtype: Optional[DTypeLike] = None,
        workers: int = -1,
        progress: Progress = None,
    ) -> Floats:
        """Sums of w x^i y^j z^k over each neighborhood for i + j + k <= degree, where x, y, z are the coordinates
        relative to the query vertex, and w the weights.

        r, vertices, scales, walls, ignored, metric, unit, workers, progress : see `MeshIndex`.
        degree : 0 to 4. weights, F : as for `aggregate`. dtype : as for `curvature`.
        Returns (#rows, 1, 4, 10, 20 or 35), with a leading axis if there are scales: 1, x, y, z, x^2, xy, xz,
        y^2, yz, z^2, x^3, ..., the order of scikit-learn's PolynomialFeatures. They are accurate to 1e-13 of the sum of
        w |p|^(i + j + k). A row depends on index, weights, vertex, radius and masks alone, bit for bit: not on other
        rows of the call, earlier calls, threads or the processor.

        >>> meshhood.MeshIndex(V, F).moments(0.3).shape
        (642, 10)
        """
        dtype = result_dtype(dtype)
        rows = read_rows(self, vertices, r, scales, metric, walls, ignored, unit, workers, progress)
        options = {"degree": _convert.integer(degree, "degree", 0, 4), "weights": area_weights(self, weights, F)}
        check_size((*rows.shape, math.comb(options["degree"] + 3, 3)), 8, None)
        found = rows.ask(_core.moments, rows.index._exact, **options)
        return _of_type(rows.shaped(found), dtype)

    def principal_components(
        self,
        r: Optional[Radii] = None,
        vertices: AnyVertices = None,
        *,
        scales: Optional[Scales] = None,
        weights: Weights = None,
        F: Any = None,
        metric: Metric = "straight",
        walls: Mask = None,
        ignored: Mask = None,
        unit: Unit = "mesh",
        dtype: Optional[DTypeLike] = None,
        workers: int = -1,
        progress: Progress = None,
    ) -> PrincipalComponents:
        """The mean and the covariance of the positions of each neighborhood: normals, surface variation, and with
        weights="area" the integral invariants area, barycenter and covariance. The arguments are those of `moments`, and so
        is what a row depends on.

        >>> found = meshhood.MeshIndex(V, F).principal_components(0.3, weights="area")
        >>> found.normal.shape, found.surface_variation.shape
        ((642, 3), (642,))
        """
        dtype = result_dtype(dtype)
        rows = read_rows(self, vertices, r, scales, metric, walls, ignored, unit, workers, progress)
        check_size((*rows.shape, 16), 8, None)
        found = rows.ask(_core.principal_components, rows.index._exact, weights=area_weights(self, weights, F))
        return PrincipalComponents(*(_of_type(rows.shaped(array), dtype) for array in found))

    def features(
        self,
        r: Optional[Radii] = None,
        vertices: AnyVertices = None,
        *,
        scales: Optional[Scales] = None,
        kinds: Union[Kind, Sequence[Kind]] = "crease",
        F: Any = None,
        filter: bool = True,
        metric: Metric = "straight",
        walls: Mask = None,
        ignored: Mask = None,
        unit: Unit = "mesh",
        dtype: Optional[DTypeLike] = None,
        workers: int = -1,
        progress: Progress = None,
    ) -> Floats:
        """Feature vectors without unit, so that scales can be compared.

        r, vertices, scales, F, walls, ignored, metric, unit, workers, progress : see `MeshIndex`; scales are for example
            `geometric_radii(a, b, count)`. Radii are > 0. With metric="rings", `r` edges count as `r` times the mean
            length of an edge.
        kinds : one name or several of crease, mean, gaussian, k1, k2, curvedness, shape_index, area, volume, gap,
            height, variation. See docs/curvature.md for what they mean. area, volume and gap are those of `invariants`
            and `gaps`: of the surface, for metric="straight" alone.
        filter, dtype : as for `curvature`.

        Returns (#scales, #rows, #kinds), without the first axis if there is one `r`, and without the last if
        `kinds` is one name. NaN where there is no result. `persistence` finds over how many scales a feature lasts. As
        for `curvature`, a row does not depend on the others. scikit-learn and networks take vertices first, (#rows,
        #scales * #kinds), as in the example.

        >>> index = meshhood.MeshIndex(V, F)
        >>> found = index.features(scales=meshhood.geometric_radii(0.2, 0.8, 3), kinds=("crease", "area"))
        >>> found.shape, found.transpose(1, 0, 2).reshape(len(V), -1).shape
        ((3, 642, 2), (642, 6))
        """
        dtype = result_dtype(dtype)
        rows = read_rows(self, vertices, r, scales, metric, walls, ignored, unit, workers, progress)
        chosen = [getattr(_core.Feature, name) for name in _convert.some_choices(kinds, "kinds", get_args(Kind))]
        check_size((*rows.shape, len(chosen)), 8, None)
        found = rows.ask(rows.index._surface(F).features, kinds=chosen, filter=bool(filter))
        found = _of_type(rows.shaped(found), dtype)
        return found[..., 0] if isinstance(kinds, str) else found


def _of_type(array: Any, dtype: Any) -> Any:
    """Numbers in this type; other arrays as they are."""
    return array.astype(dtype, copy=False) if array.dtype == np.float64 else array
