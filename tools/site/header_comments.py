#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A filter of Doxygen: the conventions of the comments in the public headers, written as Doxygen reads them.

    header_comments.py HEADER

`name  text` in a comment describes a parameter, and becomes an item of a list. `#V` is a number, not a link. Adapters
to other libraries are documented whether or not these libraries are installed. The inline namespace of the version is
left out, as in programs.
"""

import re
import sys

PARAMETER = re.compile(r"^(\s*///) (\w+(?:, \w+)*) {2,}(\S.*)$")
TEXT = re.compile(r"^\s*/// \S")
CODE = re.compile(r"^\s*/// {5}")
NUMBER = re.compile(r"#(?=[A-Za-z])")
INLINE = re.compile(r"::inline v\d+_\d+")
GUARD = re.compile(r"^#if __has_include\(.*\)$")


def escaped(line):
    code, slashes, comment = line.partition("///")
    return code + slashes + NUMBER.sub(r"\#", comment) if slashes else line


def starts_file_comment(lines, i):
    """Whether a comment begins here that describes the header: a namespace follows it, or nothing."""
    if not lines[i].startswith("///") or (i > 0 and lines[i - 1].startswith("///")):
        return False
    following = next((line for line in lines[i:] if not line.startswith("///")), "")
    return not following or following.startswith("namespace")


def filtered(lines):
    in_item = False
    for i, line in enumerate(lines):
        found = PARAMETER.match(line)
        if starts_file_comment(lines, i):
            yield "/// @file"
        if line.startswith("namespace"):
            line = INLINE.sub("", line)
        if GUARD.match(line):
            yield "#if 1"
        elif found:
            begin, names, text = found.groups()
            yield escaped(f"{begin} - `{names}`: {text}")
        else:
            if in_item and TEXT.match(line):  # ends the list
                yield line[: line.index("///")] + "///"
            yield line if CODE.match(line) and not in_item else escaped(line)
        in_item = bool(found) or (in_item and line.strip().startswith("///    "))


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        print("\n".join(filtered(file.read().splitlines())))


if __name__ == "__main__":
    main()
