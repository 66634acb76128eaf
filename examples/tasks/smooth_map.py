# Smooths a map on a cortex with 6 mm full width at half maximum.
import sys, meshhood, numpy as np  # noqa: E401
V, F = meshhood.read_mesh(sys.argv[1])
values = np.random.default_rng(1).normal(size=len(V)).astype(np.float32)

index = meshhood.MeshIndex(V, F)
result = index.smooth(values, 6.0, weights="area")
