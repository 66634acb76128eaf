import sys, meshhood, jakteristics  # noqa: E401
V, F = meshhood.read_mesh(sys.argv[1])
r, V = 3.0 * meshhood.MeshIndex(V, F).mean_edge_length, V.astype(float)

result = jakteristics.compute_features(V, search_radius=r, feature_names=["surface_variation"])[:, 0]
