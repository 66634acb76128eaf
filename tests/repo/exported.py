#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What shared libraries export is the interface: names of the public headers, and of src/shared, which the libraries of
this project have in common. Instances of templates of others (`std::vector`), which are weak, are not looked at.

    exported.py ROOT LIBRARY...
"""
import re
import subprocess
import sys
from pathlib import Path

root, libraries = Path(sys.argv[1]), sys.argv[2:]
headers = [*root.glob("include/meshhood/*.h"), *root.glob("src/shared/*.h")]
headers += [root / "io" / name for name in ("index_io.h", "mesh_io.h", "weld.h")]
words = set(re.findall(r"\w+", "".join(header.read_text(encoding="utf-8") for header in headers)))
OURS = re.compile(r"(?:^|[ *&])meshhood::(?:(?:paper|io|detail)::)*(\(anonymous namespace\)|\w+)")

count, faults = 0, []
for library in libraries:
    table = subprocess.run(["nm", "-DC", "--defined-only", library], capture_output=True, text=True, check=True).stdout
    for line in table.splitlines():
        _, kind, name = line.split(maxsplit=2)
        ours = OURS.search(re.sub(r"<[^<>]*>", "", name.split("(")[0]) if not name.startswith("(") else name)
        count += ours is not None
        if ours and ours[1] not in words or not ours and kind not in "WVu":
            faults.append(f"{library}: exports {name}, which no public header has")
print("\n".join([*faults, f"{count} symbols of the interface in {len(libraries)} libraries, {len(faults)} others"]))
sys.exit(1 if faults or count == 0 else 0)
