# SPDX-License-Identifier: MIT
"""How results are shown."""

from __future__ import annotations

from typing import Any

import numpy as np


def in_a_line(result: Any) -> str:
    """Of a named tuple: the shape of each array, and what is no array as it is."""
    parts = [f"{name} {_shown(value)}" for name, value in zip(result._fields, result)]
    return f"<meshhood.{type(result).__name__}: {', '.join(parts)}>"


def _shown(value: Any) -> str:
    if isinstance(value, tuple):
        return f"({', '.join(map(_shown, value))})"
    return " by ".join(map(str, np.shape(value))) or f"{value}"
