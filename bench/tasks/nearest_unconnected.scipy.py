import sys, meshhood, numpy as np  # noqa: E401
from scipy.sparse import csr_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree
V, F = meshhood.read_mesh(sys.argv[1])
sides = np.concatenate([F[:, [0, 1]], F[:, [1, 2]], F[:, [2, 0]]])
graph, tree = csr_array((np.ones(len(sides)), sides.T), shape=(len(V), len(V))), cKDTree(V)
EVERY = 50  # all vertices would take minutes

result = []
for v in range(0, len(V), EVERY):
    ball = tree.query_ball_point(V[v], 3.0)
    labels = connected_components(graph[ball][:, ball], directed=False)[1]
    rest = np.array(ball)[labels != labels[ball.index(v)]]
    distances = np.linalg.norm(V[rest] - V[v], axis=1)
    result.append((rest[distances.argmin()], distances.min()) if len(rest) else (-1, np.inf))
