# SPDX-License-Identifier: MIT
"""Other products on the same queries."""
from .markdown import number, table, with_spread

NOTE = """## Peers

`make peers`: each product in a process of its own, all in one run on the same vertices, {blocks} blocks in turn of as many
queries as about {seconds:g} s allow; microseconds a query by the clock on the wall, answers made but not read. One thread:
the process is held to one processor. Who answers only for all vertices at once is asked so, and the time shared out; who
takes minutes for one step is given up, and the table says so. Extra and missing: vertices a query against the exact
answer, on 20 vertices. Memory: what building added to the process. A product that answers another question is labelled
so; a ball is the wrong answer wherever two sheets lie close.

"""


def text(data):
    parts = [NOTE.format(blocks=data["blocks"], seconds=data["block_seconds"]), versions(data)]
    for contest in data["contests"]:
        order = "as in the file" if contest["order"] == "file" else "shuffled"
        found = next((peer["found"] for peer in contest["peers"]), 0)
        parts.append(f"\n### {contest['name']}, {contest['radius_edges']:g} average edges, {contest['threads']} thread"
                     f"{'s' if contest['threads'] == 'all' else ''}, vertices {order}\n\n{contest['mesh']};"
                     f" {contest['vertices']:,} vertices, {found:,.0f} found a query.\n\n{contest_table(contest)}")
    return "".join(parts)


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
