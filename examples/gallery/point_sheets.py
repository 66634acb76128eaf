# SPDX-License-Identifier: MIT
"""Thin sheets of points
========================

Points of a scan lie on two sheets that nearly touch. ``MeshIndex.from_points`` joins points at most ``link`` apart:
farther than neighbors on a sheet, less than the gap. The neighborhood of a point (green) then stays on its sheet, and
``principal_components`` fits normals to one sheet; a ball (blue) mixes both.
"""

import meshhood
import numpy as np
import pyvista

random = np.random.default_rng(5)
xy = random.uniform(0, 60, (2, 12000, 2))
height = 4 * np.sin(xy[..., 0] / 9) * np.cos(xy[..., 1] / 11) + np.array([[0], [2]])
P = np.concatenate([np.c_[xy[0], height[0]], np.c_[xy[1], height[1]]])
index = meshhood.MeshIndex.from_points(P, link=1.3)

middle = index.nearest([30, 30, 0])[0]
label = np.zeros(len(P))
label[index.neighborhood(middle, 8.0, method="ball")] = 1
label[index.neighborhood(middle, 8.0)] = 2
cut = pyvista.PolyData(P[P[:, 1] > 30])  # cut through the middle, to look between the sheets
cut.plot(scalars=label[P[:, 1] > 30], cmap=["lightgray", "#0072B2", "#009E73"], point_size=16, show_scalar_bar=False,
         render_points_as_spheres=True, cpos=[(30, -8, 12), P[middle], (0, 0, 1)])  # fmt: skip
