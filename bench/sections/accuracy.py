# SPDX-License-Identifier: MIT
"""Extra vertices of the paper's answer and of the ball."""
from .. import accuracy, programs
from .markdown import image, number, table

TITLE = "Accuracy of the paper's method and of the ball"
SHOWN_RADII = (5, 20, 65)

NOTE = """`python3 -m bench accuracy`: {queries:,} random queries for each mesh and radius. The paper's answer and the ball never miss
a vertex of the exact neighborhood. This table shows their extra vertices, relative to the exact answer:

"""

FACTOR_NOTE = """
The factor `f` decides how small the clusters are with which the paper's query starts, and thus error and time:

"""

LEVELS_NOTE = """
This table varies the number of levels computed; the lowest two are discarded, as in the paper:

"""

SUMMARY_NOTE = """`python3 -m bench accuracy`: extra vertices in percent of the exact answer, at {radii} mean edges. Neither method misses a
vertex; the exact index has no extra vertices. [All radii, factors and levels](benchmarks/accuracy.md).

"""


def text(data):
    listed = "\n".join(f"- `{name}`: {race['mesh']}" for name, race in data["meshes"].items())
    missing = sum(row.get("missing", 0) for race in data["meshes"].values() for row in race["rows"])
    if missing:
        raise SystemExit("bench: a method missed vertices; the text on accuracy is wrong")
    return (NOTE.format(queries=data["queries"]) + listed + "\n\n" + image("accuracy", "Extra vertices over the radius")
            + "\n" + extra_table(data) + FACTOR_NOTE + image("factor", "Error and time over the radius for each f")
            + LEVELS_NOTE + image("levels", "Error and time over the radius for each number of levels"))


def summary(data):
    header = ["mesh", *(f"paper, {radius}" for radius in SHOWN_RADII), *(f"ball, {radius}" for radius in SHOWN_RADII)]
    rows = []
    for name, race in data["meshes"].items():
        by_radius = programs.by_radius(race["rows"])
        rows.append([name, *(extra_percent(by_radius[radius], method) for method in (accuracy.factor_method(10), "ball")
                             for radius in SHOWN_RADII)])
    return SUMMARY_NOTE.format(radii=", ".join(map(str, SHOWN_RADII))) + table(header, rows)


def extra_percent(row, method):
    return f"{number(100 * row[method]['extra'] / row['bfs']['count'])} %"


def extra_table(data):
    """Extra vertices a query, and microseconds, at f = 10 and at the other factors."""
    header = ["mesh", "radius", "exact finds", "ball extra", *(f"f = {f}, extra (µs)" for f in accuracy.FACTORS),
              "exact index µs"]
    rows = []
    for name, race in data["meshes"].items():
        for radius, row in programs.by_radius(race["rows"]).items():
            factors = [row[accuracy.factor_method(f)] for f in accuracy.FACTORS]
            rows.append([name, f"{radius:g}", f"{row['bfs']['count']:,.0f}", number(row["ball"]["extra"]),
                         *(f"{number(f['extra'])} ({number(f['microseconds'])})" for f in factors),
                         number(row["ids"]["microseconds"])])
    return table(header, rows)
