# SPDX-License-Identifier: MIT
"""The exact index beside the best breadth-first search."""
from .. import programs
from .markdown import number, table, with_spread

NOTE = """## The exact index beside the best breadth-first search

{queries:,} queries a mesh and radius, one thread, processor time, µs a query. The search runs on the vertices as the file
has them and in index order (`reordered`); the better of the two counts. Answers as ids, as a count, and as ranges, each
from an index of its own. Scroll, plates, folds and gyroid are made by formula (`meshhood generate`).
"""


BATCH_NOTE = """
### Many vertices in one call

A batch over a run of vertices as the file numbers them, one thread, all ids streamed or only counted, µs a row; beside
it the breadth-first searches for the first vertices of each batch.

"""


def text(data):
    parts = [NOTE.format(queries=data["queries"])]
    for name, result in data["meshes"].items():
        parts.append(f"\n**{name}**, {result['vertices']:,} vertices\n\n{mesh_table(result)}")
    return "".join([*parts, BATCH_NOTE, batch_table(data["meshes"])])


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


def batch_table(meshes):
    header = ["mesh", "radius", "rows", "bfs", "bfs reordered", "ids", "counts", "× ids", "× counts"]
    rows = []
    for name, result in meshes.items():
        for batch in result["batches"]:
            times = [batch[method] for method in ("bfs", "bfs-reordered", "ids", "count")]
            best = min(time["median"] for time in times[:2])
            rows.append([name, f"{batch['radius_edges']:g}", number(batch["rows"]),
                         *(with_spread(time["median"], time["quartiles"]) for time in times),
                         *(f"{best / time['median']:.1f}" for time in times[2:])])
    return table(header, rows)
