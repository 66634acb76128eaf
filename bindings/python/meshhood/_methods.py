# SPDX-License-Identifier: MIT
"""The methods that answer queries, by the names that callers use."""

from __future__ import annotations

import os
import threading
from dataclasses import dataclass
from typing import Any, Literal, Union

from . import _convert, _core

_MOST_LEVELS = 64  # no mesh has more


@dataclass(frozen=True)
class Paper:
    """The approximate search of the paper with other parameters: `method=Paper(radius_ratio=20)`.

    Parameters of the hierarchy of clusters (section 3.2), which is built at the first use:
    levels : number of levels to compute, 1 to 64, including the level of single vertices. The hierarchy has fewer if
        every component of the mesh becomes one cluster before that; 64 always continues until then.
    discard : number of lowest levels to drop afterwards, 0 to 64. The highest level is always kept.
    fusion_growth : fusion on level l dissolves clusters of fewer than fusion_growth ** l vertices. Finite, >= 0.

    Parameter of the search (section 3.3):
    radius_ratio : the paper's factor f. A query begins on the first level whose clusters have a mean radius of at least
        radius / radius_ratio. A larger ratio means smaller clusters, more of them, and fewer vertices that do not
        belong to the answer. Finite, > 0.

    The defaults are those of the paper. Raises ValueError or TypeError, naming the parameter.

    >>> near = meshhood.MeshIndex(V, F).neighborhood(42, 0.3, method=meshhood.Paper(radius_ratio=20))
    """

    levels: int = 5
    discard: int = 2
    fusion_growth: float = 4.0
    radius_ratio: float = 10.0

    def __post_init__(self) -> None:
        for name, lowest in (("levels", 1), ("discard", 0)):
            object.__setattr__(self, name, _convert.integer(getattr(self, name), name, lowest, _MOST_LEVELS))
        for name, zero in (("fusion_growth", True), ("radius_ratio", False)):
            object.__setattr__(self, name, _convert.finite(getattr(self, name), name, or_zero=zero))


Method = Union[Literal["exact", "paper", "bfs", "ball"], Paper]


def core_metric(metric: str) -> Any:
    """By this the index of `Held._searched` is searched."""
    return _core.Metric.path if metric == "surface" else getattr(_core.Metric, metric)


class Methods(dict):
    """The methods of an index, by name, `Paper` or metric. Each is made at its first use and then kept."""

    def __init__(self, exact, whole=None):
        """`whole`: of an index with masks, the methods of that without."""
        super().__init__(exact=exact)
        self._whole = whole
        self._graph = None
        self._positions = None
        self._mean_edge_length = None
        self._hierarchies = {}
        self._locks = {}

    def __missing__(self, method):
        with self._making():
            if method not in self:
                self[method] = self._make(method)
        return self[method]

    def _making(self):
        """The lock of this process. Each process has its own, because a fork may copy a lock that is held by a thread
        which the child does not have. Reentrant, because a signal handler may need a method while its thread makes
        another."""
        return self._locks.setdefault(os.getpid(), threading.RLock())

    def _make(self, method):
        if isinstance(method, _core.Metric):
            return _core.by_metric(self["exact"], method)
        if method == "ball":
            return self[_core.Metric.space]
        if self._whole is not None and (method in ("bfs", "paper") or isinstance(method, Paper)):
            raise ValueError(f"method: {method!r}, expected 'exact' with walls or ignored vertices")
        if method == "bfs":
            return _core.bfs(self.graph())
        paper = Paper() if method == "paper" else method
        if not isinstance(paper, Paper):
            raise ValueError(f"method: {method!r}, expected 'exact', 'paper', 'bfs', 'ball' or a Paper")
        hierarchy = self._hierarchy(paper.levels, paper.discard, paper.fusion_growth)
        return _core.paper(hierarchy, radius_ratio=paper.radius_ratio)

    def _hierarchy(self, levels, discard, fusion_growth):
        options = levels, discard, fusion_growth
        if options not in self._hierarchies:
            self._hierarchies[options] = _core.hierarchy(
                self.graph(), levels=levels, discard=discard, fusion_growth=fusion_growth
            )
        return self._hierarchies[options]

    @property
    def positions(self):
        """The positions in the order of the mesh, extracted from the index at the first use."""
        if self._whole is not None:
            return self._whole.positions
        with self._making():
            if self._positions is None:
                self._positions = _core.positions(self["exact"])
            return self._positions

    def graph(self):
        """The mesh as a graph, extracted from the index at the first use."""
        if self._whole is not None:
            return self._whole.graph()
        with self._making():
            if self._graph is None:
                self._graph = _core.graph(self["exact"])
            return self._graph

    @property
    def known_mean_edge_length(self):
        """None if it has not been computed yet, which takes as long as a pass over all edges."""
        return self._mean_edge_length if self._whole is None else self._whole.known_mean_edge_length

    @property
    def mean_edge_length(self):
        if self._whole is not None:
            return self._whole.mean_edge_length
        with self._making():
            if self._mean_edge_length is None:
                self._mean_edge_length = self.graph().mean_edge_length()
            return self._mean_edge_length
