# SPDX-License-Identifier: MIT
"""Principal curvatures of all vertices in one call, beside libigl, MeshLab and CGAL."""
from .markdown import number, table


def times(data):
    header = ["mesh", "radius", "found", "rows", "libigl", "ours", "×", "whole", "× whole", "2 threads",
              "default", "jets", "CGAL jets, fit", "MeshLab"]
    rows = []
    for name, result in data["meshes"].items():
        for row in result["rows"]:
            rows.append([name, f"{row['radius_edges']:g}", number(row["found"]), f"{row['rows']:,}", *cells(row)])
    return table(header, rows)


def cells(row):
    libigl, ours, whole = (row[tool]["median"] for tool in ("libigl", "ours", "whole"))
    return [number(libigl), number(ours), number(libigl / ours), number(whole),
            number(libigl / whole), number(row["threads"]), number(row["default"]["median"]), number(row["jets"]["median"]),
            number(row["cgal"]["fit"]) if "cgal" in row else "–",
            number(row["meshlab"]["median"]) if "meshlab" in row else "–"]
