# SPDX-License-Identifier: MIT
"""Cost as mesh and radius grow."""
from .. import scaling
from ..timing import fitted_exponent
from .markdown import number, table

SIZES = (10_000, 1_000_000, 10_000_000)


def over_size(data):
    header = ["shape", "vertices", "exact built s", "paper built s", *(f"{method} µs" for method in scaling.METHODS)]
    rows = []
    for shape, races in data["by_size"].items():
        for race in filter(lambda race: race["vertices"] in SIZES, races):
            rows.append([shape, f"{race['vertices']:,}",
                         *(number(scaling.build_seconds(race, kind)) for kind in ("exact", "paper")),
                         *(number(scaling.microseconds(race, method, data["radius_edges"])) for method in scaling.METHODS)])
    return table(header, rows)


def over_radius(data):
    rows = []
    for shape, race in data["by_radius"].items():
        pairs = [scaling.large(*scaling.cost_by_found(race, method)) for method in scaling.METHODS]
        rows.append([shape, *(f"k^{fitted_exponent(*pair):.2f}" if len(pair[0]) > 1 else "" for pair in pairs)])
    return table(["shape", *scaling.METHODS], rows)
