# SPDX-License-Identifier: MIT
"""Reading mesh files, beside other libraries."""
from .markdown import number, table


def times(data):
    names = list(data["versions"])
    rows = []
    for _, measured in sorted(data["files"].items()):
        ours = measured["seconds"]["meshhood"]["median"]
        first = min(time["median"] for time in measured["seconds"].values())
        cells = [cell(measured["seconds"].get(name), ours) for name in names]
        rows.append([f"{measured['format']}, {measured['threads']}", *cells, f"{ours / first:.2f}"])
    versions = ", ".join(f"{name} {version}" for name, version in data["versions"].items())
    return table(["format, threads", *names, "meshhood / first"], rows) + f"\nVersions: {versions}.\n"


def cell(time, ours):
    if time is None:
        return ""
    value = number(1e3 * time["median"])
    return f"**{value}**" if time["median"] < ours else value
