# SPDX-License-Identifier: MIT
"""Draws a neighborhood as in Figure 4 of the paper."""

from __future__ import annotations

from typing import Any, Optional

import numpy as np
from numpy.typing import ArrayLike

from . import _convert
from ._index import MeshIndex
from ._mesh import mesh_arrays, poly_data
from ._optional import optional
from ._types import Mask, Metric, Number, Unit, Vertex

# A vertex that belongs to nothing, and to each layer of a plot, the last in front; the colors of the paper.
_COLORS = ("lightgray", "royalblue", "gold", "forestgreen")

# In steps of depth, of which VTK has 2^16: in front of everything.
_IN_FRONT = -66000

_VIEW_ANGLE = 30.0  # degrees


def plot_neighborhood(
    index: MeshIndex,
    v: Vertex,
    r: Optional[Number] = None,
    V: Any = None,
    F: Any = None,
    *,
    ids: Optional[ArrayLike] = None,
    metric: Metric = "straight",
    walls: Mask = None,
    ignored: Mask = None,
    unit: Unit = "mesh",
    legend: bool = True,
    plotter: Any = None,
) -> Any:
    """Draws the neighborhood of `v` within `r` on the mesh: the exact neighborhood in green, what the search of the
    paper adds in yellow, what the ball adds in blue, the rest in gray, and the vertex as a red dot that is always
    visible. With metric="path", green is what paths reach, and yellow what the straight metric adds; with masks, yellow
    is what they take away.

    index : the `MeshIndex` of the mesh.
    v, r, metric, walls, ignored, unit : the query, as for `MeshIndex.neighborhood`.
    V, F : the mesh, as for `MeshIndex`, but not a graph; None for the faces that the index keeps.
    ids : draw these vertices in green instead, (n,) ids or a bool mask (#V,).
    legend : explain the colors, with the number of vertices of each.
    plotter : a pyvista.Plotter to draw on; otherwise one is made and shown.

    The camera looks at the vertex along the normal of the surface, from a distance at which the whole ball is visible.
    Parts of the mesh that lie between the camera and the ball are cut away.

    Returns the plotter. Needs PyVista. For a picture without a window:

    >>> index, plotter = meshhood.MeshIndex(V, F), pyvista.Plotter(off_screen=True)
    >>> image = meshhood.plot_neighborhood(index, 42, 0.5, plotter=plotter).screenshot("picture.png")
    """
    pyvista = optional("pyvista", "plot_neighborhood")
    v = _convert.vertex(v, len(index), "v")
    if (r is None) == (ids is None):
        raise TypeError("r: expected a radius, or ids instead")
    if ids is None:
        words: Any = {"metric": metric, "walls": walls, "ignored": ignored}
        layers = _layers(index, v, r, words, unit)
    else:
        layers = {"ids": _convert.vertices(ids, len(index), "ids")}
    labels = np.zeros(len(index), np.uint8)
    for label, found in enumerate(layers.values(), start=len(_COLORS) - len(layers)):
        labels[found] = label
    arrays = (index.positions, *index._face_arrays(F)) if V is None else mesh_arrays(V, F)
    mesh = poly_data(pyvista, *arrays)
    if mesh.n_points != len(index):
        raise ValueError(f"V: {mesh.n_points} vertices, but the index has {len(index)}")
    drawn = pyvista.Plotter() if plotter is None else plotter
    drawn.add_mesh(
        mesh,
        scalars=labels,
        cmap=list(_COLORS),
        clim=(-0.5, len(_COLORS) - 0.5),
        interpolate_before_map=False,
        show_scalar_bar=False,
    )
    _add_dot(drawn, mesh.points[[v]])
    if legend:
        _add_legend(drawn, v, list(layers), labels)
    _aim(drawn, mesh, v, labels)
    if plotter is None:
        drawn.show()
    return drawn


def _layers(index: MeshIndex, v: int, r: Any, words: Any, unit: Unit) -> dict[str, Any]:
    """The vertices of each layer, by its name in the legend; each nearly always contains the one that follows."""
    ball, exact = (index.neighborhood(v, r, unit=unit, method=method) for method in ("ball", "exact"))
    if words["metric"] == "straight" and words["walls"] is None and words["ignored"] is None:
        return {"ball": ball, "paper": index.neighborhood(v, r, unit=unit, method="paper"), "exact": exact}
    return {"ball": ball, "straight": exact, "asked": index.neighborhood(v, r, unit=unit, **words)}


def _add_dot(plotter, point):
    dot = plotter.add_points(point, color="red", point_size=16, render_points_as_spheres=True)
    dot.mapper.SetResolveCoincidentTopologyToPolygonOffset()
    dot.mapper.SetRelativeCoincidentTopologyPointOffsetParameter(_IN_FRONT)


def _add_legend(plotter, v, names, labels):
    counts = [int((labels == label).sum()) for label in range(len(_COLORS))]
    colors = _COLORS[len(_COLORS) - len(names) :]
    entries = [[f"vertex {v}", "red"], [f"{names[-1]}: {counts[-1]}", colors[-1]]]
    for name, color in reversed(list(zip(names[:-1], colors))):
        entries.append([f"{name} adds {counts[_COLORS.index(color)]}", color])
    entries.append([f"other: {counts[0]}", _COLORS[0]])
    plotter.add_legend(entries, bcolor="#303030", border=True, face="rectangle", size=(0.3, 0.25), loc="lower right")


def _aim(plotter, mesh, v, labels):
    """Looks at vertex `v` along its normal, so that what is not "other" fills the picture."""
    offsets = mesh.points.astype(np.float64) - mesh.points[v]
    normal, edge = _normal_and_edge(mesh, offsets, v)
    # From the side on which fewer of the other parts lie, because they would hide the exact neighborhood.
    if np.sign(offsets[(labels == 1) | (labels == 2)] @ normal).sum() > 0:
        normal = -normal
    extent = np.linalg.norm(offsets[labels > 0], axis=1).max() + 1.5 * edge or 1.0
    distance = extent / np.sin(np.radians(_VIEW_ANGLE / 2))
    camera = plotter.camera
    camera.view_angle = _VIEW_ANGLE
    camera.focal_point = mesh.points[v]
    camera.position = mesh.points[v] + distance * normal
    camera.up = np.roll((0.0, 0.0, 1.0), np.abs(normal[::-1]).argmin() * -1)
    camera.clipping_range = (distance - extent, distance + np.linalg.norm(offsets, axis=1).max() + extent)
    camera.is_set = True


def _normal_and_edge(mesh, offsets, v):
    """The unit normal of the faces at `v`, and the length of their longest edge."""
    normal, edge = np.zeros(3), 0.0
    for face in mesh.point_cell_ids(v):
        corners = offsets[mesh.get_cell(face).point_ids]
        following = np.roll(corners, -1, axis=0)
        normal += np.cross(corners, following).sum(axis=0)
        edge = max(edge, np.linalg.norm(following - corners, axis=1).max())
    length = np.linalg.norm(normal)
    return (normal / length if length > 0 else np.array([0.0, 0.0, 1.0])), edge
