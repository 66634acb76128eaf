#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The built site: no dead link within it, nothing loaded from elsewhere, a picture of each example.

    built_test.py SITE
"""

import sys
import unittest
from collections import Counter
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

SITE = Path(sys.argv.pop()).resolve()
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


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.pages = pages()

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

    def test_gallery_has_pictures(self):
        examples = [file for file in (SITE / "gallery").glob("*.html") if file.stem != "index"]
        for file in examples:
            pictures = [link for link in self.pages[file].loaded if "_images/sphx_glr_" in link]
            self.assertTrue(pictures, file.name)
        print(f"gallery: {len(examples)} examples with pictures")
        self.assertGreaterEqual(len(examples), 10)


if __name__ == "__main__":
    unittest.main(verbosity=1)
