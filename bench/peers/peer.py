# SPDX-License-Identifier: MIT
"""The interface of all libraries that are compared."""
from importlib import metadata
from typing import NamedTuple

import numpy as np


class Mesh(NamedTuple):
    positions: np.ndarray  # #V by 3 float32
    triangles: np.ndarray  # #F by 3 int32
    path: str  # the same as PLY


class Peer:
    """One way to compute neighborhoods. It is built and queried in a process of its own, and only `query` is timed."""

    name = ""
    package = None  # its name on PyPI, for the version
    module = None  # the module to import before anything is timed
    answers = ""  # the kind of answer: "exact", "ball", or another
    remark = ""
    whole = False  # always answers all vertices at once
    largest_answer = None  # the most ids in the answers of one call, if more would not fit into memory or take too long

    def __init__(self, mesh, threads):
        """threads: 1, or -1 for all."""

    def query(self, vertices, radius):
        """The neighborhoods of `vertices` (int32; ignored if `whole`), in the form that this library returns."""
        raise NotImplementedError

    def rows(self, answer, vertices):
        """From the result of `query`: an array of ids for each of `vertices`, or None if there are no ids to
        compare."""
        return answer

    def version(self):
        return metadata.version(self.package) if self.package else ""

    def end(self):
        """Ends the processes that it has started."""


class OneByOne(Peer):
    """A library that answers one query at a time."""

    remark = "a call for each; one thread in any case"

    def query(self, vertices, radius):
        return [self.neighborhood(v, radius) for v in vertices]

    def neighborhood(self, v, radius):
        """An array of ids."""
        raise NotImplementedError


def rows_of(offsets, ids, places):
    return [ids[offsets[place]:offsets[place + 1]] for place in places]
