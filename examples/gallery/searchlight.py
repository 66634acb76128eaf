# SPDX-License-Identifier: MIT
"""A searchlight
================

Two conditions differ by a pattern in one patch. A searchlight is a row of ``radius_neighbors_graph``: the vertices
within 8 mm along the surface, without the wall (gray). Half of the trials give the pattern of each searchlight; by it
the conditions of the other half are told apart. An accuracy of 0.5 is chance.
"""

import meshhood
import numpy as np
import pyvista
from made_meshes import cortex

V, F = cortex()
random = np.random.default_rng(7)
index, wall = meshhood.MeshIndex(V, F), V[:, 0] < V[5456, 0] - 20
hemisphere = np.flatnonzero((V[:, 2] > 10) & ~wall)
patch = index.neighborhood(5456, 8.0)
first, second = random.normal(size=(2, 2, 20, len(V)))  # half, trial, vertex
second[..., patch] += random.choice([-0.3, 0.3], size=len(patch))
lights = index.radius_neighbors_graph(8.0, vertices=hemisphere, metric="surface", walls=wall)
evidence = [lights @ ((second[0] - first[0]).mean(0) * trials).T for trials in (first[1], second[1])]
accuracy = np.full(len(V), np.nan)
accuracy[hemisphere] = (evidence[1][:, :, None] > evidence[0][:, None, :]).mean((1, 2))

mesh = pyvista.PolyData.from_regular_faces(V, F)
mesh["accuracy"] = accuracy
camera = [V[5456] + (0, -10, 160), V[5456] + (0, -10, 0), (0, 1, 0)]
mesh.plot(clim=(0.5, 1), nan_color="lightgray", cpos=camera, scalar_bar_args={"vertical": True})
