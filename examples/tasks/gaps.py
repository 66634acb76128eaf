# What is near each vertex, within 3 mm, but not connected with it there: the other bank of a sulcus.
import sys, meshhood  # noqa: E401
V, F = meshhood.read_mesh(sys.argv[1])

index = meshhood.MeshIndex(V, F)
result = index.nearest_unconnected(3.0)
