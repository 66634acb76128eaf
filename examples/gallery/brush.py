# SPDX-License-Identifier: MIT
"""Brush strokes
================

A stroke runs over a page of a book whose pages nearly touch. Rays pick its points, and ``stroke`` paints what a way
along the surface connects with one of them: this page. A brush that takes its whole ball paints the pages behind, too.
"""

import subprocess

import meshhood
import numpy as np
import pyvista

subprocess.run(["meshhood", "generate", "book", "--vertices", "40000", "-o", "book.ply"], check=True)
V, F = meshhood.read_mesh("book.ply")
index = meshhood.MeshIndex(V, F)
stroke = np.array([(x, 0, 35 + 18 * np.sin(x / 6)) for x in np.linspace(20, 60, 50)])  # on the page at y = 0
face, _, point, _ = index.first_hit(stroke - (0, 9, 0), np.tile((0.0, 1.0, 0.0), (50, 1)))
page = np.round(np.arctan2(V[:, 1], V[:, 0]) / np.arctan2(V[:, 1], V[:, 0]).max() * 7)

plotter = pyvista.Plotter(shape=(1, 2), window_size=(1100, 320))
for i, brush in enumerate([{"metric": "surface", "face": face}, {"metric": "space"}]):
    plotter.subplot(0, i)
    painted = np.isin(np.arange(len(V)), index.stroke(point, 4.0, **brush)) * 1.0
    apart = pyvista.PolyData.from_regular_faces(V + page[:, None] * (0, 45, 0), F[np.ptp(page[F], axis=1) == 0])
    plotter.add_mesh(apart, scalars=painted, cmap=["lightgray", "#009E73"], show_scalar_bar=False)
    plotter.add_text(("along the surface", "a ball")[i], font_size=10)
    plotter.camera_position = [(260, -160, 110), (35, 130, 30), (0, 0, 1)]
plotter.show()
