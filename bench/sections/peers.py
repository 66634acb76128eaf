# SPDX-License-Identifier: MIT
"""Other libraries on the same queries."""
from .markdown import number, table


def times(data):
    """µs a query of each contest on one thread with the vertices as in the file; the rest is about the last of them."""
    contests = [c for c in data["contests"] if c["order"] == "file" and c["threads"] == "one"] or data["contests"]
    columns = [f"{c['name']}, {c['radius_edges']:g}" for c in contests]
    by_name = [{peer["name"]: peer for peer in contest["peers"]} for contest in contests]
    last = sorted(by_name[-1].values(), key=lambda peer: peer.get("microseconds", {}).get("median", float("inf")))
    rows = [[peer["name"], peer["answers"], *(took(peers.get(peer["name"], {})) for peers in by_name),
             *(number(peer[key]) if key in peer else "" for key in ("extra", "missing", "build_seconds")),
             number(peer["bytes"] / 1e6) if "bytes" in peer else ""] for peer in last]
    return table(["", "answers", *columns, "extra", "missing", "built, s", "MB"], rows) + f"\n{versions(data)}"


def took(peer):
    return number(peer["microseconds"]["median"]) if "microseconds" in peer else "—"


def versions(data):
    known = {peer["name"].split(",")[0].split(" ")[0]: peer["version"] for contest in data["contests"]
             for peer in contest["peers"] if peer.get("version")}
    return "Versions: " + ", ".join(f"{name} {version}" for name, version in known.items()) + ".\n"
