# SPDX-License-Identifier: MIT
"""docs/benchmarks.md and the head table of the README, made from the results. Nothing there is written by hand."""
import re

from . import machine, places, results
from .sections import SECTIONS

HEAD = """# Benchmarks

Written by `python3 -m bench report` from `docs/benchmarks/*.json`. Not edited by hand. `make reproduce` measures the
paper's tables, pictures, accuracy and growth again, `make peers` the other products; either ends by writing this page.

How it is measured: all methods of a table take the same queries in turn, block by block, in one run; a time is the
median over the blocks, in parentheses the quartiles where there is room. Never the best of several. *Cold* is a query
far from the one before, *warm* one beside it. Radii in average edges of the mesh. Extra and missing are vertices a
query, against breadth-first search, which is exact. Where another is faster, the table says so.
"""

MARKERS = re.compile(r"(<!-- from the benchmarks -->\n).*?(<!-- to here -->)", re.DOTALL)


def write():
    from . import plots  # matplotlib, which the text does without

    drawn = plots.draw_all()
    places.DOCUMENT.write_text(document(), encoding="utf-8")
    print(f"wrote docs/benchmarks.md and {len(drawn)} plots")
    tables = results.load("paper_tables")
    if tables is not None:
        places.README.write_text(readme(tables), encoding="utf-8")


def document():
    """docs/benchmarks.md, as the results want it."""
    parts = [HEAD]
    for source, section in SECTIONS.items():
        data = results.load(source)
        if data is not None:
            parts.append(f"{section.text(data)}\n*Measured on {machine.caption(data['machine'])}*\n")
    return "\n".join(parts)


def readme(tables):
    """README.md with its table as the results want it."""
    text = places.README.read_text(encoding="utf-8")
    if not MARKERS.search(text):
        raise SystemExit("bench: README.md has lost the marks between which its table stands")
    table = SECTIONS["paper_tables"].head_table(tables)
    return MARKERS.sub(lambda found: f"{found[1]}{table}{found[2]}", text)
