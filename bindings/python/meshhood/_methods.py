# SPDX-License-Identifier: MIT
"""Who answers: the methods of an index, by what callers name them."""

from __future__ import annotations

import threading
from dataclasses import dataclass
from typing import Literal, Union

from . import _convert, _core

_MOST_LEVELS = 64  # of no mesh are there more
_SCANS = {"bfs": _core.bfs, "ball": _core.ball}


@dataclass(frozen=True)
class Paper:
    """The approximate search of the paper with parameters of one's own: `method=Paper(factor=20)`.

    Of the hierarchy of clusters (section 3.2), which is built when first asked for:
    levels : how many to compute, 1 to 64, the one of single vertices included. It has fewer where every component of
        the mesh becomes one cluster before; 64 always goes on until then.
    discard : how many of the lowest to drop afterwards, 0 to 64. The highest is kept in any case.
    fusion_growth : fusion on level l dissolves clusters of fewer than fusion_growth ** l vertices. Finite, >= 0.

    Of the search (3.3):
    factor : a query begins on the first level whose clusters have a mean radius of at least radius / factor: more means
        smaller clusters, more of them, and fewer vertices that should not be in the answer. Finite, > 0.

    The defaults are the paper's. Raises ValueError or TypeError, naming the parameter.
    """

    levels: int = 5
    discard: int = 2
    fusion_growth: float = 4.0
    factor: float = 10.0

    def __post_init__(self):
        for name, lowest in (("levels", 1), ("discard", 0)):
            object.__setattr__(self, name, _convert.integer(getattr(self, name), name, lowest, _MOST_LEVELS))
        for name, zero in (("fusion_growth", True), ("factor", False)):
            object.__setattr__(self, name, _convert.finite(getattr(self, name), name, or_zero=zero))


Method = Union[Literal["exact", "paper", "bfs", "ball"], Paper]


class Methods(dict):
    """By name, or `Paper`. Each is made from the index when it is first asked for, and kept."""

    def __init__(self, exact):
        super().__init__(exact=exact)
        self._graph = None
        self._hierarchies = {}
        self._making = threading.Lock()

    def __missing__(self, method):
        with self._making:
            if method not in self:
                self[method] = self._make(method)
        return self[method]

    def _make(self, method):
        if method in _SCANS:
            return _SCANS[method](self._mesh_graph())
        paper = Paper() if method == "paper" else method
        if not isinstance(paper, Paper):
            raise ValueError(f"method: {method!r}, expected 'exact', 'paper', 'bfs', 'ball' or a Paper")
        return _core.paper(self._hierarchy(paper.levels, paper.discard, paper.fusion_growth), factor=paper.factor)

    def _hierarchy(self, levels, discard, fusion_growth):
        options = levels, discard, fusion_growth
        if options not in self._hierarchies:
            self._hierarchies[options] = _core.hierarchy(
                self._mesh_graph(), levels=levels, discard=discard, fusion_growth=fusion_growth
            )
        return self._hierarchies[options]

    def _mesh_graph(self):
        if self._graph is None:
            self._graph = _core.graph(self["exact"])
        return self._graph
