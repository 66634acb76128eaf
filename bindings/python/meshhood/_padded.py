# SPDX-License-Identifier: MIT
"""Rows of different lengths as one array with a mask, as networks take them."""

from __future__ import annotations

import math
from typing import Any, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _convert
from ._rows import check_size


def padded(
    indptr: ArrayLike,
    values: ArrayLike,
    *,
    width: Optional[int] = None,
    truncate: bool = False,
    fill: Any = 0,
    max_bytes: Optional[int] = None,
) -> tuple[NDArray[Any], NDArray[np.bool_]]:
    """The rows of a result as one array, (#rows, width, ...), and which of its entries belong to a row: bool, (#rows,
    width).

    indptr, values : of the result of `MeshIndex.neighborhoods` or `discs`: row i is values[indptr[i]:indptr[i + 1]].
        `values` are the ids, the distances, or an array of such rows, as features[indices]: a call for each.
    width : the length of each row. By default, that of the longest.
    truncate : keep the first `width` entries of longer rows, the nearest if rows are in order of distance (`discs`, or
        neighborhoods with sort="distance"). By default, a longer row is an error.
    fill : what the other entries hold. 0 is an id of every mesh, so that such rows can be used as indices.
    max_bytes : refuse a larger result with MemoryError; by default, one larger than the memory that is free.

    The arrays are new; the first has the dtype of `values`. Cost: O(#rows width + #values). Raises ValueError, naming the
    argument, and MemoryError.

    >>> indptr, indices = meshhood.MeshIndex(V, F).neighborhoods(0.3)
    >>> ids, mask = meshhood.padded(indptr, indices)
    >>> ids.shape == mask.shape, ids.dtype == indices.dtype
    (True, True)
    >>> indptr, ids, distances = meshhood.MeshIndex(V, F).discs(0.3)
    >>> (ids, mask), (distances, _) = meshhood.padded(indptr, ids), meshhood.padded(indptr, distances, fill=np.inf)
    >>> ids.shape == distances.shape == mask.shape
    True
    """
    ends, rows, one = (_convert.as_array(*each) for each in ((indptr, "indptr"), (values, "values"), (fill, "fill")))
    if ends.ndim != 1 or len(ends) == 0 or ends.dtype.kind not in "iu":
        raise ValueError(f"indptr: expected #rows + 1 integers, not {ends.dtype} of shape {ends.shape}")
    if rows.ndim == 0 or ends[0] != 0 or ends[-1] != len(rows):
        size = len(rows) if rows.ndim else "a single one"
        raise ValueError(f"indptr: runs from {ends[0]} to {ends[-1]}, expected from 0 to the number of values, {size}")
    lengths = np.diff(ends.astype(np.int64))
    if (lengths < 0).any():
        row = int(np.argmax(lengths < 0))
        raise ValueError(f"indptr: descends at {row + 1}, from {ends[row]} to {ends[row + 1]}")
    if width is None:
        width = int(lengths.max(initial=0))
    width = _convert.integer(width, "width", 0, 2**31 - 1)
    if not truncate and (lengths > width).any():
        row = int(np.argmax(lengths > width))
        raise ValueError(f"width: {width}, but row {row} has {lengths[row]} values; truncate=True keeps the first of them")
    with np.errstate(invalid="ignore"):  # as floats, None is NaN; as integers, other objects would be rounded
        filler = one if one.dtype.kind == "O" and rows.dtype.kind != "f" else one.astype(rows.dtype)
    if filler.dtype != rows.dtype or one.ndim or (rows.dtype.kind != "f" and filler != one):
        raise ValueError(f"fill: {fill!r}, expected one value of {rows.dtype}")
    shape = (len(lengths), width)
    check_size(shape, rows.itemsize * math.prod(rows.shape[1:]) + 1, max_bytes)
    mask = np.arange(width) < lengths[:, None]
    array = np.full((*shape, *rows.shape[1:]), filler, rows.dtype)
    place = np.arange(len(rows)) - np.repeat(ends[:-1], lengths)
    array[mask] = rows[place < width]
    return array, mask
