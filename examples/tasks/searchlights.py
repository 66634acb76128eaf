# The searchlights of nilearn: discs of 8 mm along a cortex, without the medial wall, as rows of a matrix.
import sys, meshhood, numpy as np  # noqa: E401
V, F = meshhood.read_mesh(sys.argv[1])
wall, rows = V[:, 0] > np.quantile(V[:, 0], 0.97), np.arange(0, len(V), 20)

index = meshhood.MeshIndex(V, F)
result = index.radius_neighbors_graph(8.0, vertices=rows, metric="surface", walls=wall)
