#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks a wheel without installing it: what it contains, its size, and that it needs no newer system than it names.

    check_wheel.py WHEEL
"""

import json
import re
import subprocess
import sys
import zipfile
from pathlib import Path

MOST_BYTES = 3_000_000


def check_contents(archive):
    names = archive.namelist()
    for needed in (
        r"meshhood/__init__\.py",
        r"meshhood/py\.typed",
        r"meshhood/_core\.pyi",
        r"meshhood/_core\.[^/]*so",
        r"meshhood/viewer\.html",
        r"meshhood-[^/]*\.data/scripts/meshhood",
        r"meshhood-[^/]*\.dist-info/licenses/LICENSE",
        r"meshhood-[^/]*\.dist-info/licenses/NOTICE",
    ):
        assert any(re.fullmatch(needed, name) for name in names), f"no {needed}"
    unexpected = [name for name in names if not re.match(r"meshhood(-[\d.]+\.(dist-info|data/scripts))?/", name)]
    assert not unexpected, unexpected
    metadata = archive.read(next(name for name in names if name.endswith("/METADATA"))).decode()
    for field in ("Summary", "License-Expression", "Requires-Python", "Requires-Dist: numpy", "Classifier", "Keywords"):
        assert f"\n{field}" in metadata, f"no {field} in the metadata"
    relative = re.findall(r"<img|!\[|\]\((?!https?:|#)[^)]*\)", metadata)
    assert not relative, f"the description has pictures or links to files, which PyPI does not show: {relative}"


def check_platform(wheel):
    """auditwheel names the oldest system that has all symbols. A module for macOS can only be told from others."""
    if "macosx" in wheel.name:
        with zipfile.ZipFile(wheel) as archive:
            module = next(name for name in archive.namelist() if name.endswith(".so"))
            assert archive.read(module)[:4] == b"\xcf\xfa\xed\xfe", "not a module of macOS"
        return "not loaded: there is no such system here"
    # Without the libraries of this machine, whose libc.so is not that of musl, but a text for the linker.
    text = subprocess.run(
        [sys.executable, "-m", "auditwheel", "show", "--ldpaths", "", wheel], check=True, capture_output=True, text=True
    ).stdout
    # zig links libc.so, as the loader of musl calls itself. auditwheel knows only the name that Alpine gives it.
    if "musllinux" in wheel.name:
        needed = re.search(r"libraries are required by the wheel:\s*(\{.*?\})", text, re.DOTALL)
        assert needed and json.loads(needed[1]) == {"libc.so": None}, text
        return "needs libc.so only"
    found = re.search(r'tag:\s+"(manylinux_(\d+)_(\d+)_(\w+))"', text)
    named = re.search(r"manylinux_(\d+)_(\d+)_(\w+)\.whl", wheel.name)
    assert found and named, text
    assert found[4] == named[3], text
    assert (int(found[2]), int(found[3])) <= (int(named[1]), int(named[2])), text
    return f"auditwheel: {found[1]}"


def check_interface(wheel):
    """abi3audit finds functions of CPython that later versions need not have."""
    if "-abi3-" in wheel.name:
        subprocess.run([sys.executable, "-m", "abi3audit", "--strict", wheel], check=True)


def main():
    wheel = Path(sys.argv[1])
    assert re.search(r"-(cp312-abi3|(cp3\d+)-\2)-", wheel.name), f"{wheel.name} names no interface of CPython"
    bytes_ = wheel.stat().st_size
    with zipfile.ZipFile(wheel) as archive:
        check_contents(archive)
    check_interface(wheel)
    print(f"{wheel.name}: {bytes_} bytes; {check_platform(wheel)}")
    assert bytes_ <= MOST_BYTES, f"expected at most {MOST_BYTES} bytes"


main()
