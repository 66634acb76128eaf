#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The built site: no dead link within it, nothing loaded from elsewhere, and an entry of the reference for everything
that the packages offer. The lists of names come from the packages, not from what made the pages.

    built_test.py SITE ROOT
"""

import inspect
import re
import sys
import unittest
import zlib
from collections import Counter
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

import meshhood
import meshhood.distributed

ROOT = Path(sys.argv.pop())
SITE = Path(sys.argv.pop()).resolve()
DESCRIPTORS = (property, classmethod, staticmethod)
LOADED = {"script": "src", "img": "src", "iframe": "src", "source": "src"}


class Page(HTMLParser):
    """The ids of a page, its links, and what it loads."""

    def __init__(self, file):
        super().__init__()
        self.ids, self.links, self.loaded = [], [], []
        self.feed(file.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        known = dict(attributes)
        if "id" in known:
            self.ids.append(known["id"])
        if tag == "a" and known.get("href"):
            self.links.append(known["href"])
        if tag in LOADED and known.get(LOADED[tag]):
            self.loaded.append(known[LOADED[tag]])
        if tag == "link" and known.get("rel") in ("stylesheet", "preload", "icon"):
            self.loaded.append(known["href"])


def pages():
    files = [file for file in SITE.rglob("*.html") if "_static" not in file.relative_to(SITE).parts]
    return {file: Page(file) for file in files}


def entries():
    """The entries of the reference: domain:kind and name."""
    data = (SITE / "objects.inv").read_bytes().split(b"\n", 4)[4]
    lines = zlib.decompress(data).decode().splitlines()
    return {tuple(line.split()[1::-1]) for line in lines}


def python_names():
    for module in (meshhood, meshhood.distributed):
        for name in module.__all__:
            thing = getattr(module, name)
            home = "meshhood" if name in meshhood.__all__ else module.__name__
            yield f"{home}.{name}"
            if inspect.isclass(thing):
                yield from (f"{home}.{name}.{part}" for part in public_parts(thing))


def public_parts(cls):
    """The methods and properties that the package itself defines."""
    for base in cls.__mro__:
        if base.__module__.startswith("meshhood"):
            for name, part in vars(base).items():
                if not name.startswith("_") and (inspect.isfunction(part) or isinstance(part, DESCRIPTORS)):
                    yield name


CPP_TYPE = re.compile(r"^(?:class|struct|enum class|concept) (\w+)\b(?! *;)", re.M)
CPP_ALIAS = re.compile(r"^using (\w+) =", re.M)
CPP_FUNCTION = re.compile(r"^(?! )(?:\[\[nodiscard\]\] )?(?:inline |constexpr )*[\w:<>,&* ]+? \*?&?(\w+)\(", re.M)
CPP_METHOD = re.compile(r"^  \[\[nodiscard\]\] (?:static |inline |constexpr )*[\w:<>,&* ]+? \*?&?(\w+)\(", re.M)
CPP_WORDS = {"decltype", "operator", "requires", "static_assert"}
CPP_HIDDEN = re.compile(
    r"^namespace detail \{.*?^\}  // namespace detail$|^ private:.*?^\};$|^#.*?$|//[^\n]*", re.M | re.S
)


def cpp_names():
    """The last parts of the names that the headers declare, read line by line: our headers are formatted."""
    of_io = (ROOT / f"io/{name}.h" for name in ("index_io", "mesh_io", "weld"))
    for header in [*(ROOT / "include/meshhood").glob("*.h"), *of_io]:
        text = CPP_HIDDEN.sub("", header.read_text(encoding="utf-8"))
        for pattern in (CPP_TYPE, CPP_ALIAS, CPP_FUNCTION, CPP_METHOD):
            yield from (name for name in pattern.findall(text) if name not in CPP_WORDS and not name.endswith("_"))


def javascript_names():
    source = (ROOT / "bindings/wasm/meshhood.d.ts").read_text(encoding="utf-8")
    source = re.sub(r"/\*.*?\*/", "", source, flags=re.S)
    for name, body in re.findall(r"^export (?:class|interface) (\w+)[^{]*\{\n(.*?)^\}", source, re.M | re.S):
        yield name
        for part in re.findall(r"^  (?:static |readonly )*(\w+)\??[:(<]", body, re.M):
            yield f"{name}.{part}"
    yield from re.findall(r"^export (?:function|type) (\w+)", source, re.M)


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.pages, cls.entries = pages(), entries()

    def test_no_link_is_dead(self):
        ids, dead, checked = {file: set(page.ids) for file, page in self.pages.items()}, [], 0
        for file, page in self.pages.items():
            for link in page.links + page.loaded:
                parts = urlsplit(link)
                if parts.scheme or parts.netloc:
                    continue
                checked += 1
                target = (file.parent / unquote(parts.path)).resolve() if parts.path else file
                if not target.exists() or target.is_dir():
                    dead.append(f"{file.relative_to(SITE)}: {link}")
                elif parts.fragment and target in ids and unquote(parts.fragment) not in ids[target]:
                    dead.append(f"{file.relative_to(SITE)}: {link}, which has no such place")
        print(f"{len(self.pages)} pages, {checked} links within the site")
        self.assertEqual(sorted(set(dead)), [])
        self.assertGreater(checked, 1000)

    def test_nothing_is_loaded_from_elsewhere(self):
        for file, page in self.pages.items():
            self.assertEqual([link for link in page.loaded if "//" in link], [], file)

    def test_no_id_is_repeated_on_a_page(self):
        for file, page in self.pages.items():
            self.assertEqual([name for name, count in Counter(page.ids).items() if count > 1], [], file)

    def test_everything_of_python_has_an_entry(self):
        found = {name for kind, name in self.entries if kind.startswith("py:")}
        names = set(python_names())
        print(f"Python: {len(names)} names")
        self.assertEqual(names - found, set())

    def test_everything_of_cpp_has_an_entry(self):
        found = {name.rpartition("::")[2] for kind, name in self.entries if kind.startswith("cpp:")}
        names = set(cpp_names())
        print(f"C++: {len(names)} names")
        self.assertEqual(names - found, set())
        self.assertGreater(len(names), 150)

    def test_everything_of_javascript_has_an_entry(self):
        found = {name for kind, name in self.entries if kind.startswith("js:")}
        names = set(javascript_names())
        print(f"JavaScript: {len(names)} names")
        self.assertEqual(names - found, set())
        self.assertGreater(len(names), 100)

    def test_every_entry_is_on_one_page(self):
        where = Counter(name for page in self.pages.values() for name in set(page.ids))
        names = set(python_names()) | set(javascript_names())
        self.assertEqual([name for name in names if where[name] > 1], [])

    def test_gallery_has_pictures(self):
        examples = [file for file in (SITE / "gallery").glob("*.html") if file.stem != "index"]
        for file in examples:
            pictures = [link for link in self.pages[file].loaded if "_images/sphx_glr_" in link]
            self.assertTrue(pictures, file.name)
        print(f"gallery: {len(examples)} examples with pictures")
        self.assertGreaterEqual(len(examples), 10)


if __name__ == "__main__":
    unittest.main(verbosity=1)
