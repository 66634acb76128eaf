# SPDX-License-Identifier: MIT
"""Values over neighborhoods."""

from __future__ import annotations

from typing import Any, Literal, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _convert, _core
from ._held import Held
from ._mesh import mesh_arrays
from ._progress import Progress, reporter
from ._types import Number, Radii, Reals, Unit, Vertex, Vertices

Reduce = Literal["sum", "mean", "min", "max", "var", "std", "count"]
Kernel = Literal["epanechnikov", "biweight"]

_REDUCTIONS = ("sum", "mean", "min", "max", "var", "std", "count")


def vertex_areas(V: Any, F: Any = None) -> NDArray[np.float64]:
    """The area that each vertex represents: each face gives equal shares to its corners, a third of a triangle. (#V,)
    float64, in the square of the unit of V. V and F as for `MeshIndex`."""
    positions, corners, offsets = mesh_arrays(V, F)
    return _core.vertex_areas(positions, corners, offsets=offsets)


class Aggregates(Held):
    """The part of `MeshIndex` that computes values over neighborhoods."""

    def aggregate(
        self,
        values: ArrayLike,
        r: Radii,
        reduce: Reduce = "mean",
        *,
        weights: Union[Literal["area"], ArrayLike, None] = None,
        kernel: Optional[Kernel] = None,
        vertices: Union[Vertex, Vertices] = None,
        nan: Literal["propagate", "omit"] = "propagate",
        nesting: Literal["own", "patch"] = "own",
        ddof: int = 0,
        F: Any = None,
        unit: Unit = "mesh",
        workers: int = -1,
        max_bytes: Optional[int] = None,
        progress: Progress = None,
    ) -> Any:
        """A sum, a mean or another aggregate of values over the exact neighborhood of each vertex.

        values : (#V,) or (#V, ...), numbers or bools; each channel by itself. Copied as float64.
        r : the radius, >= 0 or inf, or several. A vertex at exactly `r` is inside.
        reduce : "sum", "mean", "min", "max", "var", "std" or "count".
        weights : (#V,) finite and >= 0, for sum, mean, var and std; "area" for `vertex_areas`. A vertex of weight 0
            is left out.
        kernel : for sum and mean, how the weight falls with the distance d. None: not at all; "epanechnikov":
            1 - (d/r)^2; "biweight": (1 - (d/r)^2)^2, which is close to a Gaussian of the standard deviation 0.4 r.
        vertices : a vertex, a sequence of vertices, a bool mask (#V,), or None for all.
        nan : "propagate", a neighborhood with a NaN gives NaN; "omit", NaN marks a missing value, which is left out.
        nesting : what several radii mean. "own": each has its own neighborhoods. "patch": the neighborhoods of the
            largest, and of them the vertices within each smaller radius.
        ddof : "var" and "std" divide by the number of values minus this, 0 or 1.
        F : other faces than those that the index keeps, for weights="area".
        unit, workers, max_bytes, progress : as for `query_ball`. The result does not depend on `workers`.

        Returns float64: an axis of radii if `r` is a sequence, one of vertices unless `vertices` is a single one, then
        the axes of `values` but the first. NaN where a neighborhood has no values; 0 for their sum.

        No ids are listed. The cost is that of `count` for all vertices and a little for each channel. Sums
        are exact to 1e-14 of the sum of the absolute terms, with a kernel to 1e-13 of the sum without it. A result does
        not depend on the other vertices of the call, bit for bit.
        """
        count = self._count
        values = _values(values, count)
        radii = self._scale(unit) * _radii(r)
        options = {
            "radii": np.atleast_1d(radii).tolist(),
            "reduce": getattr(_core.Reduce, _convert.choice(reduce, "reduce", _REDUCTIONS)),
            "kernel": getattr(_core.SmoothingKernel, _kernel(kernel)),
            "missing": getattr(_core.MissingValues, _convert.choice(nan, "nan", ("propagate", "omit"))),
            "nesting": getattr(_core.Nesting, _convert.choice(nesting, "nesting", ("own", "patch"))),
            "ddof": _convert.integer(ddof, "ddof", 0, 1),
            "threads": _convert.threads(workers),
            "max_bytes": _convert.max_bytes(max_bytes),
        }
        if vertices is None:
            rows, row_shape = None, (count,)
        elif _convert.is_single(vertices):
            rows, row_shape = np.array([_convert.vertex(vertices, count)], np.int32), ()
        else:
            rows = _convert.vertices(vertices, count)
            row_shape = (len(rows),)
        shape = radii.shape + row_shape + values.shape[1:]
        if 0 in values.shape[1:]:
            return np.empty(shape)
        columns = values.reshape(count, int(np.prod(values.shape[1:])))
        with reporter(progress) as report:
            result = _core.aggregate(
                self._exact,
                values=columns,
                weights=area_weights(self, weights, F),
                vertices=rows,
                progress=report,
                **options,
            )
        result = result.reshape(shape)
        return result if result.ndim else float(result)

    def smooth(
        self,
        values: ArrayLike,
        fwhm: Number,
        *,
        weights: Union[Literal["area"], ArrayLike, None] = None,
        nan: Literal["propagate", "omit"] = "propagate",
        F: Any = None,
        unit: Unit = "mesh",
        workers: int = -1,
        max_bytes: Optional[int] = None,
        progress: Progress = None,
    ) -> Reals:
        """The values smoothed by a biweight that is close to a Gaussian of this full width at half maximum.

        fwhm : > 0, a straight-line distance in `unit`. Vertices farther away than 1.06 fwhm, or not connected within
            that distance, have no influence: nothing is smoothed across a gap.
        weights : None counts each vertex once; "area" weighs it by its area, and makes the result independent of how
            densely the surface is sampled.
        See `aggregate`, which this calls with reduce="mean" and kernel="biweight". Returns float64 of the shape of
        `values`.
        """
        fwhm = _convert.finite(fwhm, "fwhm", or_zero=False)
        return self.aggregate(
            values,
            _core.smoothing_radius(fwhm),
            kernel="biweight",
            weights=weights,
            nan=nan,
            F=F,
            unit=unit,
            workers=workers,
            max_bytes=max_bytes,
            progress=progress,
        )


def _values(values, count):
    """`values` as float64 in C order."""
    array = _numbers(values, "values", "biuf")
    if array.ndim == 0 or array.shape[0] != count:
        raise ValueError(f"values: expected an array of shape ({count},) or ({count}, ...), not {array.shape}")
    return array


def _radii(r):
    array = _numbers(r, "r", "iuf")
    if array.ndim > 1 or array.size == 0:
        raise ValueError(f"r: expected one number or a list of them, not an array of shape {array.shape}")
    wrong = np.flatnonzero(~(array >= 0))
    if wrong.size:
        raise ValueError(f"r: radius {np.atleast_1d(array)[wrong[0]]}, expected a number >= 0")
    return array


def area_weights(index: Held, weights: Any, F: Any) -> Any:
    """`weights` as float64, computed from the faces if they are "area"; None if there are none."""
    if weights is None:
        return None
    if isinstance(weights, str):
        _convert.choice(weights, "weights", ("area",))
        corners, offsets = index._face_arrays(F)
        return _core.vertex_areas(index._methods.graph().positions, corners, offsets=offsets)
    array = _numbers(weights, "weights", "biuf")
    if array.shape != (index._count,):
        raise ValueError(f"weights: expected an array of shape ({index._count},), not {array.shape}")
    return array


def _kernel(kernel):
    if kernel is None:
        return "box"
    return _convert.choice(kernel, "kernel", ("epanechnikov", "biweight"))


def _numbers(values, name, kinds):
    """`values` as a new float64 array in C order. A copy, because a `progress` function or another thread may write to
    `values` after they are checked."""
    array = _convert.as_array(values, name)
    if array.dtype.kind not in kinds:
        raise TypeError(f"{name}: expected numbers, not {array.dtype}")
    return np.array(array, dtype=np.float64, order="C")
