# SPDX-License-Identifier: MIT
"""Reading mesh files, beside other libraries."""
from .markdown import number, table

TITLE = "Reading mesh files"
COMMAND = "python3 -m bench reading"

NOTE = """`{command}`: {triangles:,} triangles, ms from the name of a file to arrays in Python, medians of alternating
rounds, with the file in memory. Each library runs in a process of its own with as many processors as the row has
threads. **Bold**: faster than meshhood. Corners of an STL file at the same position become one vertex, except by
libigl, which leaves three for each triangle. Goal: at most 1.5 times the time of the first.

"""


def text(data):
    names = list(data["versions"])
    rows = []
    for _, measured in sorted(data["files"].items()):
        ours = measured["seconds"]["meshhood"]["median"]
        first = min(time["median"] for time in measured["seconds"].values())
        cells = [cell(measured["seconds"].get(name), ours) for name in names]
        rows.append([f"{measured['format']}, {measured['threads']}", *cells, f"{ours / first:.2f}"])
    versions = ", ".join(f"{name} {version}" for name, version in data["versions"].items())
    return (NOTE.format(command=COMMAND, triangles=data["triangles"])
            + table(["format, threads", *names, "meshhood / first"], rows) + f"\nVersions: {versions}.\n")


def cell(time, ours):
    if time is None:
        return ""
    value = number(1e3 * time["median"])
    return f"**{value}**" if time["median"] < ours else value
