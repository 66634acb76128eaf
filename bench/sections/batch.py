# SPDX-License-Identifier: MIT
"""All vertices of a mesh in one call."""
from .. import machine
from .markdown import number, table, with_spread

TITLE = "All vertices at once"
COMMAND = "python3 -m bench batch"
SHOWN = ("head_skin", "dragon", "cortex", "mri_head")

NOTE = """`{command}`: the neighborhoods of many vertices in one call, in index order ([how](../joint.md)). One thread, processor
time in µs a row. `bfs` is breadth-first search on the mesh in index order, warm. *One* queries the exact index for one
vertex after another, *batch* for all in one call; each computes sizes (count) and ids. × is the ratio to `bfs`. The
vertices stand for all: they are stretches of some 900 consecutive vertices, evenly spread over the mesh, 40,000 in all;
above 10 mean edges of 450, 4,000 in all. `bfs` and *one* take the first eighth or tenth of each stretch.

"""

OTHERS_NOTE = """
## Threads, instruction sets, Python

*Two threads*: how many times as fast as one, counts of all vertices or of as many as take 0.25 s, wall clock. *Two
processes*: how many times as fast two processes on two processors, each with one thread and the same rows, are as one
of them alone. They share nothing that they write, so this is what the machine allows for two threads. *Work*: the
processor time of two threads, as a multiple of that of one; unlike the others it hardly depends on what else the
machine does. *AVX2* and *portable*: the speed of the kernels for AVX2, and of those without vector instructions, as a
part of that of the best ones here, counts. *Python*:
`query_ball`, kept in one array, in µs a row, and its time over that of the same call of C++, `neighborhoods`; called in
turn, one thread, processor time, with memory from the same allocator with the same settings.

"""


# Times as fast as breadth-first search: at the radii of bench/batch.py. Counts of each mesh, and ids of all of them.
COUNT_GOALS = {"cortex": (5, 7, 9, 18, 45, 400), "head_skin": (6, 10, 16, 30, 55, 170), "dragon": (4, 6, 10, 20, 45, 200),
               "mri_head": (4, 6, 10, 20, 45, 200)}
IDS_GOALS = (3, 5, 6, 11, 25, 75)
GOALS_NOTE = """
## Goals

Times as fast as breadth-first search, and in parentheses the goal; in bold where it is missed.
[What was tried](../joint.md).

"""


def text(data):
    header = ["mesh", "radius", "found", "bfs", "one, count", "one, ids", "batch, count", "batch, ids", "× count", "× ids"]
    rows = []
    for name, result in data["meshes"].items():
        for row in result["rows"]:
            times = (row[method] for method in ("bfs", "single_count", "single_ids", "count", "ids"))
            rows.append([name, f"{row['radius_edges']:g}", number(row["found"]),
                         *(with_spread(time["median"], time["quartiles"]) for time in times), *ratios(row)])
    return NOTE.format(command=COMMAND) + table(header, rows) + others(data) + goals(data)


def goals(data):
    shown = {name: data["meshes"][name]["rows"] for name in COUNT_GOALS if name in data["meshes"]}
    rows = []
    for name, measured in shown.items():
        for what, aims, at in (("counts", COUNT_GOALS[name], 0), ("ids", IDS_GOALS, 1)):
            rows.append([name, what, *(compared(ratios(row)[at], aim) for row, aim in zip(measured, aims))])
    if not rows:
        return ""
    header = ["mesh", "", *(f"r = {row['radius_edges']:g}" for row in next(iter(shown.values())))]
    return GOALS_NOTE + table(header, rows)


def compared(reached, aim):
    cell = f"{reached} ({aim})"
    return cell if float(reached.replace(",", "")) >= aim else f"**{cell}**"


def others(data):
    header = ["mesh", "radius", "two threads", "two processes", "work", "AVX2", "portable", "Python", "Python / C++"]
    rows = []
    for name, result in data["meshes"].items():
        for row in result["rows"]:
            if "python" not in row:
                continue
            best = next(isa for isa in ("AVX3", "AVX2", "SSE4", "SCALAR") if isa in row)
            rows.append([name, f"{row['radius_edges']:g}", ratio(row, "one_thread", "two_threads"),
                         ratio(row, "one_thread", "two_processes", times=2),
                         ratio(row, "two_threads_work", "one_thread_work"),
                         ratio(row, best, "AVX2"), ratio(row, best, "SCALAR"), number(row["python"]["median"]),
                         ratio(row, "python", "kept")])
    return OTHERS_NOTE + table(header, rows) if rows else ""


def ratio(row, method, other, *, times=1):
    """How many times as long `method` takes as `other`, when called `times` times."""
    return f"{times * row[method]['median'] / row[other]['median']:.2f}" if other in row else "—"


def summary(data):
    return (f"`{COMMAND}`: times as fast as breadth-first search, for the sizes and for the ids of all neighborhoods, one"
            " thread.\n[All figures](benchmarks/batch.md).\n\n" + ratio_table(data))


HEAD_NOTE = """All vertices in one call, one thread of an {processor} (`{command}`): times as fast as the
reference breadth-first search, which is written for speed, for the sizes and the ids of all neighborhoods.{remark}

"""
HEAD_RADII = (2, 5, 10, 20, 65)


def head_table(data):
    """The table of the README."""
    remark = " **Preliminary figures.**" if machine.is_busy(data["machine"]) else ""
    note = HEAD_NOTE.format(processor=data["machine"]["processor"], command=COMMAND, remark=remark)
    return note + ratio_table(data, HEAD_RADII) + "\n"


def ratio_table(data, radii=()):
    """At `radii`, or at all that were measured."""
    shown = {name: data["meshes"][name] for name in SHOWN if name in data["meshes"]} or data["meshes"]
    header = ["radius in mean edges"]
    for name in shown:
        header += [f"{name}: count", "ids"]
    by_radius = [{row["radius_edges"]: row for row in result["rows"]} for result in shown.values()]
    rows = [[f"{radius:g}", *(cell for rows in by_radius for cell in ratios(rows[radius]))] for radius in by_radius[0]
            if not radii or radius in radii]
    return table(header, rows)


def ratios(row):
    """How many times as fast as breadth-first search counts and ids are."""
    return [number(row["bfs"]["median"] / row[method]["median"]) for method in ("count", "ids")]
