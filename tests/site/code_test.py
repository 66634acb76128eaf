#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The C++ of the documents, and the examples in the comments of the public headers, compile: each block in a function of
its own, with the names that these pages introduce. `= ...;` stands for values that the reader has.

    code_test.py COMPILER ROOT INCLUDES

INCLUDES   the folders of headers, separated by colons
"""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

COMPILER, ROOT, INCLUDES = sys.argv[1], Path(sys.argv[2]), sys.argv[3].split(":")
sys.path.insert(0, str(ROOT / "tools"))
from code_blocks import blocks_to_run, documents

INCLUDE = re.compile(r"^#include .*\n", re.MULTILINE)
COMMENT = re.compile(r"(?:^///.*\n)+", re.MULTILINE)
EXAMPLE = re.compile(r"^///\n((?:/// {5}.*\n|///\n)+)", re.MULTILINE)
NEEDED = re.compile(r"^#if __has_include\((<.*>)\)$", re.MULTILINE)
NAMES = """
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <meshhood/meshhood.h>
#include <meshhood/io/weld.h>

namespace document {
extern const meshhood::MeshView mesh;
extern meshhood::Index index;
extern meshhood::Searcher searcher, along;
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
NAMES_OF_HEADERS = """
using Kernel = CGAL::Simple_cartesian<double>;
extern const std::vector<double> thickness;
extern const meshhood::FacesView faces;
extern const meshhood::CurvatureIndex surface;
"""


def examples(header):
    """The indented blocks of the comments of a header that stand at its left margin."""
    for comment in COMMENT.findall(header.read_text(encoding="utf-8")):
        for block in EXAMPLE.findall(comment):
            yield re.sub(r"^/// {0,5}", "", block, flags=re.MULTILINE).replace("\n...\n", "\n")


def has(header, command):
    """Whether the library of an adapter is there."""
    needed = NEEDED.findall(header.read_text(encoding="utf-8"))
    source = "".join(f"#include {name}\n" for name in needed)
    return subprocess.run([*command, "-x", "c++", "-"], input=source, text=True, capture_output=True).returncode == 0


def function(name, block):
    return f"void {name}() {{\n{INCLUDE.sub('', block).replace('= ...;', '= {};')}}}\n"


def main():
    folders = [option for include in INCLUDES for option in ("-I", include)]
    command = [COMPILER, "-std=c++20", "-fsyntax-only", *folders]
    of_pages = [block.code for name in documents() for block in blocks_to_run(name, "cpp")]
    headers = [header for header in sorted((ROOT / "include/meshhood").glob("*.h")) if list(examples(header))]
    known = [header for header in headers if has(header, command)]
    for header in set(headers) - set(known):
        print(f"skipped: the library of {header.name} is not installed")
    of_headers = [block for header in known for block in examples(header)]
    includes = [line for block in of_pages + of_headers for line in INCLUDE.findall(block)]
    includes += [f"#include <meshhood/{header.name}>\n" for header in known]
    parts = [*includes, NAMES, *(function(f"piece_{i}", block) for i, block in enumerate(of_pages))]
    parts += ["namespace headers {", NAMES_OF_HEADERS]
    parts += [function(f"piece_{i}", block) for i, block in enumerate(of_headers)]
    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder) / "documents.cpp"
        source.write_text("".join([*parts, "}\n}\n"]), encoding="utf-8")
        done = subprocess.run([*command, source], check=False)
    print(f"{len(of_pages)} pieces of C++ in the documents, {len(of_headers)} in the headers")
    sys.exit(done.returncode or len(of_pages) < 10 or len(of_headers) < 10)


if __name__ == "__main__":
    main()
