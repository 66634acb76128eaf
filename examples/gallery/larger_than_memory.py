# SPDX-License-Identifier: MIT
"""A mesh larger than memory
============================

``partition`` cuts a mesh file into parts, in bounded memory. Each part has what lies within the halo around its
vertices, so it answers by itself, and exactly. Dask runs the parts one after the other, side by side or on a cluster.
Left: the parts. Right: the number of vertices of each neighborhood, the same as with one index of the whole mesh.
"""

import subprocess

import meshhood
import numpy as np
import pyvista

subprocess.run(["meshhood", "generate", "scroll", "--vertices", "60000", "-o", "scroll.ply"], check=True)
parts = meshhood.partition("scroll.ply", "scroll.parts", parts=8, halo=10, unit="edge", memory="256MiB")
owner = parts.map(lambda part, index, owned: np.full(len(owned), part.number), 0).compute()
counts = parts.counts(10, unit="edge").compute()

V, F = meshhood.read_mesh("scroll.ply")
plotter = pyvista.Plotter(shape=(1, 2), window_size=(1000, 440))
for i, (title, map, colors) in enumerate([("parts", owner, "tab10"), ("vertices within 10 edges", counts, "viridis")]):
    plotter.subplot(0, i)
    plotter.add_mesh(pyvista.PolyData.from_regular_faces(V, F), scalars=map, cmap=colors, show_scalar_bar=False)
    plotter.add_text(title, font_size=10)
plotter.link_views()
plotter.show()
