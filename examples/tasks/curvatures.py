# The mean curvature at three scales.
import sys, meshhood  # noqa: E401
V, F = meshhood.read_mesh(sys.argv[1])

index = meshhood.MeshIndex(V, F)
result = index.curvature(scales=[2, 3, 5], unit="edge").mean
