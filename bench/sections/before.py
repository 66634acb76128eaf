# SPDX-License-Identifier: MIT
"""The exact index beside that of another commit."""
from statistics import geometric_mean

from .. import programs
from .markdown import table


def ratios(data):
    """The time for ids over that of the other commit."""
    by_radius = {name: programs.by_radius(result["rows"]) for name, result in data["meshes"].items()}
    radii = sorted(next(iter(by_radius.values())))
    rows = []
    for name, times in by_radius.items():
        cells = [times[radius]["ids"]["microseconds"] / times[radius]["before"]["microseconds"] for radius in radii]
        rows.append([name, *(f"{value:.2f}" for value in cells), f"{geometric_mean(cells):.2f}"])
    return table([f"time over that of {data['commit']}", *(f"{radius:g}" for radius in radii), "mean"], rows)
