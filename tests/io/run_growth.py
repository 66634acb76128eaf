#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Reading a text file takes work in proportion to its size. The work is instructions, which callgrind counts: a time would
depend on what else the machine does.

usage: run_growth.py READ_PEAK    the program that reads a file; exit code 77 without valgrind
"""
import concurrent.futures
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROWS = 1000
FACTOR = 16  # all files have fewer than 2 MB: what is quadratic often is so in a window of the file only


def ply(rows, row="1 2 3\n", comments=""):
    header = f"ply\nformat ascii 1.0\n{comments}element vertex {rows}\n"
    return header + "property float x\nproperty float y\nproperty float z\nend_header\n" + rows * row


def ply_elements(n):
    return ply(0, comments="".join(f"element e{i} 0\n" for i in range(n)))


def ply_properties(n):
    header = ply(1, "0 " * (n + 3) + "\n")
    return header.replace("end_header\n", "".join(f"property float p{i}\n" for i in range(n)) + "end_header\n")


def off(rows, row="1 2 3\n"):
    return f"OFF\n{rows} 0 0\n" + rows * row


def stl(rows, end="end"):
    loop = "outer loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
    return "solid\n" + rows // 8 * f"facet normal 0 0 1\n{loop}{end}loop\n{end}facet\n" + "endsolid\n"


def cr(text):
    return text.replace("\n", "\r")


# Files that grow in one way.
WAYS = {
    "ply, lines": ply,
    "ply, CR": lambda n: cr(ply(n)),
    "ply, a tail in CR": lambda n: ply(n, "1 2 3\r"),
    "ply, longer rows": lambda n: ply(n, "1 2 3 4\n"),
    "ply, rows in one line": lambda n: ply(n, "1 2 3 "),
    "ply, rows over lines": lambda n: ply(n, "1\n2\n3\n"),
    "ply, comments": lambda n: ply(1, comments=n * "comment of it\n"),
    "ply, elements": ply_elements,
    "ply, properties": ply_properties,
    "off, lines": off,
    "off, CR": lambda n: cr(off(n)),
    "off, a tail in CR": lambda n: off(n, "1 2 3\r"),
    "off, comments": lambda n: off(1, n * "# comment\n" + "1 2 3\n"),
    "off, comments in lines": lambda n: off(n, "1 2 3 # comment\n"),
    "obj, lines": lambda n: n * "v 1 2 3\n",
    "obj, CR": lambda n: n * "v 1 2 3\r",
    "obj, a tail in CR": lambda n: "v 1 2 3\n" + n * "v 1 2 3\r",
    "obj, comments": lambda n: n * "# comment\n" + "v 1 2 3\n",
    "obj, continued lines": lambda n: n * "v 1 \\\n2 3\n",
    "obj, a continued face": lambda n: "v 1 2 3\nf 1" + n * " \\\n1" + "\n",
    "obj, a long line": lambda n: "v 1 2 3\nf" + n * " 1" + "\n",
    "stl, lines": stl,
    "stl, CR": lambda n: cr(stl(n)),
    "stl, a tail in CR": lambda n: "solid\n" + cr(stl(n)),
    "stl, end as a word": lambda n: stl(n, "end "),
    "stl, solids": lambda n: n * "solid\nendsolid\n",
}


def instructions(program, way, rows):
    """Of the process that reads a file, its start included."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, f"mesh.{way[:3]}")
        file.write_text(WAYS[way](rows), encoding="ascii", newline="")
        command = ["valgrind", "--tool=callgrind", f"--callgrind-out-file={os.devnull}", program, file]
        done = subprocess.run(command, capture_output=True, text=True)
        assert done.returncode == 0, f"{way}: {done.stdout}{done.stderr}"
        return int(re.search(r"Collected : (\d+)", done.stderr)[1])


def growth(program, way):
    start, small, large = (instructions(program, way, rows) for rows in (8, ROWS, FACTOR * ROWS))
    return (large - start) / (small - start)


def main():
    if shutil.which("valgrind") is None:
        print("skipped: no valgrind")
        return 77
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        growths = dict(zip(WAYS, pool.map(lambda way: growth(sys.argv[1], way), WAYS)))
    for way, times in growths.items():
        print(f"{way:<24} {times:5.1f} times the instructions for {FACTOR} times the rows")
    slow = [way for way, times in growths.items() if times > 1.5 * FACTOR]
    print(f"{len(WAYS)} ways to grow a file, {len(slow)} of them not in proportion to the size: {', '.join(slow) or 'none'}")
    return 1 if slow else 0


if __name__ == "__main__":
    sys.exit(main())
