# SPDX-License-Identifier: MIT
"""The picture of `make demo`: the whole ball is in it, with a legend that has the numbers of `meshhood compare`, in the
colors of the page.

    render_test.py MESHHOOD
"""

import json
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
MESHHOOD = sys.argv.pop()
sys.path.insert(0, str(ROOT / "tools"))

import render_ply  # noqa: E402
from PIL import Image  # noqa: E402

VERTEX, RADIUS = "6039", "16"


def near(a, b):
    """The colors of the picture are darker in the shade."""
    brightness = max(a) / max(b)
    return 0.55 < brightness < 1.05 and all(abs(x - brightness * y) < 12 for x, y in zip(a, b))


class Picture(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.mesh, cls.colored, cls.drawn = (Path(cls.folder.name) / name for name in ("m.ply", "c.ply", "p.png"))
        subprocess.run([MESHHOOD, "generate", "scroll", "--vertices", "20000", "-o", cls.mesh], check=True, capture_output=True)
        told = subprocess.run([MESHHOOD, "compare", cls.mesh, "-v", VERTEX, "-r", RADIUS, "--json", "-o", cls.colored],
                              check=True, capture_output=True, text=True)
        cls.counts = {row["method"]: row["count"] for row in json.loads(told.stdout)["methods"]}
        subprocess.run([sys.executable, "-B", ROOT / "tools/render_ply.py", cls.colored, cls.drawn, "--pixels", "240",
                        "--legend", "--towards=0.3,0.55,1", "--up=0,1,0", "--cut", "0,0,1"], check=True)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_the_legend_has_the_numbers_of_compare(self):
        mesh = render_ply.Mesh(self.colored)
        counts = [count for _, _, count in render_ply.legend_rows(mesh)]
        exact, paper, ball = (self.counts[method] for method in ("exact", "paper", "ball"))
        self.assertGreater(paper, exact)
        self.assertGreater(ball, paper)
        self.assertEqual(counts, [exact, ball - exact, paper - exact, None])

    def test_all_colors_are_seen_and_the_whole_ball(self):
        picture = Image.open(self.drawn).convert("RGB")
        top = picture.height - picture.width
        self.assertGreater(top, 40)
        pixels = {(x, y): picture.getpixel((x, y)) for x in range(240) for y in range(picture.height)}
        ink = sum(color == render_ply.INK for (_, y), color in pixels.items() if y < top)
        self.assertGreater(ink, 100, "the words of the legend")
        for color in (render_ply.EXACT_COLOR, render_ply.PAPER_COLOR, render_ply.BALL_COLOR):
            swatch = [place for place, found in pixels.items() if place[1] < top and found == color]
            seen = [place for place, found in pixels.items() if place[1] >= top and near(found, color)]
            print(f"{len(seen)} pixels of {color}, {len(swatch)} in the legend")
            self.assertGreater(len(swatch), 20)
            self.assertGreater(len(seen), 100)
            for x, y in seen:
                self.assertLess(((x - 120) ** 2 + (y - top - 120) ** 2) ** 0.5, 102, "within the ball")

    def test_the_colors_are_those_of_the_page(self):
        page = (ROOT / "viewer/src/colors.ts").read_text()
        for name, color in (("exact", render_ply.EXACT_COLOR), ("paper", render_ply.PAPER_COLOR),
                            ("ball", render_ply.BALL_COLOR), ("VERTEX_COLOR", render_ply.QUERY_COLOR),
                            ("SURFACE_COLOR", render_ply.REST_COLOR)):
            found = re.search(rf"{name}(?::| =) '#(\w{{6}})'", page)[1]
            self.assertEqual(tuple(bytes.fromhex(found)), color, name)


unittest.main()
