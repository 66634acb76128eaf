# SPDX-License-Identifier: MIT
"""Principal curvatures of all vertices in one call, beside libigl, MeshLab and CGAL."""
from .markdown import number, table

TITLE = "Curvature of all vertices"
COMMAND = "python3 -m bench curvature"

# What libigl's time divided by ours was to reach, by mesh and radius.
GOALS = {"cortex": {5: 20, 10: 40, 20: 80}, "head_skin": {5: 20, 10: 50, 20: 100, 65: 200}}

NOTE = """`{command}`: principal curvatures of all vertices in one call, in µs a vertex, medians of alternating rounds in
one process. One thread, processor time; *2 threads* is wall clock. *libigl* is `igl.principal_curvature(V, F, radius,
False)` of its wheel, and *ours* computes its numbers (`like="libigl"`, with the filter) from an index; *whole* is
`meshhood.principal_curvature`, which also builds the index. × is libigl's time divided by ours, and by that of the
whole call; *goal* is what × was to reach. *Default* uses the correct shape operator, *jets* fits jets to all vertices
of a neighborhood. MeshLab's filter is "Scale Dependent Quadric Fitting"; it is left out where it would take too long.
CGAL's `Monge_via_jet_fitting` is timed on a sample, without a search. libigl has no list of vertices: where *rows* is
less than the mesh has, all tools got the same piece of it, at whose rim the neighborhoods are smaller. A radius is left
out where libigl would take too long even then.

"""


def text(data):
    header = ["mesh", "radius", "found", "rows", "libigl", "ours", "×", "goal", "whole", "× whole", "2 threads",
              "default", "jets", "CGAL jets, fit", "MeshLab"]
    rows = []
    for name, result in data["meshes"].items():
        goals = GOALS.get(name, {})
        for row in result["rows"]:
            rows.append([name, f"{row['radius_edges']:g}", number(row["found"]), f"{row['rows']:,}", *times(row, goals)])
    return NOTE.format(command=COMMAND) + table(header, rows)


def times(row, goals):
    libigl, ours, whole = (row[tool]["median"] for tool in ("libigl", "ours", "whole"))
    return [number(libigl), number(ours), number(libigl / ours), str(goals.get(row["radius_edges"], "–")), number(whole),
            number(libigl / whole), number(row["threads"]), number(row["default"]["median"]), number(row["jets"]["median"]),
            number(row["cgal"]["fit"]) if "cgal" in row else "–",
            number(row["meshlab"]["median"]) if "meshlab" in row else "–"]
