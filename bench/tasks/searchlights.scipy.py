import sys, meshhood, numpy as np  # noqa: E401
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra
V, F = meshhood.read_mesh(sys.argv[1])
wall, rows = V[:, 0] > np.quantile(V[:, 0], 0.97), np.arange(0, len(V), 20)

edges = np.unique(np.sort(np.concatenate([F[:, [0, 1]], F[:, [1, 2]], F[:, [2, 0]]]), axis=1), axis=0)
edges = edges[~wall[edges].any(axis=1)]
lengths = np.linalg.norm(V[edges[:, 0]] - V[edges[:, 1]], axis=1)
graph = csr_array((lengths, edges.T), shape=(len(V), len(V)))
parts = [dijkstra(graph, directed=False, indices=rows[i : i + 200], limit=8.0) for i in range(0, len(rows), 200)]
result = csr_array(np.concatenate([np.isfinite(part) for part in parts]))
