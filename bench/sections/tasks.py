# SPDX-License-Identifier: MIT
"""Tasks of users, beside the usual tools."""
from pathlib import Path

from .markdown import number, table

TITLE = "Tasks beside the usual tools"
COMMAND = "python3 -m bench tasks"

NOTE = """`{command}`: each task is a program of at most ten lines in examples/tasks, beside one that does the same with
another tool (bench/tasks). Wall clock from the arrays of a mesh to the result, with the index built anew, on all
processors; the median of three processes. The questions are not always the same: a ball has vertices that are not
connected, a heat method approximates distances, and Workbench reads and writes its files.
The tasks that smooth were measured while `smooth` and many_maps took a biweight of 6.37 mm for a `fwhm` of 6 mm.
*From one vertex in 50* means that the tool answered those alone, and that its time is 50 times as long.

"""
OURS = Path(__file__).resolve().parents[2] / "examples" / "tasks"


def text(data):
    rows = []
    for row in data["rows"]:
        what = (OURS / f"{row['task']}.py").read_text(encoding="utf-8").splitlines()[0].lstrip("# ")
        ours, other = row["meshhood"].get("seconds"), row["other"].get("seconds")
        cells = [f"{1e3 * ours:.0f}" if ours else "", f"{1e3 * other:.0f}" if other else "not installed here"]
        every = row["other"].get("every", 1)
        tool = row["tool"] if every == 1 else f"{row['tool']}, from one vertex in {every}"
        rows.append([row["task"], what, tool, *cells, number(other / ours) if ours and other else ""])
    return NOTE.format(command=COMMAND) + table(["task", "what", "tool", "meshhood, ms", "tool, ms", "ratio"], rows)
