# SPDX-License-Identifier: MIT
"""The exact index beside that of another commit."""
from statistics import geometric_mean

from .. import programs
from .markdown import table

TITLE = "Beside another commit"

NOTE = """`python3 -m bench before --commit {commit}`. {queries:,} queries for each mesh and radius, cold, all methods in turn
in one process. The first two rows of a mesh are the time of this version divided by the time of that commit, for ids and
for counts; so less than 1 is faster. The third is the time of breadth-first search, with the vertices in the order of
the file or in index order, whichever is faster, divided by the time of this version for ids; so more than 1 is faster.
The last column is the geometric mean.

"""

# The rows of a mesh: what each is called, and the methods whose times are divided.
ROWS = (("ids", ("ids",), ("before",)), ("count", ("count",), ("before-count",)),
        ("breadth-first search", ("bfs", "bfs-reordered"), ("ids",)))


def text(data):
    by_radius = {name: programs.by_radius(result["rows"]) for name, result in data["meshes"].items()}
    radii = sorted(next(iter(by_radius.values())))
    rows = []
    for name, times in by_radius.items():
        for label, above, below in ROWS:
            ratios = [least(times[radius], above) / least(times[radius], below) for radius in radii]
            rows.append([f"{name}, {label}", *(f"{value:.2f}" for value in ratios), f"{geometric_mean(ratios):.2f}"])
    return NOTE.format(**data) + table(["mesh", *(f"{radius:g}" for radius in radii), "mean"], rows)


def least(row, methods):
    return min(row[method]["microseconds"] for method in methods)
