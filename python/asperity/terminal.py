# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""What commands print: tables, progress, durations."""

from __future__ import annotations

import math
import os
import re
import shutil
import sys
import time

from .errors import SceneError
from .units import MILLIJOULE

PROGRESS_MODES = ("auto", "bar", "lines", "off")


def table(heads: list[str], rows: list[list[str]], left: tuple[int, ...] = (0,)) -> str:
    """Returns a table for the terminal, numbers to the right.

    Parameters
    ----------
    heads : list[str]
        Heads of the columns.
    rows : list[list[str]]
        Cells of each row; an empty row is a rule.
    left : tuple[int, ...]
        Columns that are set to the left.

    Returns
    -------
    str
        The lines.
    """
    width = [max(len(line[i]) for line in [heads, *rows] if len(line) > i) for i in range(len(heads))]
    rule = "  " + "─" * (sum(width) + 2 * len(width) - 2)

    def line(cells: list[str]) -> str:
        cells = cells + [""] * (len(heads) - len(cells))
        return "  " + "  ".join(c.ljust(w) if i in left else c.rjust(w)
                                for i, (c, w) in enumerate(zip(cells, width))).rstrip()

    return "\n".join([line(heads), rule, *(line(row) if row else rule for row in rows)])


def number(value: float, decimals: int) -> str:
    """Spells a number for people: with so many decimals, or with more if these would show less than three significant digits,
    and with powers of ten if it is tiny or huge. The rule of io/terminal.cpp.

    Parameters
    ----------
    value : float
        Number.
    decimals : int
        Decimals.

    Returns
    -------
    str
        The text.
    """
    size = abs(value)
    if not math.isfinite(value):
        return "-"
    if size >= 1e7:
        return f"{value:.3e}"
    if value == 0 or size * 10.0**decimals >= 99.5:  # rounded, it has three digits
        return f"{value if value else 0.0:.{decimals}f}"
    if size < 0.9995e-3:
        return f"{value:.2e}"
    return f"{value:.{2 - math.floor(math.log10(size))}f}"


def minus(text: str) -> str:
    """Replaces the minus sign of a number by the one that is as wide as a digit."""
    return "−" + text[1:] if text.startswith("-") else text


def millijoules(gamma: float) -> str:
    """Returns an energy over an area, meV/Å², in mJ/m²: "1120", "7.65"."""
    return number(gamma * MILLIJOULE, 0)


def duration(seconds: float) -> str:
    """Returns "45 s", "2 min 05 s", "3 h 10 min"."""
    whole = int(seconds + 0.5)
    if seconds < 9.95:
        return f"{seconds:.1f} s"
    if whole < 60:
        return f"{whole} s"
    if whole < 3600:
        return f"{whole // 60} min {whole % 60:02} s"
    if whole < 86400:
        return f"{whole // 3600} h {whole // 60 % 60:02} min"
    return f"{whole // 86400} d {whole // 3600 % 24:02} h"


def parse_duration(text: str) -> float:
    """Returns the seconds of "23h50m", "45m", "90s" or "90". Raises SceneError."""
    match = re.fullmatch(r"(?:([\d.]+)d)?(?:([\d.]+)h)?(?:([\d.]+)m(?:in)?)?(?:([\d.]+)s)?|([\d.]+)", text)
    try:
        parts = zip(match.groups() if match else (), (86400, 3600, 60, 1, 1))
        seconds = math.fsum(float(part) * unit for part, unit in parts if part)
    except ValueError:
        seconds = 0.0
    if not seconds > 0:
        raise SceneError(f"--wall-limit {text}", "is no length of time", "", "for example 23h50m, 45m or 90s")
    return seconds


def launched() -> tuple[int, bool]:
    """Tells whether a launcher has started this process. The rule is that of launched_in_parallel() of the program
    (decomposition/communicator.hpp).

    Returns
    -------
    tuple[int, bool]
        The rank of this process, and True if a launcher says that it has started more than one.
    """
    for size, rank in (("OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK"), ("PMI_SIZE", "PMI_RANK"),
                       ("SLURM_STEP_NUM_TASKS", "SLURM_PROCID")):
        if size in os.environ:
            return int(os.environ.get(rank, "0")), int(os.environ[size]) > 1
    return int(os.environ.get("PMIX_RANK", "0")), "PMIX_RANK" in os.environ


def environment_alone() -> dict[str, str]:
    """Returns the environment for a program that is one process, also if this one is a rank that a launcher has started."""
    if not launched()[1]:
        return dict(os.environ)
    of_rank = re.compile("OMPI_(?!ALLOW|MCA)|OMPI_MCA_(orte|ess|pmix|plm|shmem)|PMI|HYDRA_|MPI_LOCAL|"
                         "SLURM_(STEP|PROCID)")
    return {name: value for name, value in os.environ.items() if not of_rank.match(name)}


class Progress:
    """A bar that is drawn over (on a terminal) or lines that get rarer, to stderr."""

    def __init__(self, mode: str = "auto"):
        if mode not in PROGRESS_MODES:
            raise SceneError(f"--progress {mode}", "is none of its choices", "choices: " + ", ".join(PROGRESS_MODES))
        terminal = sys.stderr.isatty()
        if mode == "auto" or (mode == "bar" and not terminal):
            mode = "bar" if terminal else "lines"
        self.mode = mode
        self._start = self._last = time.monotonic()
        self._drawn = False

    def due(self) -> bool:
        """Returns True if it is time for the next update()."""
        elapsed = time.monotonic() - self._start
        wait = 0.2 if self.mode == "bar" else 2.0 if elapsed < 10 else 10.0 if elapsed < 100 else 0.1 * elapsed
        return self.mode != "off" and time.monotonic() - self._last >= wait

    def update(self, text: str) -> None:
        """Shows a text in place of the last one."""
        self._last = time.monotonic()
        if self.mode == "bar":
            sys.stderr.write("\r\033[K" + text[: shutil.get_terminal_size((110, 24)).columns - 1])
            self._drawn = True
        elif self.mode == "lines":
            sys.stderr.write(text + "\n")
        sys.stderr.flush()

    def say(self, sentence: str) -> None:
        """Writes a sentence that stays."""
        if self.mode != "off":
            self.finish()
            sys.stderr.write(sentence + "\n")
            sys.stderr.flush()

    def finish(self) -> None:
        """Removes the bar."""
        if self._drawn:
            sys.stderr.write("\r\033[K")
            sys.stderr.flush()
        self._drawn = False


def progress_shown(wanted: bool | None) -> bool:
    """Returns True if progress is to be shown; wanted None: on a terminal or in a notebook."""
    if wanted is not None:
        return bool(wanted)
    return sys.stderr.isatty() or type(sys.stderr).__module__.startswith("ipykernel")
