# SPDX-License-Identifier: MIT
"""libigl's curvature, over the ball and over the k-ring. Its search is the same breadth-first search limited to a ball.
It does not return the neighborhoods, so the time includes both search and fit."""
import numpy as np

from .peer import Peer


class LibiglBall(Peer):
    name = "libigl principal_curvature, ball"
    package = "libigl"
    module = "igl"
    answers = "curvature within the ball"
    remark = "all vertices at once; search and quadric fit; radius rounded to whole edges"
    whole = True
    largest_answer = 120_000_000
    use_rings = False

    def __init__(self, mesh, threads):
        import igl

        self.igl = igl
        self.positions, self.triangles = mesh.positions.astype(np.float64), mesh.triangles.astype(np.int64)
        self.edge = igl.avg_edge_length(self.positions, self.triangles)

    def query(self, vertices, radius):
        edges = max(2, round(radius / self.edge))
        self.igl.principal_curvature(self.positions, self.triangles, edges, self.use_rings)

    def rows(self, answer, vertices):
        return None


class LibiglRings(LibiglBall):
    name = "libigl principal_curvature, k-ring"
    answers = "curvature within k rings"
    use_rings = True
