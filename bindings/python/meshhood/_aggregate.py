# SPDX-License-Identifier: MIT
"""Values over neighborhoods: converts arguments and results of `MeshIndex.aggregate`."""

from __future__ import annotations

from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from . import _convert, _core
from ._mesh import mesh_arrays
from ._progress import reporter

Reduce = Literal["sum", "mean", "min", "max", "var", "std", "count"]
Kernel = Literal["epanechnikov", "biweight"]

_REDUCTIONS = ("sum", "mean", "min", "max", "var", "std", "count")


def vertex_areas(V: Any, F: Any = None) -> NDArray[np.float64]:
    """The area that each vertex represents: each face gives equal shares to its corners, a third of a triangle. (#V,)
    float64, in the square of the unit of V. V and F as for `MeshIndex`."""
    positions, corners, offsets = mesh_arrays(V, F)
    return _core.vertex_areas(positions, corners, offsets=offsets)


def aggregate(
    index, values, r, scale, vertices, F, *, reduce, weights, kernel, nan, nesting, ddof, workers, max_bytes, progress
):
    """See `MeshIndex.aggregate`; `scale` is the unit of `r`."""
    count = len(index)
    values = _values(values, count)
    radii = scale * _radii(r)
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
            index._exact,
            values=columns,
            weights=area_weights(weights, index, F),
            vertices=rows,
            progress=report,
            **options,
        )
    result = result.reshape(shape)
    return result if result.ndim else float(result)


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


def area_weights(weights, index, F):
    """`weights` as float64, computed from the faces if they are "area"; None if there are none."""
    if weights is None:
        return None
    if isinstance(weights, str):
        _convert.choice(weights, "weights", ("area",))
        corners, offsets = index._face_arrays(F)
        return _core.vertex_areas(index.positions, corners, offsets=offsets)
    array = _numbers(weights, "weights", "biuf")
    if array.shape != (len(index),):
        raise ValueError(f"weights: expected an array of shape ({len(index)},), not {array.shape}")
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
