#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes the bill of materials of a package, CycloneDX 1.6 as JSON: what NOTICE lists, in the versions of this machine.

    sbom.py wheel|deb|npm FILE

The same sources and versions give the same bytes. Needs cyclonedx-python-lib, of tests/packages/requirements.txt.
"""

import json
import re
import subprocess
import sys
from importlib.metadata import version
from pathlib import Path
from uuid import UUID, uuid5

from cyclonedx.contrib.license.factories import LicenseFactory
from cyclonedx.model.bom import Bom
from cyclonedx.model.component import Component, ComponentType
from cyclonedx.output.json import JsonV1Dot6
from cyclonedx.schema import SchemaVersion
from cyclonedx.validation.json import JsonStrictValidator
from packageurl import PackageURL

ROOT = Path(__file__).parents[1]
# The package of Debian that a library of NOTICE comes from.
DEBIAN = {
    "CLI11": "libcli11-dev",
    "fast_float": "libfast-float-dev",
    "fmt": "libfmt-dev",
    "Highway": "libhwy-dev",
    "libc++": "libc++-22-dev-wasm32",
    "nlohmann-json": "nlohmann-json3-dev",
    "wasi-libc": "wasi-libc",
    "xxHash": "libxxhash-dev",
}


def url(name):
    """Where this machine has the library from, with its version."""
    if name in DEBIAN:
        query = ["dpkg-query", "--show", "--showformat=${Version}", DEBIAN[name]]
        installed = subprocess.run(query, check=True, capture_output=True, text=True).stdout
        return PackageURL("deb", "debian", DEBIAN[name], installed)
    if name == "libc++ of zig":
        return PackageURL("pypi", None, "ziglang", version("ziglang"))
    if name in ("nanobind", "robin-map"):  # nanobind contains robin-map
        return PackageURL("pypi", None, "nanobind", version("nanobind"))
    lock = json.loads((ROOT / "viewer/package-lock.json").read_text())
    return PackageURL("npm", None, name, lock["packages"][f"node_modules/{name}"]["version"])


def library(row):
    name, _, license_, copyright_ = row
    source = url(name)
    return Component(
        type=ComponentType.LIBRARY,
        name=name,
        version=source.version,
        purl=source,
        bom_ref=name,
        licenses=[LicenseFactory().make_from_string(license_)],
        copyright=f"Copyright (c) {copyright_}",
    )


def bill(package):
    table = re.search(r"^(?:-+  )+-+\n(.*?)\n\n", (ROOT / "NOTICE").read_text(), re.DOTALL | re.MULTILINE)
    rows = [re.split(r"\s{2,}", line) for line in table[1].splitlines()]
    header = (ROOT / "include/meshhood/version.h").read_text()
    number = ".".join(re.findall(r"#define MESHHOOD_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)", header))
    bom = Bom(components=[library(row) for row in rows if package in row[1].split()])
    bom.metadata.timestamp = None
    bom.metadata.component = Component(
        type=ComponentType.LIBRARY,
        name="meshhood",
        version=number,
        bom_ref="meshhood",
        licenses=[LicenseFactory().make_from_string("MIT")],
    )
    bom.register_dependency(bom.metadata.component, bom.components)
    contents = "\n".join(f"{c.purl}" for c in bom.components)
    bom.serial_number = uuid5(UUID(int=0), f"meshhood {number} {package}\n{contents}")
    return bom


def main():
    package, path = sys.argv[1:]
    if package not in ("wheel", "deb", "npm"):
        sys.exit(f"{package!r}, expected wheel, deb or npm")
    text = JsonV1Dot6(bill(package)).output_as_string(indent=2)
    mistake = JsonStrictValidator(SchemaVersion.V1_6).validate_str(text)
    if mistake is not None:
        sys.exit(f"not CycloneDX 1.6: {mistake}")
    Path(path).write_text(text + "\n")


if __name__ == "__main__":
    main()
