# SPDX-License-Identifier: MIT
"""Extra vertices of the paper's answer and of the ball."""
from .. import accuracy, programs
from .markdown import number, table

RADII = (5, 20, 65)


def extra(data):
    """Extra vertices a query, in percent of the exact answer and, for each factor, with the microseconds."""
    header = ["mesh", "radius", "exact finds", "ball, extra", "paper, extra", *(f"f = {f}, extra (µs)" for f in accuracy.FACTORS),
              "exact index, µs"]
    rows = []
    for name, race in data["meshes"].items():
        by_radius = programs.by_radius(race["rows"])
        for radius in filter(by_radius.__contains__, RADII):
            row = by_radius[radius]
            factors = [row[accuracy.factor_method(f)] for f in accuracy.FACTORS]
            rows.append([name, f"{radius:g}", f"{row['bfs']['count']:,.0f}",
                         *(extra_percent(row, method) for method in ("ball", accuracy.factor_method(10))),
                         *(f"{number(f['extra'])} ({number(f['microseconds'])})" for f in factors),
                         number(row["ids"]["microseconds"])])
    return table(header, rows)


def extra_percent(row, method):
    if row[method]["missing"]:
        raise SystemExit("bench: a method missed vertices; the text on accuracy is wrong")
    return f"{number(100 * row[method]['extra'] / row['bfs']['count'])} %"
