#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Writes the tables of the pages from their CSV files: docs/tables.py [--check] [PAGE ...]

A table stands in a page between <!-- table: FILE.csv --> and <!-- end of table -->, with the file relative to the
page. <!-- table: FILE.csv rows=1,3-5 columns=1-4 --> takes some rows and columns, counted from 1 without the head.
--check changes nothing and fails where a table is not that of its file.
"""
import csv
import re
import sys
from pathlib import Path

BLOCK = re.compile(r"^<!-- table: ([^\n]*) -->\n.*?^<!-- end of table -->$", re.M | re.S)


def markdown(rows: list[list[str]]) -> str:
    """Rows, the first of which is the head, as a table of Markdown."""
    lines = ["| " + " | ".join(cell.replace("|", "\\|") for cell in row) + " |" for row in rows]
    return "\n".join([lines[0], "|" + "---|" * len(rows[0]), *lines[1:]])


def chosen(some: str, values: list, what: str) -> list:
    """Of the values those that "1,3-5" names, in its order."""
    found = []
    for part in some.split(","):
        first, last = (int(number) for number in (part.split("-") * 2)[:2])
        if not 1 <= first <= last <= len(values):
            sys.exit(f"{what}: {part} is not within 1 to {len(values)}")
        found += values[first - 1:last]
    return found


def block(table: str, page: Path) -> str:
    """A table with its marks; table: the file as the page names it, and what it takes of its rows and columns."""
    file, *options = table.split()
    with open(page.parent / file, newline="") as text:
        rows = list(csv.reader(text))
    widths = {len(row) for row in rows}
    if len(widths) != 1:
        sys.exit(f"{page}: the rows of {file} have {sorted(widths)} cells")
    for option in options:
        name, _, some = option.partition("=")
        if name not in ("rows", "columns") or not re.fullmatch(r"\d+(-\d+)?(,\d+(-\d+)?)*", some):
            sys.exit(f"{page}: {option} in the mark of {file} is not of the form rows=1,3-5 or columns=1-4")
        if name == "rows":
            rows = [rows[0], *chosen(some, rows[1:], f"{page}: rows of {file}")]
        else:
            rows = [chosen(some, row, f"{page}: columns of {file}") for row in rows]
    return f"<!-- table: {table} -->\n\n{markdown(rows)}\n\n<!-- end of table -->"


def with_tables(page: Path, text: str) -> str:
    """The text of a page with its tables as their files are."""
    return BLOCK.sub(lambda found: block(found[1], page), text)


def main() -> None:
    words = sys.argv[1:]
    check = "--check" in words
    pages = [Path(word) for word in words if word != "--check"] or sorted(Path(__file__).parent.rglob("*.md"))
    stale = []
    for page in pages:
        text = page.read_text()
        new = with_tables(page, text)
        if new != text:
            stale.append(str(page))
            if not check:
                page.write_text(new)
    if check and stale:
        sys.exit("tables are not those of their files in " + ", ".join(stale) + "; docs/tables.py writes them")


if __name__ == "__main__":
    main()
