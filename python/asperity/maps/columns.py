# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Columns of numbers as text, as instruments export them: cells stand between tabs, semicolons, commas or blanks, with decimal points
or commas; comments begin with #, % or //.
"""

from __future__ import annotations

import math
import re
from pathlib import Path

from ..errors import meant
from .channels import refuse

COMMENTS = ("#", "%", "//", "!")


def lines_of(path: Path) -> list[str]:
    """Returns the lines of a text in UTF-8, UTF-16 or Windows-1252. Raises InputOutputError."""
    try:
        data = path.read_bytes()
    except OSError as error:
        fix = "" if path.exists() else meant(path)
        raise refuse(path, "cannot be read", error.strerror or error, fix or "check the path and its permissions") from None
    if data[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return data.decode("utf-16", "replace").splitlines()
    try:
        return data.decode("utf-8-sig").splitlines()
    except UnicodeDecodeError:
        return data.decode("cp1252", "replace").splitlines()


def is_row(line: str) -> bool:
    """Returns True for a line that begins with a number."""
    return bool(re.match(r"""["']?[-+]?[.,]?\d""", line.strip()))


def rows_of(lines: list[str]) -> tuple[int | None, list[str]]:
    """Returns the index of the first line that begins with a number (None: no line does), and all lines that do."""
    rows = [k for k, line in enumerate(lines) if is_row(line)]
    return rows[0] if rows else None, [lines[k] for k in rows]


def separator_of(path: Path, rows: list[str], wanted: int) -> tuple[str | None, bool]:
    """Returns what separates the cells (None: blanks), and True if commas are decimal points. wanted: number of names; 0:
    unknown."""
    body = "\n".join(rows)
    for separator in "\t;":
        if separator in body:
            return separator, bool(re.search(r"\d,\d", body))
    if "," not in body:
        return None, False
    decimal = bool(re.search(r"[ ]", "\n".join(row.strip() for row in rows))) and not re.search(r",\s|\s,|\.", body)
    if decimal:
        return None, True
    cells = {len(row.split(",")) for row in rows}
    if wanted and min(cells) > wanted and '"' not in body:
        raise refuse(path, "the commas may be decimal points or separate the cells",
                     f"its header names {wanted} columns, and a row has {min(cells)} cells between commas",
                     "separate the cells by tabs or semicolons, or write decimal points")
    return ",", '"' in body and bool(re.search(r'"[^"]*\d,\d[^"]*"', body))


def cells_of(line: str, separator: str | None) -> list[str]:
    """Returns the cells of a line."""
    if separator == "," and '"' in line:
        found = [quoted or plain for quoted, plain in re.findall(r'"((?:[^"]|"")*)"|([^,]+)', line)]
    else:
        found = line.split(separator) if separator else re.split(r"\s{2,}", line.strip())
        if separator is None and len(found) < 3:
            found = re.split(r"\s+(?![\[(])", line.strip())  # a unit in brackets belongs to the name before it
    return [re.sub(r'^"(.*)"$', r"\1", cell.strip()).strip() for cell in found]


def numbers_of(path: Path, lines: list[str], first: int, separator: str | None, decimal: bool, width: int) -> list[tuple[int, list[float]]]:
    """Returns the rows of numbers, each with the number of its line. width: fewest cells. Raises InputOutputError."""
    rows = []
    for number, line in enumerate(lines[first:], first + 1):
        text = line.strip()
        if not text or text.startswith(COMMENTS):
            continue
        cells = cells_of(text, separator) if separator else text.split()
        try:
            values = [float(cell.replace(",", ".") if decimal else cell) if cell else math.nan for cell in cells]
        except ValueError as error:
            raise refuse(f"{path}:{number}", "the line is no row of numbers", error, "take it out, or put a # before it") from None
        if len(values) < width:
            raise refuse(f"{path}:{number}", "the line has too few numbers", f"{len(values)}, and the columns before it end with "
                         f"number {width}", "fill the row, or take it out")
        rows.append((number, values))
    return rows
