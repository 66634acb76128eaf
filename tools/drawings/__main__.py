"""Draws the pictures of docs/design.md again. Usage: python3 tools/drawings"""

from pathlib import Path

import column
import foreign
import leaves
import tree

IMAGES = Path(__file__).resolve().parents[2] / "docs" / "images"

for name, drawing in ("leaves", leaves), ("tree", tree), ("column", column), ("foreign", foreign):
    text = drawing.draw().finish()
    (IMAGES / f"{name}.svg").write_text(text, encoding="utf-8")
    print(f"docs/images/{name}.svg: {len(text)} bytes")
