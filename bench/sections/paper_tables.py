# SPDX-License-Identifier: MIT
"""The paper's Table 1, Table 2 and profile of the query, with the paper's figures beside ours."""
from .. import meshes, paper_tables, programs
from .markdown import image, megabytes, number, table, with_spread

TITLE = "The paper's tables"
METHODS = ("bfs", "ball", "paper", "exact")

NOTE = """`make reproduce`, which runs `bench/race` on each mesh: one thread, processor time, {queries:,} random queries
for each mesh and radius, cold. `bfs`: breadth-first search over an adjacency in CSR form; it owns its memory, clears
nothing between queries and prefetches. `ball`: a scan of all vertices, as in the paper. `paper`: the paper's index and
query with the paper's parameters (five levels computed, the last three kept, f = 10). `exact`: the exact index, with all
ids.

The meshes:

{meshes}

## Table 1: space and building time

Megabytes of 2^20 bytes, as in the paper. A plain mesh has 12 bytes for each vertex (24 if the file has doubles) and 4
bytes for each corner. Topology adds the adjacency: 4 bytes for each vertex and 8 for each edge, where the paper has the
pointers of VCG. The size of an index includes all arrays and its copy of the positions. Building time is processor time
of one thread with the adjacency included, the median of three builds. The paper used a Core i5 at 2.67 GHz.

"""

TABLE2_NOTE = """
## Table 2: time and vertices found

The paper shows its Table 2 as plots. Its text states one pair of figures: on the Raptor at 65 mean edges, 0.26 ms with
the index and 2.25 ms by breadth-first search, a ratio of 8.65. Compare the tables of head_skin and mri_head.

"""

PHASES_NOTE = """
## The phases of the paper's query (4.3)

Percent of the time of a query, the mean of {queries:,} random queries, by `bench/phases.cpp`. The paper measured 85 % in
the range search over its whole benchmark. Our range search continues with the children of intersecting clusters instead
of testing every vertex, and includes the copying of the ids.

"""

SUMMARY_NOTE = """`make reproduce`: megabytes of 2^20 bytes, and seconds of one thread. The index sizes include a copy of the positions. With
the paper's own figures and Table 2: [benchmarks/paper_tables.md](benchmarks/paper_tables.md).

"""


def text(data):
    measured = data["meshes"]
    listed = "\n".join(f"- `{name}`: {result['mesh']}" for name, result in measured.items())
    parts = [NOTE.format(queries=data["queries"], meshes=listed), table1(measured), TABLE2_NOTE,
             image("table2", "Time and vertices found over the radius, for each mesh")]
    parts += [f"\n**{name}**, µs a query\n\n{table2(result)}" for name, result in measured.items()]
    parts += [PHASES_NOTE.format(queries=paper_tables.PROFILE_QUERIES), phases(measured)]
    return "".join(parts)


def summary(data):
    header = ["mesh", "vertices", "plain mesh", "exact index", "built", "paper's index", "built"]
    rows = []
    for name, result in data["meshes"].items():
        space = result["table1"]
        cells = [f"{space['vertices']:,}", megabytes(space["mesh_bytes"])]
        for kind in ("exact", "paper"):
            build = paper_tables.build_summary(result, kind)
            cells += [megabytes(build["bytes"]), f"{build['median']:.3f} s"]
        rows.append([name, *cells])
    return SUMMARY_NOTE + table(header, rows)


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
    return table(["mesh", "radius", "climb up", "breadth-first search", "range search"], rows)
