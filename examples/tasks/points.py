# How many points of a cloud are within 4 mean edges, connected by steps of at most 2.
import sys, meshhood  # noqa: E401
V, F = meshhood.read_mesh(sys.argv[1])
edge = meshhood.MeshIndex(V, F).mean_edge_length

index = meshhood.MeshIndex.from_points(V, link=2 * edge)
result = index.counts(4 * edge)
