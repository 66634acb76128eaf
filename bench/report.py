# SPDX-License-Identifier: MIT
"""Writes the tables of README.md and docs/benchmarks/*.md from the results. A page is written by hand but for

    <!-- from the benchmarks: NAME.TABLE -->
    <!-- to here -->

between which the function TABLE of bench/sections/NAME.py gives the table, and the results NAME.json their machine. A
table without results stays as it is.
"""
import re

from . import machine, places, results
from .sections import SECTIONS

PLACE = re.compile(r"(?P<begin><!-- from the benchmarks: (?P<source>\w+)\.(?P<table>\w+) -->\n)(?P<text>.*?)(?P<end><!-- to here -->)",
                   re.DOTALL)


def write():
    from . import plots  # needs matplotlib, which the text does not

    print(f"drew {len(plots.draw_all())} plots in {places.RESULTS}")
    for path in documents():
        path.write_text(filled(path.read_text(encoding="utf-8")), encoding="utf-8")


def documents():
    return [places.README, *sorted(places.PAGES.glob("*.md"))]


def filled(text):
    """The text with the tables of the results that there are."""
    return PLACE.sub(lambda place: place["begin"] + block(place) + place["end"], text)


def block(place):
    data = results.load(place["source"])
    if data is None:
        return place["text"]
    table = getattr(SECTIONS[place["source"]], place["table"])(data)
    return f"\n{table}\n*Measured on {machine.caption(data['machine'])}*\n\n"
