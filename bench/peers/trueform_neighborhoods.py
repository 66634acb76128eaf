# SPDX-License-Identifier: MIT
"""trueform, the only other product that asks the same question. Licensed for noncommercial use only."""
from .peer import Peer, rows_of


class Trueform(Peer):
    name = "trueform neighborhoods"
    package = "trueform"
    module = "trueform"
    answers = "exact"
    remark = "all vertices at once; noncommercial licence"
    whole = True
    largest_answer = 1_000_000_000

    def __init__(self, positions, triangles, path, threads):
        import trueform

        self.trueform = trueform
        self.positions = positions
        membership = trueform.cell_membership(triangles, n_ids=len(positions))
        self.links = trueform.vertex_link_faces(triangles, membership)

    def ask(self, vertices, radius):
        return self.trueform.neighborhoods(self.links, self.positions, radius, inclusive=True)

    def rows(self, answer, vertices):
        return rows_of(answer.offsets, answer.data, vertices)
