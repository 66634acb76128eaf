# SPDX-License-Identifier: MIT
"""Tasks of users, beside the usual tools."""
from pathlib import Path

from .markdown import number, table

OURS = Path(__file__).resolve().parents[2] / "examples" / "tasks"


def times(data):
    rows = []
    for row in data["rows"]:
        what = (OURS / f"{row['task']}.py").read_text(encoding="utf-8").splitlines()[0].lstrip("# ")
        ours, other = row["meshhood"].get("seconds"), row["other"].get("seconds")
        cells = [f"{1e3 * ours:.0f}" if ours else "", f"{1e3 * other:.0f}" if other else "not installed here"]
        every = row["other"].get("every", 1)
        tool = row["tool"] if every == 1 else f"{row['tool']}, from one vertex in {every}"
        rows.append([row["task"], what, tool, *cells, number(other / ours) if ours and other else ""])
    return table(["task", "what", "tool", "meshhood, ms", "tool, ms", "ratio"], rows)
