# SPDX-License-Identifier: MIT
"""The paper's Figure 4."""
from .markdown import image, table

NOTE = """## Figure 4: what each method takes

Green: the exact neighborhood. Yellow: what the paper's search adds. Blue: what a ball takes besides. Red: the vertex.
The paper's radii; its vertices and poses are not known, so these were chosen where the methods differ: (a) in another
pose of the same cat, (b) on the leg, since Victoria's hand is far from all else here.

"""


def text(data):
    pictures = data["pictures"]
    shown = "\n".join(image(f"figure4{p['letter']}", f"({p['letter']}) {p['mesh'].partition(';')[0]}, radius"
                            f" {p['radius_edges']} average edges", "png") for p in pictures)
    rows = [[f"({p['letter']}) {p['mesh'].partition(';')[0]}", f"{p['radius_edges']}", str(p["vertex"]),
             *(f"{p['found'][method]:,}" for method in ("exact", "paper", "ball"))] for p in pictures]
    return NOTE + table(["", "radius", "vertex", "exact", "paper", "ball"], rows) + "\n" + shown
