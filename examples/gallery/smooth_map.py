# SPDX-License-Identifier: MIT
"""Smoothing a map on a cortex
==============================

A patch on one bank of a groove is active; the medial wall (gray) has an artifact. ``smooth`` with ``metric="surface"``
weighs by lengths along the surface: the other bank is far. Nothing comes from ``walls``. A kernel in space mixes all.
"""

import meshhood
import numpy as np
import pyvista
from made_meshes import cortex
from scipy.spatial import KDTree

V, F = cortex()
index = meshhood.MeshIndex(V, F)
wall = np.linalg.norm(V - V[5456] - (-24, 2, 0), axis=1) < 8
values = np.random.default_rng(1).normal(0, 0.5, len(V)) + 5 * wall
values[index.neighborhood(5456, 8.0)] += 1
smooth = index.smooth(values, fwhm=6.0, metric="surface", walls=wall)
d = KDTree(V).sparse_distance_matrix(KDTree(V), 9.47, output_type="coo_matrix")  # the same kernel in space
d.data = 0.5 ** ((d.data / 3) ** 2)
error = abs(d @ values / d.sum(1).A1 - smooth)
plotter = pyvista.Plotter(shape=(1, 3), window_size=(1200, 420))
for i, (title, map) in enumerate({"measured": values, "smooth()": smooth, "error of a kernel in space": error}.items()):
    plotter.subplot(0, i)
    plotter.add_mesh(pyvista.PolyData.from_regular_faces(V, F), scalars=map, clim=(0, 1), show_scalar_bar=False)
    plotter.add_text(title, font_size=10)
    plotter.camera_position = [V[5456] + (-6, 0, 110), V[5456] + (-6, 0, 0), (0, 1, 0)]
plotter.show()
