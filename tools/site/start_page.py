#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes what the start page shows: the plot of the speed, and the page of the viewer that a click loads.

    start_page.py BATCH.md PICTURES PAGES

BATCH.md    the page with the table of `python3 -m bench batch`
PICTURES    gets speed_light.svg and speed_dark.svg
PAGES       gets live.html
"""

import sys
from pathlib import Path

import matplotlib
import meshhood
from matplotlib import pyplot as plt

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "examples/gallery"))
import made_meshes

SHOWN = ("cortex", "dragon", "head_skin", "mri_head")
COLORS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7")  # of Okabe and Ito
MARKERS = ("o", "s", "^", "D")
INK = {"light": "#222832", "dark": "#ced6dd"}  # the text of the theme


def measured(page):
    """The rows of the table, each as the name of a column -> cell, by mesh."""
    header, _, *rows = ([cell.strip() for cell in line.split("|")[1:-1]] for line in page.splitlines() if line.startswith("|"))
    meshes = {}
    for row in rows:
        cells = dict(zip(header, row))
        meshes.setdefault(cells["mesh"], []).append(cells)
    return meshes


def plot(meshes, ink, name):
    """Times as fast as breadth-first search over the radius, for the ids of all neighborhoods."""
    matplotlib.rcParams.update({"svg.hashsalt": "meshhood", "svg.fonttype": "none"})
    matplotlib.rcParams.update({"text.color": ink, "axes.labelcolor": ink})
    figure, axes = plt.subplots(figsize=(6.4, 3.6), layout="constrained")
    for mesh, color, marker in zip(SHOWN, COLORS, MARKERS):
        radii, factors = ([float(row[column]) for row in meshes[mesh]] for column in ("radius", "× ids"))
        label = f"{mesh}, {meshes[mesh][0]['vertices']} vertices"
        axes.plot(radii, factors, color=color, marker=marker, label=label)
    axes.set(xscale="log", yscale="log", xlabel="radius in mean edges", ylabel="times as fast")
    axes.set_xticks(radii, [f"{radius:g}" for radius in radii])
    axes.set_yticks([1, 3, 10, 30, 100], ["1", "3", "10", "30", "100"])
    axes.minorticks_off()
    axes.tick_params(colors=ink)
    axes.spines[["top", "right"]].set_visible(False)
    axes.spines[["left", "bottom"]].set_color(ink)
    axes.grid(alpha=0.25)
    axes.axhline(1, color=ink, linewidth=1, linestyle=":")
    axes.legend(frameon=False)
    figure.savefig(name, transparent=True, metadata={"Date": None})
    plt.close(figure)


def main():
    page, pictures, pages = map(Path, sys.argv[1:])
    meshes = measured(page.read_text(encoding="utf-8"))
    for mode, ink in INK.items():
        plot(meshes, ink, pictures / f"speed_{mode}.svg")
    V, F = made_meshes.cortex()
    meshhood.view(V, F, v=5456, r=8.0, name="folds").save(pages / "live.html")


if __name__ == "__main__":
    main()
