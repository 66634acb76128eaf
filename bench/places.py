# SPDX-License-Identifier: MIT
"""The paths of programs, meshes, results and documents."""
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BUILD = ROOT / "build"
PROGRAMS = BUILD / "release" / "bench"
MESHHOOD = BUILD / "release" / "meshhood"
SCRATCH = BUILD / "benchmarks"
RESULTS = SCRATCH / "results"  # all that was measured, and all pictures
PAGES = ROOT / "docs" / "benchmarks"  # of each page one small table, and the pictures that it shows
README = ROOT / "README.md"
