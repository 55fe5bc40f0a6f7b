# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Late imports. Results do not import what draws them and writes their pages, which stands above them; matplotlib and jinja2 are
imported with the first plot or report."""

from __future__ import annotations

import importlib
from typing import Any


def from_above(name: str) -> Any:
    """Returns a function or a class of a module that stands above the caller's, "plots.run.RunPlots", and imports the module."""
    module, _, function = name.rpartition(".")
    return getattr(importlib.import_module(f"{__package__}.{module}"), function)
