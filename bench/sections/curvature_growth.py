# SPDX-License-Identifier: MIT
"""Principal curvatures of all vertices as the mesh grows, beside libigl."""
from .markdown import number, table

TITLE = "Curvature as the mesh grows"
COMMAND = "python3 -m bench growth"

NOTE = """`{command}`: principal curvatures of all vertices of a sphere at {radius:g} mean edges, in one call on one thread;
processor time, the median of three rounds, with libigl's numbers. *Index* is the memory of the index and of the normals,
which a call needs, in bytes for each vertex. *Call* is the most memory that the process held during a call, beyond the
mesh and the index: the normals and the result of 65 bytes, what is needed to make them, and the fixed memory of a
thread, which counts only on small meshes. *Mean* is the same for `aggregate` with one channel. libigl is left out where
it would take too long.

"""


def text(data):
    rows = [[f"{row['vertices']:,}", number(row["ours"]), number(row["libigl"]) if "libigl" in row else "–",
             number(row["bytes"]), *(number(row[peak]) if peak in row else "–" for peak in ("curvature_peak", "mean_peak"))]
            for row in data["rows"]]
    return NOTE.format(command=COMMAND, radius=data["radius_edges"]) + table(
        ["vertices", "ours, µs a vertex", "libigl, µs a vertex", "index, bytes a vertex", "call, bytes a vertex",
         "mean, bytes a vertex"], rows)
