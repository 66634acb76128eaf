# SPDX-License-Identifier: MIT
"""Principal curvatures of all vertices as the mesh grows, beside libigl."""
from .markdown import number, table

TITLE = "Curvature as the mesh grows"
COMMAND = "python3 -m bench growth"

NOTE = """`{command}`: principal curvatures of all vertices of a sphere at {radius:g} mean edges, in one call on one thread;
processor time, the median of three rounds, with libigl's numbers. *Index* is the memory of the index and of the normals,
which a call needs, in bytes for each vertex. The result takes another 65 bytes for each vertex. libigl is left out where
it would take too long.

"""


def text(data):
    rows = [[f"{row['vertices']:,}", number(row["ours"]), number(row["libigl"]) if "libigl" in row else "–",
             number(row["bytes"])] for row in data["rows"]]
    return NOTE.format(command=COMMAND, radius=data["radius_edges"]) + table(
        ["vertices", "ours, µs a vertex", "libigl, µs a vertex", "index, bytes a vertex"], rows)
