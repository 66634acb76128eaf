# The areas of 200 patches, cut at the ball.
import sys, meshhood, numpy as np  # noqa: E401
V, F = meshhood.read_mesh(sys.argv[1])
r, rows = 10 * meshhood.MeshIndex(V, F).mean_edge_length, np.linspace(0, len(V) - 1, 200).astype(int)

index = meshhood.MeshIndex(V, F)
result = index.invariants(r, rows).area
