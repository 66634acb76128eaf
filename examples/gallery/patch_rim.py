# SPDX-License-Identifier: MIT
"""A patch around a picked point, with its rim
==============================================

``closest_point`` finds the point of the surface nearest to a pick, and its face; ``neighborhood`` the patch around it;
``clip`` cuts the surface at the ball (green), and ``rim`` is its outline (orange). The ball (blue) has another strand.
"""

import subprocess

import meshhood
import numpy as np
import pyvista

subprocess.run(["meshhood", "generate", "knot", "--vertices", "20000", "-o", "knot.ply"], check=True)
V, F = meshhood.read_mesh("knot.ply")
index, radius = meshhood.MeshIndex(V, F), 14.0
face, barycentric, point, _ = index.closest_point(V[F[16495]].mean(axis=0) + (0.3, -0.2, 0.5))
ids = index.neighborhood(point, radius, face=face)
patch = index.clip(point, radius, face=face)

plotter, toward = pyvista.Plotter(), np.array([0.06, -0.06, 0.11])  # nearer to the camera, so that colors cover gray
plotter.add_mesh(pyvista.PolyData.from_regular_faces(V, F), color="lightgray")
plotter.add_mesh(patch.to_pyvista().translate(toward), color="#009E73")
for line in index.rim(ids, point, radius):
    plotter.add_lines(np.r_[line.points, line.points[:1]] + 2 * toward, color="#D55E00", width=6, connected=True)
plotter.add_mesh(pyvista.Sphere(radius=radius, center=point), color="#0072B2", opacity=0.15)
plotter.camera_position = [point + 700 * toward, point, (0, 1, 0)]
plotter.show()
