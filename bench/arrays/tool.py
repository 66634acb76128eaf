# SPDX-License-Identifier: MIT
"""The interface of all tools that answer for every vertex of a mesh in memory."""
import copy
import time
from typing import NamedTuple

import numpy as np

QUESTIONS = ("counts", "ids", "mean", "curvature")
PIECE = 10_000  # vertices from which the time for a large mesh is estimated


class Scale(NamedTuple):
    edges: int  # the radius in mean edges; the rings of a tool that counts rings
    radius: float  # in the unit of the positions


class Tool:
    """A tool answers a question by the method of its name, from what `build` has made of the arrays. Both are timed."""

    name = ""
    package = ""  # its name on PyPI
    module = ""  # imported before anything is timed
    answers = "exact"  # or "ball", "k rings" ...
    remark = ""
    questions = QUESTIONS
    real, integer = np.float32, np.int32  # what it takes without a conversion

    def __init__(self, mesh, threads):
        """mesh: see bench/peers/peer.py. threads: 1 or 2; the process has as many processors."""
        self.V, self.F = mesh.positions.astype(self.real), mesh.triangles.astype(self.integer)
        self.signal = np.arange(len(self.V), dtype=float)
        self.threads = threads

    def build(self):
        """What all answers need, whatever the question; None if there is nothing."""

    def run(self, question, scale):
        """Seconds to build, seconds to answer, and the vertices found for each vertex, on average; None if the tool does
        not tell."""
        begin = time.perf_counter()
        built = self.build()
        between = time.perf_counter()
        answer = getattr(self, question)(built, scale)
        end = time.perf_counter()
        return between - begin, end - between, self.found(question, answer)

    def found(self, question, answer):
        """answer: by default, the numbers themselves, or offsets and ids."""
        if question == "counts":
            return float(np.mean(answer))
        return len(answer[1]) / len(self.V) if question == "ids" else None

    def expected_seconds(self, question, scale):
        """For all vertices, as a piece of the mesh suggests; None for a small mesh."""
        if len(self.V) < 10 * PIECE:
            return None
        part = self.part()
        seconds = min(sum(part.run(question, scale)[:2]) for _ in range(2))  # the first call may start threads
        return seconds / len(part.V) * len(self.V)

    def part(self):
        """The tool with a piece of a large mesh."""
        part = copy.copy(self)
        if len(self.V) >= 10 * PIECE:
            part.V, part.F = piece(self.V, self.F)
            part.signal = self.signal[:len(part.V)]
        return part

    def end(self):
        """Ends the processes that it has started."""


def piece(V, F):
    """The vertices nearest to one of them, and the faces between them."""
    near = np.argpartition(((V - V[len(V) // 2])**2).sum(axis=1), PIECE)[:PIECE]
    number = np.full(len(V), -1, F.dtype)
    number[near] = np.arange(PIECE)
    inside = number[F]
    inside = inside[(inside >= 0).all(axis=1)]
    used = np.unique(inside)  # libigl ends the program if an isolated vertex has a larger id than those of all faces
    return V[near[used]], np.searchsorted(used, inside).astype(F.dtype)


def mean_of_rows(signal, offsets, ids):
    """No row is empty."""
    return np.add.reduceat(signal[ids], offsets[:-1]) / np.diff(offsets)


class OneByOne(Tool):
    """A call for each vertex, and one thread in any case."""

    questions = ("ids",)
    SAMPLE = 8

    def ids(self, built, scale):
        return [self.neighborhood(built, v, scale) for v in range(len(self.V))]

    def found(self, question, answer):
        return sum(map(len, answer)) / len(self.V)

    def expected_seconds(self, question, scale):
        part = self.part()
        built = part.build()
        begin = time.perf_counter()
        for v in np.random.default_rng(3).integers(0, len(part.V), self.SAMPLE):
            part.neighborhood(built, int(v), scale)
        return (time.perf_counter() - begin) / self.SAMPLE * len(self.V)

    def neighborhood(self, built, v, scale):
        """The ids."""
        raise NotImplementedError
