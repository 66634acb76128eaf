# SPDX-License-Identifier: MIT
"""The paper's Figure 4: exact green over paper yellow over ball blue, the vertex red; drawn off screen."""
import os
from dataclasses import dataclass

from . import meshes, places, programs, results

# VTK would otherwise look for a screen.
os.environ.setdefault("PYVISTA_OFF_SCREEN", "true")
PIXELS = (800, 800)
SHOWN = "e"  # by the page; the others are in build


@dataclass(frozen=True)
class Picture:
    """The vertex is the one nearest to `at`, a place in the box of the mesh (0 to 1 along each axis), because the paper
    does not state its vertices."""

    letter: str
    mesh: str
    radius_edges: float
    at: tuple
    towards: tuple  # from the vertex to the eye
    up: tuple
    width: float = 2.2  # of the picture, over the diameter of the ball


PICTURES = (
    Picture("a", "cat2", 40, (0.724, 0.347, 0.07), (0, -1, 0.3), (0, 0, 1), 2),
    Picture("b", "victoria0", 50, (0.529, 0.577, 0.135), (0.2, -1, 0.2), (0, 0, 1)),
    Picture("c", "dragon", 85, (0.875, 0.271, 0.524), (0.75, 0.25, -0.7), (0, 1, 0)),
    Picture("d", "head_skin", 70, (0.037, 0.342, 0.49), (-1, 0.2, 0.1), (0, 0, 1)),
    Picture("e", "victoria0", 10, (0.995, 0.067, 0.784), (0.3, -1, 0.5), (0, 0, 1)),
)


def run(names):
    watched = results.begin("Figure 4")
    drawn = [draw(picture) for picture in PICTURES if not names or picture.mesh in names]
    results.save("figure4", {"pictures": drawn}, watched)


def draw(picture):
    import meshhood
    import pyvista

    print(f"  {picture.letter}", flush=True)
    mesh = meshes.as_file(picture.mesh)
    positions, faces = meshhood.read_mesh(mesh)
    radius = picture.radius_edges * programs.race(mesh)["mean_edge_length"]
    index = meshhood.MeshIndex(positions, faces)
    v = nearest(positions, picture.at)
    plotter = pyvista.Plotter(off_screen=True, window_size=PIXELS)
    plotter.background_color = "white"
    meshhood.plot_neighborhood(index, v, radius, positions, faces, legend=False, plotter=plotter)
    look(plotter, middle(positions[index.neighborhood(v, radius, method="ball")]), radius, picture)
    folder = places.PAGES if picture.letter == SHOWN else places.RESULTS
    folder.mkdir(parents=True, exist_ok=True)
    plotter.screenshot(folder / f"figure4{picture.letter}.png")
    plotter.close()
    return {"letter": picture.letter, "mesh": meshes.described(picture.mesh), "radius_edges": picture.radius_edges,
            "vertex": v, "found": found(index, v, radius)}


def nearest(positions, at):
    import numpy as np

    low, high = positions.min(0), positions.max(0)
    return int(np.argmin(np.linalg.norm(positions - (low + (high - low) * at), axis=1)))


def middle(positions):
    return (positions.min(0) + positions.max(0)) / 2


def look(plotter, center, radius, picture):
    import numpy as np

    towards = np.array(picture.towards, float)
    plotter.enable_parallel_projection()
    plotter.camera.focal_point = center
    plotter.camera.position = center + 100 * radius * towards / np.linalg.norm(towards)
    plotter.camera.up = picture.up
    plotter.camera.parallel_scale = picture.width * radius / 2
    plotter.camera.reset_clipping_range()


def found(index, v, radius):
    return {method: int(index.count(v, radius, method=method)) for method in ("exact", "paper", "ball")}
