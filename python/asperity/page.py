# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""A self-contained HTML page of sections, and the files of its figures in report/ beside it."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import jinja2
from markupsafe import Markup, escape
from matplotlib.axes import Axes

from . import files
from .errors import Error
from .plots import style as figures


def file_name(text: str) -> str:
    """A name ("every:1000") as part of the name of a file or an element."""
    return re.sub(r"[^A-Za-z0-9.-]", "-", text)


def _set(text: Any) -> Markup:
    """Escaped, with its subscripts γ_{eff} and `commands`, and units that stay with their numbers."""
    out = re.sub(r"_\{([^}]*)\}", r"<sub>\1</sub>", str(escape(str(text))))
    out = re.sub(r"(?<=\d)e-(?=\d)", "e\u2011", out)  # no line ends in a number
    out = re.sub(r"`([^`]*)`", r"<code>\1</code>", out)
    return Markup(out.replace(" meV/Å", "\u00a0meV/\u2060Å").replace(" mJ/m", "\u00a0mJ/\u2060m"))


@dataclass
class Section:
    id: str
    heading: str
    parts: list[tuple[str, Any]] = field(default_factory=list)


@dataclass
class Page:
    """Built from top to bottom; `write()` makes DIR/report.html."""

    directory: Path
    kicker: str
    title: str
    lead: str
    notices: list[tuple[str, str]] = field(default_factory=list)
    sections: list[Section] = field(default_factory=lambda: [Section("", "")])
    kinds: tuple[str, ...] = figures.KINDS
    """of files of its figures"""
    files: int = 0
    said: str = ""
    """what write() wrote, in words"""
    unread: list[str] = field(default_factory=list)
    """what of the result could not be read; the page says it as well"""

    @property
    def path(self) -> Path:
        return self.directory / "report.html"

    def section(self, id: str, heading: str) -> None:
        self.sections.append(Section(id, heading))

    def add(self, kind: str, content: Any) -> None:
        if content:
            self.sections[-1].parts.append((kind, content))

    def table(self, heads: list[str], rows: list[list[str]], links: list[str] | None = None) -> None:
        """links: where the first cell of each row leads."""
        self.add("table", rows and {"heads": heads, "rows": list(zip(rows, links or [""] * len(rows)))})

    def figure(self, id: str, heading: str, caption: str, draw: Callable[[Axes], bool]) -> bool:
        """A figure in the section, with PNG, PDF, SVG and CSV. False: there was nothing to draw."""
        try:
            fig = figures.make(draw)
        except Error as error:  # data that a damaged file lacks
            note = (f"{heading}: no figure", str(error))
            if note not in self.notices:
                self.notices.append(note)
                self.unread.append(str(error).splitlines()[0])
            return False
        if fig is None:
            return False
        stem = files.directory(self.directory / "report") / id
        self.files += len(figures.save(fig, stem, self.kinds)) + 1
        files.write(stem.with_name(id + ".csv"), figures.csv(fig))
        parts = self.sections[-1].parts
        if not parts or parts[-1][0] != "figures":
            parts.append(("figures", []))
        parts[-1][1].append({"id": id, "heading": heading, "caption": caption, "svg": figures.inline_svg(fig),
                             "data": figures.readout(fig),
                             "kinds": ", ".join("." + kind for kind in (*self.kinds, "csv"))})
        return True

    def write(self) -> None:
        """Writes the page, without sections that hold nothing."""
        self.sections = [s for s in self.sections if s.parts]
        loader = jinja2.FileSystemLoader(Path(__file__).parent / "templates")
        environment = jinja2.Environment(loader=loader, autoescape=True, trim_blocks=True)
        environment.filters["set"] = _set
        text = environment.get_template("page.html").render(page=self)
        files.write(self.path, text)
        self.said = (f"{self.path}: one page, {len(text.encode()) / 1e6:.1f} MB, nothing else needed; "
                     f"{self.files} files of its figures in {self.directory / 'report'}")
