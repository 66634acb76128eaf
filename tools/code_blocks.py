#!/usr/bin/env python3
"""The code blocks of the documents. The language of a block says which test runs it, on all pages.

    tools/code_blocks.py LANGUAGE [MARK]     # prints these blocks in JSON, for tests in other languages

    python     python.documents, in the order of the page
    sh         python.documents, likewise; `sh installed` runs against an installed library, in install.pkg_config
    cpp        site.code compiles it
    cmake      install.find_package configures it, as a project or as part of one
    js         wasm.documents; `js esbuild`, `js vite` and `js webpack` run in wasm.bundlers, with that bundler
    html       wasm.bundlers opens it in Chromium
    text       is no program: the output of one, a formula, a list of folders

`sh setup` is code that changes the machine or builds the checkout: only its syntax, and what it names, are checked.
A block below the line <!-- from FILE --> is a quotation of a file that runs; check_docs.py compares them.
"""

import json
import re
import sys
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
MARKS = {
    "python": {""},
    "sh": {"", "installed", "setup"},
    "cpp": {""},
    "cmake": {""},
    "js": {"", "esbuild", "vite", "webpack"},
    "html": {""},
    "text": {""},
}
FENCE = re.compile(r"^(?P<indent> *)(?P<fence>`{3,}|~{3,}|:{3,})(?P<info>.*)\n(?P<code>(?:.*\n)*?)(?P=indent)(?P=fence) *$", re.M)
QUOTED = re.compile(r"<!-- from (\S+) -->\n\Z")
# A line that is indented as code is, after an empty one. Text of a list is indented by less.
INDENTED = re.compile(r"(?<=\n\n) {4,}\S.*")


@dataclass(frozen=True)
class Block:
    language: str  # "" if the page names none; that of a directive of Sphinx begins with a brace
    mark: str
    code: str
    quoted: str  # the file that it quotes, or ""


def files(*patterns):
    """The names of the files of the checkout that match. Does not call git, which may not trust the owner."""
    names = sorted(path.relative_to(ROOT) for pattern in patterns for path in ROOT.rglob(pattern))
    return [str(name) for name in names if name.parts[0] != "build" and "node_modules" not in name.parts]


def documents():
    return files("*.md")


def blocks(text):
    for found in FENCE.finditer(text):
        if found["fence"][0] == ":":
            yield from blocks(found["code"])
            continue
        language, _, mark = found["info"].strip().partition(" ")
        code = re.sub(rf"^{found['indent']}", "", found["code"], flags=re.M)
        quoted = QUOTED.search(text[: found.start()])
        yield Block(language, mark.strip(), code, quoted[1] if quoted else "")


def blocks_to_run(name, *languages, mark=""):
    """The blocks of a page in these languages and with this mark, except quotations."""
    text = (ROOT / name).read_text(encoding="utf-8")
    return [block for block in blocks(text) if block.language in languages and block.mark == mark and not block.quoted]


def faults(name, text):
    """The blocks of a page that no test runs."""
    for block in blocks(text):
        first, _, _ = block.code.partition("\n")
        if block.language.startswith("{"):
            continue
        if not block.language:
            yield f"{name}: the block '{first}' has no language; text is output, a formula, a list"
        elif block.mark not in MARKS.get(block.language, ()):
            info = f"{block.language} {block.mark}".strip()
            yield f"{name}: no test runs the block '{first}' of {info}; tools/code_blocks.py has the languages"
    for line in INDENTED.findall(FENCE.sub("", text)):
        yield f"{name}: the block '{line.strip()}' is indented; a fence says its language"


def main(language, mark=""):
    found = ((name, block) for name in documents() for block in blocks_to_run(name, language, mark=mark))
    print(json.dumps([{"page": name, "code": block.code} for name, block in found]))


if __name__ == "__main__":
    main(*sys.argv[1:])
