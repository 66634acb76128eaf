# SPDX-License-Identifier: MIT
"""We ourselves, through the Python package: many vertices in one call, and a call for each."""
from .peer import Peer, rows_of


class MeshhoodBatch(Peer):
    name = "meshhood, one call"
    package = "meshhood"
    module = "meshhood"
    answers = "exact"
    method = "exact"

    def __init__(self, positions, triangles, path, threads):
        import meshhood

        self.threads = threads
        self.index = meshhood.MeshIndex(positions, triangles, workers=threads)
        self.index.query_ball(0, 0.0, method=self.method)  # other methods build when first asked

    def ask(self, vertices, radius):
        return self.index.query_ball(vertices, radius, method=self.method, workers=self.threads)

    def rows(self, answer, vertices):
        return rows_of(*answer, range(len(vertices)))


class MeshhoodPaper(MeshhoodBatch):
    name = "meshhood, the paper's index"
    answers = "the paper's"
    method = "paper"


class MeshhoodCalls(MeshhoodBatch):
    name = "meshhood, a call for each"
    remark = "one thread in any case"

    def ask(self, vertices, radius):
        return [self.index.query_ball(v, radius) for v in vertices]

    def rows(self, answer, vertices):
        return answer


class MeshhoodCount(MeshhoodBatch):
    name = "meshhood, counts only"
    answers = "how many"

    def ask(self, vertices, radius):
        return self.index.query_ball_count(vertices, radius, workers=self.threads)

    def rows(self, answer, vertices):
        return None
