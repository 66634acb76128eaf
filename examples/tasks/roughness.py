# How rough a surface is: the surface variation of each neighborhood of 3 mean edges.
import sys, meshhood  # noqa: E401
V, F = meshhood.read_mesh(sys.argv[1])

index = meshhood.MeshIndex(V, F)
result = index.principal_components(3.0, unit="edge").surface_variation
