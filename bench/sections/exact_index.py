# SPDX-License-Identifier: MIT
"""The exact index compared with breadth-first search."""
from .. import programs
from .markdown import number, table

BFS = ("bfs", "bfs-reordered")
SHOWN_RADII = (2, 5, 10, 20, 65)
KINDS = {"head_skin": "a smooth scan", "dragon": "a scan with folds", "mri_head": "strongly folded",
         "plates": "two sheets close together"}


def speed(data):
    header = ["mesh", "radius", "found", "bfs, cold", "exact, cold", "× cold", "× cold, count", "× warm",
              "× warm, count"]
    rows = []
    for name, result in shown(data).items():
        label = f"{name} ({KINDS[name]})" if name in KINDS else name
        cold, warm = (programs.by_radius(result[order]) for order in ("cold", "warm"))
        for radius in filter(cold.__contains__, SHOWN_RADII):
            ratios = (ratio(row[radius], method) for row in (cold, warm) for method in ("ids", "count"))
            rows.append([label, f"{radius:g}", *timed_cells(cold[radius]), *(f"{value:.1f}" for value in ratios)])
    return table(header, rows) + "\n" + extremes(data["meshes"])


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
    def said(found):
        return f"{found[0]:.1f} ({found[1]}, {found[3]}, {found[2]:g} edges)"

    least, most = least_and_most(meshes)
    return f"Over all meshes and radii, the smallest ratio is {said(least)} and the largest {said(most)}.\n"


def timed_cells(row):
    """Vertices found, and the times of breadth-first search and of the exact index."""
    return [number(row["bfs"]["count"]), number(best_bfs(row)), number(row["ids"]["microseconds"])]
