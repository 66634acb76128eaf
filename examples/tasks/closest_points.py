# The nearest points of a surface for 10,000 points in space.
import sys, meshhood, numpy as np  # noqa: E401
V, F = meshhood.read_mesh(sys.argv[1])
points = np.random.default_rng(1).uniform(V.min(axis=0), V.max(axis=0), (10_000, 3))

index = meshhood.MeshIndex(V, F)
result = index.closest_point(points)
