# SPDX-License-Identifier: MIT
"""Creases over scales
======================

Fine scratches run over folds. A scratch is a crease at small radii only; a fold remains one at large radii.
``features`` measures creases, ``persistence`` counts the radii at which each lasts: ridges red, valleys blue.
:doc:`/curvature` shows creases of a scan of a dragon, whose terms do not allow us to ship it with this program.
"""

import meshhood
import numpy as np
import pyvista
from made_meshes import cortex, sphere, waves

V, F = cortex()
V *= 1 - 0.008 * np.exp(-((waves(sphere(6)[0], 40, 45.0, 6) / 0.2) ** 2))[:, None]
index = meshhood.MeshIndex(V, F)
radii = meshhood.geometric_radii(1.5, 12.0, 10) * index.mean_edge_length
creases = index.features(scales=radii)  # (10, #V), without unit
lasting = meshhood.persistence(creases, radii, threshold=0.4)

plotter = pyvista.Plotter(shape=(1, 2), window_size=(1000, 440))
maps = {"the smallest radius": 10 * creases[0], "radii that a crease lasts": lasting.scales.astype(float)}
for i, (title, map) in enumerate(maps.items()):
    plotter.subplot(0, i)
    mesh = pyvista.PolyData.from_regular_faces(V, F)
    plotter.add_mesh(mesh, scalars=map, cmap="RdBu_r", clim=(-10, 10), show_scalar_bar=False)
    plotter.add_text(title, font_size=10)
    plotter.camera_position = [(0, 0, 240), (0, 0, 0), (0, 1, 0)]
plotter.show()
