# SPDX-License-Identifier: MIT
"""Runs our own programs, which print JSON."""
import json
import subprocess
import sys

from . import places


def run(program, *arguments):
    command = [str(program), *map(str, arguments)]
    done = subprocess.run(command, stdout=subprocess.PIPE, text=True)
    if done.returncode != 0:
        sys.exit(f"bench: {' '.join(command)} failed")
    return json.loads(done.stdout)


def race(mesh, methods=(), *, radii=(), queries=0, order="cold", builds=0):
    """All `methods` on the same queries in one run; the first defines the exact answer. See bench/race/main.cpp."""
    arguments = [mesh, "--order", order, "--builds", builds]
    for method in methods:
        arguments += ["--method", method]
    if radii:
        arguments += ["--radii", ",".join(map(str, radii)), "--queries", queries]
    return run(places.PROGRAMS / "race", *arguments)


def by_radius(rows):
    """Rows as radius -> method -> row."""
    radii = {}
    for row in rows:
        radii.setdefault(row["radius_edges"], {})[row["method"]] = row
    return radii
