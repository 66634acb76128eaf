# SPDX-License-Identifier: MIT
"""The gap between two parts, whatever the triangles
=================================================

A pin leans in a cup, which is cut open here. Above, the nearest vertex of the cup, below, ``gaps``: its nearest point.
Left, the cup has the few triangles of the design; right, the same surface has 16 times as many.
"""

import meshhood
import numpy as np
import pyvista
from made_meshes import pin_in_a_cup

plotter = pyvista.Plotter(shape=(2, 2), window_size=(900, 1000))
for column, splits in enumerate((0, 2)):
    V, F, pin = pin_in_a_cup(splits)
    index = meshhood.MeshIndex(V, F)
    found = index.nearest_unconnected(np.inf, pin).distance, index.gaps(np.inf, pin).distance
    print("{:.6f} mm to a vertex, a gap of {:.6f} mm, in the mean".format(*(distance.mean() for distance in found)))
    for row, distance in enumerate(found):
        plotter.subplot(row, column)
        mesh = pyvista.PolyData.from_regular_faces(V[pin], F[(F < len(pin)).all(axis=1)])
        plotter.add_mesh(mesh, scalars=distance, clim=(0, 2), cmap="viridis", show_scalar_bar=False)
        cup = pyvista.PolyData.from_regular_faces(V, F[(F >= len(pin)).all(axis=1)])
        plotter.add_mesh(cup.clip("y", invert=False), color="lightgray", show_edges=True, edge_color="gray")
        plotter.camera_position = [(30, -100, 60), (0, 0, 18), (0, 0, 1)]
plotter.show()
