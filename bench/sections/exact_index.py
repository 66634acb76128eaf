# SPDX-License-Identifier: MIT
"""The exact index compared with breadth-first search."""
from .. import programs
from .markdown import number, table, with_spread

TITLE = "Speed over the radius"
COMMAND = "python3 -m bench exact"
BFS = ("bfs", "bfs-reordered")
SHOWN_RADII = (2, 5, 10, 20, 65)
KINDS = {"head_skin": "a smooth scan", "dragon": "a scan with folds", "mri_head": "strongly folded",
         "plates": "two sheets close together"}

NOTE = """`{command}`. {queries:,} queries for each mesh and radius, one thread, processor time in µs a query. Breadth-first
search runs twice, with the vertices in the order of the file (`bfs`) and in index order (`bfs reordered`); the ratios
(×) compare with the faster of the two. The exact index returns ids, a count, or ranges of the index order. Each of the
three has an index of its own, so that none profits from the cache of another. Scroll, plates, folds and gyroid are
generated (`meshhood generate`).
"""

SUMMARY_NOTE = """`{command}`: µs a query, one thread, processor time. `bfs` is breadth-first search, in the order of the file
or in index order, whichever is faster. All meshes and radii, with quartiles:
[benchmarks/exact_index.md](benchmarks/exact_index.md).

"""


def text(data):
    parts = [NOTE.format(command=COMMAND, queries=data["queries"])]
    for name, result in data["meshes"].items():
        parts.append(f"\n**{name}**, {result['vertices']:,} vertices\n\n{mesh_table(result)}")
    return "".join(parts)


def summary(data):
    header = ["mesh", "radius", "found", "bfs, cold", "exact, cold", "× cold", "× cold, count", "× warm",
              "× warm, count"]
    rows = []
    for name, result in shown(data).items():
        label = f"{name} ({KINDS[name]})" if name in KINDS else name
        cold, warm = (programs.by_radius(result[order]) for order in ("cold", "warm"))
        for radius in filter(cold.__contains__, SHOWN_RADII):
            ratios = (ratio(row[radius], method) for row in (cold, warm) for method in ("ids", "count"))
            rows.append([label, f"{radius:g}", *timed_cells(cold[radius]), *(f"{value:.1f}" for value in ratios)])
    return SUMMARY_NOTE.format(command=COMMAND) + table(header, rows) + "\n" + extremes(data["meshes"])


def shown(data):
    """The meshes of KINDS, or all where there is none of them."""
    return {name: data["meshes"][name] for name in KINDS if name in data["meshes"]} or data["meshes"]


def best_bfs(row):
    return min(row[method]["microseconds"] for method in BFS)


def ratio(row, method):
    return best_bfs(row) / row[method]["microseconds"]


def least_and_most(meshes):
    """The smallest and the largest ratio, each with its mesh, radius and order."""
    ratios = [(ratio(row, "ids"), name, radius, order) for name, result in meshes.items() for order in ("cold", "warm")
              for radius, row in programs.by_radius(result[order]).items()]
    return min(ratios), max(ratios)


def extremes(meshes):
    radii = len(next(iter(programs.by_radius(result["cold"]) for result in meshes.values())))

    def said(found):
        return f"{found[0]:.1f} ({found[1]}, {found[3]}, {found[2]:g} edges)"

    least, most = least_and_most(meshes)
    return (f"Over all {len(meshes)} meshes and {radii} radii, cold and warm, the smallest ratio is"
            f" {said(least)}\nand the largest {said(most)}.\n")


def mesh_table(result):
    header = ["", "radius", "found", "bfs", "bfs reordered", "ids", "count", "ranges", "× ids", "× count", "× ranges"]
    rows = []
    for order in ("cold", "warm"):
        for radius, row in programs.by_radius(result[order]).items():
            kinds = [row[method] for method in ("ids", "count", "ranges")]
            times = [with_spread(m["microseconds"], m["quartiles"]) for m in (row["bfs"], row["bfs-reordered"], *kinds)]
            rows.append([order, f"{radius:g}", number(row["bfs"]["count"]), *times,
                         *(f"{best_bfs(row) / m['microseconds']:.1f}" for m in kinds)])
    return table(header, rows)


def head_table(data):
    """The line of the README on single queries: one smooth mesh and one folded mesh, cold."""
    meshes = data["meshes"]
    said = []
    for name in dict.fromkeys(next(n for n in (wanted, *meshes) if n in meshes) for wanted in ("head_skin", "mri_head")):
        rows = programs.by_radius(meshes[name]["cold"])
        ratios = ", ".join(f"{ratio(rows[radius], 'ids'):.1f}" for radius in SHOWN_RADII if radius in rows)
        said.append(f"{ratios} on `{name}`")
    radii = ", ".join(f"{radius:g}" for radius in SHOWN_RADII)
    least, most = (found[0] for found in least_and_most(meshes))
    return (f"One query at a time, cold (`{COMMAND}`), at {radii} edges: " + "\nand ".join(said)
            + f"; over all meshes and radii, cold and warm, {least:.1f} to {most:.1f}.\n")


def timed_cells(row):
    """Vertices found, and the times of breadth-first search and of the exact index."""
    return [number(row["bfs"]["count"]), number(best_bfs(row)), number(row["ids"]["microseconds"])]
