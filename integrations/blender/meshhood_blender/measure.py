# SPDX-License-Identifier: MIT
"""Thickness and curvature as attributes of the vertices, for geometry nodes and shaders, and as colors."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np

from .object_index import index_of
from .operator_parts import Reporting, choose_radius, metric_property, radius_property

_COLORS = "meshhood"  # the color attribute of what was measured last
_BLUE, _WHITE, _RED, _GREY = (0.04, 0.12, 0.6), (0.8, 0.8, 0.8), (0.6, 0.02, 0.02), (0.1, 0.1, 0.1)


def _color_property() -> Any:
    return bpy.props.BoolProperty(
        name="Colors",
        description="Also write the color attribute that Solid view shows with Color: Attribute",
        default=True,
    )


class _Measure(Reporting):
    """An operator on the active mesh in object mode that writes a float attribute."""

    @classmethod
    def poll(cls, context: Any) -> bool:
        if context.mode == "OBJECT" and context.object is not None and context.object.type == "MESH":
            return True
        cls.poll_message_set("expected an active mesh in object mode")
        return False

    def _run(self, context: Any, progress: Any) -> None:
        mesh = context.object.data
        if len(mesh.polygons) == 0:
            raise ValueError(f"{context.object.name} has no faces")
        name, values, strengths = self._measured(index_of(context.object, progress), progress)
        written = {name: ("FLOAT", "value", values)}
        if self.colors:
            written[_COLORS] = ("FLOAT_COLOR", "color", _colors(strengths))
        _write(context.object, written)
        if self.colors:
            mesh.color_attributes.active_color = mesh.color_attributes[_COLORS]
        mesh.update()
        self.report({"INFO"}, f"Attribute {name}")


class MESHHOOD_OT_thickness(_Measure, bpy.types.Operator):
    """Write the thickness of the wall at each vertex, in world units, to the attribute thickness. Thin is red"""

    bl_idname = "meshhood.thickness"
    bl_label = "Measure Thickness"

    method: bpy.props.EnumProperty(  # type: ignore
        name="Method",
        description="How thickness is measured",
        items=(
            ("ray", "Ray", "The way against the normal to the surface; infinite where nothing is met"),
            ("sphere", "Sphere", "The diameter of the largest ball that touches the surface there from inside"),
        ),
    )
    colors: _color_property()  # type: ignore

    def _measured(self, index: Any, progress: Any) -> tuple[str, Any, Any]:
        values = index.thickness(method=self.method, progress=progress)
        return "thickness", values, -_between(values, *_usual(values))


class MESHHOOD_OT_curvature(_Measure, bpy.types.Operator):
    """Write the curvature at the scale of a radius to an attribute of its name. Convex is red, concave is blue"""

    bl_idname = "meshhood.curvature"
    bl_label = "Measure Curvature"

    kind: bpy.props.EnumProperty(  # type: ignore
        name="Kind",
        description="What is written; curvatures are in 1 / world unit",
        items=(
            ("mean", "Mean", "Mean curvature, to mean_curvature"),
            ("gaussian", "Gaussian", "Gaussian curvature, to gaussian_curvature"),
            ("k1", "Largest", "The larger principal curvature, to k1"),
            ("k2", "Smallest", "The smaller principal curvature, to k2"),
            ("curvedness", "Curvedness", "How much the surface is curved, to curvedness"),
            ("shape_index", "Shape Index", "From -1 in a bowl over 0 on a saddle to 1 on a dome, to shape_index"),
        ),
    )
    radius: radius_property("The scale of the curvature, in world units; a larger one smooths noise")  # type: ignore
    metric: metric_property()  # type: ignore
    colors: _color_property()  # type: ignore

    def _measured(self, index: Any, progress: Any) -> tuple[str, Any, Any]:
        choose_radius(self, index)
        found = index.curvature(self.radius, metric=self.metric, progress=progress)
        values = getattr(found, self.kind)
        name = f"{self.kind}_curvature" if self.kind in ("mean", "gaussian") else self.kind
        most = max(map(abs, _usual(values)))
        return name, values, _between(values, -most, most)


def _write(obj: Any, written: dict[str, tuple[str, str, Any]]) -> None:
    """Attributes of the vertices by name: their type, its member, the values. All or none; they replace those of the
    same name and type."""
    mesh = obj.data
    for name, (data_type, _, _) in written.items():
        found = mesh.attributes.get(name)
        if found is None and name in obj.vertex_groups:  # a new attribute would get another name
            raise ValueError(f"The mesh has a vertex group {name}: rename or remove it")
        if found is not None and (found.data_type, found.domain) != (data_type, "POINT"):
            raise ValueError(f"The mesh has another attribute {name}: rename or remove it")
    for name, (data_type, _, _) in written.items():  # all, before one is written: a new one moves the others
        if name not in mesh.attributes:
            mesh.attributes.new(name, data_type, "POINT")
    for name, (_, member, values) in written.items():
        mesh.attributes[name].data.foreach_set(member, values.astype(np.float32).ravel())


def _usual(values: Any) -> tuple[float, float]:
    """The limits between which nine tenths of the finite values lie."""
    finite = values[np.isfinite(values)]
    low, high = np.percentile(finite, (5, 95)) if finite.size else (0.0, 0.0)
    return float(low), float(high)


def _between(values: Any, low: float, high: float) -> Any:
    """-1 at the lower limit and below, 1 at the upper one and above; NaN stays."""
    least = max(1e-6 * max(abs(low), abs(high)), np.finfo(float).tiny)  # below it, rounding
    with np.errstate(over="ignore"):
        return np.clip((2 * values - low - high) / max(high - low, least), -1, 1)


def _colors(strengths: Any) -> Any:
    """(n, 4): from blue at -1 over white to red at 1; grey for NaN."""
    channels = [np.interp(strengths, (-1, 0, 1), three) for three in zip(_BLUE, _WHITE, _RED)]
    colors = np.stack([*channels, np.ones(len(strengths))], axis=1)
    colors[np.isnan(strengths), :3] = _GREY
    return colors
