# SPDX-License-Identifier: MIT
"""The exact index compared with breadth-first search."""
from .. import machine, programs
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

BATCH_NOTE = """
## Many vertices in one call

A batch over consecutive vertices of the file, one thread, µs a row. `ids`: all ids are streamed. `counts`: only the sizes
are computed. The breadth-first searches run for the first vertices of each batch.

"""

SUMMARY_NOTE = """`{command}`: µs a query, one thread, processor time. `bfs` is breadth-first search, in the order of the file
or in index order, whichever is faster. All meshes and radii, with quartiles:
[benchmarks/exact_index.md](benchmarks/exact_index.md).

"""

BATCH_SUMMARY = """
### Many queries in one call

µs a row, one thread. [All meshes](benchmarks/exact_index.md#many-vertices-in-one-call).

"""


def text(data):
    parts = [NOTE.format(command=COMMAND, queries=data["queries"])]
    for name, result in data["meshes"].items():
        parts.append(f"\n**{name}**, {result['vertices']:,} vertices\n\n{mesh_table(result)}")
    return "".join([*parts, BATCH_NOTE, batch_table(data["meshes"])])


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
    return (SUMMARY_NOTE.format(command=COMMAND) + table(header, rows) + "\n" + extremes(data["meshes"])
            + BATCH_SUMMARY + batch_table(shown(data)))


def shown(data):
    """The meshes of KINDS, or all where there is none of them."""
    return {name: data["meshes"][name] for name in KINDS if name in data["meshes"]} or data["meshes"]


def best_bfs(row):
    return min(row[method]["microseconds"] for method in BFS)


def ratio(row, method):
    return best_bfs(row) / row[method]["microseconds"]


def extremes(meshes):
    """The smallest and the largest ratio, each with its mesh and radius."""
    ratios = [(ratio(row, "ids"), name, radius, order) for name, result in meshes.items() for order in ("cold", "warm")
              for radius, row in programs.by_radius(result[order]).items()]

    def said(found):
        return f"{found[0]:.1f} ({found[1]}, {found[3]}, {found[2]:g} edges)"

    return (f"Over all {len(meshes)} meshes and {len(ratios) // len(meshes) // 2} radii, cold and warm, the smallest ratio is"
            f" {said(min(ratios))}\nand the largest {said(max(ratios))}.\n")


def mesh_table(result):
    header = ["", "radius", "found", "bfs", "bfs reordered", "ids", "count", "ranges", "× ids", "× count", "× ranges"]
    rows = []
    for order in ("cold", "warm"):
        for radius, row in programs.by_radius(result[order]).items():
            asked = [row[method] for method in ("ids", "count", "ranges")]
            times = [with_spread(m["microseconds"], m["quartiles"]) for m in (row["bfs"], row["bfs-reordered"], *asked)]
            rows.append([order, f"{radius:g}", number(row["bfs"]["count"]), *times,
                         *(f"{best_bfs(row) / m['microseconds']:.1f}" for m in asked)])
    return table(header, rows)


def batch_table(meshes):
    header = ["mesh", "radius", "rows", "bfs", "bfs reordered", "ids", "counts", "× ids", "× counts"]
    rows = []
    for name, result in meshes.items():
        for batch in result["batches"]:
            times = [batch[method] for method in (*BFS, "ids", "count")]
            best = min(time["median"] for time in times[:2])
            rows.append([name, f"{batch['radius_edges']:g}", number(batch["rows"]),
                         *(with_spread(time["median"], time["quartiles"]) for time in times),
                         *(f"{best / time['median']:.1f}" for time in times[2:])])
    return table(header, rows)


HEAD_NOTE = """One query, cold, on one thread of an {processor} (`{command}`). `{smooth}` is {smooth_kind}
of {smooth_size:,} vertices, `{folded}` is {folded_kind}, with {folded_size:,}. The radius is in mean edge lengths,
and `bfs` is the fastest breadth-first search we could write; × is the ratio of the times.{remark}

"""


def head_table(data):
    """The table of the README: one smooth mesh and one folded mesh, cold."""
    meshes = data["meshes"]
    smooth = next((name for name in ("head_skin", *meshes) if name in meshes))
    folded = next((name for name in ("mri_head", *meshes) if name in meshes))
    header = ["radius"]
    for name in (smooth, folded):
        header += [f"{name}: found", "bfs µs", "exact µs", "×"]
    columns = [programs.by_radius(meshes[name]["cold"]) for name in (smooth, folded)]
    rows = [[f"{radius:g}", *(cell for rows in columns for cell in head_cells(rows[radius]))]
            for radius in SHOWN_RADII if all(radius in rows for rows in columns)]
    note = HEAD_NOTE.format(
        processor=data["machine"]["processor"], command=COMMAND,
        smooth=smooth, smooth_kind=KINDS.get(smooth, "a mesh"), smooth_size=meshes[smooth]["vertices"],
        folded=folded, folded_kind=KINDS.get(folded, "a mesh"), folded_size=meshes[folded]["vertices"],
        remark=" **Preliminary: the machine was busy.**" if machine.is_busy(data["machine"]) else "")
    return note + table(header, rows) + "\n" + extremes(meshes)


def head_cells(row):
    return [*timed_cells(row), f"{ratio(row, 'ids'):.1f}"]


def timed_cells(row):
    """Vertices found, and the times of breadth-first search and of the exact index."""
    return [number(row["bfs"]["count"]), number(best_bfs(row)), number(row["ids"]["microseconds"])]
