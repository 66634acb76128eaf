#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Gives each file option of each command what may block: a named pipe without a partner, a pipe whose partner is silent,
a terminal, and a full device. A pipe without a partner and a full device must be refused, and a signal must end the rest.
The commands and their options are those that --help prints.

usage: run_blocking.py PROGRAM
"""
import concurrent.futures
import contextlib
import os
import pty
import re
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

# What else each command needs. A command that is not here fails.
ARGUMENTS = {
    "aggregate": "mesh.ply --values values -r 1 -o out",
    "batch": "mesh.ply -r 1 -o out",
    "build": "mesh.ply -o out",
    "check": "index.mhi",
    "closest": "mesh.ply --points points",
    "compare": "mesh.ply -v 1 -r 1",
    "connect": "mesh.ply -v 1 -w 2",
    "curvature": "mesh.ply -r 1 -o out",
    "features": "mesh.ply -r 1,2 -o out",
    "gaps": "mesh.ply -r 1 -o out",
    "generate": "sphere --vertices 20000 -o out",
    "info": "mesh.ply",
    "invariants": "mesh.ply -r 1 -o out",
    "partition": "mesh.ply --parts 2 --halo 1 -o folder",
    "query": "mesh.ply -v 1 -r 1",
    "region": "mesh.ply -v 1 -r 1e9 -o out",
    "unconnected": "mesh.ply -r 1 -o out",
    "view": "mesh.ply -o out",
}
# Without a file of their own, or with a folder.
OTHERS = {"manual", "help"}
NOT_FILES = {("partition", "-o")}
# Results that fit into a pipe, so that nothing waits for the reader; and a page needs a mesh file that is stored.
SMALL = 1 << 16
WRITTEN = {"-o", "--ply", "--vtk", "--arrays"}
REPLACED_BY = {"--radii": ("-r",), "--vertices": ("--order",),
               "--ply": (), "--vtk": ()}
LIMIT = 30  # seconds, for what must end at once


def help_of(program, *command):
    return subprocess.run([program, *command, "--help"], check=True, capture_output=True, text=True).stdout


def file_options(program):
    """Pairs of a command and its first argument (None) or the shortest name of an option, each the name of a file."""
    text = help_of(program)
    commands = re.findall(r"^  ([a-z]+)  ", text[text.index("Subcommands:"):], re.M)
    unknown = set(commands) - set(ARGUMENTS) - OTHERS
    if unknown or set(ARGUMENTS) - set(commands):
        sys.exit(f"commands without arguments here, or no longer there: {unknown or set(ARGUMENTS) - set(commands)}")
    for command in ARGUMENTS:
        text = help_of(program, command)
        if re.search(r"^  (FILE|MESH|INDEX) REQUIRED", text, re.M):
            yield command, None
        for name in re.findall(r"^  (-[-a-z,]+) (?:area\|)?FILE\b", text, re.M):
            name = name.split(",")[0]
            if (command, name) not in NOT_FILES:
                yield command, name


def command_line(command, option, file):
    words = ARGUMENTS[command].split()
    if option is None:
        return [command, file, *words[1:]]
    for replaced in (option, *REPLACED_BY.get(option, ())):
        if replaced in words:
            at = words.index(replaced)
            del words[at:at + 2]
    return [command, *words, option, file]


def reset_signals():
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGPIPE):
        signal.signal(number, signal.SIG_DFL)


class Trial:
    """One command in a folder of its own."""

    def __init__(self, program, sources, command, option):
        self.program, self.sources, self.command, self.option = program, sources, command, option
        self.name = f"{command} {option or 'FILE'}"

    @contextlib.contextmanager
    def running(self, file, **streams):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            for source in self.sources.iterdir():
                (folder / source.name).symlink_to(source)
            os.mkfifo(folder / "pipe")
            environment = {**os.environ, "MESHHOOD_VIEWER": str(folder / "page")}
            streams = {"stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE, **streams}
            with subprocess.Popen([self.program, *command_line(self.command, self.option, file)], cwd=folder,
                                  env=environment, preexec_fn=reset_signals, **streams) as process:
                try:
                    yield folder, process
                finally:
                    process.kill()

    def ends(self, process, codes, what):
        try:
            _, stderr = process.communicate(timeout=LIMIT)
        except subprocess.TimeoutExpired:
            return f"{self.name}, {what}: does not end"
        if process.returncode in codes:
            return None
        return f"{self.name}, {what}: exit code {process.returncode}, {stderr.decode(errors='replace').strip()[:200]}"

    def without_partner(self):
        """Refused after two seconds, as a pipe or as a file that must be stored."""
        with self.running("pipe") as (_, process):
            return self.ends(process, {2, 5, 6}, "a pipe without a partner")

    def silent_writer(self, number):
        with self.running("pipe") as (folder, process):
            file = os.open(folder / "pipe", os.O_RDWR)  # also a reader, so that this does not block
            try:
                time.sleep(0.5)
                process.send_signal(number)
                return self.ends(process, {130, -number, 2, 3, 5}, "a pipe with a silent writer")
            finally:
                os.close(file)

    def terminal(self, number):
        master, slave = pty.openpty()
        try:
            with self.running("-" if self.option is None else os.ttyname(slave), stdin=slave) as (_, process):
                time.sleep(0.5)
                process.send_signal(number)
                return self.ends(process, {130, -number, 2, 3, 5}, "a terminal")
        finally:
            os.close(master)
            os.close(slave)

    def silent_reader(self, number):
        """Ended by the signal, unless all fits into the pipe."""
        with self.running("pipe") as (folder, process):
            file = os.open(folder / "pipe", os.O_RDWR)
            try:
                time.sleep(1)
                process.send_signal(number)
                return self.ends(process, {130, -number, 0}, "a pipe with a silent reader")
            finally:
                os.close(file)

    def full_device(self):
        with self.running("/dev/full") as (_, process):
            return self.ends(process, {5}, "a full device")

    def run(self):
        if self.option in WRITTEN:
            trials = [self.without_partner, self.full_device]
            trials += [lambda n=n: self.silent_reader(n) for n in (signal.SIGINT, signal.SIGTERM)]
        else:
            trials = [self.without_partner]
            trials += [lambda n=n, f=f: f(n) for n in (signal.SIGINT, signal.SIGTERM)
                       for f in (self.silent_writer, self.terminal)]
        return len(trials), [failure for failure in (trial() for trial in trials) if failure]


def make_sources(program, folder):
    def run(*command):
        subprocess.run([program, *command], cwd=folder, check=True, stdout=subprocess.DEVNULL)
    run("generate", "sphere", "--vertices", "20000", "-o", "mesh.ply")
    run("build", "mesh.ply", "-o", "index.mhi")
    (folder / "page").write_text("<!-- meshhood:page -->")
    count = int(re.search(r"vertices +(\d+)", subprocess.run([program, "info", "mesh.ply"], cwd=folder, check=True,
                                                             capture_output=True, text=True).stdout).group(1))
    (folder / "values").write_text("1\n" * count)
    (folder / "points").write_text("40 0 1\n" * 20000)


def main():
    program = Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as name:
        make_sources(program, Path(name))
        trials = [Trial(program, Path(name), *pair) for pair in file_options(program)]
        with concurrent.futures.ThreadPoolExecutor(max_workers=8) as pool:
            results = list(pool.map(Trial.run, trials))
    failures = [failure for _, some in results for failure in some]
    print(f"{len(ARGUMENTS)} commands, {len(trials)} file options, {sum(count for count, _ in results)} trials, "
          f"{len(failures)} failed")
    print("\n".join(failures))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
