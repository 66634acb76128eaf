# SPDX-License-Identifier: MIT
"""One library in a comparison: the number of queries for which there is time, the quality of its answers, and its
times."""
import time
from dataclasses import dataclass, field

import numpy as np

from .. import timing
from ..worker import Worker
from . import PEERS
from .service import ONE_THREAD, Service

BLOCKS = 5
BLOCK_QUERIES = 2000
STEP_TIMEOUT = 300  # seconds for one step of one library
# For a library that answers all vertices at once: the time of this many blocks, but at least one run.
WHOLE_MESH_BLOCKS = 30


@dataclass
class Judged:
    """A few vertices and their correct answers."""

    vertices: np.ndarray
    truth: list  # of sets of ids

    def typical(self):
        return float(np.mean([len(row) for row in self.truth]))

    def difference(self, answers):
        """Extra and missing vertices for each answer, on average."""
        pairs = [(set(answer), right) for answer, right in zip(answers, self.truth)]
        return {"extra": float(np.mean([len(answer - right) for answer, right in pairs])),
                "missing": float(np.mean([len(right - answer) for answer, right in pairs]))}


@dataclass
class Contestant:
    name: str
    worker: Worker
    built: dict = None
    failure: str = None
    spent: float = 0  # seconds, in all calls
    # At this radius:
    queries: int = 0  # for each block
    runs: int = 0  # the number of blocks in which it takes part
    microseconds: list = field(default_factory=list)
    row: dict = field(default_factory=dict)

    @classmethod
    def started(cls, name, path, threads):
        contestant = cls(name, Worker(Service, name, path, threads, processors=1 if threads == ONE_THREAD else None))
        contestant.built = contestant.attempt(contestant.worker.result)
        return contestant

    def is_running(self):
        return self.built is not None and self.failure is None

    def begin_radius(self, judged, radius, vertices, block_seconds):
        """Compares the answers, and finds for how many queries there is time. Both warm the caches."""
        self.queries, self.runs, self.microseconds, self.row = 0, 0, [], {}
        if not self.is_running():
            return
        peer = PEERS[self.name]
        ids = judged.typical() * vertices
        if peer.largest_answer and ids > peer.largest_answer:
            self.row = {"left_out": f"{ids:.1e} ids in all would be too many"}
            return
        judgement = self.attempt(self.worker.call, "judge", judged.vertices, radius)
        if judgement is None:
            return
        seconds, answers = judgement
        if peer.whole:
            self.plan_whole(seconds, vertices, block_seconds)
        else:
            self.plan_blocks(seconds, judged.vertices, radius, block_seconds)
        if answers is not None:
            self.row = judged.difference(answers)

    def plan_whole(self, seconds, vertices, block_seconds):
        self.queries = vertices
        self.microseconds.append(1e6 * seconds / vertices)  # it takes too long for a run that is not counted
        self.runs = int(np.clip(WHOLE_MESH_BLOCKS * block_seconds / seconds, 1, BLOCKS)) - 1

    def plan_blocks(self, seconds, vertices, radius, block_seconds):
        if seconds < block_seconds:  # again, without the work that only the first call does
            seconds = self.attempt(self.worker.call, "time", vertices, radius) or seconds
        self.queries = int(np.clip(block_seconds * len(vertices) / seconds, 1, BLOCK_QUERIES))
        self.runs = BLOCKS

    def run_block(self, number, block, radius):
        if not self.is_running() or number >= self.runs:
            return
        seconds = self.attempt(self.worker.call, "time", block[:self.queries], radius)
        if seconds is not None:
            self.microseconds.append(1e6 * seconds / self.queries)

    def result(self, judged):
        peer = PEERS[self.name]
        row = {"name": self.name, "answers": peer.answers, "remark": peer.remark, "whole": peer.whole,
               "found": judged.typical(), **(self.built or {}), **self.row}
        if self.failure:
            row["failure"] = self.failure
        if self.microseconds:
            row.update(microseconds=timing.summary(self.microseconds), queries=self.queries)
        return row

    def attempt(self, call, *arguments):
        """The result of the call of the worker, or None. A failure is kept, and ends the runs of this library."""
        begin = time.perf_counter()
        try:
            return call(*arguments, timeout=STEP_TIMEOUT)
        except RuntimeError as error:
            self.failure = str(error)
            return None
        finally:
            self.spent += time.perf_counter() - begin
