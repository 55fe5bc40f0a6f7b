# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""A self-contained HTML page of sections, and the files of its figures in report/ in the same directory."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import jinja2
from markupsafe import Markup, escape
from matplotlib.axes import Axes

from ..errors import Error, InternalError
from ..files import store
from ..plots import style as figures

WIDE = 24
"""Characters of a cell from which its column is one of text, which is broken into lines."""


def file_name(text: str) -> str:
    """Returns a name ("every:1000") as part of the name of a file or an element."""
    return re.sub(r"[^A-Za-z0-9.-]", "-", text)


def _set(text: Any) -> Markup:
    """Escapes a text and sets its subscripts γ_{eff} and `commands`, and keeps units with their numbers."""
    out = re.sub(r"_\{([^}]*)\}", r"<sub>\1</sub>", str(escape(str(text))))
    out = re.sub(r"(?<=\d)e-(?=\d)", "e\u2011", out)  # no line ends in a number
    out = re.sub(r"`([^`]*)`", r"<code>\1</code>", out)
    return Markup(out.replace(" meV/Å", "\u00a0meV/\u2060Å").replace(" mJ/m", "\u00a0mJ/\u2060m"))


def _no_such_form(kind: str) -> str:
    """Raises InternalError: the template would leave out a part of the page."""
    raise InternalError("page.html", f"has no form of the name {kind}", "this is a mistake in the program", "report it")


def page_files(ids: Iterable[str], kinds: Iterable[str] = figures.KINDS) -> list[str]:
    """Returns the names of the files of a page."""
    return ["report.html", *(f"report/{id}.{kind}" for id in ids for kind in (*kinds, "csv"))]


@dataclass
class Section:
    """A part of a page under a heading."""

    id: str
    heading: str
    parts: list[tuple[str, Any]] = field(default_factory=list)


@dataclass
class Page:
    """Page that is built from top to bottom; write() makes report.html in the directory of the result or another one."""

    directory: Path
    kicker: str
    title: str
    lead: str
    notices: list[tuple[str, str]] = field(default_factory=list)
    sections: list[Section] = field(default_factory=lambda: [Section("", "")])
    kinds: tuple[str, ...] = figures.KINDS
    """of files of its figures"""
    made: dict[str, bytes] = field(default_factory=dict)
    """the files of its figures, by name"""
    said: str = ""
    """what write() wrote, in words"""
    unread: list[str] = field(default_factory=list)
    """what of the result could not be read; the page says it as well"""

    @property
    def path(self) -> Path:
        """The file of the page."""
        return self.directory / "report.html"

    def section(self, id: str, heading: str) -> None:
        """Begins a section."""
        self.sections.append(Section(id, heading))

    def add(self, kind: str, content: Any) -> None:
        """Adds content to the last section, unless it is empty."""
        if content:
            self.sections[-1].parts.append((kind, content))

    def table(self, heads: list[str], rows: list[list[str]], links: list[str] | None = None) -> None:
        """Adds a table to the last section."""
        wide = {k for row in rows for k, cell in enumerate(row) if k and heads and len(cell) > WIDE}
        self.add("table", rows and {"heads": heads, "rows": list(zip(rows, links or [""] * len(rows))), "wide": wide})

    def figure(self, id: str, heading: str, caption: str, draw: Callable[[Axes], bool]) -> bool:
        """Adds a figure to the last section, with PNG, PDF, SVG and CSV."""
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
        self.made |= {f"report/{id}.{kind}": figures.picture(fig, kind) for kind in self.kinds}
        self.made[f"report/{id}.csv"] = figures.csv(fig).encode()
        parts = self.sections[-1].parts
        if not parts or parts[-1][0] != "figures":
            parts.append(("figures", []))
        parts[-1][1].append({"id": id, "heading": heading, "caption": caption, "svg": figures.inline_svg(fig),
                             "data": figures.readout(fig),
                             "kinds": ", ".join("." + kind for kind in (*self.kinds, "csv"))})
        return True

    def write(self) -> None:
        """Writes the page, without empty sections, and the files of its figures."""
        self.sections = [s for s in self.sections if s.parts]
        loader = jinja2.FileSystemLoader(Path(__file__).parent / "templates")
        environment = jinja2.Environment(loader=loader, autoescape=True, trim_blocks=True)
        environment.filters["set"] = _set
        environment.globals["no_such_form"] = _no_such_form
        text = environment.get_template("page.html").render(page=self)
        with store.outputs(self.directory, [*self.made, self.path.name]) as out:
            for name, content in self.made.items():
                out.write(name, content)
            out.write(self.path.name, text)
        self.said = (f"{self.path}: one page, {len(text.encode()) / 1e6:.1f} MB, nothing else needed; "
                     f"{len(self.made)} files of its figures in {self.directory / 'report'}")
