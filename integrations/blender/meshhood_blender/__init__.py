# SPDX-License-Identifier: MIT
"""meshhood in Blender 3.4 and later: what is connected within a radius, thickness and curvature.

Lengths are in world units, so that they are those that the scene shows: the transformation of the object counts, its
modifiers do not. Operators need the Python package meshhood, and say how to install it where it is missing.
"""

from __future__ import annotations

from typing import Any

import bpy

from .measure import MESHHOOD_OT_curvature, MESHHOOD_OT_thickness
from .object_index import forget_index
from .select_connected import MESHHOOD_OT_select_connected

bl_info = {
    "name": "meshhood",
    "description": "Select what is connected within a radius; thickness and curvature as attributes",
    "author": "The meshhood authors",
    "blender": (3, 4, 0),
    "location": "Select menu in edit mode, Object menu in object mode",
    "category": "Mesh",
}

_CLASSES = (MESHHOOD_OT_select_connected, MESHHOOD_OT_thickness, MESHHOOD_OT_curvature)


def _in_select_menu(menu: Any, context: Any) -> None:
    menu.layout.separator()
    menu.layout.operator(MESHHOOD_OT_select_connected.bl_idname)


def _in_object_menu(menu: Any, context: Any) -> None:
    menu.layout.separator()
    menu.layout.operator(MESHHOOD_OT_thickness.bl_idname)
    menu.layout.operator(MESHHOOD_OT_curvature.bl_idname)


def register() -> None:
    for each in _CLASSES:
        bpy.utils.register_class(each)
    bpy.types.VIEW3D_MT_select_edit_mesh.append(_in_select_menu)
    bpy.types.VIEW3D_MT_object.append(_in_object_menu)


def unregister() -> None:
    bpy.types.VIEW3D_MT_object.remove(_in_object_menu)
    bpy.types.VIEW3D_MT_select_edit_mesh.remove(_in_select_menu)
    for each in reversed(_CLASSES):
        bpy.utils.unregister_class(each)
    forget_index()
