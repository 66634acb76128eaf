# SPDX-License-Identifier: MIT
"""The tasks of examples/tasks beside the usual tools: programs of a few lines, whose last paragraph is measured.

    python3 -m bench tasks [--meshes MESH ...]

A program reads its input in the first paragraph; the last one, from the arrays of a mesh to the result, is timed in a
process of its own: the median of three runs, wall clock, after one run that is not counted. A program that takes too
long answers one vertex in EVERY, and its time is multiplied by that. `NAME.TOOL.py` does with
TOOL what examples/tasks/NAME.py does. The answers are not the same where the questions differ: a ball has vertices that are
not connected, and a heat method approximates distances.
"""

import json
import statistics
import subprocess
import sys
from pathlib import Path

from .. import meshes, results

OURS = Path(__file__).resolve().parents[2] / "examples" / "tasks"
RUNS = 3

_TIMED = """
import json, sys, time
import scipy.sparse  # which some calls import at their first use
given, task = open(sys.argv[1], encoding="utf-8").read().rsplit("\\n\\n", 1)
sys.argv = sys.argv[1:]
names = {}
exec(compile(given, sys.argv[0], "exec"), names)
begin = time.perf_counter()
exec(compile(task, sys.argv[0], "exec"), names)
seconds = time.perf_counter() - begin
every = names.get("EVERY", 1)
print(json.dumps({"seconds": every * seconds, "every": every}))
"""


def timed(program, mesh):
    """Seconds, and of one vertex in how many; None, and the last line of its errors, if the program does not run here."""
    done = subprocess.run([sys.executable, "-c", _TIMED, program, mesh], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        return None, done.stderr.strip().splitlines()[-1]
    return json.loads(done.stdout.splitlines()[-1]), ""


def measure(program, mesh):
    times = []
    for _ in range(1 + RUNS):
        found, reason = timed(program, mesh)
        if found is None:
            return {"reason": reason}
        times.append(found["seconds"])
    return {**found, "seconds": statistics.median(times[1:])}


def run(names=None):
    watched = results.begin("tasks")
    rows = []
    for name in names or ["cortex"]:
        mesh = str(meshes.as_file(name))
        for tool in sorted(Path(__file__).parent.glob("*.*.py")):
            task, other = tool.stem.split(".")
            row = {"mesh": name, "task": task, "tool": other}
            row |= {"meshhood": measure(OURS / f"{task}.py", mesh), "other": measure(tool, mesh)}
            rows.append(row)
            print(row, flush=True)
    results.save("tasks", {"rows": rows}, watched)
