# SPDX-License-Identifier: MIT
"""The paper's Table 1, Table 2 and profile of the query, with the paper's figures beside ours."""
from .. import meshes, paper_tables, programs
from .markdown import megabytes, number, table

RADII = (2, 10, 65)
METHODS = ("bfs", "ball", "paper", "exact")


def space(data):
    """Table 1."""
    measured = data["meshes"]
    header = ["mesh", "vertices", "faces", "with topology", "plain mesh", "paper's index", "index / plain", "built in",
              "exact index", "built in"]
    rows = []
    names = list(measured)
    for name in names:
        rows.append(table1_row(name, measured[name]))
        of_paper = meshes.MESHES[name].of_paper
        if of_paper and not any(meshes.MESHES[other].of_paper == of_paper for other in names[names.index(name) + 1:]):
            rows.append(paper_row(of_paper))
    return table(header, rows)


def table1_row(name, result):
    space = result["table1"]
    paper, exact = (paper_tables.build_summary(result, kind) for kind in ("paper", "exact"))
    return [name, f"{space['vertices']:,}", f"{space['faces']:,}", megabytes(space["topology_bytes"]),
            megabytes(space["mesh_bytes"]), megabytes(paper["bytes"]), f"{paper['bytes'] / space['mesh_bytes']:.3f}",
            f"{paper['median']:.3f} s", megabytes(exact["bytes"]), f"{exact['median']:.3f} s"]


def paper_row(name):
    vertices, topology, mesh, index, seconds = paper_tables.PAPER_TABLE1[name]
    return [f"*{name}, the paper's figures*", f"{vertices:,}", "", f"{topology:.3f}", f"{mesh:.3f}", f"{index:.3f}",
            f"{index / mesh:.3f}", f"{seconds:.3f} s", "", ""]


def queries(data):
    """Table 2 at some radii, with the share of the range search in the paper's query."""
    header = ["mesh", "radius", *(f"{method}, µs" for method in METHODS), "bfs / paper", "bfs / exact", "found", "ball extra",
              "paper extra", "range search"]
    rows = []
    for name, result in data["meshes"].items():
        by_radius = programs.by_radius(result["table2"])
        shares = {row["radius_edges"]: row["range_search"] for row in result["phases"]}
        for radius in filter(by_radius.__contains__, RADII):
            row = by_radius[radius]
            times = {method: row[method]["microseconds"] for method in METHODS}
            rows.append([name, f"{radius:g}", *map(number, times.values()),
                         *(f"{times['bfs'] / times[method]:.2f}" for method in ("paper", "exact")), f"{row['bfs']['count']:,.1f}",
                         *(f"{row[method]['extra']:,.1f}" for method in ("ball", "paper")), f"{shares[radius]:.0f} %"])
    return table(header, rows)
