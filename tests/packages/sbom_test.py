#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The bills of materials are valid, and name every library that the packages are built with.

    sbom_test.py REPOSITORY
"""

import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path
from urllib.parse import unquote

root = Path(sys.argv[1])


def names(package):
    """Those of the bill of a package, and where the libraries come from."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "bill.json"
        # The script validates what it writes.
        subprocess.run([sys.executable, "-B", root / "packaging/sbom.py", package, path], check=True)
        components = json.loads(path.read_text())["components"]
    assert all(component["licenses"] and component["copyright"] for component in components)
    return {unquote(re.search(r"/([^/@]+)@", component["purl"])[1]) for component in components}


setup = (root / "tools/setup").read_text()
built_with = set(re.findall(r"^  (libcli11-dev .*)$", setup, re.MULTILINE)[0].split())
page = set(json.loads((root / "viewer/package.json").read_text())["dependencies"])
bills = {package: names(package) for package in ("wheel", "deb", "npm")}
for package in ("wheel", "deb"):
    missing = (built_with | page) - bills[package]
    assert not missing, f"the bill of {package} lacks {missing}: add them to NOTICE"
module = {"libfast-float-dev", "libfmt-dev", "libhwy-dev", "libxxhash-dev", "libc++-22-dev-wasm32", "wasi-libc"}
assert bills["npm"] == module, bills["npm"]
assert {"nanobind", "ziglang"} <= bills["wheel"] and "ziglang" not in bills["deb"]
assert "nanobind" in bills["wheel"] and "nanobind" not in bills["deb"]
print({package: len(bill) for package, bill in bills.items()})
