# SPDX-License-Identifier: MIT
"""meshhood from Python, and the reference search in C++."""
import subprocess

from .. import places
from .tool import Tool


class Meshhood(Tool):
    name = "meshhood"
    package = module = "meshhood"

    def build(self):
        import meshhood

        return meshhood.MeshIndex(self.V, self.F, workers=self.threads)

    def counts(self, index, scale):
        return index.counts(scale.radius, workers=self.threads)

    def ids(self, index, scale):
        return index.neighborhoods(scale.radius, workers=self.threads)

    def mean(self, index, scale):
        return index.aggregate(self.signal, scale.radius, workers=self.threads)

    def curvature(self, index, scale):
        return index.curvature(scale.radius, workers=self.threads)


class MeshhoodRings(Meshhood):
    name = "meshhood rings"
    answers = "k rings"
    questions = ("counts", "ids")

    def counts(self, index, scale):
        return index.counts(scale.edges, metric="rings", workers=self.threads)

    def ids(self, index, scale):
        return index.neighborhoods(scale.edges, metric="rings", workers=self.threads)


class BreadthFirst(Tool):
    name = "our breadth-first search (C++)"
    remark = "builds: the adjacency, on one thread"
    questions = ("counts", "ids", "mean")

    def __init__(self, mesh, threads):
        self.program = subprocess.Popen([places.PROGRAMS / "breadth_first", mesh.path, str(threads)], text=True,
                                        stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.vertices = len(mesh.positions)

    def run(self, question, scale):
        print(question, repr(scale.radius), file=self.program.stdin, flush=True)
        built, answered, found = map(float, self.program.stdout.readline().split())
        return built, answered, found / self.vertices

    def expected_seconds(self, question, scale):
        return None

    def end(self):
        self.program.stdin.close()
        self.program.wait()
