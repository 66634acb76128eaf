#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Finds a vertex at which the methods differ. Usage: tools/find_trap.py MESHHOOD FILE RADIUS

RADIUS is in mean edge lengths. Of 200 vertices spread over the mesh, prints the one at which the largest part of the
ball does not belong to the exact neighborhood; one at which the paper's answer differs, too, comes first.
"""
import json
import subprocess
import sys

CANDIDATES = 200


def run(*command):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(done.stderr.strip())
    return json.loads(done.stdout)


def main(meshhood, file, radius):
    vertices = run(meshhood, "info", file, "--json")["vertices"]
    sample = range(0, vertices, max(1, vertices // CANDIDATES))
    if len(sample) < 2:
        print(0)
        return

    def counts(method):
        answers = run(meshhood, "query", file, "--radius", radius, "--unit", "edge", "--method", method, "--count",
                      "--json", "--vertex", ",".join(map(str, sample)))
        return [answer["counts"][0] for answer in answers["answers"]]

    exact, paper, ball = counts("exact"), counts("paper"), counts("ball")

    def difference(i):
        return (paper[i] > exact[i], 1 - exact[i] / ball[i])

    print(sample[max(range(len(sample)), key=difference)])


if __name__ == "__main__":
    main(*sys.argv[1:])
