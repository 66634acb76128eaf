# SPDX-License-Identifier: MIT
"""trueform, the only other library with the same query. Licensed for noncommercial use only."""
from .peer import Peer, rows_of


class Trueform(Peer):
    name = "trueform neighborhoods"
    package = "trueform"
    module = "trueform"
    answers = "exact"
    remark = "all vertices at once; noncommercial licence"
    whole = True
    largest_answer = 1_000_000_000

    def __init__(self, mesh, threads):
        import trueform

        self.trueform = trueform
        self.positions = mesh.positions
        membership = trueform.cell_membership(mesh.triangles, n_ids=len(mesh.positions))
        self.links = trueform.vertex_link_faces(mesh.triangles, membership)

    def query(self, vertices, radius):
        return self.trueform.neighborhoods(self.links, self.positions, radius, inclusive=True)

    def rows(self, answer, vertices):
        return rows_of(answer.offsets, answer.data, vertices)
