# All neighborhoods of 3 mean edges as a sparse matrix of distances.
import sys, meshhood  # noqa: E401
V, F = meshhood.read_mesh(sys.argv[1])

index = meshhood.MeshIndex(V, F)
result = index.radius_neighbors_graph(3.0, unit="edge", mode="distance")
