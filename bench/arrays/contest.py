# SPDX-License-Identifier: MIT
"""All tools on the same question, in turns, from the arrays of a mesh to the answers for all of its vertices."""
import importlib
import importlib.metadata
import resource
from dataclasses import dataclass, field
from pathlib import Path

from .. import meshes, results, timing
from ..peers import mesh_files
from ..peers.edges import edges_of, lengths_of
from ..worker import Worker
from . import TOOLS
from .tool import QUESTIONS, Scale

MESHES = ("head_skin", "cortex", "mri_head", "dragon")
RADII = (2, 3, 5, 10)
THREADS = (1, 2)
ROUNDS = 5
ENOUGH_SECONDS = 1  # of one tool for one question; no further round is begun then
MOST_SECONDS = 20  # of one answer
MOST_BYTES = 12 << 30  # of the address space of a tool
OUT_OF_MEMORY = ("MemoryError", "bad_alloc", "CPU malloc failed")  # the last is Open3D's


def run(names, radii, threads):
    """Adds to the results, so that a part of the meshes, radii and threads can be measured again."""
    for name in names or MESHES:
        path = mesh_files.prepared(name, "file")
        for count in threads or THREADS:
            for edges in radii or RADII:
                watched = results.begin(f"{name}, {edges} edges, threads: {count}")
                piece = contest(path, edges, count)
                data = results.load("arrays") or {"pieces": {}}
                data.pop("machine", None)
                data["most_seconds"] = MOST_SECONDS
                data["pieces"][f"{name}, {count}, {edges}"] = {"mesh": name, "threads": count, "radius_edges": edges, **piece}
                results.save("arrays", data, watched)


def contest(path, edges, threads):
    """The times of each tool for each question that it answers."""
    mesh = mesh_files.load(path)
    scale = Scale(edges, float(edges * lengths_of(mesh, edges_of(mesh)).mean()))
    entrants = {name: Entrant(name, path, threads) for name in TOOLS}
    questions = {question: ask(question, scale, [entrant for entrant in entrants.values()
                                                 if question in TOOLS[entrant.name].questions])
                 for question in QUESTIONS}
    for entrant in entrants.values():
        entrant.end()
    return {"vertices": len(mesh.positions), "questions": questions}


def ask(question, scale, entrants):
    for entrant in entrants:
        entrant.begin(question, scale)
    for _ in range(ROUNDS):
        for entrant in entrants:
            entrant.take_turn(question, scale)
    rows = {entrant.name: {"answers": TOOLS[entrant.name].answers, **entrant.result()} for entrant in entrants}
    for name, row in rows.items():
        seconds = f"{row['seconds']['median']:.3f} s" if "seconds" in row else row["failure"]
        print(f"    {question}: {name}: {seconds}", flush=True)
    return rows


class Limited:
    """A tool in its process."""

    def __init__(self, name, path, threads):
        resource.setrlimit(resource.RLIMIT_AS, (MOST_BYTES, MOST_BYTES))
        if TOOLS[name].module:
            importlib.import_module(TOOLS[name].module)
        self.tool = TOOLS[name](mesh_files.load(path), threads)
        self.started = importlib.metadata.version(self.tool.package) if self.tool.package else ""

    def __getattr__(self, method):
        return getattr(self.tool, method)


@dataclass
class Entrant:
    """A tool, its process, and its times for the present question."""

    name: str
    path: Path
    threads: int
    worker: Worker = None
    version: str = ""
    failure: str = ""
    turns: list = field(default_factory=list)  # seconds to build, seconds to answer, vertices found

    def begin(self, question, scale):
        """Leaves out what would take too long. A fast tool answers once without being timed."""
        self.failure, self.turns = "", []
        if self.worker is None:
            self.worker = Worker(Limited, self.name, self.path, self.threads, processors=self.threads)
            self.version = self.attempt(self.worker.result)
        expected = self.attempt(self.call, "expected_seconds", question, scale)
        if expected is not None and expected > MOST_SECONDS:
            self.failure = over_limit()
        self.take_turn(question, scale)
        if self.turns and sum(self.turns[0][:2]) < ENOUGH_SECONDS / 2:
            self.turns.clear()

    def take_turn(self, question, scale):
        if self.failure or sum(built + answered for built, answered, _ in self.turns) > ENOUGH_SECONDS:
            return
        turn = self.attempt(self.call, "run", question, scale)
        if turn is not None:
            self.turns.append(turn)

    def call(self, method, *arguments, timeout):
        return self.worker.call(method, *arguments, timeout=timeout)

    def attempt(self, call, *arguments):
        """The result, or None after a failure, which ends the process: the next question begins with a new one."""
        if self.failure:
            return None
        try:
            return call(*arguments, timeout=MOST_SECONDS)
        except RuntimeError as error:
            self.failure = reason(str(error))
            self.end()
            return None

    def result(self):
        if not self.turns:
            return {"failure": self.failure}
        builds, answers, found = zip(*self.turns)
        return {"version": self.version, "found": found[0], "build_seconds": timing.summary(builds),
                "answer_seconds": timing.summary(answers),
                "seconds": timing.summary([sum(pair) for pair in zip(builds, answers)])}

    def end(self):
        if self.worker is not None:
            self.worker.end()
        self.worker = None


def over_limit():
    return f"over {MOST_SECONDS} s"


def reason(error):
    if "took longer" in error:
        return over_limit()
    if any(word in error for word in OUT_OF_MEMORY):
        return f"over {MOST_BYTES >> 30} GiB"
    return "failed: " + "".join(c for c in error if c.isprintable())  # in one cell of a table
