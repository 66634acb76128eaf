# SPDX-License-Identifier: MIT
"""What every peer offers."""
from importlib import metadata
from typing import NamedTuple

import numpy as np


class Mesh(NamedTuple):
    positions: np.ndarray  # #V by 3 float32
    triangles: np.ndarray  # #F by 3 int32
    path: str  # the same as PLY


class Peer:
    """One way to ask for neighborhoods. It is built and asked in a process of its own, and `ask` alone is timed."""

    name = ""
    package = None  # as PyPI calls it, for the version
    module = None  # what it is imported as, before any time is taken
    answers = ""  # which question: "exact", "ball", or what else
    remark = ""
    whole = False  # answers for all vertices at once, and for nothing less
    largest_answer = None  # ids of all answers of one call, where more would not fit into memory or take too long

    def __init__(self, mesh, threads):
        """threads: 1, or -1 for all."""

    def ask(self, vertices, radius):
        """The neighborhoods of `vertices` (int32; ignored by a peer that answers for all), in whatever form this peer has."""
        raise NotImplementedError

    def rows(self, answer, vertices):
        """Of what `ask` gave: an array of ids for each of `vertices`, or None where it has none to compare."""
        return answer

    def version(self):
        return metadata.version(self.package) if self.package else ""

    def end(self):
        """Ends what it has started."""


class OneByOne(Peer):
    """A peer that answers for one neighborhood at a time."""

    remark = "a call for each; one thread in any case"

    def ask(self, vertices, radius):
        return [self.neighborhood(v, radius) for v in vertices]

    def neighborhood(self, v, radius):
        """An array of ids."""
        raise NotImplementedError


def rows_of(offsets, ids, places):
    return [ids[offsets[place]:offsets[place + 1]] for place in places]
