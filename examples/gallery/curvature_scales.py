# SPDX-License-Identifier: MIT
"""Curvature at four scales
===========================

The radius of ``curvature`` is the scale of what it measures. At 1.5 mean edges it shows the noise of this surface, at 3
the walls of the grooves, at 6 the folds, and at 12 the shape that the folds lie on. Red is convex, blue concave.
"""

import meshhood
import numpy as np
import pyvista
from made_meshes import cortex

V, F = cortex()
V += np.random.default_rng(3).normal(0, 0.08, V.shape)
index = meshhood.MeshIndex(V, F)
radii = [1.5, 3, 6, 12]
mean = index.curvature(scales=radii, unit="edge").mean  # (4, #V), in 1/mm

plotter = pyvista.Plotter(shape=(2, 2), window_size=(1000, 860))
for i, (radius, map) in enumerate(zip(radii, mean)):
    plotter.subplot(i // 2, i % 2)
    largest = np.quantile(abs(map), 0.95)
    mesh = pyvista.PolyData.from_regular_faces(V, F)
    plotter.add_mesh(mesh, scalars=map, cmap="RdBu_r", clim=(-largest, largest), show_scalar_bar=False)
    plotter.add_text(f"{radius:g} edges; red is {largest:.2g} / mm", font_size=10)
    plotter.camera_position = [(0, 0, 240), (0, 0, 0), (0, 1, 0)]
plotter.show()
