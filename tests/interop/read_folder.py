#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Reads every mesh file of a folder with `meshhood info`, and with plyfile and trimesh where they are installed.

    MESHHOOD_FOREIGN_MESHES=FOLDER read_folder.py MESHHOOD

Fails if the program crashes, takes more than a minute, refuses a file with another exit code or more than one line, or
reads another number of vertices than plyfile (PLY) or trimesh (OFF). Lists the files that it refuses and another reader
accepts: each should be in the table of refused files in docs/reliability.md. Exit code 77, skipped, without the folder.
"""
import json
import os
import subprocess
import sys
from pathlib import Path

SKIPPED = 77
TIMEOUT_SECONDS = 60
EXTENSIONS = (".ply", ".obj", ".off", ".stl")
REFUSED = (3, 4, 6)


def ours(program, file):
    """(vertices, None) of an accepted file, (None, message) of a refused one. An AssertionError names a fault."""
    try:
        done = subprocess.run([program, "info", "--json", "--", file], capture_output=True, timeout=TIMEOUT_SECONDS,
                              check=False)
    except subprocess.TimeoutExpired as error:
        raise AssertionError(f"not read within {TIMEOUT_SECONDS} s") from error
    message = done.stderr.decode("utf-8", "backslashreplace").strip()
    if done.returncode == 0:
        return json.loads(done.stdout)["vertices"], None
    assert done.returncode in REFUSED, f"exit code {done.returncode}: {message}"
    assert message.count("\n") == 0 and message.startswith("meshhood: "), f"not one line: {message!r}"
    return None, message


def theirs(file):
    """The reader and its number of vertices; (None, None) if there is no reader, or it refuses the file."""
    extension = file.suffix.lower()
    try:
        if extension == ".ply":
            import plyfile
            return "plyfile", plyfile.PlyData.read(str(file))["vertex"].count
        if extension == ".off":
            import trimesh
            return "trimesh", len(trimesh.load(str(file), file_type="off", process=False, maintain_order=True).vertices)
    except Exception:  # a failure of another reader is not a fault of meshhood
        pass
    return None, None


def main(program, folder):
    files = sorted(file for file in folder.rglob("*") if file.is_file() and file.suffix.lower() in EXTENSIONS)
    accepted = refused = faults = 0
    for file in files:
        name = file.relative_to(folder)
        reader, expected = theirs(file)
        try:
            vertices, message = ours(program, file)
            assert None in (vertices, expected) or vertices == expected, f"{vertices} vertices, {reader} has {expected}"
        except AssertionError as fault:
            faults += 1
            print(f"FAULT {name}: {fault}")
            continue
        accepted += message is None
        refused += message is not None
        if message is not None and reader is not None:
            print(f"refused, but {reader} reads {expected} vertices: {name}: {message}")
    print(f"{len(files)} files: {accepted} accepted, {refused} refused, {faults} faults")
    return 1 if faults or not files else 0


if __name__ == "__main__":
    if "MESHHOOD_FOREIGN_MESHES" not in os.environ:
        print("skipped: MESHHOOD_FOREIGN_MESHES names no folder")
        sys.exit(SKIPPED)
    sys.exit(main(sys.argv[1], Path(os.environ["MESHHOOD_FOREIGN_MESHES"])))
