#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Promises that no other test reads stand where users look for them, and lists of the documents are complete.

    promises_test.py ROOT
"""

import re
import sys
from pathlib import Path

# A blank stands for any white space of the document.
PROMISES = [
    ("CHANGELOG.md", r"Semantic Versioning\].*While the first number is 0, a breaking change increases the second"),
    ("CHANGELOG.md", r"The public API\*\* is .*installed headers.*CMake.*pkg-config.*exit codes.*Python.*JavaScript"),
    ("CHANGELOG.md", r"versions read all released formats of both; a newer format is refused, with advice"),
    ("CHANGELOG.md", r"What will go is marked `\[\[deprecated\]\]`, or warns, for one minor version before"),
    ("CHANGELOG.md", r"the ABI, with the soname and the inline namespace, in each minor version until 1\.0"),
    ("SECURITY.md", r"To report a weakness:\*\*.*The last minor version gets the fixes"),
    ("SECURITY.md", r"trusted\?.* mesh files, index files.* no\. .*with `trusted` \| yes\. .*a pickle of Python.* yes"),
    ("packaging/RELEASE.md", r"the address of the maintainer, which step 1 fills in"),
    ("packaging/RELEASE.md", r"The linter and the hooks of ConanCenter, and the linter of vcpkg, cannot be installed from PyPI, npm or Debian"),
    ("packaging/RELEASE.md", r"nothing here runs programs of macOS.*There is no wheel for Windows"),
    ("README.md", r"Wheels are for Linux, and for macOS, where they have not been run\. On Windows, the C\+\+ library"),
    ("docs/python.md", r"Wheels are for Linux, and for macOS, where they have not been run\. There are none for Windows"),
    ("docs/cpp.md", r"for Windows \(MinGW, in Wine\).*macOS and Visual C\+\+ have not been tried"),
    ("docs/cpp.md", r"Where there are no threads, all runs on the caller's"),
    ("docs/cpp.md", r"compiled with `-fno-rtti`, and with `-fno-exceptions`, where an error ends them"),
    ("docs/design.md", r"keeps no state between calls but .*There is no pool of threads"),
]
PLATFORMS = {"newest": "next version of Debian", "mingw": "MinGW"}
FUZZED = {
    "any": "any format",
    "calls": "sequences of calls",
    "index": "index files as they are",
    "index_fixed": "corrected checksums",
    "mesh": "arrays as meshes",
    "parts": "folders of parts",
}


def text(name):
    return (Path(sys.argv[1]) / name).read_text(encoding="utf-8")


def words(name):
    return " ".join(text(name).split())


def other_namespaces():
    """Places of the libraries whose names are not in the inline namespace of the version."""
    major, minor = re.findall(r"VERSION_M\w+ (\d+)", text("include/meshhood/version.h"))
    sources = [path for room in ("include", "src", "io") for path in Path(sys.argv[1], room).rglob("*") if path.suffix in (".h", ".cpp")]
    for path in sources:
        for opened in re.findall(r"^namespace meshhood\b(?: \{\n)?.*", path.read_text(encoding="utf-8"), re.M):
            if f"v{major}_{minor}" not in opened:
                yield f"{path.name}: {opened!r}, expected in the inline namespace v{major}_{minor}"
    if not sources:
        yield "no sources"


platforms = re.search(r"known=\((.*)\)", text("tools/platforms"))[1].split()
fuzzers = re.search(r"foreach\(target (.*)\)", text("fuzz/CMakeLists.txt"))[1].split()
steps = re.findall(r"^(\d+)\. ", text("packaging/RELEASE.md"), re.M)
undone = " ".join(re.findall(r"^\| ([\d, ]+)", text("packaging/RELEASE.md"), re.M))
tried = words("docs/cpp.md").split("## On other systems")[1].split(" ## ")[0].lower()
fuzzed = words("SECURITY.md").split("Fuzzed are ")[1].lower()

faults = [f"{name} does not say: {promise}" for name, promise in PROMISES if not re.search(promise, words(name))]
faults += [f"docs/cpp.md does not name {n} of tools/platforms" for n in platforms if PLATFORMS.get(n, n).lower() not in tried]
faults += [f"SECURITY.md does not name {n} of fuzz" for n in fuzzers if FUZZED.get(n, n) not in fuzzed]
faults += [f"packaging/RELEASE.md does not say how to undo step {n}" for n in steps if n not in undone]
faults += other_namespaces()
counts = f"{len(PROMISES)} promises, {len(platforms)} platforms, {len(fuzzers)} fuzzers, {len(steps)} steps of a release"
print("\n".join([*faults, f"{counts}; {len(faults)} faults"]))
sys.exit(1 if faults or not (platforms and fuzzers and steps) else 0)
