# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""What commands of studies share: the forecast that they print, the options of their runs, and workers."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

from ..terminal import Voice

if TYPE_CHECKING:
    from ..running.pool import PoolOptions
    from ..studies.estimate import Estimate
    from ..studies.estimates import Estimating
    from ..studies.forecast import Forecast

EARLY = "Stopped early: the same command goes on from here."


@contextlib.contextmanager
def on_workers(executor: str, options: PoolOptions) -> Iterator[bool]:
    """Starts the workers of --executor, "" for none, for the runs. Yields False in a rank that has been a worker of the first one."""
    from ..running.pool import executor_of

    with executor_of(executor) if executor else contextlib.nullcontext() as workers:
        options.executor = workers
        yield not executor or workers is not None


def show_estimate(found: Estimate, making: Estimating, voice: Voice) -> None:
    """Shows the numbers of an estimate, with the notes that were not said while it was made."""
    voice.show(str(replace(found, notes=[note for note in found.notes if note not in making.said])))
    voice.tell({**found.json(), "directory": making.place})


def told(forecast: Forecast, plan: bool, voice: Voice) -> bool:
    """Tells what a study will run."""
    for line in forecast.lines:
        (voice.show if plan else voice.say)(line)
    if plan:
        voice.tell(forecast.json())
    return plan
