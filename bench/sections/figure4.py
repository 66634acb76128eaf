# SPDX-License-Identifier: MIT
"""The paper's Figure 4."""
from .markdown import table


def found(data):
    rows = [[f"({p['letter']}) {p['mesh'].partition(';')[0]}", f"{p['radius_edges']}", str(p["vertex"]),
             *(f"{p['found'][method]:,}" for method in ("exact", "paper", "ball"))] for p in data["pictures"]]
    return table(["", "radius", "vertex", "exact", "paper", "ball"], rows)
