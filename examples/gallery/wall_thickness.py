# SPDX-License-Identifier: MIT
"""Wall thickness: the largest ball inside
==========================================

A bowl of a CAD part is thin at its bottom. The thickness at a vertex is the diameter of the largest ball that touches
the surface there from inside. It does not depend on how the other side is divided into triangles. ``method="ray"``
measures along the normal instead, which at the rim leads far down the wall.
"""

import meshhood
import pyvista
from made_meshes import bowl

V, F = bowl()

mesh = pyvista.PolyData.from_regular_faces(V, F)
mesh["mm"] = meshhood.MeshIndex(V, F).thickness(method="sphere")
camera = [(30, -120, 60), (0, 0, -20), (0, 0, 1)]
bar = {"vertical": True}
mesh.clip("y", invert=False).plot(cmap="viridis", cpos=camera, scalar_bar_args=bar)
