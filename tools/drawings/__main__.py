"""Writes the drawings of docs/design.md and docs/joint.md, or checks that they are up to date. Usage: python3 tools/drawings [--check]"""

import sys
from pathlib import Path

import leaves
import marks
import tree
import waves
import words

IMAGES = Path(__file__).resolve().parents[2] / "docs" / "images"
DRAWINGS = {
    "leaves": leaves,
    "waves": waves,
    "tree": tree,
    "marks": marks,
    "words": words,
}


def update(path, text):
    path.write_text(text, encoding="utf-8")
    print(f"{path.name}: {len(text)} bytes")


def is_current(path, text):
    same = path.exists() and path.read_text(encoding="utf-8") == text
    print(f"{path.name}: {'up to date' if same else 'out of date, run python3 tools/drawings'}")
    return same


def main(arguments):
    if arguments not in ([], ["--check"]):
        return f"tools/drawings: expected nothing or --check, not {' '.join(arguments)}"
    pictures = [(IMAGES / f"{name}.svg", drawing.draw().finish()) for name, drawing in DRAWINGS.items()]
    if arguments:
        return 0 if all([is_current(path, text) for path, text in pictures]) else 1
    for path, text in pictures:
        update(path, text)
    return 0


sys.exit(main(sys.argv[1:]))
