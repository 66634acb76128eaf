# SPDX-License-Identifier: MIT
"""Other libraries on the same queries."""
from .markdown import number, table, with_spread

TITLE = "Other libraries"

NOTE = """`make peers`: each library runs in a process of its own, all in one run on the same vertices, in {blocks} alternating blocks
of about {seconds:g} s. Times are µs a query, wall clock; answers are computed but not read. One thread: the process is
bound to one processor. A library that only answers all vertices at once is called for all, and its time is divided by
their number. A library that takes minutes for one step is stopped, and the table says so. Extra and missing: vertices
of a query compared with the exact answer, on 20 vertices. MB: the memory that building added to the process. The column
`answers` names the kind of answer; a ball is wrong wherever two sheets lie close together.

"""

SUMMARY_NOTE = """`make peers`: {name}, {radius:g} mean edges, {found:,.0f} vertices found, {threads}, vertices in the order of the file; µs a
query, wall clock. Extra and missing vertices are compared with the exact answer. Other meshes, radii, threads, shuffled
vertices and curvature: [benchmarks/peers.md](benchmarks/peers.md).

"""


def text(data):
    parts = [NOTE.format(blocks=data["blocks"], seconds=data["block_seconds"]), versions(data)]
    for contest in data["contests"]:
        order = "as in the file" if contest["order"] == "file" else "shuffled"
        found = next((peer["found"] for peer in contest["peers"]), 0)
        parts.append(f"\n## {contest['name']}, {contest['radius_edges']:g} mean edges, {contest['threads']} thread"
                     f"{'s' if contest['threads'] == 'all' else ''}, vertices {order}\n\n{contest['mesh']};"
                     f" {contest['vertices']:,} vertices, {found:,.0f} found a query.\n\n{contest_table(contest)}")
    return "".join(parts)


def summary(data):
    """The contest of the largest mesh on one thread, with the libraries that search neighborhoods."""
    contests = [c for c in data["contests"] if c["order"] == "file" and c["threads"] == "one"] or data["contests"]
    contest = max(contests, key=lambda c: (c["vertices"], c["radius_edges"]))
    header = ["", "answers", "µs a query (quartiles)", "extra", "missing", "built s"]
    timed = sorted((peer for peer in contest["peers"] if "microseconds" in peer and "curvature" not in peer["answers"]),
                   key=lambda peer: peer["microseconds"]["median"])
    note = SUMMARY_NOTE.format(name=contest["name"], radius=contest["radius_edges"], found=timed[0]["found"],
                               threads="one thread" if contest["threads"] == "one" else "all threads")
    return note + table(header, [timed_row(peer)[:6] for peer in timed])


def versions(data):
    known = {peer["name"].split(",")[0].split(" ")[0]: peer["version"] for contest in data["contests"]
             for peer in contest["peers"] if peer.get("version")}
    return "Versions: " + ", ".join(f"{name} {version}" for name, version in known.items()) + ".\n"


def contest_table(contest):
    header = ["", "answers", "µs a query (quartiles)", "extra", "missing", "built s (once)", "MB", "remark"]
    timed = sorted((peer for peer in contest["peers"] if "microseconds" in peer),
                   key=lambda peer: peer["microseconds"]["median"])
    others = [peer for peer in contest["peers"] if "microseconds" not in peer]
    return table(header, [timed_row(peer) for peer in timed] + [other_row(peer) for peer in others])


def timed_row(peer):
    took = peer["microseconds"]
    differences = [number(peer[key]) if key in peer else "" for key in ("extra", "missing")]
    runs = f"{peer['queries']:,} queries × {took['runs']}"
    remark = "; ".join(part for part in (peer["remark"], runs, failure(peer)) if part)
    return [peer["name"], peer["answers"], with_spread(took["median"], took["quartiles"]), *differences,
            number(peer["build_seconds"]), number(peer["bytes"] / 1e6), remark]


def other_row(peer):
    return [peer["name"], peer["answers"], "—", "", "", "", "", failure(peer) or f"left out: {peer.get('left_out', '')}"]


def failure(peer):
    return f"**failed: {peer['failure'].replace('|', '/')}**" if "failure" in peer else ""
