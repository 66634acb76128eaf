# SPDX-License-Identifier: MIT
"""The paper's Figure 4, for a mesh of one's own."""

import numpy as np

from . import _convert

# What each vertex is, the later over the earlier, and the colours of the paper.
_LABELS = ("other", "ball", "paper", "exact")
_COLORS = ("lightgray", "royalblue", "gold", "forestgreen")


def plot_neighborhood(index, v, r, V, F=None, *, plotter=None):
    """Shows the neighborhood of `v` within `r` on the mesh: green what is exact, yellow what the paper's search adds,
    blue what a ball takes besides, and the vertex as a red dot.

    index : the `MeshIndex` of the mesh.    V, F : the mesh, as `MeshIndex` takes it, but not a graph.
    plotter : a pyvista.Plotter to draw on; otherwise one is made and shown.

    Returns the plotter. Needs PyVista. For a picture without a window:

        plotter = pyvista.Plotter(off_screen=True)
        meshhood.plot_neighborhood(index, 42, 1.5, V, F, plotter=plotter).screenshot("picture.png")
    """
    import pyvista

    labels = np.zeros(len(index), np.uint8)
    for label, method in enumerate(_LABELS[1:], start=1):
        labels[index.query_ball(v, r, method=method)] = label
    mesh = _poly_data(pyvista, *_convert.mesh_arrays(V, F))
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
    drawn.add_points(mesh.points[[v]], color="red", point_size=12, render_points_as_spheres=True)
    if plotter is None:
        drawn.show()
    return drawn


def _poly_data(pyvista, positions, corners, offsets):
    if offsets is None:
        return pyvista.PolyData.from_regular_faces(positions, corners.reshape(-1, 3))
    sides = np.diff(offsets)
    padded = np.insert(corners.astype(np.int64), offsets[:-1], sides)
    return pyvista.PolyData(positions, padded)
