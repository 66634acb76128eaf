# SPDX-License-Identifier: MIT
"""SciPy: the ball; the component of the vertex in the ball, which is exact; and paths along edges."""
import numpy as np

from .edges import edges_of, lengths_of
from .peer import OneByOne, Peer


def graph_of(mesh):
    """The edges as a matrix of their lengths, each in both directions once."""
    from scipy.sparse import csr_array

    edges = edges_of(mesh)
    rows, columns = np.concatenate([edges, edges[:, ::-1]]).T
    lengths = np.tile(lengths_of(mesh, edges), 2)
    return csr_array((lengths, (rows, columns)), shape=(len(mesh.positions), len(mesh.positions)))


class KdTree(Peer):
    name = "scipy cKDTree"
    package = "scipy"
    module = "scipy.spatial"
    answers = "ball"

    def __init__(self, mesh, threads):
        from scipy.spatial import cKDTree

        self.positions, self.threads = mesh.positions, threads
        self.tree = cKDTree(mesh.positions)

    def query(self, vertices, radius):
        return self.tree.query_ball_point(self.positions[vertices], radius, workers=self.threads)


class Components(OneByOne, KdTree):
    name = "scipy cKDTree, then connected_components"
    module = "scipy.sparse.csgraph"
    answers = "exact"

    def __init__(self, mesh, threads):
        super().__init__(mesh, threads)
        self.graph = graph_of(mesh)

    def neighborhood(self, v, radius):
        from scipy.sparse.csgraph import connected_components

        ball = np.array(self.tree.query_ball_point(self.positions[v], radius))
        _, labels = connected_components(self.graph[ball][:, ball], directed=False)
        return ball[labels == labels[np.flatnonzero(ball == v)[0]]]


class Dijkstra(OneByOne):
    name = "scipy dijkstra, limit"
    package = "scipy"
    module = "scipy.sparse.csgraph"
    answers = "length of path along edges"

    def __init__(self, mesh, threads):
        self.graph = graph_of(mesh)

    def neighborhood(self, v, radius):
        from scipy.sparse.csgraph import dijkstra

        return np.flatnonzero(np.isfinite(dijkstra(self.graph, indices=v, limit=radius)))
