# SPDX-License-Identifier: MIT
"""A searchlight
================

In one patch, two conditions differ by a pattern whose mean contains nothing. A searchlight collects the evidence within
8 mm of each vertex, over the connected part of the ball, so that the other bank of a groove does not blur the answer.
"""

import meshhood
import numpy as np
import pyvista
from made_meshes import cortex

V, F = cortex()
index = meshhood.MeshIndex(V, F)
random = np.random.default_rng(7)
patch = index.query_ball(5456, 8.0)
first, second = random.normal(size=(2, 20, len(V)))
second[:, patch] += random.choice([-0.7, 0.7], size=len(patch))
evidence = 20 * (second.mean(0) - first.mean(0)) ** 2 / (first.var(0, ddof=1) + second.var(0, ddof=1))  # t squared
found = index.aggregate(evidence, 8.0)

plotter = pyvista.Plotter(shape=(1, 2), window_size=(1000, 480))
for i, (title, map) in enumerate({"each vertex by itself": evidence, "searchlight of 8 mm": found}.items()):
    plotter.subplot(0, i)
    plotter.add_mesh(pyvista.PolyData.from_regular_faces(V, F), scalars=map, clim=(0.5, 4), show_scalar_bar=False)
    plotter.add_text(title, font_size=10)
    plotter.camera_position = [V[5456] + (0, 0, 160), V[5456], (0, 1, 0)]
plotter.show()
