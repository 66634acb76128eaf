# SPDX-License-Identifier: MIT
"""Tables and figures as Markdown."""


def table(header, rows):
    lines = [header, ["---"] + ["---:"] * (len(header) - 1), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines) + "\n"


def image(name, text, kind="svg", folder=""):
    """`folder` leads from the page to docs/benchmarks."""
    return f"![{text}]({folder}{name}.{kind})\n"


def number(value):
    """Three significant digits, with a thousands separator."""
    if value == 0 or abs(value) >= 1000:
        return f"{value:,.0f}"
    digits = f"{value:.3g}"
    return f"{value:.3f}" if "e" in digits else digits


def with_spread(median, quartiles):
    return f"{number(median)} ({number(quartiles[0])}-{number(quartiles[1])})"


def megabytes(count):
    """Of 2^20 bytes, as in the paper."""
    return f"{count / 2**20:.3f}"
