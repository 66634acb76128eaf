# SPDX-License-Identifier: MIT
"""The picture of a neighborhood, checked by its colors."""

import meshes
import meshhood
import numpy as np
import pytest

pyvista = pytest.importorskip("pyvista")


def pixels(picture, red, green, blue):
    """The number of pixels of about this hue."""
    wanted = np.array([red, green, blue]) / np.linalg.norm([red, green, blue])
    rgb = picture.reshape(-1, 3).astype(float)
    size = np.linalg.norm(rgb, axis=1)
    return int(((rgb @ wanted) > 0.99 * np.maximum(size, 60)).sum())


def test_colors(tmp_path):
    V, F = meshes.two_plates(20)
    V[len(V) // 2 :, 0] += 25  # side by side, so that the camera sees both
    index = meshhood.MeshIndex(V, F)
    plotter = pyvista.Plotter(off_screen=True, window_size=(600, 400))
    meshhood.plot_neighborhood(index, 210, 20.0, V, F, plotter=plotter)
    plotter.view_xy()
    picture = plotter.screenshot(str(tmp_path / "picture.png"), return_img=True)
    green, blue = pixels(picture, 34, 139, 34), pixels(picture, 65, 105, 225)
    print(f"{green} green, {blue} blue of {picture.shape[0] * picture.shape[1]} pixels")
    assert green > 1000
    assert blue > 1000


def test_the_vertex_is_visible_through_the_mesh_in_front_of_it():
    V, F = meshes.two_plates(20)
    V[len(V) // 2 :, 2] += 10
    index = meshhood.MeshIndex(V, F)
    plotter = pyvista.Plotter(off_screen=True, window_size=(600, 400))
    meshhood.plot_neighborhood(index, 210, 3.0, V, F, plotter=plotter)  # on the lower plate, seen from above
    plotter.view_xy()
    red = pixels(plotter.screenshot(return_img=True), 255, 0, 0)
    print(f"{red} red")
    assert red > 50


def test_one_vertex_is_expected():
    V, F = meshes.two_plates(5)
    index = meshhood.MeshIndex(V, F)
    for v, error in (([0, 1], TypeError), (50, ValueError)):
        with pytest.raises(error, match="v: "):
            meshhood.plot_neighborhood(index, v, 1.0, V, F, plotter=object())


def test_another_mesh_is_refused():
    V, F = meshes.two_plates(5)
    index = meshhood.MeshIndex(V, F)
    with pytest.raises(ValueError, match="V: 36 vertices, but the index has 50"):
        meshhood.plot_neighborhood(index, 0, 1.0, *meshes.grid(6), plotter=object())


@pytest.mark.parametrize("edges", (0, 3, 15, np.inf))
@pytest.mark.parametrize("scale", (1e-6, 1e-3, 1.0, 1e3, 1e6))
def test_the_camera_shows_the_region_at_any_scale_and_radius(scale, edges):
    V, F = meshes.two_plates(40)
    V = scale * (V + 1000)
    index = meshhood.MeshIndex(V, F)
    v = 15 * 40 + 20
    plotter = pyvista.Plotter(off_screen=True, window_size=(600, 400))
    meshhood.plot_neighborhood(index, v, edges, V, F, unit="edge", plotter=plotter, legend=False)
    picture = plotter.screenshot(return_img=True)
    plotter.close()
    red = np.argwhere((picture[:, :, 0] > 150) & (picture[:, :, 1:] < 80).all(axis=2))
    is_green = picture[:, :, 1] > picture[:, :, ::2].max(axis=2).astype(int) + 20  # fades out over one edge
    green = int(is_green.sum())
    print(f"{green} green pixels, red around {red.mean(axis=0)}")
    np.testing.assert_allclose(red.mean(axis=0), (200, 300), atol=5)
    if edges > 0:  # the region of radius 0 is the vertex itself, which is red
        assert green > 500
    if edges < 20:
        assert not np.concatenate([is_green[0], is_green[-1], is_green[:, 0], is_green[:, -1]]).any()


def test_the_legend_explains_every_color():
    V, F = meshes.two_plates(10)
    index = meshhood.MeshIndex(V, F)
    for legend, entries in ((True, 5), (False, 0)):
        plotter = pyvista.Plotter(off_screen=True)
        meshhood.plot_neighborhood(index, 55, 3.0, V, F, plotter=plotter, legend=legend)
        drawn = plotter.renderer.legend
        assert (drawn.GetNumberOfEntries() if drawn else 0) == entries
        plotter.close()


def test_any_ids_and_metrics_are_drawn():
    V, F = meshes.two_plates(10)
    index = meshhood.MeshIndex(V, F)
    walls = V[:, 0] > 6
    for words, entries in (
        ({"ids": index.neighborhood(55, 2.0)}, 3),
        ({"ids": V[:, 0] > 4}, 3),
        ({"r": 3.0, "metric": "path"}, 5),
        ({"r": 3.0, "walls": walls}, 5),
    ):
        plotter = pyvista.Plotter(off_screen=True)
        meshhood.plot_neighborhood(index, 55, plotter=plotter, **words)
        assert plotter.renderer.legend.GetNumberOfEntries() == entries
        plotter.close()
    for words in ({}, {"r": 1.0, "ids": [1]}):
        with pytest.raises(TypeError, match="r: expected a radius, or ids instead"):
            meshhood.plot_neighborhood(index, 0, plotter=object(), **words)
