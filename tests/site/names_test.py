#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The pages of the reference name everything public once, and the gallery keeps its rules. Reads sources alone, so that
it runs anywhere in no time; reference_test.py checks the pages themselves.

    names_test.py ROOT
"""

import ast
import re
import sys
import unittest
from collections import Counter
from pathlib import Path

ROOT = Path(sys.argv.pop() if len(sys.argv) > 1 else Path(__file__).resolve().parents[2])
PACKAGE = ROOT / "bindings/python/meshhood"
REFERENCE = ROOT / "docs/reference"
DIRECTIVE = re.compile(
    r"^\.\. (?:auto(?:class|function)|py:data):: (?:meshhood\.)?(\w+)$(.*?)(?=^\.\.|^```)", re.M | re.S
)
INSTALLED = re.compile(r"install\(FILES ((?:io/\w+\.h ?)+)")
MODULE_EXPORTS = re.compile(r"^export \{ ([\w, ]+) \}", re.M)
DECLARED = re.compile(r"^export (?:class|function|const) (\w+)", re.M)


def tree(file):
    return ast.parse(file.read_text(encoding="utf-8"))


def exports(file):
    for node in tree(file).body:
        if isinstance(node, ast.Assign) and [getattr(target, "id", "") for target in node.targets] == ["__all__"]:
            return ast.literal_eval(node.value)
    raise AssertionError(f"{file}: has no __all__")


def classes():
    """The classes of the Python package by name."""
    nodes = (node for file in PACKAGE.glob("*.py") for node in tree(file).body)
    return {node.name: node for node in nodes if isinstance(node, ast.ClassDef)}


def has_methods(node):
    return any(isinstance(part, ast.FunctionDef) and not part.name.startswith("_") for part in node.body)


class Reference(unittest.TestCase):
    def test_python_names_are_listed_once(self):
        public = {*exports(PACKAGE / "__init__.py"), *exports(PACKAGE / "distributed.py")}
        listed = Counter(name for name, _ in DIRECTIVE.findall((REFERENCE / "python.md").read_text(encoding="utf-8")))
        print(f"Python: {len(public)} names")
        self.assertEqual(set(listed), public)
        self.assertEqual([name for name, count in listed.items() if count > 1], [])

    def test_methods_are_shown(self):
        known, checked = classes(), 0
        for name, options in DIRECTIVE.findall((REFERENCE / "python.md").read_text(encoding="utf-8")):
            if name in known and has_methods(known[name]):
                checked += 1
                self.assertIn(":members:", options, name)
            if name in known and any(getattr(base, "id", "") in known for base in known[name].bases):
                self.assertIn(":inherited-members:", options, name)
        print(f"Python: {checked} classes with methods")
        self.assertGreater(checked, 5)

    def test_cpp_headers_are_listed_once(self):
        installed = INSTALLED.search((ROOT / "cmake/MeshhoodInstall.cmake").read_text(encoding="utf-8"))[1].split()
        public = {file.name for file in (ROOT / "include/meshhood").glob("*.h")} - {"meshhood.h", "export.h"}
        public |= {Path(file).name for file in installed}
        text = "".join(page.read_text(encoding="utf-8") for page in REFERENCE.glob("cpp_*.md"))
        included = Counter(f"{stem}.h" for stem in re.findall(r"^```\{include\} headers/(\w+)\.inc$", text, re.M))
        print(f"C++: {len(public)} headers")
        self.assertEqual(set(included), public)
        self.assertEqual(set(included.values()), {1})

    def test_javascript_exports_are_declared(self):
        source = (ROOT / "bindings/wasm/meshhood.js").read_text(encoding="utf-8")
        exported = sorted(name for names in MODULE_EXPORTS.findall(source) for name in names.split(", "))
        declarations = (ROOT / "bindings/wasm/meshhood.d.ts").read_text(encoding="utf-8")
        print(f"JavaScript: {len(exported)} exports")
        self.assertEqual(sorted(set(DECLARED.findall(declarations))), exported)


class Gallery(unittest.TestCase):
    def test_examples_are_short(self):
        examples = sorted((ROOT / "examples/gallery").glob("*.py"))
        order = tree(ROOT / "tools/site/gallery_order.py").body
        listed = next(ast.literal_eval(node.value) for node in order if isinstance(node, ast.Assign))
        self.assertEqual({*listed, "made_meshes"}, {file.stem for file in examples})
        for file in examples:
            lines = file.read_text(encoding="utf-8").splitlines()
            self.assertLessEqual(max(map(len, lines)), 120, file.name)
            if file.stem != "made_meshes":
                self.assertLessEqual(len(lines), 30, file.name)
                self.assertRegex(ast.get_docstring(tree(file)), r"^.+\n=+\n\n", file.name)
        print(f"gallery: {len(listed)} examples")


if __name__ == "__main__":
    unittest.main(verbosity=1)
