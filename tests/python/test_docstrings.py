# SPDX-License-Identifier: MIT
"""Each public function, and each public method of an index, has an example in its docstring, which runs."""

import doctest
import inspect

import meshhood
import numpy as np
import pytest

FUNCTIONS = [name for name in meshhood.__all__ if inspect.isfunction(getattr(meshhood, name))]
METHODS = [name for name, thing in inspect.getmembers(meshhood.MeshIndex, inspect.isfunction) if name[0] != "_"]
OBJECTS = {
    **{name: getattr(meshhood, name) for name in FUNCTIONS},
    **{f"MeshIndex.{name}": getattr(meshhood.MeshIndex, name) for name in METHODS},
    **{name: getattr(meshhood, name) for name in ("MeshIndex", "Paper", "RegionMesh")},
}


@pytest.mark.parametrize("name", OBJECTS)
def test_the_example_runs(name, tmp_path, monkeypatch):
    sphere = pytest.importorskip("trimesh").creation.icosphere(subdivisions=3)
    sphere.export(tmp_path / "hand.ply")
    monkeypatch.chdir(tmp_path)
    names = {"meshhood": meshhood, "np": np, "V": np.array(sphere.vertices), "F": np.array(sphere.faces)}
    if name == "plot_neighborhood":
        names["pyvista"] = pytest.importorskip("pyvista")
    if name == "open_parts":
        pytest.importorskip("dask.array")
    if name == "view":
        page = tmp_path / "viewer.html"
        page.write_text(f"<html>{meshhood._view._PLACE}</html>", encoding="utf-8")
        monkeypatch.setenv("MESHHOOD_VIEWER", str(page))
    example = doctest.DocTestParser().get_doctest(inspect.getdoc(OBJECTS[name]), names, name, None, 0)
    assert example.examples, f"{name} has no example"
    lines = []
    doctest.DocTestRunner().run(example, out=lines.append)
    assert not lines, "".join(lines)
