# SPDX-License-Identifier: MIT
"""Cost as work grows."""
from .. import scaling
from ..timing import fitted_exponent
from .markdown import image, number, table

NOTE = """## Cost as work grows

Shapes by formula (`meshhood generate`); one thread, processor time, {queries:,} random queries, cold; each method has an
index of its own, so that none finds in the cache what another has read. Exponents are the slopes in log-log.

"""

RADIUS_NOTE = """
Over the radius, fitted where at least {large:,} vertices are found (k). What is expected: where one sheet fills the ball
(sphere), ranges and counts cost the rim of the answer, k^0.5, and ids on top what it takes to copy them, k^1. Where
sheets lie close (scroll) or a surface is all spikes (noise), the search goes through the leaves of the answer, and all
three tend to k^1; the paper's index does not ask what hangs together there, and can be the faster for it.

"""


def text(data):
    return (NOTE.format(queries=data["queries"]) + image("build_over_size", "Building over the size of the mesh") + "\n"
            + image("query_over_size", "One query over the size of the mesh") + "\n" + size_table(data)
            + RADIUS_NOTE.format(large=scaling.LARGE) + image("query_over_radius", "One query over what it finds") + "\n"
            + exponent_table(data))


def size_table(data):
    header = ["shape", "vertices", "exact built s", "paper built s", *(f"{method} µs" for method in scaling.METHODS)]
    rows = []
    for shape, races in data["by_size"].items():
        for race in races:
            rows.append([shape, f"{race['vertices']:,}",
                         *(number(scaling.build_seconds(race, kind)) for kind in ("exact", "paper")),
                         *(number(scaling.microseconds(race, method, data["radius_edges"])) for method in scaling.METHODS)])
    return table(header, rows)


def exponent_table(data):
    rows = []
    for shape, race in data["by_radius"].items():
        pairs = [scaling.large(*scaling.cost_by_found(race, method)) for method in scaling.METHODS]
        rows.append([shape, *(f"k^{fitted_exponent(*pair):.2f}" if len(pair[0]) > 1 else "" for pair in pairs)])
    return table(["shape", *scaling.METHODS], rows)
