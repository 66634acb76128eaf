# SPDX-License-Identifier: MIT
"""Calls on a class instead of an instance."""

from __future__ import annotations

import functools
from abc import ABCMeta  # so that subclasses may have it, too
from types import FunctionType
from typing import TYPE_CHECKING, Any, Callable

_checked: dict[FunctionType, Callable[..., Any]] = {}  # methods of this package, by the functions that they call


def check_instance(method: FunctionType) -> None:
    """Lets the method, where it is called on a class, say that it needs an instance."""

    @functools.wraps(method)
    def call(*arguments: Any, **words: Any) -> Any:
        # `__class__`, because the type of a weak reference is another.
        if not (arguments and isinstance(arguments[0].__class__, NeedsInstance)):
            cls, _, name = method.__qualname__.partition(".")
            raise TypeError(f"{cls}.{name}: called on the class, expected on an instance: {cls}(V, F).{name}(...)")
        return method(*arguments, **words)

    _checked[method] = call


class NeedsInstance(ABCMeta):
    """Of a class with such methods. Calls on an instance do not come here, and take no longer."""

    if not TYPE_CHECKING:

        def __getattribute__(cls, name: str) -> Any:
            found = super().__getattribute__(name)
            return _checked.get(found, found) if isinstance(found, FunctionType) else found
