# SPDX-License-Identifier: MIT
"""Libraries that are not installed with the package."""

import importlib
from typing import Any

_INSTALLED_AS = {"dask": "'dask[array]'"}


def optional(module: str, wish: str) -> Any:
    """`module`. `wish`: what needs it, for the error that says what to install."""
    library = module.partition(".")[0]
    try:
        return importlib.import_module(module)
    except ModuleNotFoundError as error:
        if error.name is None or error.name.partition(".")[0] != library:
            raise
        text = f"{wish} needs {library}: pip install {_INSTALLED_AS.get(library, library)}"
        raise ModuleNotFoundError(text, name=library) from None
