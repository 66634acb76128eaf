# SPDX-License-Identifier: MIT
"""Results as files: measurements are kept as JSON in build/benchmarks, from which all tables and plots are made."""
import json

from . import machine, places


def begin(what):
    """The argument of `save`: the machine, observed from now on."""
    print(f"{what} ...", flush=True)
    return machine.Watched()


def save(name, data, watched):
    places.RESULTS.mkdir(parents=True, exist_ok=True)
    document = {"machine": watched.description(), **data}
    path = places.RESULTS / f"{name}.json"
    path.write_text(as_text(rounded(document)) + "\n", encoding="utf-8")
    print(f"wrote {path}")


def load(name):
    """The result that `save` has written, or None."""
    path = places.RESULTS / f"{name}.json"
    return json.loads(path.read_text(encoding="utf-8")) if path.exists() else None


def as_text(value, indent=""):
    """JSON with a line for each value that fits on one, so that a changed value changes one line."""
    line = json.dumps(value)
    if not isinstance(value, (dict, list)) or len(line) < 200:
        return line
    deeper = indent + " "
    if isinstance(value, list):
        return "[\n" + ",\n".join(deeper + as_text(item, deeper) for item in value) + f"\n{indent}]"
    items = (f"{deeper}{json.dumps(key)}: {as_text(item, deeper)}" for key, item in value.items())
    return "{\n" + ",\n".join(items) + f"\n{indent}}}"


def rounded(value):
    """Floats to five digits: more is noise."""
    if isinstance(value, float):
        return float(f"{value:.5g}")
    if isinstance(value, dict):
        return {key: rounded(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [rounded(item) for item in value]
    return value
