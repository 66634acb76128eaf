#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Counts the instructions of fixed queries and builds under callgrind and compares them with the committed baseline.

usage: bench/guard/guard.py PROGRAM [--update]

The number of instructions does not depend on the load of the machine, so 5 % more is a regression. It depends on the
compiler, which the baseline names: with another version the guard is skipped (exit code 77). If more work is intended,
`--update` rewrites the baseline, and the commit says why.
"""
import argparse
import json
import re
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

BASELINE = Path(__file__).with_name("baseline.json")
TOLERANCE = 0.05
SKIPPED = 77

# Sphere: one smooth sheet. Scroll and plates: several sheets in a ball. Noise: separate spheres.
CASES = [
    "ids:sphere:2", "ids:sphere:5", "ids:sphere:10", "ids:sphere:20", "ids:sphere:65",
    "count:sphere:20", "ranges:sphere:65",
    "ids:scroll:10", "ids:scroll:65", "ids:plates:20", "ids:noise:10",
    "paper:sphere:20", "paper:scroll:20", "reference:sphere:10", "reference:scroll:20",
    "build:exact:sphere", "build:exact:noise", "build:paper:sphere",
]


def instructions(program, case):
    with tempfile.TemporaryDirectory() as scratch:
        command = ["valgrind", "--tool=callgrind", "--toggle-collect=meshhood_guard_measured",
                   f"--callgrind-out-file={scratch}/out", program, case]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode == SKIPPED:
            skip(done.stdout.strip())
        counted = re.search(r"Collected : (\d+)", done.stderr)
        if done.returncode != 0 or counted is None or int(counted[1]) == 0:
            sys.exit(f"guard: {case} was not counted:\n{done.stderr}")
        return int(counted[1])


def skip(reason):
    print(reason if reason.startswith("skipped") else f"skipped: {reason}")
    sys.exit(SKIPPED)


def count_all(program, workers):
    with ThreadPoolExecutor(workers) as pool:
        return dict(zip(CASES, pool.map(lambda case: instructions(program, case), CASES)))


def report(counted, expected):
    """Prints a line a case and returns the cases that cost too much."""
    worse = []
    for case, now in counted.items():
        change = now / expected[case] - 1
        verdict = "worse" if change > TOLERANCE else "better: --update" if change < -TOLERANCE else ""
        if verdict == "worse":
            worse.append(case)
        print(f"{case:<20} {expected[case]:>12,} -> {now:>12,}  {change:+6.1%}  {verdict}".rstrip())
    return worse


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", help="build/release/bench/guard")
    parser.add_argument("--update", action="store_true", help="write the baseline instead of comparing with it")
    parser.add_argument("--workers", type=int, default=2, help="cases at a time (default 2)")
    return parser.parse_args()


def main():
    options = parse_arguments()
    if shutil.which("valgrind") is None:
        skip("no valgrind")
    compiler = subprocess.run([options.program, "--compiler"], capture_output=True, text=True, check=True).stdout.strip()
    if options.update:
        baseline = {"compiler": compiler, "instructions": count_all(options.program, options.workers)}
        BASELINE.write_text(json.dumps(baseline, indent=2) + "\n", encoding="utf-8")
        print(f"wrote {len(CASES)} cases to {BASELINE}")
        return
    baseline = json.loads(BASELINE.read_text(encoding="utf-8"))
    if baseline["compiler"] != compiler:
        skip(f"the baseline is of {baseline['compiler']}, and this is {compiler}")
    if set(baseline["instructions"]) != set(CASES):
        sys.exit("guard: the baseline and guard.py have different cases; rewrite the baseline with --update")
    worse = report(count_all(options.program, options.workers), baseline["instructions"])
    print(f"{len(CASES)} cases, {len(worse)} more than {TOLERANCE:.0%} worse than the baseline of {compiler}")
    if worse:
        sys.exit(f"guard: {', '.join(worse)} cost over {TOLERANCE:.0%} more instructions than the baseline. Fix it, or,"
                 " if it is intended, run bench/guard/guard.py PROGRAM --update and say why in the commit.")


if __name__ == "__main__":
    main()
