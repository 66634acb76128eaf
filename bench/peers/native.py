# SPDX-License-Identifier: MIT
"""Libraries in C++, each in a program of its own, which measures its time."""
import os
import subprocess
import tempfile
from pathlib import Path

import numpy as np

from .. import places
from .peer import Peer

PROGRAM = places.PROGRAMS / "native_peers"


class Native(Peer):
    kind = ""

    def __init__(self, mesh, threads):
        if not PROGRAM.exists():
            raise ImportError("native_peers is not built (libnanoflann-dev, libeigen3-dev)")
        count = len(os.sched_getaffinity(0)) if threads == -1 else threads
        self.program = subprocess.Popen([PROGRAM, self.kind, mesh.path, str(count)], text=True, stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE)
        self.build_seconds = float(self.program.stdout.readline())
        self.scratch = tempfile.TemporaryDirectory()

    def query(self, vertices, radius):
        self.seconds = self.command(vertices, radius)
        return vertices, radius

    def rows(self, answer, vertices):
        path = Path(self.scratch.name, "answers")
        self.command(*answer, path)
        words, at, found = np.fromfile(path, np.uint32), 0, []
        for _ in vertices:
            found.append(words[at + 1:at + 1 + words[at]])
            at += 1 + words[at]
        return found

    def end(self):
        self.program.stdin.close()
        self.program.wait()

    def command(self, vertices, radius, *answers):
        queries = Path(self.scratch.name, "queries")
        np.asarray(vertices, np.uint32).tofile(queries)
        print(repr(float(radius)), queries, *answers, file=self.program.stdin, flush=True)
        return float(self.program.stdout.readline())


class BreadthFirst(Native):
    name = "our breadth-first search (C++)"
    kind = "bfs"
    answers = "exact"


class Nanoflann(Native):
    name = "nanoflann (C++)"
    kind = "nanoflann"
    answers = "ball"

    def version(self):
        header = Path("/usr/include/nanoflann.hpp").read_text(encoding="utf-8")
        word = header.partition("#define NANOFLANN_VERSION ")[2].split()[0]
        return ".".join(str(int(digit, 16)) for digit in word.removeprefix("0x"))


class Curvature(Native):
    name = "meshhood, then a quadric fit (C++)"
    kind = "curvature"
    answers = "curvature within the ball"
    remark = "search and a quadric fit like libigl's"

    def rows(self, answer, vertices):
        return None


class CurvatureBreadthFirst(Curvature):
    name = "our breadth-first search, then a quadric fit (C++)"
    kind = "curvature-bfs"
