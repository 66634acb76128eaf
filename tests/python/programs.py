# SPDX-License-Identifier: MIT
"""Programs that run in a process of their own, because they end it, limit it, or may crash it."""

import os
import subprocess
import sys

PREPARE = f"""
import os, pathlib, signal, sys, threading, time
sys.path.insert(0, {os.path.dirname(__file__)!r})
import meshes, meshhood
import numpy as np
"""

# What calls on all vertices are given. `folder` is the first argument of the program.
SCENE = """
folder = pathlib.Path(sys.argv[1])
V, F = meshes.two_plates({side})
index = meshhood.MeshIndex(V, F)
values = np.ones((len(V), 20))
walls, ignored = np.arange(len(V)) % 7 == 0, np.arange(len(V)) % 5 == 0
arrays = folder / "V.npy", folder / "F.npy"
np.save(arrays[0], V), np.save(arrays[1], F)
"""


def run(program, *arguments, seconds=600, environment=None):
    """The process, which has ended without an error. `environment`: what it has in addition."""
    command = [sys.executable, "-W", "ignore", "-c", PREPARE + program, *map(str, arguments)]
    variables = {**os.environ, **(environment or {})}
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=seconds, env=variables)
    assert done.returncode == 0, done.stdout + done.stderr
    return done
