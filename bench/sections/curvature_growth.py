# SPDX-License-Identifier: MIT
"""Principal curvatures of all vertices as the mesh grows, beside libigl."""
from .markdown import number, table


def growth(data):
    rows = [[f"{row['vertices']:,}", number(row["ours"]), number(row["libigl"]) if "libigl" in row else "–",
             number(row["bytes"]), *(number(row[peak]) if peak in row else "–" for peak in ("curvature_peak", "mean_peak"))]
            for row in data["rows"]]
    return table(
        ["vertices", "ours, µs a vertex", "libigl, µs a vertex", "index, bytes a vertex", "call, bytes a vertex",
         "mean, bytes a vertex"], rows)
