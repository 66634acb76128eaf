# The nearest unconnected vertex of each vertex, within 3 mm: on the other bank of a sulcus.
import sys, meshhood  # noqa: E401
V, F = meshhood.read_mesh(sys.argv[1])

index = meshhood.MeshIndex(V, F)
result = index.nearest_unconnected(3.0)
