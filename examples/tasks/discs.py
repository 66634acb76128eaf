# Distances along the surface from 50 vertices, up to 20 mm.
import sys, meshhood, numpy as np  # noqa: E401
V, F = meshhood.read_mesh(sys.argv[1])
rows = np.linspace(0, len(V) - 1, 50).astype(int)

index = meshhood.MeshIndex(V, F)
result = index.neighborhoods(20.0, rows, metric="surface", return_distance=True)
