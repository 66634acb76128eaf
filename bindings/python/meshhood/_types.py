# SPDX-License-Identifier: MIT
"""The types of arguments and results that several modules use."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Literal, Optional, TypedDict, Union

import numpy as np
from numpy.typing import NDArray

from ._methods import Method
from ._progress import Progress

Ids = NDArray[np.int32]
Offsets = NDArray[np.int64]
Counts = NDArray[np.int64]
Reals = NDArray[np.float64]
Vertex = Union[int, "np.integer[Any]"]
Vertices = Union[Sequence[int], "NDArray[np.integer[Any]]", NDArray[np.bool_], None]
Number = Union[float, "np.floating[Any]", "np.integer[Any]"]
Radii = Union[Number, Sequence[float], "NDArray[np.floating[Any]]", "NDArray[np.integer[Any]]"]
Unit = Literal["mesh", "edge"]
Metric = Literal["straight", "path"]


class CountOptions(TypedDict, total=False):
    """The options of `MeshIndex.count`."""

    method: Method
    metric: Metric
    unit: Unit
    workers: int
    progress: Progress


class BallOptions(CountOptions, total=False):
    """The options of `MeshIndex.query_ball`, but `return_distance`, on which the type of the result depends."""

    sort: bool
    max_bytes: Optional[int]


class RegionOptions(TypedDict, total=False):
    """The options of `MeshIndex.query_region`, but `return_distance`, on which the type of the result depends."""

    seeds: Union[int, "np.integer[Any]", Sequence[int], "NDArray[np.integer[Any]]", None]
    face: Union[int, "np.integer[Any]", None]
    walls: Optional[NDArray[np.bool_]]
    ignored: Optional[NDArray[np.bool_]]
    sort: bool
    metric: Metric
    unit: Unit
