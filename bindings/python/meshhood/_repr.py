# SPDX-License-Identifier: MIT
"""How results are shown."""

from __future__ import annotations

from typing import Any, TypeVar

import numpy as np


Result = TypeVar("Result", bound=type)


def shown_in_a_line(result: Result) -> Result:
    """A named tuple whose arrays are shown by their shapes; three numbers, as of a point, and all else as they are."""
    setattr(result, "__repr__", _in_a_line)
    return result


def _in_a_line(result: Any) -> str:
    parts = [f"{name} {_shown(value)}" for name, value in zip(result._fields, result)]
    return f"<meshhood.{type(result).__name__}: {', '.join(parts)}>"


def _shown(value: Any) -> str:
    if isinstance(value, tuple):
        return f"({', '.join(map(_shown, value))})"
    shape = np.shape(value)
    if len(shape) == 1 and shape != (3,):
        return f"{shape[0]} value" + "s" * (shape != (1,))
    return f"{value}" if shape in ((), (3,)) else " by ".join(map(str, shape))
