# SPDX-License-Identifier: MIT
"""meshhood itself, through the Python package: many vertices in one call, and a call for each."""
from .peer import OneByOne, Peer, rows_of


class Meshhood(Peer):
    package = "meshhood"
    module = "meshhood"
    answers = "exact"

    def __init__(self, mesh, threads):
        import meshhood

        self.threads = threads
        self.index = meshhood.MeshIndex(mesh.positions, mesh.triangles, workers=threads)


class MeshhoodBatch(Meshhood):
    name = "meshhood, one call"
    method = "exact"

    def query(self, vertices, radius):
        return self.index.neighborhoods(radius, vertices, method=self.method, workers=self.threads)

    def rows(self, answer, vertices):
        return rows_of(*answer, range(len(vertices)))


class MeshhoodAll(Meshhood):
    name = "meshhood, all vertices"
    remark = "all vertices at once"
    whole = True
    largest_answer = 1_000_000_000

    def query(self, vertices, radius):
        return self.index.neighborhoods(radius, workers=self.threads)

    def rows(self, answer, vertices):
        return rows_of(*answer, vertices)


class MeshhoodPaper(MeshhoodBatch):
    name = "meshhood, the paper's index"
    answers = "the paper's"
    method = "paper"
    remark = "built after the exact index, from its graph"

    def __init__(self, mesh, threads):
        super().__init__(mesh, threads)
        self.index.count(0, 0.0, method=self.method)  # builds the paper's index


class MeshhoodCount(Meshhood):
    name = "meshhood, counts only"
    answers = "how many"

    def query(self, vertices, radius):
        return self.index.counts(radius, vertices, workers=self.threads)

    def rows(self, answer, vertices):
        return None


class MeshhoodCalls(OneByOne, Meshhood):
    name = "meshhood, a call for each"
    remark = "one thread in any case"

    def neighborhood(self, v, radius):
        return self.index.neighborhood(v, radius)
