import sys, meshhood, numpy as np, igl  # noqa: E401
V, F = meshhood.read_mesh(sys.argv[1])
points = np.random.default_rng(1).uniform(V.min(axis=0), V.max(axis=0), (10_000, 3))

result = igl.point_mesh_squared_distance(points, V.astype(float), F)
