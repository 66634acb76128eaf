# SPDX-License-Identifier: MIT
"""The paper's Figure 4, for a mesh of one's own."""

import numpy as np

from . import _convert
from ._mesh import mesh_arrays

# What each vertex is, the later over the earlier, and the colours of the paper.
_LABELS = ("other", "ball", "paper", "exact")
_COLORS = ("lightgray", "royalblue", "gold", "forestgreen")

# In steps of depth, of which VTK has 2^16: from anywhere to the eye.
_BEFORE_ALL = -66000


def plot_neighborhood(index, v, r, V, F=None, *, plotter=None):
    """Shows the neighborhood of `v` within `r` on the mesh: green what is exact, yellow what the paper's search adds,
    blue what a ball takes besides, and the vertex as a red dot, whatever lies before it.

    index : the `MeshIndex` of the mesh.    V, F : the mesh, as `MeshIndex` takes it, but not a graph.
    plotter : a pyvista.Plotter to draw on; otherwise one is made and shown.

    Returns the plotter. Needs PyVista. For a picture without a window:

        plotter = pyvista.Plotter(off_screen=True)
        meshhood.plot_neighborhood(index, 42, 1.5, V, F, plotter=plotter).screenshot("picture.png")
    """
    import pyvista

    v = _convert.vertex(v, len(index))
    labels = np.zeros(len(index), np.uint8)
    for label, method in enumerate(_LABELS[1:], start=1):
        labels[index.query_ball(v, r, method=method)] = label
    mesh = _poly_data(pyvista, *mesh_arrays(V, F))
    if mesh.n_points != len(index):
        raise ValueError(f"V: {mesh.n_points} vertices, but the index has {len(index)}")
    drawn = pyvista.Plotter() if plotter is None else plotter
    drawn.add_mesh(
        mesh,
        scalars=labels,
        cmap=list(_COLORS),
        clim=(-0.5, len(_LABELS) - 0.5),
        interpolate_before_map=False,
        show_scalar_bar=False,
    )
    dot = drawn.add_points(mesh.points[[v]], color="red", point_size=16, render_points_as_spheres=True)
    dot.mapper.SetResolveCoincidentTopologyToPolygonOffset()
    dot.mapper.SetRelativeCoincidentTopologyPointOffsetParameter(_BEFORE_ALL)
    if plotter is None:
        drawn.show()
    return drawn


def _poly_data(pyvista, positions, corners, offsets):
    if offsets is None:
        return pyvista.PolyData.from_regular_faces(positions, corners.reshape(-1, 3))
    sides = np.diff(offsets)
    padded = np.insert(corners.astype(np.int64), offsets[:-1], sides)
    return pyvista.PolyData(positions, padded)
