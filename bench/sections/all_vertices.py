# SPDX-License-Identifier: MIT
"""Sec. 4.2: does building pay off if every vertex is queried?"""
from .. import paper_tables, programs, results
from .markdown import table


def account(data):
    tables = results.load("paper_tables") or {"meshes": {}}
    rows = [["*Raptor, the paper's figures*", "", "12.6 s", "260 s", "2,250 s"]]
    for name, took in data["meshes"].items():
        if name in tables["meshes"]:
            rows += computed(name, tables["meshes"][name], data["radius_edges"])
        rows += measured(name, took)
    return table(["mesh", "how", "building", "all queries", "breadth-first search"], rows)


def computed(name, result, radius):
    row = programs.by_radius(result["table2"]).get(radius)
    if row is None:
        return []
    vertices = result["table1"]["vertices"]
    whole = {method: f"{1e-6 * vertices * row[method]['microseconds']:,.1f} s" for method in ("bfs", "paper", "exact")}
    return [[name, f"{method} index, computed", f"{paper_tables.build_summary(result, method)['median']:.2f} s", whole[method],
             f"{whole['bfs']}"] for method in ("paper", "exact")]


def measured(name, account):
    rows = []
    for workers, label in (("1", "one thread"), ("-1", "all threads")):
        took = account[workers]
        for key, what in (("ids_seconds", "ids"), ("count_seconds", "counts")):
            rows.append([name, f"exact index, measured, {what}, {label}", f"{took['build_seconds']:.2f} s",
                         f"{took[key]:,.1f} s", ""])
    return rows
