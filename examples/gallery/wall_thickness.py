# SPDX-License-Identifier: MIT
"""Wall thickness: what is near but not connected
=================================================

A bowl of a CAD part is thin at its bottom. From a vertex of one side of the wall, the other side is near in space, but
far along the surface. The vertices of a ball that are not in the neighborhood are those of the other side, and the
distance of the nearest one is the thickness of the wall. Where nothing of that kind is within 7 mm there is no number.
"""

import meshhood
import numpy as np
import pyvista
from made_meshes import bowl
from scipy.spatial import KDTree

V, F = bowl()
index = meshhood.MeshIndex(V, F)
ball = KDTree(V).sparse_distance_matrix(KDTree(V), 7.0, output_type="coo_matrix").tocsr()
other = ball - ball.multiply(index.radius_neighbors_graph(7.0))
other.eliminate_zeros()
rows = np.flatnonzero(np.diff(other.indptr))
thickness = np.full(len(V), np.nan)
thickness[rows] = np.minimum.reduceat(other.data, other.indptr[rows])

mesh = pyvista.PolyData.from_regular_faces(V, F)
mesh["thickness in mm"] = thickness
mesh.clip("y", invert=False).plot(cmap="viridis", nan_color="lightgray", cpos=[(30, -120, 60), (0, 0, -20), (0, 0, 1)])
