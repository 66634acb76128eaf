# SPDX-License-Identifier: MIT
"""What the operators have in common: properties of redo panels, messages, progress."""

from __future__ import annotations

import re
import warnings
from typing import Any

import bpy

_EDGES = 5  # of the first radius
_ADVICE = (  # calls of Python in warnings of the package, and the menus of edit mode that do the same
    (r"pass F=F\[:, ::-1\]", "use Mesh > Normals > Recalculate Outside"),
    (r"V, F, ids = meshhood\.weld\(V, F\)", "Mesh > Merge > By Distance"),
    (r"V, F, ids = meshhood\.weld\(V, F, eps=(.*)\)", r"Mesh > Merge > By Distance, of \1 world units"),
)


def radius_property(text: str) -> Any:
    return bpy.props.FloatProperty(name="Radius", description=text, subtype="DISTANCE", min=0, default=1)


def metric_property() -> Any:
    return bpy.props.EnumProperty(
        name="Metric",
        description="How distances are measured",
        items=(
            ("straight", "Straight", "By straight lines; what is found is connected inside the ball"),
            ("path", "Path along Edges", "By shortest paths along edges"),
            ("surface", "Path along Surface", "By paths that also run straight over two triangles, nearly geodesics"),
        ),
    )


def choose_radius(operator: Any, index: Any) -> None:
    """Sets the radius of an operator that was called without one: five mean edges."""
    if not operator.properties.is_property_set("radius"):
        operator.radius = _EDGES * index.mean_edge_length


class Reporting:
    """An operator that reports its errors, warnings and progress. Derived classes have `_run`."""

    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context: Any) -> set[str]:
        manager = context.window_manager
        manager.progress_begin(0, 100)
        try:
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always", UserWarning)
                self._run(context, lambda done, total: manager.progress_update(100 * done / max(total, 1)))
        except (ImportError, MemoryError, TypeError, ValueError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        finally:
            manager.progress_end()
        for warning in caught:
            text = str(warning.message)
            for call, here in _ADVICE:
                text = re.sub(call, here, text)
            self.report({"WARNING"}, text)
        return {"FINISHED"}
