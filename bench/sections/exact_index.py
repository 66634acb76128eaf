# SPDX-License-Identifier: MIT
"""The exact index beside the best breadth-first search."""
from .. import programs
from .markdown import number, table, with_spread

NOTE = """## The exact index beside the best breadth-first search

{queries:,} queries a mesh and radius, one thread, processor time, µs a query. The search runs on the vertices as the file
has them and in index order (`reordered`); the better of the two counts. Answers as ids, as a count, and as ranges, each
from an index of its own. Scroll, plates, folds and gyroid are made by formula (`meshhood generate`).
"""


def text(data):
    parts = [NOTE.format(queries=data["queries"])]
    for name, result in data["meshes"].items():
        parts.append(f"\n**{name}**, {result['vertices']:,} vertices\n\n{mesh_table(result)}")
    return "".join(parts)


def mesh_table(result):
    header = ["", "radius", "found", "bfs", "bfs reordered", "ids", "count", "ranges", "× ids", "× count", "× ranges"]
    rows = []
    for order in ("cold", "warm"):
        for radius, row in programs.by_radius(result[order]).items():
            best = min(row[method]["microseconds"] for method in ("bfs", "bfs-reordered"))
            asked = [row[method] for method in ("ids", "count", "ranges")]
            times = [with_spread(m["microseconds"], m["quartiles"]) for m in (row["bfs"], row["bfs-reordered"], *asked)]
            rows.append([order, f"{radius:g}", number(row["bfs"]["count"]), *times,
                         *(f"{best / m['microseconds']:.1f}" for m in asked)])
    return table(header, rows)
