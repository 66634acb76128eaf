# SPDX-License-Identifier: MIT
"""Wall thickness: what is near but not connected
=================================================

A bowl of a CAD part is thin at its bottom. From a vertex of one side of the wall, the other side is near in space, but
far along the surface. ``nearest_unconnected`` finds the nearest vertex of the ball that is not in the neighborhood: it
is on the other side, and its distance is the thickness of the wall. There is none within 7 mm where the way over the
rim lies in the ball (gray).
"""

import meshhood
import numpy as np
import pyvista
from made_meshes import bowl

V, F = bowl()
index = meshhood.MeshIndex(V, F)
other, gap = index.nearest_unconnected(7.0)

mesh = pyvista.PolyData.from_regular_faces(V, F)
mesh["mm"] = np.where(other >= 0, gap, np.nan)
camera = [(30, -120, 60), (0, 0, -20), (0, 0, 1)]
bar = {"vertical": True}
mesh.clip("y", invert=False).plot(cmap="viridis", nan_color="lightgray", cpos=camera, scalar_bar_args=bar)
