# SPDX-License-Identifier: MIT
"""The account of 4.2: is building worth it where every vertex is asked?"""
from .. import paper_tables, programs, results
from .markdown import table

NOTE = """## Every vertex of a mesh (4.2)

The paper reckons with one query of the Raptor within {radius} average edges, 0.26 ms, on its 1,000,080 vertices: 260 s,
and 272 s with building, where breadth-first search would take 2,250 s. Reckoned in the same way from Table 2 above, and,
for the exact index, really done, once: one call of the Python package, all ids streamed, by the clock on the wall.

"""


def text(data):
    tables = results.load("paper_tables") or {"meshes": {}}
    rows = [["*Raptor, the paper's figures*", "", "12.6 s", "260 s", "2,250 s"]]
    for name, account in data["meshes"].items():
        if name in tables["meshes"]:
            rows += reckoned(name, tables["meshes"][name], data["radius_edges"])
        rows += done(name, account)
    return (NOTE.format(radius=data["radius_edges"])
            + table(["mesh", "how", "building", "all queries", "breadth-first search"], rows))


def reckoned(name, result, radius):
    row = programs.by_radius(result["table2"]).get(radius)
    if row is None:
        return []
    vertices = result["table1"]["vertices"]
    whole = {method: f"{1e-6 * vertices * row[method]['microseconds']:,.1f} s" for method in ("bfs", "paper", "exact")}
    return [[name, f"{method} index, reckoned", f"{paper_tables.build_summary(result, method)['median']:.2f} s", whole[method],
             f"{whole['bfs']}"] for method in ("paper", "exact")]


def done(name, account):
    rows = []
    for workers, label in (("1", "one thread"), ("-1", "all threads")):
        took = account[workers]
        for key, what in (("ids_seconds", "ids"), ("count_seconds", "counts only")):
            rows.append([name, f"exact index, done, {what}, {label}", f"{took['build_seconds']:.2f} s",
                         f"{took[key]:,.1f} s", ""])
    return rows
