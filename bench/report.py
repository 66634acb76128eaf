# SPDX-License-Identifier: MIT
"""Writes docs/benchmarks.md, docs/benchmarks/*.md and the table of the README, all from the results."""
import re

from . import machine, places, results
from .sections import SECTIONS
from .sections.markdown import image

HEAD = """# Benchmarks

Written by `python3 -m bench report` from `docs/benchmarks/*.json`; do not edit. `make reproduce` measures the paper's
tables, Figure 4, accuracy and growth again, `make peers` the other libraries. Both end by writing these pages.

How we measure: all methods of a table answer the same queries in alternating blocks of one run. A time is the median over
the blocks, with the quartiles in parentheses; never the best of several. *Cold*: each query is far from the one before.
*Warm*: it is next to it. Radii are in mean edge lengths of the mesh. *Extra* and *missing* count vertices compared with
breadth-first search, which is exact. Each table names its machine and date; later changes of the library are not in it.

"""

PLOTS = (("table2", "Above: time of a query over the radius, by method. Below: vertices found"),
         ("accuracy", "Extra vertices of the paper's answer and of the ball, over the radius"),
         ("query_over_size", "Time of a query over the size of the mesh"))

PAGE_HEAD = "# {title}\n\nPart of the [benchmarks](../benchmarks.md), where the terms are explained. Generated; do not edit.\n\n"

IN_README = ("batch", "arrays", "exact_index")
MARKERS = re.compile(r"(<!-- from the benchmarks -->\n).*?(<!-- to here -->)", re.DOTALL)


def write():
    from . import plots  # needs matplotlib, which the text does not

    drawn = plots.draw_all()
    texts = documents()
    for path, text in texts.items():
        path.write_text(text, encoding="utf-8")
    print(f"wrote {len(texts)} pages and {len(drawn)} plots")
    places.README.write_text(readme(), encoding="utf-8")


def documents():
    """Every page by its path."""
    measured = {source: data for source in SECTIONS if (data := results.load(source)) is not None}
    texts = {places.RESULTS / f"{source}.md": page(source, data) for source, data in measured.items()}
    return {places.DOCUMENT: overview(measured), **texts}


def page(source, data):
    section = SECTIONS[source]
    return f"{PAGE_HEAD.format(title=section.TITLE)}{section.text(data)}{measured_on(data)}"


def overview(measured):
    """The main page: plots, the main tables, and links to the others."""
    parts = [HEAD]
    parts += [image(name, text, folder="benchmarks/") + "\n" for name, text in PLOTS]
    more = []
    for source, data in measured.items():
        section = SECTIONS[source]
        if hasattr(section, "summary"):
            parts.append(f"## {section.TITLE}\n\n{section.summary(data)}{measured_on(data)}\n")
        else:
            more.append(f"- [{section.TITLE}](benchmarks/{source}.md)\n")
    return "".join([*parts, "## More\n\n", *more])


def measured_on(data):
    return f"\n*Measured on {machine.caption(data['machine'])}*\n"


def readme():
    """README.md with its tables replaced by those of the results."""
    text = places.README.read_text(encoding="utf-8")
    if not MARKERS.search(text):
        raise SystemExit("bench: README.md lacks the two comments that enclose its table")
    tables = "".join(SECTIONS[source].head_table(data) for source in IN_README if (data := results.load(source)) is not None)
    return MARKERS.sub(lambda found: f"{found[1]}{tables}{found[2]}", text)
