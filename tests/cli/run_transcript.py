#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs a transcript and compares the output of the program with it.

usage: run_transcript.py TRANSCRIPT [EMULATOR...] PROGRAM

A transcript is a text of

    $ a shell command, in which `meshhood` is the program
    a line of standard output
    ! a line of standard error
    ? the exit code, where it is not 0

and `%` in place of `$` where the command needs POSIX: it is left out for a program of Windows.

`<number>` matches any number, `<size>` a number of bytes with its unit, `<any>` anything on the line; `#` begins a
comment. All commands of a transcript run in one folder, which is empty at the start, with the default disposition of
SIGPIPE and SIGXFSZ.
"""
import os
import re
import shlex
import subprocess
import sys
import tempfile
from pathlib import Path

PLACEHOLDERS = {"<number>": r"-?[0-9.]+(e[-+]?[0-9]+)?", "<size>": r"[0-9.]+ (bytes|[kMGTP]B)", "<any>": r".*"}


class Step:
    def __init__(self, line, line_number):
        self.command = line[2:]
        self.needs_posix = line[0] == "%"
        self.line_number = line_number
        self.stdout = []
        self.stderr = []
        self.exit_code = 0


def parse(text):
    steps = []
    for number, line in enumerate(text.splitlines(), 1):
        if line.startswith(("$ ", "% ")):
            steps.append(Step(line, number))
        elif line.startswith("! "):
            steps[-1].stderr.append(line[2:])
        elif line.startswith("? "):
            steps[-1].exit_code = int(line[2:])
        elif line and not line.startswith("#"):
            steps[-1].stdout.append(line)
    return steps


def matches(expected, line):
    parts = re.split("(" + "|".join(PLACEHOLDERS) + ")", expected)
    pattern = "".join(PLACEHOLDERS.get(part, re.escape(part)) for part in parts)
    return re.fullmatch(pattern, line) is not None


def compare(stream, expected, output):
    """The differences in a stream, line by line, without blank lines."""
    lines = [line for line in output.decode("utf-8", "backslashreplace").splitlines() if line.strip()]
    wrong = [
        f"{stream}: expected '{want}', got '{got}'" for want, got in zip(expected, lines) if not matches(want, got)
    ]
    wrong += [f"{stream}: expected '{want}', got nothing" for want in expected[len(lines):]]
    wrong += [f"{stream}: not expected '{got}'" for got in lines[len(expected):]]
    return wrong


def run(step, folder, environment):
    done = subprocess.run(
        ["bash", "-c", step.command], cwd=folder, env=environment, capture_output=True, timeout=300, check=False
    )
    wrong = compare("stdout", step.stdout, done.stdout) + compare("stderr", step.stderr, done.stderr)
    if done.returncode != step.exit_code:
        wrong.append(f"exit code: expected {step.exit_code}, got {done.returncode}")
    return wrong


def main():
    transcript, *emulator, program = sys.argv[1:]
    transcript, program = Path(transcript), Path(program).resolve()
    steps = parse(transcript.read_text(encoding="utf-8"))
    if program.suffix == ".exe":
        steps = [step for step in steps if not step.needs_posix]
    failures = 0
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "bin").mkdir()
        command = Path(folder) / "bin" / "meshhood"
        if emulator:
            command.write_text(f'#!/bin/sh\nexec {shlex.join([*emulator, str(program)])} "$@"\n', encoding="utf-8")
            command.chmod(0o700)
        else:
            command.symlink_to(program)
        (Path(folder) / "work").mkdir()
        environment = dict(os.environ, PATH=f"{folder}/bin:{os.environ['PATH']}", LC_ALL="C.UTF-8")
        for step in steps:
            wrong = run(step, Path(folder) / "work", environment)
            failures += bool(wrong)
            for line in wrong:
                print(f"{transcript.name}:{step.line_number}: $ {step.command}\n    {line}")
    print(f"{transcript.name}: {len(steps) - failures} of {len(steps)} commands as written")
    return 1 if failures or not steps else 0


if __name__ == "__main__":
    sys.exit(main())
