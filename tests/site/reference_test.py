#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Every public name has one entry in the reference of the built site: a C++ name one for each of its overloads. The lists
of names come from the compiler, the Python package and the declarations for TypeScript, not from what made the pages.

    reference_test.py SITE ROOT CLANG INCLUDES

INCLUDES   the folders of headers, separated by colons
"""

import inspect
import re
import sys
import unittest
from collections import Counter
from html.parser import HTMLParser
from pathlib import Path

import meshhood
import meshhood.distributed
from declared_cpp import declared_names

DESCRIPTORS = (property, classmethod, staticmethod)
PART = re.compile(r"(\d+)")
OPERATORS = {"ix": "operator[]", "cl": "operator()", "eq": "operator==", "ne": "operator!=", "lt": "operator<",
             "cvd": "operator double", "cv8VertexId": "operator unsigned int"}


class Entries(HTMLParser):
    """The ids of the entries of a page, by language."""

    def __init__(self, file):
        super().__init__()
        self.ids = {"cpp": [], "py": [], "js": []}
        self.feed(file.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        known = dict(attributes)
        words = (known.get("class") or "").split()
        if tag == "dt" and "sig-object" in words:
            self.ids[next(word for word in words if word in self.ids)].append(known.get("id", "an entry without an id"))


def entries(site, language):
    """The ids of all entries of the site, each as often as it stands there."""
    files = (file for file in site.rglob("*.html") if "_static" not in file.relative_to(site).parts)
    return Counter(name for file in files for name in Entries(file).ids[language])


def cpp_name(identifier):
    """The qualified name in the id of an entry: the parts of _CPPv4N8meshhood8Searcher5countE8VertexIdd are
    meshhood, Searcher and count. Before each stands its length, as in the symbols of compilers.
    """
    if "8meshhood" not in identifier:
        return identifier
    rest, parts = identifier[identifier.index("8meshhood") :], []
    while found := PART.match(rest):
        end = found.end() + int(found[1])
        parts.append(rest[found.end() : end])
        rest = rest[end:]
    if rest[:2] == "C4":  # a constructor
        parts.append(parts[-1])
    parts += [name for operator, name in OPERATORS.items() if rest.startswith(operator)]
    return "::".join(parts)


def python_names():
    for module in (meshhood, meshhood.distributed):
        for name in module.__all__:
            if module is not meshhood and name in meshhood.__all__:
                continue
            thing = getattr(module, name)
            yield f"{module.__name__}.{name}"
            if inspect.isclass(thing):
                yield from (f"{module.__name__}.{name}.{part}" for part in public_parts(thing))


def public_parts(cls):
    """The methods and properties that the package itself defines."""
    return {
        name
        for base in cls.__mro__
        if base.__module__.startswith("meshhood")
        for name, part in vars(base).items()
        if not name.startswith("_") and (inspect.isfunction(part) or isinstance(part, DESCRIPTORS))
    }


def javascript_names(source):
    source = re.sub(r"/\*.*?\*/", "", source, flags=re.S)
    for name, body in re.findall(r"^export (?:class|interface) (\w+)[^{]*\{\n(.*?)^\}", source, re.M | re.S):
        yield name
        yield from {f"{name}.{part}" for part in re.findall(r"^  (?:static |readonly )*(\[?[\w.]+\]?)\??[:(<]", body, re.M)}
    yield from set(re.findall(r"^export (?:function|type|const) (\w+)", source, re.M))


def faults(declared, found):
    """How the entries differ from what is declared; `declared` and `found` count each name."""
    missing = [f"{name}: {count} entries missing" for name, count in (declared - found).items()]
    repeated = [f"{name}: {count} entries too many" for name, count in (found - declared).items()]
    return sorted(missing + repeated)


class Reference(unittest.TestCase):
    def check(self, language, declared, found):
        print(f"{language}: {len(declared)} names, {sum(declared.values())} entries")
        self.assertEqual(faults(declared, found), [])
        self.assertGreater(len(declared), 100)
        # The comparison itself finds a name that is missing, and one that is there twice.
        for name in (min(declared), max(declared)):
            self.assertEqual(faults(declared, found - Counter([name])), [f"{name}: 1 entries missing"])
            self.assertEqual(faults(declared, found + Counter([name])), [f"{name}: 1 entries too many"])

    def test_cpp(self):
        found = entries(SITE, "cpp")
        self.check("C++", declared_names(CLANG, ROOT, INCLUDES), Counter(cpp_name(name) for name in found.elements()))

    def test_python(self):
        """Fields of results and special methods may have entries, too; what has one, has one."""
        found, declared = entries(SITE, "py"), Counter(python_names())
        others = {name for name in found if name not in declared}
        self.check("Python", declared + Counter(others), found)

    def test_javascript(self):
        source = (ROOT / "bindings/wasm/meshhood.d.ts").read_text(encoding="utf-8")
        found = entries(SITE, "js")
        named = Counter(re.sub(r"\.-(Symbol\.\w+)$", r".[\1]", name) for name in found.elements())
        self.check("JavaScript", Counter(javascript_names(source)), named)


if __name__ == "__main__":
    SITE, ROOT, CLANG, INCLUDES = Path(sys.argv[1]), Path(sys.argv[2]), sys.argv[3], sys.argv[4].split(":")
    unittest.main(argv=sys.argv[:1], verbosity=1)
