# SPDX-License-Identifier: MIT
"""Table 1, Table 2 and the phases of the query, the paper's figures beside ours."""
from .. import machine, meshes, paper_tables, programs
from .markdown import image, megabytes, number, table, with_spread

METHODS = ("bfs", "ball", "paper", "exact")

NOTE = """## The paper's tables

`make reproduce`, which runs `meshhood bench --json` on each mesh: one thread, processor time, {queries:,} random queries
a mesh and radius, cold. `bfs`: a breadth-first search over compressed adjacency that owns its memory, clears nothing
between queries and fetches ahead. `ball`: a scan of all vertices, as in the paper. `paper`: the paper's index and query
with its parameters (five levels computed, the last three kept, f = 10). `exact`: our index, all ids listed.

The meshes:

{meshes}

### Table 1: space and building time

Megabytes of 2^20 bytes, as in the paper. A plain mesh is 12 bytes a vertex (24 where the file has doubles) and 4 bytes a
corner; topology adds the adjacency, 4 bytes a vertex and 8 an edge, where the paper has the pointers of VCG. All arrays
of an index are counted, its copy of the positions too. Seconds of one thread's processor time, adjacency included: the
median of three builds in turn. The paper had a Core i5 at 2.67 GHz.

"""

TABLE2_NOTE = """
### Table 2: time and vertices found

The paper gives its Table 2 as plots. Its text states one pair of figures: on the Raptor at 65 average edges, 0.26 ms with
the index and 2.25 ms by breadth-first search, 8.65 times as fast. Ours at that place stand in the tables of head_skin
and mri_head.

"""

PHASES_NOTE = """
### The phases of the paper's query (4.3)

Per cent of the time of a query, the mean over {queries:,} random ones, by `phases`. The paper found 85 % in the range
search over its whole benchmark. Our range search goes down to the children of clusters at the rim instead of testing
every vertex, and has the copying of the ids with it.

"""


def text(data):
    measured = data["meshes"]
    listed = "\n".join(f"- `{name}`: {result['mesh']}" for name, result in measured.items())
    parts = [NOTE.format(queries=data["queries"], meshes=listed), table1(measured), TABLE2_NOTE,
             image("table2", "Time and vertices found over the radius, mesh by mesh")]
    parts += [f"\n**{name}**, µs a query\n\n{table2(result)}" for name, result in measured.items()]
    parts += [PHASES_NOTE.format(queries=paper_tables.PROFILE_QUERIES), phases(measured)]
    return "".join(parts)


def table1(measured):
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


def table2(result):
    header = ["radius", *METHODS, "bfs / paper", "bfs / exact", "found", "ball extra", "paper extra", "missing"]
    rows = []
    for radius, row in programs.by_radius(result["table2"]).items():
        ratios = [f"{row['bfs']['microseconds'] / row[method]['microseconds']:.2f}" for method in ("paper", "exact")]
        rows.append([f"{radius:g}", *(with_spread(row[method]["microseconds"], row[method]["quartiles"]) for method in METHODS),
                     *ratios, f"{row['bfs']['count']:,.1f}", *(f"{row[method]['extra']:,.1f}" for method in ("ball", "paper")),
                     number(sum(row[method]["missing"] for method in METHODS))])
    return table(header, rows)


def phases(measured):
    rows = []
    for name, result in measured.items():
        for row in result["phases"]:
            rows.append([name, f"{row['radius_edges']:g}",
                         *(f"{row[phase]:.0f} %" for phase in ("climb_up", "breadth_first", "range_search"))])
    return table(["mesh", "radius", "climb up", "breadth first", "range search"], rows)


def head_table(data):
    """For the README: one query on the largest mesh, of the radius that the paper names."""
    name = next((name for name in ("head_skin", *data["meshes"]) if name in data["meshes"]))
    result = data["meshes"][name]
    radius = paper_tables.ACCOUNT_RADIUS
    row = programs.by_radius(result["table2"])[radius]
    header = ["breadth-first search", "scan for the ball", "the paper's index", "the exact index"]
    busy = " **Preliminary: the machine was busy.**" if machine.is_busy(data["machine"]) else ""
    return (f"One neighborhood within {radius:g} average edges on {name}, {result['table1']['vertices']:,} vertices"
            f" ({row['bfs']['count']:,.0f} found; {data['machine']['processor']}, one thread, far-apart queries):{busy}\n\n"
            + table(header, [[f"{number(row[method]['microseconds'])} µs" for method in METHODS]]))
