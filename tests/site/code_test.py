#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The pieces of C++ in docs/queries.md compile, each in a function of its own, with the names that the page introduces.

    code_test.py COMPILER ROOT INCLUDES

INCLUDES   the folders of headers, separated by colons
"""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

BLOCK = re.compile(r"```cpp\n(.*?)```", re.DOTALL)
INCLUDE = re.compile(r"^#include .*\n", re.MULTILINE)
NAMES = """
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <meshhood/meshhood.h>
#include <meshhood/io/weld.h>

namespace document {
extern const meshhood::MeshView mesh;
extern meshhood::Index index;
extern meshhood::RegionSearcher searcher;
extern meshhood::EdgeSearcher along;
extern std::vector<meshhood::VertexId> ids, changed;
extern const meshhood::VertexId a, b, c, v, w;
extern const double r;
extern const meshhood::SpacePoint p;
extern const std::array<meshhood::VertexId, 3> corners;
extern const std::vector<std::pair<meshhood::SpacePoint, std::array<meshhood::VertexId, 3>>> stroke;
extern const std::vector<meshhood::VertexId> seam;
extern const std::vector<float> positions;
extern const std::vector<meshhood::SpacePoint> points;
extern CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3> surface;
"""


def main():
    compiler, root, includes = sys.argv[1], Path(sys.argv[2]), sys.argv[3].split(":")
    blocks = BLOCK.findall((root / "docs/queries.md").read_text(encoding="utf-8"))
    headers = [line for block in blocks for line in INCLUDE.findall(block)]
    bodies = [INCLUDE.sub("", block).replace("= ...;", "= {};") for block in blocks]
    functions = [f"void piece_{i}() {{\n{body}}}\n" for i, body in enumerate(bodies)]
    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder) / "queries.cpp"
        source.write_text("".join([*headers, NAMES, *functions, "}\n"]), encoding="utf-8")
        folders = [option for include in includes for option in ("-I", include)]
        done = subprocess.run([compiler, "-std=c++20", "-fsyntax-only", *folders, source], check=False)
    print(f"docs/queries.md: {len(blocks)} pieces of C++")
    sys.exit(done.returncode or len(blocks) < 10)


if __name__ == "__main__":
    main()
