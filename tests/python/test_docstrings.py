# SPDX-License-Identifier: MIT
"""Each public class, function and method has an example in its docstring, which runs. Other code of docstrings does,
too."""

import doctest
import importlib
import inspect
import pkgutil
import re
import webbrowser

import meshhood
import meshhood.distributed
import numpy as np
import pytest


def objects():
    """Each public class and function, and each public method of a class, by name."""
    for module in (meshhood, meshhood.distributed):
        for name in module.__all__:
            thing = getattr(module, name)
            if inspect.isclass(thing) or inspect.isfunction(thing):
                yield name, thing
            if inspect.isclass(thing):
                for method, function in inspect.getmembers(thing, lambda x: inspect.isfunction(x) or inspect.ismethod(x)):
                    if method[0] != "_":
                        yield f"{name}.{method}", function


OBJECTS = {**dict(objects()), "distributed": meshhood.distributed, "meshhood": meshhood}
OF_PARTS = ("distributed", "open_parts", "map_meshes", "Parts", "OpenPart", "PartSize")


def test_the_list_of_calls_has_each():
    lists = inspect.getdoc(meshhood).split("shows one:")[1]
    calls = re.findall(r"[\w.]+", re.sub(r"^- .*?:|; .*:", " ", lists, flags=re.M))
    of_index = {name for name in dir(meshhood.MeshIndex) if name[0] != "_"}
    functions = {f"meshhood.{name}" for name in meshhood.__all__ if inspect.isfunction(getattr(meshhood, name))}
    assert set(calls) == of_index | functions


@pytest.mark.parametrize("name", OBJECTS)
def test_the_example_runs(name, tmp_path, monkeypatch):
    sphere = pytest.importorskip("trimesh").creation.icosphere(subdivisions=3)
    sphere.export(tmp_path / "hand.ply")
    sphere.export(tmp_path / "scan.ply")
    monkeypatch.chdir(tmp_path)
    names = {"meshhood": meshhood, "np": np, "V": np.array(sphere.vertices), "F": np.array(sphere.faces)}
    if name == "plot_neighborhood":
        names["pyvista"] = pytest.importorskip("pyvista")
    if name.split(".")[0] in OF_PARTS:
        pytest.importorskip("dask.array")
    if name.split(".")[0] in ("view", "Page"):
        monkeypatch.setattr(webbrowser, "open", lambda address: None)
        page = tmp_path / "viewer.html"
        page.write_text(f"<html>{meshhood._view._PLACE}</html>", encoding="utf-8")
        monkeypatch.setenv("MESHHOOD_VIEWER", str(page))
    example = doctest.DocTestParser().get_doctest(inspect.getdoc(OBJECTS[name]), names, name, None, 0)
    assert example.examples, f"{name} has no example"
    lines = []
    doctest.DocTestRunner().run(example, out=lines.append)
    assert not lines, "".join(lines)


def docstrings():
    """The docstrings of all modules of the package, with their names."""
    finder = doctest.DocTestFinder(exclude_empty=True)
    for module in pkgutil.iter_modules(meshhood.__path__):
        if module.name not in ("_core", "_pyvista"):  # compiled; of PyVista, which loads it
            for found in finder.find(importlib.import_module(f"meshhood.{module.name}")):
                yield found.name, found.docstring
    yield "meshhood", meshhood.__doc__


def test_all_code_runs():
    """Code of a docstring is an example of those above: its lines are indented, and begin with >>>."""
    tested = {inspect.getdoc(thing) for thing in OBJECTS.values()}
    left = []
    for name, text in docstrings():
        paragraphs = inspect.cleandoc(text).split("\n\n")
        code = [lines for lines in paragraphs if all(line.startswith("    ") for line in lines.splitlines())]
        if any(">>>" not in lines for lines in code) or (code and inspect.cleandoc(text) not in tested):
            left.append(name)
    assert left == []
