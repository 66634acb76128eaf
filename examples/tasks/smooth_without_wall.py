# Smooths a map along a cortex; nothing comes from the medial wall, and nothing crosses a sulcus.
import sys, meshhood, numpy as np  # noqa: E401
V, F = meshhood.read_mesh(sys.argv[1])
values, wall = np.random.default_rng(1).normal(size=len(V)).astype(np.float32), V[:, 0] > np.quantile(V[:, 0], 0.97)

index = meshhood.MeshIndex(V, F)
result = index.smooth(values, 6.0, weights="area", metric="surface", walls=wall)
