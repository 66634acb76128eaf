# SPDX-License-Identifier: MIT
"""Extra vertices of the paper's answer and of the ball."""
from .. import accuracy, programs
from .markdown import image, number, table

NOTE = """## Accuracy

{queries:,} random queries a mesh and radius. Neither the paper's answer nor the ball ever misses a vertex of the exact
neighborhood; how many they take besides, as a share of the exact answer:

"""

FACTOR_NOTE = """
The factor `f` decides how small the clusters are that the paper's query begins with, hence error and time:

"""

LEVELS_NOTE = """
The number of levels computed, the lowest two of them dropped as in the paper:

"""


def text(data):
    listed = "\n".join(f"- `{name}`: {race['mesh']}" for name, race in data["meshes"].items())
    missing = sum(row.get("missing", 0) for race in data["meshes"].values() for row in race["rows"])
    if missing:
        raise SystemExit("bench: a method missed vertices; the text on accuracy is wrong")
    return (NOTE.format(queries=data["queries"]) + listed + "\n\n" + image("accuracy", "Extra vertices over the radius")
            + "\n" + extra_table(data) + FACTOR_NOTE + image("factor", "Error and time over the radius by f") + LEVELS_NOTE
            + image("levels", "Error and time over the radius by the number of levels"))


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
