import sys, meshhood, numpy as np, potpourri3d  # noqa: E401
V, F = meshhood.read_mesh(sys.argv[1])
rows = np.linspace(0, len(V) - 1, 50).astype(int)

solver = potpourri3d.MeshHeatMethodDistanceSolver(V.astype(float), F)
distances = [solver.compute_distance(int(v)) for v in rows]
result = [(np.flatnonzero(d <= 20.0), d[d <= 20.0]) for d in distances]
