# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""What commands print: tables, progress, durations."""

from __future__ import annotations

import html
import json
import math
import os
import re
import shutil
import sys
import time
from collections.abc import Iterable, MutableMapping
from typing import Any

from .errors import SceneError, printable
from .units import MILLIJOULE

WIDTH = 80
"""Columns of text that a line fills at most, as in the program (io/terminal.hpp)."""
LEAST = 20
"""Columns of a last column of text that is broken to fit."""
PROGRESS_MODES = ("auto", "bar", "lines", "off")


def wrapped(text: str, most: int) -> list[str]:
    """Returns a text in lines that are broken at blanks; a unit stays behind its number."""
    lines = [""]
    for word in text.split(" "):
        if lines[-1] and len(lines[-1]) + 1 + len(word) > most:
            before, _, last = lines[-1].rpartition(" ")
            both = bool(before) and bool(re.fullmatch(r"[-+(.\de]+", last) and re.search(r"\d", last[:2]))
            lines[-1:] = [before, last] if both else [lines[-1], ""]
        lines[-1] += " " * bool(lines[-1]) + word
    return lines


def folded(text: str, indent: int = 0) -> str:
    """Returns a printable text whose lines fill at most WIDTH columns, as folded() of the program (io/terminal.cpp) makes it.

    The rest of a longer line stands below its first word, of a line "  name   value" below the value, and of "note: ..." below the
    text."""
    return "\n".join(_folded_line(line, indent) for line in printable(text).split("\n"))


def _folded_line(line: str, of_margin: int) -> str:
    if len(line) <= WIDTH:
        return line
    first = len(line) - len(line.lstrip(" "))
    gap = re.compile(r"  +").search(line, first)
    label = re.compile(r"why: |fix: |note: |\$ ").match(line, first)
    begin = label.end() if label else gap.end() if gap and gap.start() < 20 else first
    indent = begin or of_margin
    return line[:begin] + ("\n" + " " * indent).join(wrapped(line[begin:], WIDTH - indent))


def table(heads: list[str], rows: list[list[str]], left: tuple[int, ...] = (0,), again: tuple[int, ...] = (0,)) -> str:
    """Returns a table for the terminal, numbers to the right. If it is wider than WIDTH, the cells of a last column of text are broken, or the table
    is divided into parts below each other."""
    width = [max(len(line[i]) for line in [heads, *rows] if len(line) > i) + 2 for i in range(len(heads))]
    last = len(heads) - 1
    if last in left and sum(width) > WIDTH:
        width[last] = max(min(width[last], LEAST), width[last] - (sum(width) - WIDTH))
    parts: list[list[int]] = [[]]
    for i in range(len(heads)):
        if sum(width[k] for k in parts[-1]) + width[i] > WIDTH and set(parts[-1]) - set(again):
            parts.append([k for k in again if k != i])
        parts[-1].append(i)

    def line(cells: list[str], part: list[int]) -> str:
        cells = [cells[k] if k < len(cells) else "" for k in part]
        lines = []
        for piece in wrapped(cells[-1], width[part[-1]] - 2):
            cells[-1] = piece
            lines.append("".join("  " + (cell.ljust(width[k] - 2) if k in left else cell.rjust(width[k] - 2))
                                 for k, cell in zip(part, cells)).rstrip())
            cells = [""] * len(cells)
        return "\n".join(lines)

    def one(part: list[int]) -> str:
        rule = "  " + "─" * (sum(width[k] for k in part) - 2)
        return "\n".join([line(heads, part), rule, *(line(row, part) if row else rule for row in rows)])

    return "\n\n".join(map(one, parts))


def html_table(title: str, heads: Iterable[str], rows: Iterable[Iterable[str]], below: str = "") -> str:
    """Returns a small table for a notebook."""
    def cells(tag: str, row: Iterable[str]) -> str:
        return "<tr>" + "".join(f"<{tag}>{html.escape(cell)}</{tag}>" for cell in row) + "</tr>"

    heads = list(heads)
    return (f"<p><b>{html.escape(title)}</b></p><table>" + (cells("th", heads) if heads else "") + "".join(cells("td", row) for row in rows)
            + "</table>" + (f"<p>{html.escape(below)}</p>" if below else ""))


def number(value: float, decimals: int) -> str:
    """Spells a number for people, with this number of decimals, with more decimals if needed for three significant digits, and with powers of ten for
    very small or large values, as io/terminal.cpp does."""
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
    (decomposition/communicator.hpp)."""
    for size, rank in (("OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK"), ("PMI_SIZE", "PMI_RANK"),
                       ("SLURM_STEP_NUM_TASKS", "SLURM_PROCID")):
        if size in os.environ:
            return int(os.environ.get(rank, "0")), int(os.environ[size]) > 1
    return int(os.environ.get("PMIX_RANK", "0")), "PMIX_RANK" in os.environ


def sleep_soon(environment: MutableMapping[str, str]) -> None:
    """Sets an environment in which waiting threads of OpenMP sleep soon, as the script `asperity` does, unless OMP_WAIT_POLICY is set."""
    if "OMP_WAIT_POLICY" not in environment:
        environment.setdefault("GOMP_SPINCOUNT", "3000")
        environment.setdefault("KMP_BLOCKTIME", "0")


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
            sys.stderr.write("\r\033[K" + printable(text)[: shutil.get_terminal_size((WIDTH, 24)).columns - 1])
            self._drawn = True
        elif self.mode == "lines":
            sys.stderr.write(folded(text) + "\n")
        sys.stderr.flush()

    def say(self, sentence: str) -> None:
        """Writes a sentence that stays."""
        if self.mode != "off":
            self.finish()
            sys.stderr.write(folded(sentence) + "\n")
            sys.stderr.flush()

    def finish(self) -> None:
        """Removes the bar."""
        if self._drawn:
            sys.stderr.write("\r\033[K")
            sys.stderr.flush()
        self._drawn = False


class Voice:
    """Voice of a command: it prints sentences on the course and results, or with --json one line of JSON in place of both.

    quiet : prints results alone
    json : prints what tell() is given, and nothing else
    progress : mode of Progress; None: "off" if quiet or json, else "auto"
    """

    def __init__(self, quiet: bool = False, json: bool = False, progress: str | None = None):
        self.quiet, self.json = quiet, json
        self.progress = progress or ("off" if quiet or json else "auto")
        Progress(self.progress)  # refuses what is no mode before anything is done

    def say(self, sentence: str) -> None:
        """Prints a sentence on the course of the command or a note, unless it is quiet."""
        if not self.quiet and not self.json:
            print(folded(sentence), flush=True)

    def show(self, text: str) -> None:
        """Prints a result for people."""
        if not self.json:
            print(folded(text), flush=True)

    def tell(self, values: Any) -> None:
        """Prints a result for programs, if they ask; numbers that are not finite are null."""
        if self.json:
            print(json.dumps(_finite(values), ensure_ascii=False).encode("utf-8", "replace").decode(), flush=True)


def _finite(value: Any) -> Any:
    if isinstance(value, dict):
        return {str(name): _finite(member) for name, member in value.items()}
    if isinstance(value, (list, tuple)):
        return [_finite(member) for member in value]
    if hasattr(value, "tolist"):  # numpy's
        return _finite(value.tolist())
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    return value if value is None or isinstance(value, (str, int)) else str(value)


def progress_shown(wanted: bool | None) -> bool:
    """Returns True if progress is to be shown; wanted None: on a terminal or in a notebook."""
    if wanted is not None:
        return bool(wanted)
    return sys.stderr.isatty() or type(sys.stderr).__module__.startswith("ipykernel")
