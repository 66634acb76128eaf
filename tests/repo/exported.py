#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What shared libraries export is the interface: names of the public headers, and of src/shared, which the libraries of
this project have in common. Instances of templates of others (`std::vector`), which are weak, are not looked at. All
that a release exported is there, so that its programs still link.

    exported.py ROOT [--list] [--released FILE]... LIBRARY...

--list prints the symbols, for such a file.
"""
import argparse
import re
import subprocess
import sys
from pathlib import Path

parser = argparse.ArgumentParser()
parser.add_argument("root", type=Path)
parser.add_argument("libraries", nargs="+")
parser.add_argument("--list", action="store_true")
parser.add_argument("--released", type=Path, action="append", default=[])
arguments = parser.parse_args()
root = arguments.root
headers = [*root.glob("include/meshhood/*.h"), *root.glob("src/shared/*.h")]
headers += [root / "io" / name for name in ("index_io.h", "mesh_io.h", "weld.h")]
text = "".join(header.read_text(encoding="utf-8") for header in headers)
words = set(re.findall(r"\w+", re.sub(r"//.*", "", text)))
OURS = re.compile(r"(?:^|[ *&])meshhood::v\d+_\d+::(?:(?:paper|io|detail)::)*(\(anonymous namespace\)|\w+)")


def symbols(library, *options):
    """Kind and name of each, but not the name of the library, which is the version of them all."""
    nm = ["nm", "-D", "--defined-only", "--without-symbol-versions", *options, library]
    table = subprocess.run(nm, capture_output=True, text=True, check=True).stdout
    return [line.split(maxsplit=2)[1:] for line in table.splitlines() if " A " not in line]


interface, faults = set(), []
for library in arguments.libraries:
    for (_, symbol), (kind, name) in zip(symbols(library), symbols(library, "-C")):
        ours = OURS.search(re.sub(r"<[^<>]*>", "", name.split("(")[0]) if not name.startswith("(") else name)
        if ours:
            interface.add(symbol)
        if ours and ours[1] not in words or not ours and kind not in "WVu":
            faults.append(f"{library}: exports {name}, which no public header has")
for path in arguments.released:
    gone = [symbol for symbol in path.read_text().split() if symbol not in interface]
    faults += [f"{path.name} had {symbol}, which is gone" for symbol in gone]
if arguments.list:
    print("\n".join(sorted(interface)))
    sys.exit(0)
print("\n".join(faults + [f"{len(interface)} symbols of the interface, {len(faults)} faults"]))
sys.exit(1 if faults or not interface else 0)
