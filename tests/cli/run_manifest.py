#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compares the output of `meshhood info` for every shared mesh with the manifest of the meshes.

usage: run_manifest.py PROGRAM SHARED

SHARED is the folder that contains `meshes`, unless MESHHOOD_SHARED names it.

Files without figures in the manifest are skipped, and packed files if there is no zstd. Exit code 77 without the folder.
"""
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

COLUMNS = {
    "vertices": "vertices",
    "faces": "faces",
    "boundary edges": "boundary_edges",
    "non-manifold edges": "nonmanifold_edges",
    "repeated positions": "repeated_positions",
}

# The manifest counts only triangles in STL; the reader keeps a facet of four corners as a quad. And it has figures of a
# binary STL whose first facet announces 16,317 more bytes than follow it, which is refused.
OTHERWISE = {"toomanyvertices.stl", "quad.ascii.stl", "multiWordName.bin.stl"}


def tables(manifest):
    """The rows of every table that lists files, as dictionaries by column."""
    header = None
    for line in manifest.read_text(encoding="utf-8").splitlines():
        cells = [cell.strip() for cell in line.strip("|").split(" | ")] if line.startswith("|") else None
        if cells is None:
            header = None
        elif header is None:
            header = cells
        elif "file" in header and not set(line) <= set("|- "):
            yield dict(zip(header, cells))


def number(cell):
    return int(cell.replace(",", ""))


def expected(row):
    figures = {key: number(row[column]) for column, key in COLUMNS.items() if row[column] != "-"}
    components = re.fullmatch(r"([\d,]+)(?: \+ ([\d,]+) isolated vertices)?", row["components"])
    figures["components"] = number(components[1])
    figures["isolated_vertices"] = number(components[2] or "0")
    return figures


def degrees_agree(cell, faces, found):
    """`cell`: "3", or "3: 24, 4: 3355", or "3 to 8"."""
    if sum(found.values()) != faces:
        return False
    if " to " in cell:
        least, most = (int(end) for end in cell.split(" to "))
        return {min(map(int, found)), max(map(int, found))} == {least, most}
    return found == ({d: int(n) for d, n in re.findall(r"(\d+): (\d+)", cell)} or {cell: faces})


def info(program, file):
    # The manifest counts the positions that are equal in float.
    command = [program, "info", "--json", "--precision", "float", "--", file]
    done = subprocess.run(command, capture_output=True, timeout=300, check=False)
    return json.loads(done.stdout) if done.returncode == 0 else done.stderr.decode().strip()


def unpacked(file, folder):
    if file.suffix != ".zst":
        return file
    target = Path(folder) / file.stem
    subprocess.run(["zstd", "-dqf", file, "-o", target], check=True)
    return target


def differences(row, found):
    if isinstance(found, str):
        return [f"refused: {found}"]
    wrong = [f"{key}: {found[key]}, manifest {value}" for key, value in expected(row).items() if found[key] != value]
    sides = row["sides per face (count)"]
    if not degrees_agree(sides, found["faces"], found["polygon_degrees"]):
        wrong.append(f"polygon_degrees: {found['polygon_degrees']}, manifest {sides}")
    edge = float(row["average edge"])
    if abs(found["average_edge"] - edge) > 6e-4 * edge:
        wrong.append(f"average_edge: {found['average_edge']}, manifest {edge}")
    return wrong


def main():
    program, shared = sys.argv[1], Path(os.environ.get("MESHHOOD_SHARED", sys.argv[2])) / "meshes"
    if not (shared / "MANIFEST.md").exists():
        print(f"skipped: no {shared}")
        return 77
    rows = [row for row in tables(shared / "MANIFEST.md") if row["components"] != "-"]
    rows = [row for row in rows if Path(row["file"].strip("`")).name not in OTHERWISE]
    if shutil.which("zstd") is None:
        rows = [row for row in rows if ".zst" not in row["file"]]
        print("packed meshes skipped: no zstd")
    failures = 0
    with tempfile.TemporaryDirectory() as folder:
        for row in rows:
            file = shared / row["file"].strip("`")
            wrong = differences(row, info(program, unpacked(file, folder)))
            failures += bool(wrong)
            for line in wrong:
                print(f"{file.name}: {line}")
    print(f"{len(rows) - failures} of {len(rows)} meshes agree with the manifest")
    return 1 if failures or not rows else 0


if __name__ == "__main__":
    sys.exit(main())
