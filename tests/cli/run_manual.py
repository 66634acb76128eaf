#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Completes command lines in bash, zsh and fish, and reads the manual page, as `meshhood manual` prints them. What is not
installed is left out; bash must be there.

usage: run_manual.py PROGRAM
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

# A command line, whose last word is to be completed, and the words; FILES: the names of files.
FILES = ["mesh.ply"]
LINES = [
    (["q"], ["query"]),
    (["--v"], ["--version"]),
    (["query", "--me"], ["--method", "--metric"]),
    (["query", "mesh.ply", "--method", ""], ["ball", "bfs", "exact", "paper"]),
    (["compare", "mesh.ply", "-v", "3", "--uni"], ["--unit"]),
    (["query", "--unit", "e"], ["edge"]),
    (["features", "--no"], ["--no-filter"]),
    (["manual", "z"], ["zsh"]),
    (["query", "mes"], FILES),
    (["query", "--json", "mes"], FILES),
    (["query", "-r", "mes"], []),
    (["batch", "mesh.ply", "--vertices", "mes"], FILES),
    (["build", "mesh.ply", "-o", "mes"], FILES),
]

# For bash, `--option=value` is three words.
LINES_OF_BASH = [(["query", "--method", "=", "e"], ["exact"]), (["query", "--unit", "="], ["edge", "mesh"])]

BASH = r"""
source ./bash
default='-o default'
compopt() { [[ $1 == +o ]] && default=; }
COMP_WORDS=(meshhood "$@") COMP_CWORD=$#
_meshhood
if ((${#COMPREPLY[@]} == 0)) && [[ $default ]]; then compgen -f -- "${@: -1}"; fi
printf '%s\n' "${COMPREPLY[@]}"
"""

# Prints what zsh would list: its completion system works in a terminal alone.
ZSH = r"""
_describe() { [[ $1 == -o ]] && shift; print -rl -- ${${(P)2}%%:*} | grep -e "^$word" }
_files() { print -rl -- ${word}*(N) }
_arguments() {
  local spec value= before=${words[CURRENT-1]}
  local -a names
  for spec in "$@"; do
    [[ $spec =~ '^(\([^)]*\)|\*)(-[^[]*)\[.*\](:.*)?$' ]] || continue
    names+=$match[2]
    [[ $match[2] == $before ]] && value=${match[3]#:}
  done
  if [[ -n $value ]]; then
    case ${value#*:} in
      _files*) _files ;;
      *) print -rl -- ${(s: :)${${value#*:\(}%\)}} | grep -e "^$word" ;;
    esac
  elif [[ $word == -* ]]; then
    print -rl -- $names | grep -e "^$word"
  else
    case $argv[-1] in
      1:*) print -rl -- ${(s: :)${${argv[-1]#*\(}%\)}} | grep -e "^$word" ;;
      *) _files ;;
    esac
  fi
}
words=(meshhood "$@") CURRENT=$(($# + 1)) word=${@[-1]}
source ./zsh
"""


def run(command, folder):
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=60, check=False)
    return done.stdout + done.stderr


def bash(folder, words):
    return run(["bash", "-c", BASH, "bash", *words], folder).split()


def zsh(folder, words):
    return run(["zsh", "-f", "-c", ZSH, "zsh", *words], folder).split()


def fish(folder, words):
    line = " ".join(["meshhood", *words])
    found = run(["fish", "--no-config", "-c", f"source ./fish; complete -C '{line}'"], folder)
    return [one.split("\t")[0] for one in found.splitlines()]


def expect(name, complete, folder, lines):
    wrong = 0
    for words, expected in lines:
        found = sorted(set(complete(folder, words)))
        if found != expected:
            wrong += 1
            print(f"{name}: meshhood {' '.join(words)}: expected {expected}, got {found}")
    print(f"{name}: {len(lines) - wrong} of {len(lines)} lines completed")
    return wrong


def options_of(program, command):
    text = run([program, *command, "--help"], None)
    return set(re.findall(r"^  (?:-\w,)?(--[a-z-]+)", text, re.MULTILINE))


def lacks(program, name, text):
    """The commands and options of --help that a text does not have."""
    commands = re.findall(r"^  ([a-z]+) ", run([program, "--help"], None).split("Subcommands:")[1], re.MULTILINE)
    assert len(commands) > 10, commands
    missing = [command for command in commands if not re.search(rf"\b{command}\b", text)]
    for command in [[], *([command] for command in commands)]:
        for option in options_of(program, command):
            if option not in text and f" -l {option[2:]} " not in text:
                missing.append(f"{command} {option}")
    print(f"{name}: {len(commands)} commands, lacks {missing}")
    return len(missing)


def check_page(folder):
    wrong = 0
    if shutil.which("mandoc"):
        problems = run(["mandoc", "-T", "lint", "-W", "warning", "man"], folder).splitlines()
        problems = [one for one in problems if "missing date" not in one]  # so that a build can be repeated
        print(f"mandoc: {problems}")
        wrong += len(problems)
    else:
        print("skipped: no mandoc")
    if shutil.which("man"):
        page = re.sub(".\b", "", run(["man", "-l", "man"], folder))
        wrong += not re.search(r"--radius NUMBER\n +radius of the ball", page)
    else:
        print("skipped: no man")
    return wrong


def main():
    program = Path(sys.argv[1]).resolve()
    wrong = 0
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "mesh.ply").write_text("", encoding="utf-8")
        for kind in ("man", "bash", "zsh", "fish"):
            text = run([program, "manual", kind], None)
            (folder / kind).write_text(text, encoding="utf-8")
            wrong += lacks(program, kind, text.replace(r"\-", "-"))
        wrong += expect("bash", bash, folder, LINES + LINES_OF_BASH)
        for shell, complete in (("zsh", zsh), ("fish", fish)):
            if shutil.which(shell):
                wrong += expect(shell, complete, folder, LINES)
            else:
                print(f"skipped: no {shell}")
        wrong += check_page(folder)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
