# SPDX-License-Identifier: MIT
"""Cost as mesh and radius grow."""
from .. import scaling
from ..timing import fitted_exponent
from .markdown import image, number, table

TITLE = "Cost as mesh and radius grow"

NOTE = """`python3 -m bench scaling`: generated shapes (`meshhood generate`), one thread, processor time, {queries:,} random queries,
cold. Each method has an index of its own, so that none profits from the cache of another. Exponents are slopes in log-log
scale.

"""

RADIUS_NOTE = """
Over the radius, fitted to answers of at least {large:,} vertices (k). Expected: where one sheet fills the ball (sphere),
ranges and counts cost as much as the boundary of the answer, k^0.5; ids add the cost of copying them, k^1. Where sheets
lie close together (scroll), or where the surface is rough everywhere (noise), the search visits the leaves of the answer,
and all three approach k^1. The paper's index does not test connectivity there, and can be faster.

"""


def text(data):
    return (NOTE.format(queries=data["queries"]) + image("build_over_size", "Building time over the size of the mesh") + "\n"
            + image("query_over_size", "Query time over the size of the mesh") + "\n" + size_table(data)
            + RADIUS_NOTE.format(large=scaling.LARGE) + image("query_over_radius", "Query time over the vertices found") + "\n"
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
