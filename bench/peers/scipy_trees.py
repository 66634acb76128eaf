# SPDX-License-Identifier: MIT
"""What SciPy offers: the ball; the ball and the component of the vertex in it, which is exact; and paths along edges."""
import numpy as np

from .peer import Peer


def edges_of(triangles):
    return np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])


def graph_of(positions, triangles):
    """The edges as a matrix of their lengths, each in both directions once."""
    from scipy.sparse import csr_array

    edges = edges_of(triangles)
    edges = np.unique(np.sort(edges, axis=1), axis=0)
    lengths = np.linalg.norm(positions[edges[:, 0]].astype(float) - positions[edges[:, 1]], axis=1)
    rows, columns = np.concatenate([edges, edges[:, ::-1]]).T
    return csr_array((np.tile(lengths, 2), (rows, columns)), shape=(len(positions), len(positions)))


class KdTree(Peer):
    name = "scipy cKDTree"
    package = "scipy"
    module = "scipy.spatial"
    answers = "ball"

    def __init__(self, positions, triangles, path, threads):
        from scipy.spatial import cKDTree

        self.positions, self.threads = positions, threads
        self.tree = cKDTree(positions)

    def ask(self, vertices, radius):
        return self.tree.query_ball_point(self.positions[vertices], radius, workers=self.threads)


class Components(KdTree):
    name = "scipy cKDTree, then connected_components"
    module = "scipy.sparse.csgraph"
    answers = "exact"
    remark = "one thread in any case"

    def __init__(self, positions, triangles, path, threads):
        super().__init__(positions, triangles, path, threads)
        self.graph = graph_of(positions, triangles)

    def ask(self, vertices, radius):
        return [self.component(v, np.array(self.tree.query_ball_point(self.positions[v], radius))) for v in vertices]

    def component(self, v, ball):
        from scipy.sparse.csgraph import connected_components

        _, labels = connected_components(self.graph[ball][:, ball], directed=False)
        return ball[labels == labels[np.flatnonzero(ball == v)[0]]]


class Dijkstra(Peer):
    name = "scipy dijkstra, limit"
    package = "scipy"
    module = "scipy.sparse.csgraph"
    answers = "length of path along edges"
    remark = "one thread in any case"

    def __init__(self, positions, triangles, path, threads):
        self.graph = graph_of(positions, triangles)

    def ask(self, vertices, radius):
        from scipy.sparse.csgraph import dijkstra

        return [np.flatnonzero(np.isfinite(dijkstra(self.graph, indices=v, limit=radius))) for v in vertices]
