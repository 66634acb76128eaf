#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Renders the recipe for conda on each platform, which gives both packages. They are not built: no channel of conda is
reached here.

    render_conda.py RECIPE VERSION
"""

import sys
from pathlib import Path

import rattler_build as rb

text = Path(sys.argv[1]).read_text()
for name, value in {"PROJECT_VERSION": sys.argv[2], "PROJECT_SOURCE_DIR": str(Path(__file__).parents[2])}.items():
    text = text.replace(f"@{name}@", value)
recipe = rb.Stage0Recipe.from_yaml(text)
variants = rb.VariantConfig({"python": ["3.12"], "c_stdlib": ["sysroot"], "c_stdlib_version": ["2.28"]})
for platform in ("linux-64", "linux-aarch64", "osx-arm64"):
    config = rb.RenderConfig(platform=rb.PlatformConfig(target_platform=platform))
    packages = [variant.recipe.package for variant in recipe.render(variants, config)]
    rendered = [(package.name, str(package.version)) for package in packages]
    print(platform, rendered)
    assert sorted(rendered) == [("libmeshhood", sys.argv[2]), ("meshhood", sys.argv[2])]
