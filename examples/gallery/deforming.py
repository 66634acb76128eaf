# SPDX-License-Identifier: MIT
"""A mesh that deforms
======================

A sheet rolls up. Its edges stay, so ``refit`` makes the index of each frame from the one before, in a fraction of the
time of a build. The patch of a vertex (green) hardly changes; the ball meets more and more of the other layers (blue).
"""

import meshhood
import numpy as np
import pyvista
from made_meshes import rolled

V, F = rolled(0.05)
index = meshhood.MeshIndex(V, F)
v = 15099  # in the middle of the upper border

plotter = pyvista.Plotter(shape=(2, 2), window_size=(1000, 860))
for i, turn in enumerate([0.05, 0.6, 1.6, 2.6]):
    index = index.refit(rolled(turn)[0])
    label = np.zeros(len(index))
    label[index.neighborhood(v, 14.0, method="ball")] = 1
    label[index.neighborhood(v, 14.0)] = 2
    plotter.subplot(i // 2, i % 2)
    mesh = pyvista.PolyData.from_regular_faces(index.positions, F)
    plotter.add_mesh(mesh, scalars=label, cmap=["lightgray", "#0072B2", "#009E73"], show_scalar_bar=False)
    plotter.camera_position = [(-90, -160, 330), (0, 35, 70), (0, 1, 0)]
    plotter.add_text(f"patch {(label == 2).sum()}, not connected {(label == 1).sum()}", font_size=10)
plotter.show()
