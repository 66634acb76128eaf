# SPDX-License-Identifier: MIT
"""From the arrays of a mesh in memory to the answers for all of its vertices, beside other libraries."""
from .markdown import number, table

# The columns: question, tool, and whether the index is in hand.
COLUMNS = {
    "counts": ("counts", "meshhood", False),
    "in hand": ("counts", "meshhood", True),
    "BFS": ("counts", "our breadth-first search (C++)", False),
    "trueform": ("ids", "trueform neighborhoods", False),
    "cKDTree": ("counts", "SciPy cKDTree", False),
    "Open3D": ("ids", "Open3D fixed_radius_search", False),
    "rings": ("counts", "meshhood rings", False),
    "trueform rings": ("ids", "trueform k_rings", False),
    "curvature": ("curvature", "meshhood", False),
    "curvature, in hand": ("curvature", "meshhood", True),
    "trueform curvature": ("curvature", "trueform principal_curvatures", False),
    "libigl curvature": ("curvature", "libigl principal_curvature", False),
}


def times(data):
    """µs a vertex on the most threads that were measured."""
    pieces = sorted(data["pieces"].values(), key=lambda piece: (piece["mesh"], piece["radius_edges"]))
    threads = max(piece["threads"] for piece in pieces)
    rows = [[piece["mesh"], f"{piece['radius_edges']:g}", *(cell(piece, *column) for column in COLUMNS.values())]
            for piece in pieces if piece["threads"] == threads]
    return table(["mesh", "radius", *COLUMNS], rows)


def cell(piece, question, tool, is_in_hand):
    row = piece["questions"][question].get(tool, {})
    if "seconds" not in row:
        return row.get("failure", "")
    seconds = row["answer_seconds" if is_in_hand else "seconds"]["median"]
    return number(1e6 * seconds / piece["vertices"])
