# SPDX-License-Identifier: MIT
"""All vertices of a mesh in one call."""
from .. import machine
from .markdown import number, table, with_spread

TITLE = "All vertices at once"
COMMAND = "python3 -m bench batch"
SHOWN = ("head_skin", "dragon", "cortex", "mri_head")

NOTE = """`{command}`: the neighborhoods of many vertices in one call, in index order ([how](../joint.md)). One thread, processor
time in µs a row. `bfs` is breadth-first search on the mesh in index order, warm. *One* queries the exact index for one
vertex after another, *batch* for all in one call; each computes sizes (count) and ids. × is the ratio to `bfs`. 20,000
consecutive vertices up to 10 mean edges, 3,000 above; the first 4,000 or 400 for `bfs` and *one*.

"""


def text(data):
    header = ["mesh", "radius", "found", "bfs", "one, count", "one, ids", "batch, count", "batch, ids", "× count", "× ids"]
    rows = []
    for name, result in data["meshes"].items():
        for row in result["rows"]:
            times = (row[method] for method in ("bfs", "single_count", "single_ids", "count", "ids"))
            rows.append([name, f"{row['radius_edges']:g}", number(row["found"]),
                         *(with_spread(time["median"], time["quartiles"]) for time in times), *ratios(row)])
    return NOTE.format(command=COMMAND) + table(header, rows)


def summary(data):
    return (f"`{COMMAND}`: times as fast as breadth-first search, for the sizes and for the ids of all neighborhoods, one"
            " thread.\n[All figures](benchmarks/batch.md).\n\n" + ratio_table(data))


HEAD_NOTE = """All vertices in one call, one thread of an {processor} (`{command}`): times as fast as the
fastest breadth-first search we could write, for the sizes and the ids of all neighborhoods. Radius in mean edges.{remark}

"""
HEAD_RADII = (2, 5, 10, 20, 65)


def head_table(data):
    """The table of the README."""
    remark = "\n**Preliminary: the machine was busy.**" if machine.is_busy(data["machine"]) else ""
    note = HEAD_NOTE.format(processor=data["machine"]["processor"], command=COMMAND, remark=remark)
    return note + ratio_table(data, HEAD_RADII) + "\n"


def ratio_table(data, radii=()):
    """At `radii`, or at all that were measured."""
    shown = {name: data["meshes"][name] for name in SHOWN if name in data["meshes"]} or data["meshes"]
    header = ["radius"]
    for name in shown:
        header += [f"{name}: count", "ids"]
    by_radius = [{row["radius_edges"]: row for row in result["rows"]} for result in shown.values()]
    rows = [[f"{radius:g}", *(cell for rows in by_radius for cell in ratios(rows[radius]))] for radius in by_radius[0]
            if not radii or radius in radii]
    return table(header, rows)


def ratios(row):
    """How many times as fast as breadth-first search counts and ids are."""
    return [number(row["bfs"]["median"] / row[method]["median"]) for method in ("count", "ids")]
