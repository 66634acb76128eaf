# SPDX-License-Identifier: MIT
"""From the arrays of a mesh in memory to the answers for all of its vertices, beside other libraries."""
import statistics

from .. import machine
from .markdown import number, table

TITLE = "From arrays to the answers for all vertices"
COMMAND = "python3 -m bench arrays"
OURS, OUR_RINGS, BFS = "meshhood", "meshhood rings", "our breadth-first search (C++)"
TRUEFORM_RINGS, TRUEFORM_CURVATURE = "trueform k_rings", "trueform principal_curvatures"
QUESTIONS = {"counts": "Counts", "ids": "Ids", "mean": "Mean of a signal", "curvature": "Principal curvatures"}
RADII = (2, 3, 5, 10)

NOTE = """`{command}`: wall clock from the arrays of positions and triangles in memory to the answers for all vertices, in µs a
vertex, with what must be built for it. Each tool runs in a process of its own that has as many processors as the table
has threads, in turns with the others; medians. It gets its own types of numbers, and answers all vertices. **Bold**:
another tool is faster than meshhood. The radii are in mean edges. The answers are not all the same, see the second
column: *exact* is the neighborhood of meshhood; *ball* is the ball in space, which takes other sheets for near ones,
except for libigl's, which is connected; *k rings* are the vertices within k edges, whatever their length, for k as
large as the radius; *found* is how many vertices that gives at the largest radius. In the tables of counts, a tool
that can only return ids counts by them. *(in hand)* is the same with the index already built. A tool that would take
longer than {most:g} s is stopped, or left out if a piece of the mesh suggests so; one that needs more than 12 GiB is
stopped.

"""

FROM_ARRAYS, IN_HAND = "seconds", "answer_seconds"

# How many times as long as meshhood another tool should take at least, by question and radius; more threads or less.
GOALS = (("counts", OURS, BFS, FROM_ARRAYS, {3: 1, 5: 3, 10: 8}),
         ("curvature", OURS, TRUEFORM_CURVATURE, FROM_ARRAYS, {2: 1 / 0.7, 5: 4}),
         ("ids", OUR_RINGS, TRUEFORM_RINGS, IN_HAND, {2: 3, 3: 3, 5: 3}))
MICROSECONDS_OF_BUILD = {"head_skin": 0.35, "cortex": 0.45, "mri_head": 0.45}  # on one thread, at most
GAIN_OF_TWO_THREADS = 1.8  # of the build, at least
GOALS_NOTE = """
## Goals

The time of another tool over that of meshhood, both from arrays, or both with what they build in hand; in parentheses
the goal. In bold where it is missed.

"""
BUILDS_NOTE = """
The build of the index, in µs a vertex; in parentheses the goals, at most for one thread and at least for the gain of
two.

"""


def text(data):
    contests = grouped(data)
    parts = [NOTE.format(command=COMMAND, most=data["most_seconds"])]
    for (name, threads), pieces in contests.items():
        parts.append(f"## {name}, {threads_in_words(threads)}\n\n{next(iter(pieces.values()))['vertices']:,} vertices.\n")
        for question, title in QUESTIONS.items():
            parts.append(f"\n{title}:\n\n{question_table(question, pieces)}")
        parts.append("\n")
    return "".join(parts).rstrip("\n") + "\n" + goals(contests)


def grouped(data):
    """mesh and threads -> radius -> piece, in the order of the radii."""
    contests = {}
    for piece in sorted(data["pieces"].values(), key=lambda piece: piece["radius_edges"]):
        contests.setdefault((piece["mesh"], piece["threads"]), {})[piece["radius_edges"]] = piece
    return dict(sorted(contests.items()))


def threads_in_words(threads):
    return {1: "one thread", 2: "two threads"}[threads]


def question_table(question, pieces):
    tools = {}
    for piece in pieces.values():
        for name, row in rows_of(question, piece).items():
            tools[name] = row["answers"]
    last = rows_of(question, list(pieces.values())[-1])
    rows = [[name, answers, *(cell(rows_of(question, piece), name, piece) for piece in pieces.values()),
             number(last[name]["found"]) if last.get(name, {}).get("found") else ""] for name, answers in tools.items()]
    for ours in (OUR_RINGS, OURS):
        if ours in tools:
            times = [in_hand(question, ours, piece) for piece in pieces.values()]
            rows.insert(list(tools).index(ours) + 1, [f"{ours} (in hand)", tools[ours], *times, ""])
    return table(["", "answers", *(f"r = {edges}" for edges in pieces), "found"], rows)


def rows_of(question, piece):
    """The rows of those that answer the question; of those that answer it by ids, the rows of the ids."""
    found = dict(piece["questions"][question])
    if question == "counts":
        found |= {name: row for name, row in piece["questions"]["ids"].items() if name not in found}
    return found


def cell(rows, name, piece):
    row = rows.get(name)
    if row is None:
        return ""
    if "seconds" not in row:
        return row["failure"]
    mine, own = rows[OURS]["seconds"]["median"], row["seconds"]["median"]
    text = number(1e6 * own / piece["vertices"])
    return f"**{text}**" if own < mine and name != OUR_RINGS else text


def in_hand(question, ours, piece):
    if not is_measured(piece, question, ours):
        return ""
    return f"*({number(microseconds(piece, question, ours, IN_HAND))})*"


def is_measured(piece, question, name):
    return "seconds" in piece["questions"][question].get(name, {})


def microseconds(piece, question, name, key=FROM_ARRAYS):
    return 1e6 * piece["questions"][question][name][key]["median"] / piece["vertices"]


def goals(contests):
    rows = []
    for question, ours, other, key, aims in GOALS:
        what = f"{QUESTIONS[question]}, {other}" + (", in hand" if key == IN_HAND else "")
        for (name, threads), pieces in contests.items():
            cells = [compared(question, ours, other, key, pieces.get(edges), aims.get(edges)) for edges in RADII]
            if any(cells):
                rows.append([what, name, threads_in_words(threads), *cells])
    return GOALS_NOTE + table(["", "mesh", "threads", *(f"r = {edges}" for edges in RADII)], rows) + builds(contests)


def builds(contests):
    """The build of our index where it was measured on one thread and on two."""
    rows = []
    for name in dict.fromkeys(name for name, _ in contests):
        times = [build_of(contests.get((name, threads), {})) for threads in (1, 2)]
        if not all(times):
            continue
        most = MICROSECONDS_OF_BUILD.get(name)
        one = number(times[0]) + (f" ({number(most)})" if most else "")
        gain = f"{number(times[0] / times[1])} ({number(GAIN_OF_TWO_THREADS)})"
        rows.append([name, f"**{one}**" if most and times[0] > most else one, number(times[1]),
                     gain if times[0] / times[1] >= GAIN_OF_TWO_THREADS else f"**{gain}**"])
    return BUILDS_NOTE + table(["mesh", "one thread", "two threads", "gain"], rows) if rows else ""


def build_of(pieces):
    """µs a vertex, the median of all radii and questions; None without any."""
    times = [1e6 * rows[OURS]["build_seconds"]["median"] / piece["vertices"]
             for piece in pieces.values() for question, rows in piece["questions"].items()
             if is_measured(piece, question, OURS)]
    return statistics.median(times) if times else None


def compared(question, ours, other, key, piece, aim):
    if piece is None or aim is None or not all(is_measured(piece, question, name) for name in (ours, other)):
        return ""
    reached = microseconds(piece, question, other, key) / microseconds(piece, question, ours, key)
    text = f"{number(reached)} ({number(aim)})"
    return text if reached >= aim else f"**{text}**"


HEAD_NOTE = """From the arrays of a mesh to the counts and curvatures of all vertices on two threads, beside the same with the index in
hand (`{command}`), in µs a vertex; *BFS* is the reference search with the adjacency that it needs.{remark}

"""


def head_table(data):
    """The table of the README."""
    remark = " **Preliminary figures.**" if machine.is_busy(data["machine"]) else ""
    rows = []
    for (name, threads), pieces in grouped(data).items():
        if threads != max(threads for _, threads in grouped(data)):
            continue
        for edges, piece in pieces.items():
            rows.append([f"{name}, {edges}", *(number(microseconds(piece, *what)) for what in
                                               (("counts", BFS), ("counts", OURS), ("counts", OURS, IN_HAND),
                                                ("curvature", OURS), ("curvature", OURS, IN_HAND)))])
    header = ["mesh, radius in mean edges", "BFS, counts", "counts", "in hand", "curvature", "in hand"]
    return "\n" + HEAD_NOTE.format(command=COMMAND, remark=remark) + table(header, rows) + "\n"


def summary(data):
    """Counts on the most threads, and the goals."""
    return (f"`{COMMAND}`: what users do, from arrays in memory, beside other libraries."
            f" [All figures](benchmarks/arrays.md).\n\n{head_table(data)}")
