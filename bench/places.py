# SPDX-License-Identifier: MIT
"""The paths of programs, meshes and results."""
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BUILD = ROOT / "build"
PROGRAMS = BUILD / "release" / "bench"
MESHHOOD = BUILD / "release" / "meshhood"
SCRATCH = BUILD / "benchmarks"
RESULTS = ROOT / "docs" / "benchmarks"
DOCUMENT = ROOT / "docs" / "benchmarks.md"
README = ROOT / "README.md"
