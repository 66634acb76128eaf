# SPDX-License-Identifier: MIT
"""The docstrings of the Python package as reStructuredText.

They are written for `help()`: `name : text` describes an argument, more indented lines belong to it, and an indented
block is code.
"""

import re

ARGUMENT = re.compile(r"^(\w+(?:, \w+)*) : (.*)$")
INDENT = "   "
SPECIAL = re.compile(r"([*|])")


def escaped(line):
    """Without the meaning that stars and bars have in reStructuredText, except within backquotes."""
    parts = line.split("`")
    parts[::2] = [SPECIAL.sub(r"\\\1", part) for part in parts[::2]]
    return "`".join(parts)


def paragraphs(lines):
    """The lines between empty lines."""
    block = []
    for line in [*lines, ""]:
        if line.strip():
            block.append(line)
        elif block:
            yield block
            block = []


def arguments(block):
    """A block of text in which some lines describe arguments, which become a list of definitions."""
    in_list = False
    for line in block:
        found = ARGUMENT.match(line)
        if found:
            names, text = found.groups()
            terms = ", ".join(f"``{name}``" for name in names.split(", "))
            yield from ([] if in_list else [""]) + [terms, INDENT + escaped(text)]
            in_list = True
        elif in_list and line.startswith(" "):
            yield INDENT + escaped(line.strip())
        else:
            yield from ([""] if in_list else []) + [escaped(line.strip())]
            in_list = False


def as_rest(lines):
    result = []
    for block in paragraphs(lines):
        if all(line.startswith("    ") for line in block):
            result += [".. code-block:: python", "", *block]
        else:
            result += arguments(block)
        result.append("")
    return result


def process_docstring(app, what, name, thing, options, lines):
    """For the event `autodoc-process-docstring`."""
    lines[:] = as_rest(lines)
