# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Losses of a result beside `lost`: energy that memories of the solids dissipate, named dissipated_in_... by the engine."""

from __future__ import annotations

from collections.abc import Iterable

DISSIPATED_IN = "dissipated_in_"


def losses(names: Iterable[str]) -> dict[str, str]:
    """Returns the losses among names of a result, of its columns or of its series: {"block": "dissipated_in_block"}."""
    heads = dict.fromkeys(name.partition(".")[0] for name in names)
    return {head.removeprefix(DISSIPATED_IN).replace("_", " "): head for head in heads if head.startswith(DISSIPATED_IN)}
