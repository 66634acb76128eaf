# SPDX-License-Identifier: MIT
"""Calls on a class instead of an instance."""

from __future__ import annotations

import functools
from abc import ABCMeta  # so that subclasses may have it, too
from types import FunctionType
from typing import TYPE_CHECKING, Any


class NeedsInstance(ABCMeta):
    """Of a class whose methods, where they are called on the class itself, say that they need an instance. Calls on an
    instance do not come here, and take no longer."""

    if not TYPE_CHECKING:

        def __getattribute__(cls, name: str) -> Any:
            found = super().__getattribute__(name)
            if name.startswith("_") or not isinstance(found, FunctionType):
                return found

            @functools.wraps(found)
            def method(*arguments: Any, **words: Any) -> Any:
                if not (arguments and isinstance(arguments[0], cls)):
                    raise TypeError(
                        f"{cls.__name__}.{name}: called on the class, expected on an instance: "
                        f"{cls.__name__}(V, F).{name}(...)"
                    )
                return found(*arguments, **words)

            return method
