import sys, meshhood, igl  # noqa: E401
V, F = meshhood.read_mesh(sys.argv[1])
V = V.astype(float)

found = [igl.principal_curvature(V, F, radius, False) for radius in (2, 3, 5)]
result = [(k1 + k2) / 2 for _, _, k1, k2, *_ in found]
