#!/usr/bin/env python3
"""Checks that everything the documents name exists: files, excerpts of code, presets and targets, MESHHOOD_ names,
identifiers of the code, and options of the command line; that a test runs each block of code; and that the version of
version.h is that of every package.
Usage: tools/check_docs.py [PROGRAM]

Without PROGRAM, or if it does not exist, the options of the command line are not checked, and a line says so.
"""
import functools
import json
import re
import subprocess
import sys
from pathlib import Path

import code_blocks

ROOT = Path(__file__).resolve().parent.parent
LINK = re.compile(r"\]\(([^)#\s]+)(?:#[^)]*)?\)|<img[^>]* src=\"([^\"]+)\"")
CODE = re.compile(r"```.*?```|`[^`\n]+`", re.DOTALL)
PATH = re.compile(r"(?<![\w./<-])(?:include|src|io|cli|shapes|tests|bench|examples|docs|cmake|tools|\.ci)/[\w./-]*\w")
EXCERPT = re.compile(r"<!-- from (\S+) -->\n```cpp\n(.*?)```", re.DOTALL)
PRESET = re.compile(r"--preset[ =]([\w-]+)")
TARGET = re.compile(r"(?<![\w-])make ([a-z][\w-]*)")
MACRO = re.compile(r"\bMESHHOOD_[A-Z_]*[A-Z]\b")
# `kConstant`, `snake_case`, `CamelCase`, or any name before `(` or beside `::`; a name of a single word may be prose.
IDENTIFIER = re.compile(r"(?<![\w./<-])(?:k[A-Z]\w+|[a-z]\w*_\w+|[A-Z]\w*[a-z]\w*[A-Z]\w*|\w+(?=\(|::)|(?<=::)\w+)(?![\w/-])")
ABOUT_OTHERS = "docs/coming_from/"  # these pages name what other libraries have; their code runs
INLINE = re.compile(r"(?<!`)`([^`\n]+)`(?!`)")
COMMAND = re.compile(r"(?<![\w:])(?<!from )meshhood ([a-z]+)\b([^\n`#]*)")
# What each package has where it states the version, or takes it from version.h.
VERSIONED = {
    "CITATION.cff": "\nversion: {}\n",
    "bindings/wasm/package.json.in": '"version": "@PROJECT_VERSION@"',
    "bindings/wasm/version.js.in": "version = '@PROJECT_VERSION@'",
    "packaging/conan/conanfile.py": 'load(self, REPOSITORY / "include/meshhood/version.h")',
    "packaging/conda/recipe.yaml.in": 'version: "@PROJECT_VERSION@"',
    "packaging/vcpkg/vcpkg.json.in": '"version": "@PROJECT_VERSION@"',
    "pyproject.toml": 'field = "version"\ninput = "include/meshhood/version.h"',
}
OPTION = re.compile(r"(?<!\S)\[?(--?[a-z][\w-]*)")


def texts(*patterns):
    """The files of the checkout that match, each with its text."""
    names = code_blocks.files(*patterns)
    return [(name, (ROOT / name).read_text(encoding="utf-8")) for name in names]


def code_in(text):
    """The code of a document; a command broken over lines by a backslash becomes one line."""
    return "\n".join(CODE.findall(text)).replace("\\\n", " ")


def missing_links(name, text):
    for target in filter(None, (a or b for a, b in LINK.findall(text))):
        if "://" not in target and not (ROOT / name).parent.joinpath(target).exists():
            yield f"{name}: link to {target}, which does not exist"


def missing_paths(name, text):
    for path in sorted(set(PATH.findall(code_in(text)))):
        if not (ROOT / path).exists() and not list(ROOT.glob(path + ".*")):
            yield f"{name}: names {path}, which does not exist"


def stale_excerpts(name, text):
    """The code under `<!-- from FILE -->` must equal the part of FILE between its two `// [readme]` lines."""
    for path, code in EXCERPT.findall(text):
        parts = (ROOT / path).read_text(encoding="utf-8").split("// [readme]\n")
        if len(parts) != 3 or parts[1] != code:
            yield f"{name}: the excerpt differs from {path}"


def missing_presets(name, text):
    presets = {p["name"] for p in json.loads((ROOT / "CMakePresets.json").read_text())["configurePresets"]}
    for preset in sorted(set(PRESET.findall(text)) - presets):
        yield f"{name}: names the preset {preset}, which does not exist"


def missing_targets(name, text):
    targets = re.search(r"^\.PHONY: (.*)", (ROOT / "Makefile").read_text(encoding="utf-8"), re.M)[1].split()
    for target in sorted(set(TARGET.findall(code_in(text))) - set(targets)):
        yield f"{name}: names `make {target}`, which does not exist"


def broken_shell(name, text):
    """Only the syntax: what can run without a change of the machine runs in the tests."""
    for block in code_blocks.blocks(text):
        if block.language == "sh":
            run = subprocess.run(["bash", "-n"], input=block.code, capture_output=True, text=True, check=False)
            yield from (f"{name}: {line}" for line in run.stderr.splitlines())


def missing_macros(name, text):
    for macro in sorted(set(MACRO.findall(text)) - known_macros()):
        yield f"{name}: names {macro}, which does not exist"


@functools.cache
def known_macros():
    sources = texts("CMakeLists.txt", "*.cmake", "*.json", "*.h", "*.cpp", "*.py")
    return frozenset(macro for _, text in sources for macro in MACRO.findall(text))


def missing_identifiers(name, text):
    """History may name what is gone, so the changelog is not checked."""
    if name == "CHANGELOG.md" or name.startswith(ABOUT_OTHERS):
        return
    code = "\n".join(INLINE.findall(re.sub(r"```.*?```", "", text, flags=re.DOTALL)))
    for identifier in sorted(set(IDENTIFIER.findall(code)) - known_words()):
        yield f"{name}: names `{identifier}`, which no source contains"


@functools.cache
def known_words():
    """All words of the sources, and the names of the files."""
    sources = texts("CMakeLists.txt", "*.cmake", "*.json", "*.toml", "*.h", "*.in", "*.cpp", "*.py", "*.txt", "*.js", "*.ts")
    tools = [(str(path), path.read_text(encoding="utf-8")) for path in (ROOT / "tools").iterdir() if path.is_file()]
    names = " ".join(name for name, _ in sources)
    return frozenset(re.findall(r"\w+", names + "".join(text for _, text in sources + tools)))


@functools.cache
def help_of(program, subcommand):
    run = subprocess.run([program, subcommand, "--help"], capture_output=True, text=True, check=False)
    return run.stdout if run.returncode == 0 else None


def missing_options(name, text, program):
    for subcommand, rest in COMMAND.findall(code_in(text)):
        manual = help_of(program, subcommand)
        if manual is None:
            yield f"{name}: `meshhood {subcommand}` is not a command"
            continue
        for option in OPTION.findall(rest):
            if not re.search(rf"(?<![\w-]){option}(?![\w-])", manual):
                yield f"{name}: `meshhood {subcommand}` has no option {option}"


def wrong_versions(program):
    """What has the version takes it from version.h, or states the same."""
    def read(name):
        return (ROOT / name).read_text(encoding="utf-8")

    version = ".".join(re.findall(r"define MESHHOOD_VERSION_\w+ (\d+)", read("include/meshhood/version.h")))
    for name, needed in VERSIONED.items():
        if needed.format(version) not in read(name):
            yield f"{name}: does not have the version of version.h: {needed.format(version)}"
    if program:
        printed = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout
        if not printed.startswith(f"meshhood {version}, "):
            yield f"{program}: is of another version than version.h, {version}: {printed.strip()}"
    for name in ("README.md", "docs/cpp.md"):
        for stated in set(re.findall(r"(?i)(?:version |meshhood_)(\d+\.\d+\.\d+)", read(name))) - {version}:
            yield f"{name}: names version {stated}, but that of version.h is {version}"


def main(program):
    known = texts("*.md")
    checks = [
        missing_links, missing_paths, stale_excerpts, missing_presets, missing_targets, missing_macros,
        missing_identifiers, broken_shell, code_blocks.faults,
    ]  # fmt: skip
    if program and Path(program).exists():
        program = str(Path(program).resolve())
        checks.append(lambda name, text: missing_options(name, text, program))
    else:
        program = None
        print("docs: the options of the command line are not checked, as there is no program")
    faults = [*wrong_versions(program), *(fault for name, text in known for check in checks for fault in check(name, text))]
    print("\n".join(faults + [f"docs: {len(known)} documents, {len(faults)} faults"]))
    return 1 if faults or not known else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1] if len(sys.argv) > 1 else ""))
