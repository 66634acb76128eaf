# SPDX-License-Identifier: MIT
"""The types of arguments and results that several modules use."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Literal, Union, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

Ids = NDArray[np.int32]
Offsets = Union[NDArray[np.int32], NDArray[np.int64]]
Counts = NDArray[np.int64]
Reals = NDArray[np.float64]
Floats = Union[NDArray[np.float32], NDArray[np.float64]]
Vertex = Union[int, "np.integer[Any]"]
Vertices = Union[Sequence[int], "NDArray[np.integer[Any]]", NDArray[np.bool_], None]
AnyVertices = Union[Vertex, Vertices]
Number = Union[float, "np.floating[Any]", "np.integer[Any]"]
Scales = Union[Sequence[float], "NDArray[np.floating[Any]]", "NDArray[np.integer[Any]]"]
Radii = Union[Number, Scales]
Mask = Union[NDArray[np.bool_], NDArray[np.integer[Any]], Sequence[int], None]
Unit = Literal["mesh", "edge"]
Metric = Literal["straight", "path", "surface", "rings", "space"]
Sort = Literal["index", "id", "distance"]
Weights = Union[Literal["area"], ArrayLike, None]

METRICS: tuple[str, ...] = get_args(Metric)
