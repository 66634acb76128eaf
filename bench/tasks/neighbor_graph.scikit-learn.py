import sys, meshhood, sklearn.neighbors  # noqa: E401
V, F = meshhood.read_mesh(sys.argv[1])
r = 3.0 * meshhood.MeshIndex(V, F).mean_edge_length

result = sklearn.neighbors.radius_neighbors_graph(V, r, mode="distance", include_self=True, n_jobs=-1)
