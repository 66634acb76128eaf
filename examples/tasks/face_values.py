# Smooths values that lie on faces.
import sys, meshhood  # noqa: E401
V, F = meshhood.read_mesh(sys.argv[1])
heights = V[F].mean(axis=1)[:, 2]

index = meshhood.MeshIndex.of_faces(V, F)
result = index.smooth(heights, 6.0)
