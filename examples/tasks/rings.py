# The vertices within three edges of each vertex.
import sys, meshhood  # noqa: E401
V, F = meshhood.read_mesh(sys.argv[1])

index = meshhood.MeshIndex(V, F)
result = index.neighborhoods(3, metric="rings")
