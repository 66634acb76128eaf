# SPDX-License-Identifier: MIT
"""The page of meshhood.view holds the mesh and the settings that it was given. tests/viewer looks at pages in a
browser."""

import base64
import json
import re

import meshes
import meshhood
import numpy as np
import pytest


@pytest.fixture(autouse=True)
def stand_in(tmp_path, monkeypatch):
    """A stand-in for the page, which may not be built here."""
    page = tmp_path / "viewer.html"
    page.write_text("<body>\n<!-- meshhood:page -->\n</body>\n")
    monkeypatch.setenv("MESHHOOD_VIEWER", str(page))
    return page


def settings_of(page):
    return json.loads(re.search(r'id="meshhood-settings">(.*)</script>', page.html)[1])


def mesh_of(page, tmp_path):
    (tmp_path / "mesh.ply").write_bytes(base64.b64decode(re.search(r'id="meshhood-mesh">(.*)</script>', page.html)[1]))
    return meshhood.read_mesh(tmp_path / "mesh.ply")


@pytest.mark.parametrize("real", [np.float32, np.float64])
def test_the_page_holds_the_mesh(tmp_path, real):
    V, F = meshes.two_plates(9)
    positions, faces = mesh_of(meshhood.view(V.astype(real), F), tmp_path)
    assert positions.dtype == real
    assert np.array_equal(positions, V)
    assert np.array_equal(faces, F)


def test_a_scan_with_holes_is_shown(tmp_path):
    V, F = meshes.two_plates(3)
    V = np.vstack([V.astype(float), [(np.nan, 0, 0)]])
    with pytest.warns(UserWarning, match="1 vertices without a position"):
        page = meshhood.view(V, F)
    with pytest.warns(UserWarning, match=r"\(NaN\), the first of which is 18, are walls"):
        np.testing.assert_array_equal(mesh_of(page, tmp_path)[0][:-1], V[:-1])


def test_polygons_keep_their_corners(tmp_path):
    V = np.random.default_rng(1).random((9, 3))
    offsets, corners = np.array([0, 3, 7, 12]), np.array([0, 1, 2, 2, 3, 4, 5, 4, 5, 6, 7, 8])
    _, faces = mesh_of(meshhood.view(V, (offsets, corners)), tmp_path)
    assert np.array_equal(faces[0], offsets)
    assert np.array_equal(faces[1], corners)


def test_a_query_an_answer_and_values_are_passed_to_the_page():
    V, F = meshes.two_plates(9)
    values = np.arange(len(V)) / 2
    page = meshhood.view(V, F, v=np.int64(7), r=2, unit="edge", ids=[3, 1], values=values, name="</script>")
    settings = settings_of(page)
    scalar = np.frombuffer(base64.b64decode(settings.pop("scalar")["values"]), "<f4")
    assert np.array_equal(scalar, values.astype(np.float32))
    assert settings == {"name": "</script>", "vertex": 7, "radius": 2.0, "unit": "edge", "ids": [3, 1]}


def test_a_notebook_gets_a_frame_and_a_file_the_page(tmp_path):
    V, F = meshes.two_plates(5)
    page = meshhood.view(V, F, height=321)
    assert "height: 321px" in page._repr_html_()
    assert '"' not in re.search(r'srcdoc="([^"]*)"', page._repr_html_())[1]
    page.save(tmp_path / "page.html")
    assert (tmp_path / "page.html").read_text() == page.html


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"v": 9999}, "v: vertex 9999"),
        ({"r": -1}, "r: radius -1"),
        ({"r": float("inf")}, "finite"),
        ({"unit": "foot"}, "unit: "),
        ({"height": 0}, "height: 0"),
        ({"ids": [-1]}, "ids: row 0: vertex -1"),
        ({"values": [1.0, 2.0]}, "values: an array of shape"),
        ({"values": np.full(len(meshes.two_plates(5)[0]), -1e300)}, "values: vertex 0: -1e\\+300, but a page holds numbers of at most 3.4e\\+38"),
    ],
)
def test_wrong_arguments_are_named(options, message):
    with pytest.raises(ValueError, match=message):
        meshhood.view(*meshes.two_plates(5), **options)


@pytest.mark.parametrize(
    ("V", "F", "message"),
    [
        (np.zeros((3, 3)), [[0, 1, 7]], "F: face 0"),
        ([(0, 0, 0), (1, 0, 0), (0, np.inf, 0)], [[0, 1, 2]], "V: vertex 2: .*inf"),
        (np.zeros((99, 3)), [[0, 1, 2]], "V: a mesh of 2[0-9]{3} bytes, but a page holds at most 999"),
    ],
)
def test_meshes_that_the_page_cannot_open_are_refused(V, F, message, monkeypatch):
    monkeypatch.setattr(meshhood._view, "_MOST_BYTES", 999)
    with pytest.raises(ValueError, match=message):
        meshhood.view(np.asarray(V, float), np.asarray(F))


def test_the_error_for_a_missing_page_says_how_to_build_it(monkeypatch, stand_in):
    monkeypatch.delenv("MESHHOOD_VIEWER")
    monkeypatch.setattr(meshhood._view, "__file__", str(stand_in.parent / "nowhere" / "_view.py"))
    with pytest.raises(FileNotFoundError, match=r"run 'make view && pip install \.' in the sources"):
        meshhood.view(*meshes.two_plates(5))
    monkeypatch.setenv("MESHHOOD_VIEWER", meshes.__file__)
    with pytest.raises(ValueError, match="not the page"):
        meshhood.view(*meshes.two_plates(5))
