# SPDX-License-Identifier: MIT
"""A patch around a picked point, with its rim
==============================================

A point is picked on a tube whose strands pass close to each other. ``query_region`` finds the patch around it
(green) and ``RegionMesh`` its rim (orange): where the surface leaves the ball, at exactly the radius. The strand beside
it reaches into the ball, too, but is not connected there.
"""

import subprocess

import meshhood
import numpy as np
import pyvista

subprocess.run(["meshhood", "generate", "knot", "--vertices", "20000", "-o", "knot.ply"], check=True)
V, F = meshhood.read_mesh("knot.ply")
picked, radius = V[F[16495]].mean(axis=0), 14.0
ids = meshhood.MeshIndex(V, F).query_region(picked, radius, seeds=F[16495])
regions = meshhood.RegionMesh(V, F)
patch = regions.submesh(ids)

plotter = pyvista.Plotter()
plotter.add_mesh(pyvista.PolyData.from_regular_faces(V, np.delete(F, patch.faces, 0)), color="lightgray")
plotter.add_mesh(pyvista.PolyData.from_regular_faces(patch.V, patch.F), color="#009E73")
for line in regions.rim(ids, picked, radius):
    plotter.add_mesh(pyvista.Spline(line.points, 4 * len(line.points)), color="#D55E00", line_width=6)
plotter.add_mesh(pyvista.Sphere(radius=radius, center=picked), color="#0072B2", opacity=0.15)
plotter.camera_position = [picked + (60, -60, 110), picked, (0, 1, 0)]
plotter.show()
