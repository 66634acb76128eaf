# SPDX-License-Identifier: MIT
"""A page that shows a mesh and its neighborhoods: viewer/ of the sources, built into one HTML file."""

from __future__ import annotations

import base64
import html
import json
import os
import webbrowser
from pathlib import Path
from typing import Any, Optional, Union

from . import _convert, _core
from ._mesh import mesh_arrays, placed
from ._other_files import binary_ply
from ._types import Number, Unit, Vertex, Vertices

_PLACE = "<!-- meshhood:page -->"  # replaced by the mesh
_MOST_BYTES = 256 << 20  # a browser holds a text of at most 2^29 characters


class Page:
    """A page that shows a mesh and its neighborhoods. A notebook displays it.

    >>> page = meshhood.view(V, F, v=42, r=0.3)
    """

    html: str
    """The whole page: it needs neither a server nor a network."""

    def __init__(self, html: str, height: int) -> None:
        self.html = html
        self._height = height

    def save(self, path: Union[str, os.PathLike[str]]) -> None:
        """Writes the page to a file, which appears whole or not at all. Raises OSError, with errno and filename; an old
        file of that name is then unchanged.

        >>> meshhood.view(V, F).save("hand.html")
        """
        with _core.FileWriter(_convert.path(path)) as file:
            file.write(self.html.encode())

    def open(self, path: Union[str, os.PathLike[str]]) -> None:
        """Writes the page to a file and opens it in the browser.

        >>> meshhood.view(V, F, values=V[:, 2]).open("heights.html")
        """
        self.save(path)
        webbrowser.open(Path(os.fsdecode(path)).resolve().as_uri())

    def __repr__(self) -> str:
        return f"<meshhood.Page: {len(self.html)} characters>"

    def _repr_html_(self) -> str:
        return (
            f'<iframe srcdoc="{html.escape(self.html)}" style="width: 100%; height: {self._height}px; border: 0" '
            'allow="fullscreen; clipboard-write"></iframe>'
        )


def view(
    V: Any,
    F: Any = None,
    *,
    v: Optional[Vertex] = None,
    r: Optional[Number] = None,
    unit: Unit = "mesh",
    ids: Vertices = None,
    values: Any = None,
    name: str = "mesh",
    height: int = 600,
) -> Page:
    """Makes an interactive page of the mesh, to choose a vertex and a radius and to compare the answers of all methods:
    the exact neighborhood in green, extra vertices of the search of the paper in yellow, further vertices of the ball
    in blue.

    >>> page = meshhood.view(V, F, v=42, r=10, unit="edge")  # displayed by a notebook
    >>> meshhood.view(V, F, values=V[:, 2]).save("heights.html")

    V, F : the mesh, as for `MeshIndex`, but not a graph.
    v, r, unit : the query to show at first, as for `MeshIndex.neighborhood`; by default the page chooses one.
    ids : vertices to show instead of the answers, until another query is made: a sequence or a bool mask (#V,).
    values : (#V,) a number for each vertex, shown as colors. Values that are not finite get no color.
    name : the name of the mesh on the page.
    height : the height of the page in a notebook, in pixels.

    The page holds the positions and faces, about 60 bytes for each vertex of a closed triangle mesh of float32, of at
    most 6 million vertices, and builds its own index in the browser. Raises ValueError or TypeError, naming the
    argument, and FileNotFoundError if the page was not built before this package was installed.
    """
    page = _built_page()
    if hasattr(F, "tocoo"):
        raise TypeError("F: expected faces, not a graph")
    mesh = mesh_arrays(V, F)
    _core.check_mesh(placed(mesh, stacklevel=3)[0])
    settings = _settings(len(mesh[0]), v, r, unit, ids, values, name)
    height = _convert.integer(height, "height")
    script = json.dumps(settings).replace("<", "\\u003c")
    ply = binary_ply(*mesh)  # the page makes walls of vertices without a position, as it does for a file
    if len(ply) > _MOST_BYTES:
        raise ValueError(f"V: a mesh of {len(ply)} bytes, but a page holds at most {_MOST_BYTES}; drop a file onto one")
    data = (
        f'<script type="application/json" id="meshhood-settings">{script}</script>\n'
        f'<script type="text/plain" id="meshhood-mesh">{base64.b64encode(ply).decode("ascii")}</script>\n'
    )
    return Page(page.replace(_PLACE, data, 1), height)


def _built_page() -> str:
    named = os.environ.get("MESHHOOD_VIEWER")
    path = Path(named) if named else Path(__file__).with_name("viewer.html")
    if not path.exists():
        raise FileNotFoundError(
            f"{path}: the viewer is not built: run 'make view && pip install .' in the sources of meshhood, or name "
            "its viewer.html in MESHHOOD_VIEWER"
        )
    text = path.read_text(encoding="utf-8")
    if _PLACE not in text:
        raise ValueError(f"{path}: is not the page of the viewer")
    return text


def _settings(count: int, v: Any, r: Any, unit: Any, ids: Any, values: Any, name: Any) -> dict[str, Any]:
    settings: dict[str, Any] = {"name": str(name)}
    if v is not None:
        settings["vertex"] = _convert.vertex(v, count, "v")
    unit = _convert.choice(unit, "unit", ("mesh", "edge"))
    if r is not None:
        settings["radius"] = _convert.radius(r)
        settings["unit"] = unit
        if settings["radius"] == float("inf"):
            raise ValueError("r: radius inf, expected a finite number")
    if ids is not None:
        settings["ids"] = _convert.vertices(ids, count, "ids").tolist()
    if values is not None:
        settings["scalar"] = {"title": "values", "values": _encode(values, count)}
    return settings


def _encode(values: Any, count: int) -> str:
    array = _convert.numbers(values, "values", "biuf")
    if array.shape != (count,):
        raise ValueError(f"values: an array of shape {array.shape}, expected ({count},)")
    numbers = _convert.as_float32(array, "values", "a page")
    return base64.b64encode(numbers.astype("<f4").tobytes()).decode("ascii")
