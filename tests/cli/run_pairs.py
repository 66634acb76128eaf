#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs every pair of options of every command on meshes of more than 40,000 vertices, and compares the answers with
those of plain.py, by definition. The table of the options is made from --help, so a new option is in it.

usage: run_pairs.py PROGRAM SHARED [COMMAND...]

A pair is answered, or refused as wrong usage by a message that names both options. Every option that takes a file gets
it from a file, from standard input and from a pipe, and no output may be an input. On the real meshes in SHARED, which
MESHHOOD_SHARED may name, a twentieth of the pairs is run. MESHHOOD_TEST_SCALE below 1 runs a sample. Exit code 77:
NumPy is missing.
"""
import collections
import io
import itertools
import math
import os
import random
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

try:
    import numpy as np
except ImportError:
    print("skipped: no NumPy")
    sys.exit(77)

import plain
from plain_answers import CHECKS

SCALE = float(os.environ.get("MESHHOOD_TEST_SCALE", "1"))
REAL_MESHES = ["cortex_left_41k", "armadillo_43k"]
PAIRS_OF_A_REAL_MESH = 0.05
VERTICES = 42000

# On these the bytes of an answer do not depend.
NEUTRAL = {"--threads", "--json", "--max-bytes", "FILE"}
SAME_BYTES = {"batch", "aggregate", "curvature", "features", "invariants", "unconnected", "gaps", "region",
              "closest"}

# Of these, no input may be standard input, because it is read more than once; of view the mesh.
STORED = {("partition", "FILE"), ("partition", "--faces"), ("view", "FILE")}

# Not run: what prints and ends.
LEFT_OUT = {"--help", "--version"}
COMMANDS_LEFT_OUT = {"manual"}  # without options

# These are run on the mesh, check on its index, and all others on either: the index is faster to read.
MESH_COMMANDS = {"build", "partition", "view", "info", "generate", "check"}

# The options of each command that every command line has, unless one of the pair replaces or excludes them.
BASE = {
    "info": [],
    "build": ["--output"],
    "check": [],
    "query": ["--vertex", "--radius"],
    "connect": ["--vertex", "--to"],
    "region": ["--vertex", "--radius", "--output", "--arrays"],
    "closest": ["--points"],
    "batch": ["--radius", "--output"],
    "aggregate": ["--values", "--radius", "--output"],
    "curvature": ["--radius", "--output"],
    "features": ["--radius", "--output"],
    "invariants": ["--radius", "--output"],
    "unconnected": ["--radius", "--output"],
    "gaps": ["--radius", "--output"],
    "partition": ["--halo", "--parts", "--output"],
    "compare": ["--vertex", "--radius"],
    "generate": ["KIND", "--output"],
    "view": ["--output"],
}

# Of these, an option replaces that of the base. Two of them may be refused.
INSTEAD = [{"--vertex", "--point"}, {"--radius", "--radii", "--largest"}, {"--point", "--points"},
           {"--output", "--csv"}, {"--to", "--nearest"}, {"--parts", "--vertices-per-part"}, {"--list", "KIND"}, {"--list", "--output"}]

# What a setting needs besides what --help says; a scan for each of all rows would take long.
NEEDS = {
    ("query", "--factor"): [("--method", "paper")],
    ("check", "--weld"): [("--mesh", "mesh")],
    ("batch", "--radius"): [("--count", None)],
    ("batch", "--method", "ball"): [("--vertices", "vertices")],
    ("view", "--unit"): [("--radius", "5.5")],
    ("region", "--tolerance"): [("--faces", "clip")],
    ("aggregate", "--quantile"): [("--reduce", "quantile")],
    ("aggregate", "--nesting"): [("--radius", "2,3.5")],
}

# Instead of a value by the type: by the option, or by command and option.
VALUES = {
    "--weld": [True],
    ("batch", "--max-bytes"): ["enough"],
    ("aggregate", "--max-bytes"): ["enough"],
    ("compare", "--vertex"): ["20011"],
    ("connect", "--vertex"): ["20011"],
    ("region", "--vertex"): ["20011"],
    ("view", "--vertex"): ["20011"],
    "--vertex": ["20011,LAST,17"],
    "--radius": ["2,3.5"],
    ("region", "--radius"): ["5.5"],
    ("compare", "--radius"): ["5.5"],
    ("view", "--radius"): ["5.5"],
    ("unconnected", "--metric"): ["path", "rings"],  # in space nothing is connected
    "--point": ["point"],
    "--seed": ["20011"],
    "--to": ["3,LAST,20300"],
    "--nearest": ["25"],
    "--factor": ["7.5"],
    "--largest": ["6"],
    "--smallest": ["2"],
    ("features", "--count"): ["3"],
    "--threshold": ["0.25"],
    "--tolerance": ["0.01"],
    "--quantile": ["0.9"],
    "--kinds": ["mean,crease"],
    "--reduce": ["sum", "min", "max", "var", "std", "median", "mean,count", "quantile"],
    "--threads": ["2"],
    "--halo": ["4"],
    "--parts": ["5"],
    "--vertices-per-part": ["9000"],
    "--memory": ["200MB"],
    ("generate", "--vertices"): ["41000"],
    "KIND": ["sphere"],
    "--walls": ["walls"],
    "--ignored": ["ignored"],
    "--vertices": ["vertices"],
    "--radii": ["radii"],
    "--values": ["values"],
    ("view", "--values"): ["one_value"],
    "--weights": ["area", "weights"],
    "--points": ["points"],
    "--ids": ["vertices"],
    "--cut": ["cut"],
    "--mesh": ["mesh"],
    ("partition", "--faces"): ["faces"],
    "--ply": ["out.ply"],
    "--vtk": ["out.vtk"],
    "--arrays": ["arrays.npz"],
}
BASE_VALUES = {"--vertex": "17,LAST", "--radius": "3.5", "--point": "point", "--to": "40000,20300", "--parts": "3"}
OUTPUTS = {"build": "out.mhi", "region": "out.ply", "query": "out.ply", "compare": "out.ply", "generate": "out.ply",
           "view": "out.html", "partition": "parts"}


class Option:
    """A line of --help."""

    PATTERN = re.compile(r"^  (?:-\w,)?(--[a-z-]+)(?: \[=EPS\])?(?: ([A-Z,]+|i/N|[a-z]+(?:\|\w+)+)(?=[ =:]|$))?"
                         r"(?::SIZE \[.*?\])?(?:=\S+)?(?: \.\.\.)?( REQUIRED)?(?: Needs:((?: --[a-z-]+)+))?"
                         r"(?: Excludes:((?: --[a-z-]+)+))?(?: .*)?$")

    def __init__(self, match, line):
        self.name, self.type = match[1], match[2]
        self.default = (re.search(r"\|[a-z]+=([a-z]+)", line) or [None, None])[1]
        self.needs, self.excludes = ((match[i] or "").split() for i in (4, 5))
        self.is_output = re.search(r"\((?!\.npy)\.\w+( or \.csv)?\)$", line) is not None
        self.is_input = "FILE" in (self.type or "") and not self.is_output

    def values(self, command):
        """The values that are run; None is that of a flag."""
        known = VALUES.get((command, self.name), VALUES.get(self.name))
        if known:
            return known
        if self.type is None:
            return [None]
        if "|" in self.type:
            return [word for word in self.type.split("|") if word != self.default]
        if self.name == "--output":
            return ["-"] if self.name in BASE[command] and command != "partition" else [OUTPUTS.get(command, "out.npz")]
        raise LookupError(f"{command} {self.name} {self.type}: no value is known; add one to VALUES of run_pairs.py")


def table_of(program):
    """The options of each command, from --help."""
    def help_of(*command):
        done = subprocess.run([program, *command, "--help"], env=dict(os.environ, COLUMNS="10000"), capture_output=True,
                              text=True, check=True)
        return done.stdout

    table = {}
    for command in re.findall(r"^  ([a-z]+) ", help_of().split("Subcommands:")[1], re.MULTILINE):
        text = re.sub(r"\n {10,}", "  ", help_of(command))  # a description on a line of its own
        lines = [line for line in text.splitlines() if re.match(r"  -", line)]
        options = []
        for line in lines:
            match = Option.PATTERN.match(line)
            if match is None:
                raise LookupError(f"{command}: this line of --help is not understood: {line}")
            options.append(Option(match, line))
        table[command] = {option.name: option for option in options if option.name not in LEFT_OUT}
    return table


def index_name(weld, precision):
    return f"index{'_welded' if weld else ''}{precision}.mhi"


class Files:
    """A mesh, its indexes, and lists for it, with the arrays that they stand for."""

    def __init__(self, program, folder, name, V, offsets, corners):
        self.program, self.folder, self.name = str(program), folder, name
        self.arrays = plain.with_seam(V, offsets, corners)
        self.count = len(self.arrays[0])
        plain.write_ply(folder / "mesh.ply", *self.arrays)
        random_numbers = np.random.default_rng(2)
        fixed = [17, 20011, 40500]
        self.walls = random_numbers.choice(self.count, self.count // 12, replace=False)
        self.walls = self.walls[~np.isin(self.walls, [*fixed, 40000])]
        self.ignored = random_numbers.choice(self.count, self.count // 7, replace=False)
        self.vertices = np.concatenate([fixed, random_numbers.integers(0, self.count, 3000)])
        self.values = random_numbers.normal(size=(self.count, 2))
        self.values[random_numbers.choice(self.count, self.count // 500, replace=False), 1] = math.nan
        self.weights = random_numbers.uniform(0.5, 2, self.count)
        self.weights[::50] = 0
        V = self.arrays[0].astype(np.float64)
        self.points = V[random_numbers.integers(0, self.count, 300)] + random_numbers.normal(size=(300, 3)) / 3
        self.point = V[20011] + (0.21, 0.13, 0.17)
        whole = plain.Plain(*self.arrays)
        self.cut = whole.edges[random_numbers.choice(len(whole.edges), 4000, replace=False)]
        self.radii = random_numbers.choice([1.5, 2.5, 4.0], self.count)
        self._write()
        self._plain = {}
        self.bytes = {}

    def _write(self):
        def text(name, rows):
            lines = ["# a list", "", *(" ".join(map(repr, np.atleast_1d(row).tolist())) for row in rows)]
            (self.folder / name).write_text("\n".join(lines) + "\n", encoding="utf-8")

        for name in ("walls", "ignored", "vertices", "weights", "points", "cut", "radii"):
            text(name, getattr(self, name))
        text("one_value", self.values[:, 0])
        text("radii_of_vertices", self.radii[: len(self.vertices)])
        text("radii_of_points", self.radii[: len(self.points)])
        np.save(self.folder / "values", self.values)
        (self.folder / "values.npy").rename(self.folder / "values")
        np.save(self.folder / "positions.npy", self.arrays[0])
        if set(np.diff(self.arrays[1])) == {3}:
            np.save(self.folder / "faces.npy", self.arrays[2].reshape(-1, 3))
        for weld, precision in itertools.product((False, True), ("", "float", "double")):
            reading = (["--weld"] if weld else []) + (["--precision", precision] if precision else [])
            self.run(["build", "mesh.ply", *reading, "--faces", "-o", index_name(weld, precision)])

    def run(self, arguments, stdin=None, folder=None, program=None):
        environment = dict(os.environ, MESHHOOD_VIEWER=str(self.folder.parent / "viewer.html"))
        environment["PATH"] = f"{self.folder.parent}/bin:{environment['PATH']}"
        return subprocess.run([program or self.program, *arguments], cwd=folder or self.folder, env=environment,
                              stdin=stdin or subprocess.DEVNULL, capture_output=True, timeout=600, check=False)

    def plain(self, weld=False, cut=False):
        if (weld, cut) not in self._plain:
            masks = {"walls": self.walls, "ignored": self.ignored}
            cut_edges = self.cut.tolist() if cut else ()
            self._plain[weld, cut] = plain.Plain(*self.arrays, masks, weld, cut_edges)
        return self._plain[weld, cut]


class Run:
    """A command line and its answer."""

    def __init__(self, files, table, command, settings):
        self.files, self.table, self.command, self.pair = files, table, command, settings
        self.asked = self._complete(settings)
        self.typed = {}  # instead of the value of an option
        self.folder = Path(tempfile.mkdtemp(dir=files.folder))
        self.done = None

    def _complete(self, settings):
        """All options by name: the pair, what it needs, and the base."""
        asked, options = dict(settings), self.table[self.command]
        excluded = {name for setting in settings if setting[0] in options for name in options[setting[0]].excludes}
        for name, value in settings:
            needs = options[name].needs if name in options else []
            needs = [(need, options[need].values(self.command)[0]) for need in needs]
            needs += NEEDS.get((self.command, name), []) + NEEDS.get((self.command, name, value), [])
            for need, need_value in needs:
                if need not in excluded:
                    asked.setdefault(need, need_value)
        self.needed = set(asked) - set(dict(settings))
        for name in BASE[self.command]:
            replaced = any(name in group and group & set(asked) for group in INSTEAD)
            if name not in asked and not replaced:
                asked[name] = self._base_value(name)
        return asked

    def _base_value(self, name):
        known = VALUES.get((self.command, name), VALUES.get(name, [None]))[0]
        if name == "--output":
            return OUTPUTS.get(self.command, "out.npz")
        return known if (self.command, name) in VALUES else BASE_VALUES.get(name, known)

    @property
    def file(self):
        """The first argument: the mesh if it is to be welded, else the index, which is faster to read."""
        if "FILE" in self.asked:
            return self.asked["FILE"]
        if self.command == "check":
            return index_name("--weld" in self.asked, self.asked.get("--precision", ""))
        if self.command in MESH_COMMANDS or {"--weld", "--precision"} & set(self.asked):
            return "positions.npy" if "--faces" in self.asked and self.command == "partition" else "mesh.ply"
        return "index.mhi"

    def value_of(self, name):
        """As it is typed."""
        value = self.asked[name]
        if value == "point":
            return ",".join(map(repr, self.files.point.tolist()))
        if value == "enough":
            return str(self.enough)
        for rows in ("vertices", "points"):
            if value == "radii" and f"--{rows}" in self.asked:
                value = f"radii_of_{rows}"
        if value in ("mesh", "faces"):
            value += {"mesh": ".ply", "faces": ".npy"}[value]
        if isinstance(value, str):
            value = value.replace("LAST", str(self.files.count - 1))  # a vertex of the seam
        if isinstance(value, str) and (self.files.folder / value).is_file():
            return str(self.files.folder / value)
        return value

    def arguments(self):
        arguments = [self.command]
        if self.command != "generate":
            arguments.append(self.typed.get("FILE", str(self.files.folder / self.file)))
        for name in self.asked:
            value = self.typed.get(name, self.value_of(name))
            if name == "KIND":
                arguments.insert(1, value)
            elif name == "FILE":
                continue
            elif value is None or value is True:
                arguments.append(name)
            else:
                arguments.append(f"{name}={value}" if str(value).startswith("-") and value != "-" else name)
                arguments += [] if "=" in arguments[-1] else [str(value)]
        return arguments

    def run_piped(self, name, way):
        """With the file of an option from standard input, or from a pipe."""
        file = self.value_of(name) if name != "FILE" else str(self.files.folder / self.file)
        self.typed[name] = "-" if way == "stdin" else "PIPE"
        line = shlex.join([self.files.program, *self.arguments()]).replace("PIPE", f"<(cat {shlex.quote(file)})")
        self.done = self.files.run(["-c", line], stdin=open(file, "rb"), folder=self.folder, program="bash")
        return self

    def run(self):
        if self.asked.get("--max-bytes") == "enough":
            without = Run(self.files, self.table, self.command, [s for s in self.pair if s[0] != "--max-bytes"])
            without.run()
            self.enough = int(len(without.output() or b"") * 1.02)
            self.without = without
        self.done = self.files.run(self.arguments(), folder=self.folder)
        return self

    def output(self, name="--output"):
        """The bytes of an output file; None without."""
        if name == "--output" and "--csv" in self.asked:
            return self.done.stdout
        value = self.asked.get(name)
        if value == "-":
            return self.done.stdout
        file = self.folder / str(value)
        return file.read_bytes() if value and file.is_file() else None

    def text(self):
        """What is printed."""
        is_taken = "-" in self.asked.values() or "--csv" in self.asked
        return (self.done.stderr if is_taken else self.done.stdout).decode()

    def close(self):
        shutil.rmtree(self.folder)

    def __str__(self):
        named = [argument.replace(str(self.files.folder) + "/", "") for argument in self.arguments()]
        return f"{self.files.name}: meshhood {' '.join(named)}"


def names_both(run, message):
    """A refusal names both options of the pair, or instead of one of them what it needs."""
    named = {name for name in run.asked if re.search(rf"{name}(?![a-z-])", message)}
    if run.needed:
        return len(run.pair) == 2 and len(named & {*run.needed, *dict(run.pair)}) >= 2
    return len(run.pair) == 2 and set(dict(run.pair)) <= named


def check(run, counts):
    """What is wrong with an answer; counts what was compared."""
    message = run.done.stderr.decode("utf-8", "replace").strip()
    if run.done.returncode == 2 and names_both(run, message):
        counts["refused"] += 1
        return []
    if run.done.returncode != 0:
        return [f"exit code {run.done.returncode}: {message}"]
    counts["pairs"] += 1
    wrong = []
    try:
        counts["rows"] += CHECKS[run.command](run, wrong)
    except Exception as error:  # noqa: BLE001: of an answer in another form
        wrong.append(f"the answer is not understood: {error!r}")
    return wrong + other_bytes(run, counts)


def other_bytes(run, counts):
    """The same question has one answer, bit for bit."""
    if run.command not in SAME_BYTES or run.output() is None:
        return []
    question = {name: value for name, value in run.asked.items() if name not in NEUTRAL and name != "--output"}
    key = (run.command, "--order" in question, tuple(sorted(question.items(), key=str)))
    counts["same bytes"] += key in run.files.bytes
    known = run.files.bytes.setdefault(key, hash(run.output()))
    return [] if known == hash(run.output()) else ["other bytes than the same question had before"]


def settings_of(table, command):
    """Each option with each of its values."""
    if command not in BASE:
        raise LookupError(f"{command}: no command line is known; add it to BASE and CHECKS")
    settings = [(name, value) for name, option in table[command].items() for value in option.values(command)]
    return settings + ([] if command in MESH_COMMANDS else [("FILE", "mesh.ply")])


def pairs_of(table, command):
    settings = settings_of(table, command)
    singles = [[setting] for setting in settings]
    return singles + [[a, b] for a, b in itertools.combinations(settings, 2) if a[0] != b[0]]


def run_pairs(files, table, commands, share, counts):
    """The number of wrong answers."""
    chosen = random.Random(3)
    runs = [(command, pair) for command in commands for pair in pairs_of(table, command)]
    runs = [run for run in runs if chosen.random() < share]
    wrong = 0
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for run in pool.map(lambda item: Run(files, table, *item).run(), runs):
            wrong += report(run, check(run, counts))
    return wrong


def run_all_rows(files, counts):
    """Every row of a batch with a radius for each, against breadth-first search on a mesh without the walls."""
    wrong, columns = 0, files.count

    def places(arguments):
        arrays = np.load(io.BytesIO(files.run(["batch", *arguments, "--order", "vertex", "-o", "-"]).stdout))
        return np.sort(np.repeat(np.arange(columns), np.diff(arrays["indptr"])) * columns + arrays["indices"])

    for walls, ignored in itertools.product(([], files.walls), ([], files.ignored)):
        mesh = files.plain()
        edges = mesh.edges[~np.isin(mesh.edges, walls).any(axis=1)]
        faces = edges[:, [0, 1, 1]]  # the same edges, although the faces at a wall are gone
        plain.write_ply(files.folder / "edges.ply", files.arrays[0], 3 * np.arange(len(faces) + 1), faces.ravel())
        expected = []
        for r in np.unique(files.radii):
            found = places(["edges.ply", "-r", repr(float(r)), "--method", "bfs"])
            row, column = np.divmod(found, columns)
            expected.append(found[(files.radii[row] == r) & ~np.isin(row, walls) & ~np.isin(column, ignored)])
        masks = (["--walls", "walls"] if len(walls) else []) + (["--ignored", "ignored"] if len(ignored) else [])
        if not np.array_equal(places(["index.mhi", "--radii", "radii", *masks]), np.sort(np.concatenate(expected))):
            print(f"{files.name}: batch --radii radii {' '.join(masks)} differs from breadth-first search", flush=True)
            wrong += 1
        counts["rows"] += columns
    return wrong


def run_inputs(files, table, commands, counts):
    """Every input from standard input and from a pipe; two inputs from standard input; an output that is an input."""
    wrong = 0
    for command in commands:
        inputs = [name for name, option in table[command].items() if option.is_input]
        inputs += ["FILE"] if command != "generate" else []
        outputs = [name for name, option in table[command].items() if option.is_output]
        for name in inputs:
            setting = [] if name == "FILE" else [(name, table[command][name].values(command)[-1])]
            expected = check(Run(files, table, command, setting).run(), counts)
            assert not expected, expected
            for way in ("stdin", "pipe"):
                run = Run(files, table, command, setting).run_piped(name, way)
                is_refused = run.done.returncode != 0 and run.done.stderr.count(b"\n") == 1
                wrong += report(run, [] if is_refused and (command, name) in STORED else check(run, counts))
                counts["inputs"] += 1
            for other in inputs:
                if other < name:
                    wrong += refused(files, table, command, setting, {name: "-", other: "-"}, (name, other), counts)
            for output in outputs:
                wrong += refused(files, table, command, setting, {name: "same", output: "same"}, (name, output), counts)
    return wrong


def refused(files, table, command, setting, typed, names, counts):
    """Two arguments that name the same file are wrong usage; the message names both."""
    known = dict(setting)
    for name in names:
        if name != "FILE" and name not in known:
            known[name] = table[command][name].values(command)[-1]
    run = Run(files, table, command, list(known.items()))
    if any(name in table[command] and set(table[command][name].excludes) & set(run.asked) for name in run.asked):
        return 0
    run.typed = typed
    file = files.folder / run.file
    if "same" in typed.values():
        value = Run(files, table, command, setting).value_of(names[0]) if names[0] != "FILE" else file
        shutil.copy(value, run.folder / "same")
    run.done = files.run(run.arguments(), folder=run.folder, stdin=open(file, "rb"))
    counts["refused"] += 1
    message = run.done.stderr.decode()
    if (command, names[0]) in STORED or (command, names[1]) in STORED:
        return report(run, [] if run.done.returncode else ["is not refused"])
    missing = [name for name in names if name not in message.replace("MESH", "FILE").replace("INDEX", "FILE")]
    is_right = run.done.returncode == 2 and not missing
    return report(run, [] if is_right else [f"exit code {run.done.returncode}, not named: {missing}: {message}"])


def report(run, found):
    for line in found[:3]:
        print(f"{run}\n    {line}", flush=True)
    run.close()
    return bool(found)


def main():
    program, shared = Path(sys.argv[1]).resolve(), Path(os.environ.get("MESHHOOD_SHARED", sys.argv[2])) / "meshes"
    try:
        table = table_of(program)
        commands = sys.argv[3:] or [command for command in table if command not in COMMANDS_LEFT_OUT]
        for command in commands:
            settings_of(table, command)
    except LookupError as error:
        print(error.args[0])
        return 1
    counts = collections.Counter(options=sum(len(table[command]) for command in commands))
    wrong = 0
    with tempfile.TemporaryDirectory() as name:
        root = Path(name)
        (root / "viewer.html").write_text("<html><!-- meshhood:page --></html>", encoding="utf-8")
        (root / "bin").mkdir()
        (root / "bin" / "xdg-open").symlink_to(shutil.which("true"))
        for mesh, share in meshes(program, shared, root):
            (root / mesh).mkdir()
            vertices, offsets, corners = plain.read_ply(root / f"{mesh}.ply")
            V = np.stack([vertices[axis] for axis in "xyz"], axis=1)
            files = Files(program, root / mesh, mesh, V, offsets, corners)
            wrong += run_pairs(files, table, commands, share * SCALE, counts)
            if "batch" in commands:
                wrong += run_all_rows(files, counts)
            if share == 1:
                wrong += run_inputs(files, table, commands, counts)
    print(f"{len(commands)} commands, {counts['options']} options: {counts['pairs']} answered, "
          f"{counts['refused']} refused, {counts['inputs']} inputs from streams, {counts['rows']} rows compared, "
          f"{counts['same bytes']} times the same bytes, {wrong} wrong")
    return 1 if wrong or not counts["rows"] else 0


def meshes(program, shared, root):
    """The name of each mesh, whose file is then in `root`, and the share of the pairs to run."""
    subprocess.run([program, "generate", "plates", "--vertices", str(VERTICES), "-o", root / "plates.ply"],
                   check=True, capture_output=True)
    yield "plates", 1
    for name in REAL_MESHES:
        packed = next(shared.glob(f"*/{name}.ply.zst"), None)
        if packed is None or shutil.which("zstd") is None:
            print(f"skipped: {name}: no file in {shared}" if packed is None else f"skipped: {name}: no zstd")
            continue
        subprocess.run(["zstd", "-dqf", packed, "-o", root / f"{name}.ply"], check=True)
        yield name, PAIRS_OF_A_REAL_MESH


if __name__ == "__main__":
    sys.exit(main())
