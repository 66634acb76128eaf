# Smooths 200 maps at once.
import sys, meshhood, numpy as np  # noqa: E401
V, F = meshhood.read_mesh(sys.argv[1])
maps = np.random.default_rng(1).normal(size=(len(V), 200))

index = meshhood.MeshIndex(V, F)
result = index.smooth(maps, 6.0)
