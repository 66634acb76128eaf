# SPDX-License-Identifier: MIT
"""Tables as Markdown."""


def table(header, rows):
    lines = [header, ["---"] + ["---:"] * (len(header) - 1), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines) + "\n"


def number(value):
    """Three significant digits, with a thousands separator."""
    if value == 0 or abs(value) >= 1000:
        return f"{value:,.0f}"
    digits = f"{value:.3g}"
    return f"{value:.3f}" if "e" in digits else digits


def megabytes(count):
    """Of 2^20 bytes, as in the paper."""
    return f"{count / 2**20:.3f}"
