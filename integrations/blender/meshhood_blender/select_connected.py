# SPDX-License-Identifier: MIT
"""Selects the front of a sleeve, not its back."""

from __future__ import annotations

from typing import Any

import bmesh
import bpy
import numpy as np

from .object_index import index_of
from .operator_parts import Reporting, choose_radius, metric_property, radius_property


class MESHHOOD_OT_select_connected(Reporting, bpy.types.Operator):
    """Select the vertices that are connected with the active vertex within a radius. Hidden vertices separate"""

    bl_idname = "meshhood.select_connected"
    bl_label = "Select Connected within Radius"

    radius: radius_property("How far, in world units")  # type: ignore
    metric: metric_property()  # type: ignore
    extend: bpy.props.BoolProperty(name="Extend", description="Keep the selection", default=False)  # type: ignore

    @classmethod
    def poll(cls, context: Any) -> bool:
        if context.mode == "EDIT_MESH" and context.edit_object is not None:
            return True
        cls.poll_message_set("expected a mesh in edit mode")
        return False

    def _run(self, context: Any, progress: Any) -> None:
        obj = context.edit_object
        edited = bmesh.from_edit_mesh(obj.data)
        active = edited.select_history.active
        if not isinstance(active, bmesh.types.BMVert):
            raise ValueError("No active vertex: in vertex select mode, click one")
        obj.update_from_editmode()
        index = index_of(obj, progress)
        choose_radius(self, index)
        hidden = np.empty(len(index), bool)
        obj.data.vertices.foreach_get("hide", hidden)
        walls = hidden if hidden.any() else None
        found = index.neighborhood(active.index, self.radius, metric=self.metric, walls=walls)
        _select(edited, found.tolist(), self.extend)
        bmesh.update_edit_mesh(obj.data, loop_triangles=False, destructive=False)
        self.report({"INFO"}, f"{len(found)} vertices")


def _select(edited: Any, vertices: list[int], extend: bool) -> None:
    """Selects vertices, and the edges and faces between them; unless `extend`, no others."""
    for elements in () if extend else (edited.verts, edited.edges, edited.faces):
        for element in elements:
            element.select = False
    edited.verts.ensure_lookup_table()
    for vertex in vertices:
        edited.verts[vertex].select = True
    edited.select_flush(True)
    edited.select_history.validate()
