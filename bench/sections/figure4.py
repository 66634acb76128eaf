# SPDX-License-Identifier: MIT
"""The paper's Figure 4."""
from .markdown import image, table

TITLE = "The paper's Figure 4"

NOTE = """`python3 -m bench pictures`. Green: the exact neighborhood. Yellow: extra vertices of the paper's answer. Blue: further
vertices of the ball. Red: the query vertex. Radii are the paper's. Its vertices and poses are not known, so we chose some
where the methods differ: (a) is another pose of the same cat; (b) is on the leg, because the hand of this Victoria is far
from everything else.

"""


def text(data):
    pictures = data["pictures"]
    shown = "\n".join(image(f"figure4{p['letter']}", f"({p['letter']}) {p['mesh'].partition(';')[0]}, radius"
                            f" {p['radius_edges']} mean edges", "png") for p in pictures)
    rows = [[f"({p['letter']}) {p['mesh'].partition(';')[0]}", f"{p['radius_edges']}", str(p["vertex"]),
             *(f"{p['found'][method]:,}" for method in ("exact", "paper", "ball"))] for p in pictures]
    return NOTE + table(["", "radius", "vertex", "exact", "paper", "ball"], rows) + "\n" + shown
