import sys, meshhood, numpy as np  # noqa: E401
from scipy.sparse import csr_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree
V, F = meshhood.read_mesh(sys.argv[1])

sides = np.concatenate([F[:, [0, 1]], F[:, [1, 2]], F[:, [2, 0]]])
graph = csr_array((np.ones(len(sides)), sides.T), shape=(len(V), len(V)))
other, gap = np.full(len(V), -1), np.full(len(V), np.inf)
for v, ball in enumerate(cKDTree(V).query_ball_point(V, 3.0, workers=-1)):
    labels = connected_components(graph[ball][:, ball], directed=False)[1]
    rest = np.array(ball)[labels != labels[ball.index(v)]]
    if len(rest):
        distances = np.linalg.norm(V[rest] - V[v], axis=1)
        other[v], gap[v] = rest[distances.argmin()], distances.min()
result = other, gap
