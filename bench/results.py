# SPDX-License-Identifier: MIT
"""Results as files: what is measured is kept as JSON, and everything shown is made from that."""
import json

from . import machine, places


def save(name, data, measured_on):
    places.RESULTS.mkdir(parents=True, exist_ok=True)
    document = {"machine": measured_on, **data}
    (places.RESULTS / f"{name}.json").write_text(json.dumps(rounded(document), indent=1) + "\n", encoding="utf-8")
    print(f"wrote docs/benchmarks/{name}.json")


def load(name):
    """What `save` has written, or None."""
    path = places.RESULTS / f"{name}.json"
    return json.loads(path.read_text(encoding="utf-8")) if path.exists() else None


def begin(what):
    print(f"{what} ...", flush=True)
    return machine.describe()


def rounded(value):
    """Floats to five digits: more is noise."""
    if isinstance(value, float):
        return float(f"{value:.5g}")
    if isinstance(value, dict):
        return {key: rounded(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [rounded(item) for item in value]
    return value
