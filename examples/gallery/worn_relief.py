# SPDX-License-Identifier: MIT
"""A worn relief by the volume behind it
=====================================

Worn strokes under grains hardly show in the light. The volume of the part of a ball behind the surface is a mean over a
patch, so it shows them where the radius exceeds the grains. Here it is a mean curvature (Pottmann et al. 2009): blue is
a groove, and gray is near the border of the mesh.
"""

import meshhood
import numpy as np
import pyvista
from made_meshes import worn_tablet

V, F = worn_tablet()
radii = np.array([1.5, 4, 8])
volume = meshhood.MeshIndex(V, F).invariants(scales=radii).volume.T
mean = (2 * np.pi / 3 * radii**3 - volume) * 4 / (np.pi * radii**4)  # (#V, 3), in 1/mm

plotter = pyvista.Plotter(shape=(2, 2), window_size=(1000, 1000))
plotter.add_mesh(pyvista.PolyData.from_regular_faces(V, F), color="tan", smooth_shading=True)
for i, radius in enumerate(radii):
    plotter.subplot((i + 1) // 2, (i + 1) % 2)
    largest = np.nanquantile(abs(mean[:, i]), 0.98)
    mesh = pyvista.PolyData.from_regular_faces(V, F)
    plotter.add_mesh(mesh, scalars=mean[:, i], cmap="RdBu_r", clim=(-largest, largest), show_scalar_bar=False)
    plotter.add_text(f"radius {radius:g} mm", font_size=12)
plotter.link_views()
plotter.view_xy()
plotter.show()
