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
    fusion_growth : fusion on level l dissolves clusters of fewer than fusion_growth ** l vertices, and those
        with a single child. Finite, >= 0.

    Parameter of the search (section 3.3):
    radius_ratio : the paper's factor f. A query begins on the first level whose clusters have a mean radius of at least
        radius / radius_ratio. A larger ratio means smaller clusters, more of them, and fewer vertices that do not
        belong to the neighborhood. Finite, > 0.

    The defaults are those of the paper, which states no `fusion_growth`. Raises ValueError or TypeError, naming the
    parameter.

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


def is_exact(method: Any) -> bool:
    if not isinstance(method, (str, Paper)):
        raise TypeError(f"method: expected a name or a Paper, not {type(method).__name__}")
    return method == "exact"


def core_metric(metric: str) -> Any:
    """By this the index of `Held._searched` is searched."""
    return _core.Metric.path if metric == "surface" else getattr(_core.Metric, metric)


class Methods(dict):
    """The methods of an index, by name, `Paper` or metric, and what they are made of. Each is made at its first use and
    then kept."""

    def __init__(self, exact, whole=None):
        """`whole`: of an index with masks, the methods of that without."""
        super().__init__(exact=exact)
        self._whole = whole
        self._parts = {}
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
            masks = "walls, ignored vertices or vertices without a position (NaN)"
            raise ValueError(f"method: {method!r}, expected 'exact' or 'ball' with {masks}")
        if method == "bfs":
            return _core.bfs(self.graph())
        paper = Paper() if method == "paper" else method
        if not isinstance(paper, Paper):
            raise ValueError(f"method: {method!r}, expected 'exact', 'paper', 'bfs', 'ball' or a Paper")
        options = {"levels": paper.levels, "discard": paper.discard, "fusion_growth": paper.fusion_growth}
        hierarchy = self._part(tuple(options.values()), lambda whole: _core.hierarchy(whole.graph(), **options))
        return _core.paper(hierarchy, radius_ratio=paper.radius_ratio)

    def _part(self, name, make):
        """What does not depend on masks. `make` is called with the methods of the index without."""
        if self._whole is not None:
            return self._whole._part(name, make)
        with self._making():
            if name not in self._parts:
                self._parts[name] = make(self)
            return self._parts[name]

    @property
    def positions(self):
        """In the order of the mesh."""
        return self._part("positions", lambda whole: _core.positions(whole["exact"]))

    def graph(self):
        """The mesh as a graph."""
        return self._part("graph", lambda whole: _core.graph(whole["exact"]))

    @property
    def mean_edge_length(self):
        return self._part("mean edge", lambda whole: whole.graph().mean_edge_length())

    @property
    def known_mean_edge_length(self):
        """None if it has not been computed yet, which takes as long as a pass over all edges."""
        return self._parts.get("mean edge") if self._whole is None else self._whole.known_mean_edge_length
