# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""A table that is printed row by row while it is made, and written as CSV at its end."""
import csv
import pathlib


class Printed:
    """A table whose rows are printed as they come."""

    def __init__(self, *head: str) -> None:
        """Prints the names of the columns."""
        self.rows: list[tuple[str, ...]] = []
        self.add(*head)

    def add(self, *row: str) -> None:
        """Prints a row."""
        self.rows.append(row)
        print("  ".join(row), flush=True)

    def write(self, file: pathlib.Path | None) -> None:
        """Writes the table as CSV, unless there is no file."""
        if file is None:
            return
        file.parent.mkdir(parents=True, exist_ok=True)
        with file.open("w", newline="") as opened:
            csv.writer(opened, lineterminator="\n").writerows(self.rows)
