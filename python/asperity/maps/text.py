# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Maps as text: a matrix with the headers of Gwyddion or SPIP or without, several of them in one file, ESRI grid, points
x, y and height with or without a line of names, with more columns than one for heights."""

from __future__ import annotations

import contextlib
import re
from functools import partial
from pathlib import Path
from typing import Any

import numpy

from ..errors import InputOutputError
from ..units import in_angstrom, is_length
from .channels import Channel, refuse

SIZE = r"([-+]?[\d.,]+(?:[eE][-+]?\d+)?)\s*(.*)"
HEADERS = ("width", "height", "edge", "x-length", "y-length", "value units", "x-unit", "y-unit", "z-unit", "bit2nm")
"""Of which _matrix() takes sizes and units."""
OF_ALL = ("width", "height", "edge", "x-length", "y-length", "x-unit", "y-unit", "x-pixels", "y-pixels", "file format")
"""Headers of the first map that hold for later ones which do not have them."""
MOST_COLUMNS = 10
"""Of points without names: x, y and what was measured there."""
NARROWEST = 20
"""Rows over columns, from which a matrix of few columns is a curve."""


class Text:
    """A map as text: (number of the line, line) without comments, and what those say: "# name: value"."""

    def __init__(self, path: Path, header: dict[str, str] | None = None, lines: list[tuple[int, str]] | None = None):
        self.path, self.header, self.lines = path, header or {}, lines or []
        self.separators = str.maketrans(",;\t", "   ")

    def take_commas(self) -> None:
        """Takes commas as decimal points if all of them can be and tabs or semicolons separate the numbers."""
        body = "\n".join(line for _, line in self.lines)
        if "," not in body or re.search(r"(?<!\d),|,(?!\d)|,[^\s;,]*,", body) or not re.search(r"[ \t;]", body):
            return
        if not re.search(r"[\t;]", body) or "." in body:
            raise refuse(self.path, "the commas may be decimal points or separate numbers",
                         "there are blanks or points as well",
                         "write decimal points, or separate the numbers by tabs or semicolons")
        self.separators = str.maketrans(",;\t", ".  ")

    def rows(self) -> list[tuple[int, list[float]]]:
        """Returns the lines of numbers, each with its number in the file; "bad" and "void" are NaN. Raises InputOutputError."""
        found = []
        for number, line in self.lines:
            words = line.translate(self.separators).split()
            try:
                found.append((number, [numpy.nan if w.lower() in ("bad", "void") else float(w) for w in words]))
            except ValueError as error:
                raise refuse(f"{self.path}:{number}", "the line is no row of numbers", error,
                             "take headings out of the file, or put a # before them") from None
        return [(number, row) for number, row in found if row]

    def matrix(self, said: dict, counts: tuple[str, str]) -> numpy.ndarray:
        """Returns the numbers as a map. Raises InputOutputError."""
        rows = self.rows()
        for number, row in rows:
            if len(row) != len(rows[0][1]):
                raise refuse(f"{self.path}:{number}", "the rows of the map are not of one length",
                             f"this line has {len(row)} numbers, line {rows[0][0]} has {len(rows[0][1])}")
        heights = numpy.array([row for _, row in rows], ndmin=2)
        for key, there in zip(counts, heights.shape[::-1]):
            if re.fullmatch(r"\d+(\.0)?", str(said.get(key, ""))) and float(said[key]) != there:
                raise refuse(self.path, "the height map is not whole",
                             f"its header says {key} = {said[key]}, and {there} are there", "export it again")
        return heights

    def translate(self) -> str | None:
        """Returns the title and gives the headers their English names. Gwyddion writes them in the language of its user,
        always in this order: title, width, height, unit of the heights."""
        if {"width", "height", "value units"} <= self.header.keys():
            return self.header.get("channel")
        said = list(self.header.items())
        for k, ((_, width), (_, height), (_, unit)) in enumerate(zip(said, said[1:], said[2:])):
            sizes = [re.fullmatch(SIZE, text) for text in (width, height)]
            if re.fullmatch(r"[^\s\d]\S{0,7}", unit) and all(size and is_length(size[2]) for size in sizes):
                self.header = {"width": width, "height": height, "value units": unit} | self.header
                return said[k - 1][1] if k else None
        return self.header.get("channel")

    def unused(self) -> list[str]:
        """Returns headers that state a length, of which nothing was taken."""
        def states(text: str) -> bool:
            size = re.fullmatch(SIZE, text)
            return is_length(text) or bool(size and is_length(size[2]))

        taken = {self.header.get(key) for key in HEADERS}
        return [f"{key}: {text}" for key, text in self.header.items()
                if key not in HEADERS and text not in taken and states(text)]

    def size(self, keys: tuple[str, ...], unit: str | None) -> float | None:
        """Returns a size by the first header that gives a number."""
        for key in keys:
            if found := re.fullmatch(SIZE, self.header.get(key, "")):
                value, unit = float(found[1].replace(",", ".")), found[2] or unit
                if not is_length(unit) or not 0.0 < value < numpy.inf:
                    raise refuse(self.path, f"the header '{key}: {self.header[key]}' is no size",
                                 f"unit: {unit}" if value > 0.0 else "it is not above zero", "correct the header")
                return value * in_angstrom(str(unit))
        return None


def parts(path: Path, content: str) -> list[Text]:
    """Splits a text where lines without numbers stand between those with numbers. Lines without numbers are the header of the following part, or
    belong to the last part behind it."""
    found: list[Text] = []
    header: dict[str, str] = {}
    between = True
    for number, line in enumerate(content.split("\n"), 1):
        line, _, comment = line.partition("#")
        if said := re.match(r"([^:=：]*)[:=：](.*)", comment):
            header.setdefault(said[1].strip().lower(), said[2].strip())
        if not line.strip():
            between = True
            continue
        if between:
            found.append(Text(path, header))
            header, between = {}, False
        found[-1].lines.append((number, line.strip()))
    if found:
        found[-1].header = {**header, **found[-1].header}
    return found


def _joined(texts: list[Text]) -> Text:
    header: dict[str, str] = {}
    for text in texts:
        header = {**text.header, **header}
    return Text(texts[0].path, header, [line for text in texts for line in text.lines])


def _maps_of(found: list[Text]) -> list[Text]:
    """Returns the parts that are maps of their own: those with headers of their own, or all if all have as many rows (at
    least two); a part without a header belongs to the one before it."""
    rows = {len(part.lines) for part in found}
    if max(rows) == 1 or found[0].lines[0][1].lower().startswith("ncols"):
        return [_joined(found)]
    if not any(part.header for part in found[1:]):
        return found if len(rows) == 1 else [_joined(found)]
    maps: list[list[Text]] = []
    for part in found:
        if part.header or not maps:
            maps.append([part])
        else:
            maps[-1].append(part)
    for later in maps[1:]:
        shared = {key: found[0].header[key] for key in OF_ALL if key in found[0].header}
        if not shared.keys() & later[0].header.keys():
            later[0].header |= shared
    return [_joined(one) for one in maps]


def _matrix(text: Text) -> dict:
    """Returns a matrix with the headers of Gwyddion ("# Value units: nm") and SPIP ("# Bit2nm = 0.03"), or without."""
    text.take_commas()
    text.translate()
    said = {key: value for key, value in text.header.items() if value}
    spip = "x-pixels" in said or "bit2nm" in said or said.get("file format", "").lower() == "ascii"
    found: dict[str, Any] = {"heights": text.matrix(said, ("x-pixels", "y-pixels")),
             "unit": said.get("value units", said.get("z-unit"))}
    if "bit2nm" in said and not found["unit"]:
        if not re.fullmatch(r"[-+]?[\d.]*[1-9][\d.]*([eE][-+]?\d+)?", said["bit2nm"]):
            raise refuse(text.path, f"the header 'Bit2nm = {said['bit2nm']}' is no factor", "", "correct the header")
        found |= {"unit": "nm", "scale": float(said["bit2nm"])}
    lateral = said.get("x-unit", "nm" if spip else found["unit"])
    size = (text.size(("width", "x-length", "edge"), lateral),
            text.size(("height", "y-length", "edge"), said.get("y-unit", lateral)))
    found |= {"notes": [f"the header '{header}' is not understood" for header in text.unused()]}
    return found | ({"size": size, "size_unit": "Å"} if all(size) else {})


def _esri(text: Text) -> dict:
    header = {}
    while text.lines and text.lines[0][1][0] not in "+-.0123456789":
        number, line = text.lines.pop(0)
        try:
            name, value = line.split()
            header[name.lower()] = float(value)
        except ValueError as error:
            raise refuse(f"{text.path}:{number}", "the line is no header of a grid", error) from None
    heights = text.matrix(header, ("ncols", "nrows"))
    heights[heights == header.get("nodata_value")] = numpy.nan
    pixel = [header.get(own, header.get("cellsize", 0.0)) for own in ("dx", "dy")]
    if not min(pixel) > 0.0:
        raise refuse(text.path, "the grid has no pixel size", "cellsize is not above zero", "export the grid again")
    return {"heights": heights, "size": tuple(p * n for p, n in zip(pixel, heights.shape[::-1]))}


def _points(text: Text, columns: tuple[int, int, int] = (0, 1, 2), count: int = 3) -> dict:
    """Returns the map of XYZ: the points of a grid in any order; those that are not given are missing. columns: of x, y and height, of so
    many."""
    def on_no_grid(why: str) -> InputOutputError:
        return refuse(text.path, "the points of the map are on no grid", why, "interpolate them onto a grid before")

    text.take_commas()
    rows = text.rows()
    for number, row in rows:
        if len(row) != count or not numpy.isfinite([row[k] for k in columns[:2]]).all():
            raise refuse(f"{text.path}:{number}", "the line is no point of a map", f"{row}: x, y and z are needed",
                         "a matrix of heights must not be called .xyz")
    x, y, z = numpy.array([[row[k] for k in columns] for _, row in rows]).reshape(-1, 3).T
    axes = []
    for name, places in (("x", x), ("y", y)):
        span = numpy.ptp(places) if len(places) else 0.0
        gaps = numpy.diff(numpy.sort(places))
        steps = numpy.rint(span / gaps[gaps > 1e-6 * span].min()) if span > 0.0 else 0.0
        pixel = span / max(1.0, steps)
        index = numpy.rint((places - places.min()) / pixel) if span > 0.0 else places
        if not span > 0.0 or (abs(places - (places.min() + index * pixel)) > 0.01 * pixel).any():
            raise on_no_grid(f"their {name} are not evenly spaced")
        axes.append((index.astype(int), pixel, int(steps) + 1))
    (across, dx, columns_there), (along, dy, lines) = axes
    if columns_there * lines > 4 * len(z):
        raise on_no_grid(f"{len(z)} points for {columns_there} different x and {lines} different y")
    place = along * columns_there + across
    if len(numpy.unique(place)) != len(place):
        raise on_no_grid("a point stands twice")
    heights = numpy.full(columns_there * lines, numpy.nan)
    heights[place] = z
    return {"heights": heights.reshape(lines, columns_there), "size": (dx * columns_there, dy * lines)}


def _matrix_or_points(text: Text) -> list[Channel]:
    """Returns the maps of plain rows. More than three rows of three numbers are the points of a map where they lie on a grid; of four to ten numbers,
    the points of several."""
    found = _matrix(text)
    rows, columns = found["heights"].shape
    unit, notes = found["unit"], found["notes"]
    if 3 <= columns <= MOST_COLUMNS and rows > columns:
        with contextlib.suppress(InputOutputError):
            points = _points(text, count=columns)
            if columns == 3:
                said = "its three columns are taken as points x, y and height"
                return [Channel("height", lambda: points | {"unit": unit, "notes": [*notes, said]}, unit)]
            if points["heights"].size == rows:
                def column(k: int) -> dict[str, Any]:
                    return _points(text, (0, 1, k), columns) | {"unit": unit, "notes": notes}

                return [Channel(f"column {k + 1}", partial(column, k), unit) for k in range(2, columns)]
    if columns <= MOST_COLUMNS and rows > NARROWEST * columns:
        raise refuse(text.path, "is no map of heights", f"it is {rows} lines of {columns} numbers, which lie on no grid as points x, y and height: "
                     "a curve, of force over distance for example", "export the scan of the heights, as a matrix of numbers")
    if columns == 3:
        notes.append("its three columns are rows of a map: as points x, y and height they are on no grid")
    return [Channel(text.header.get("channel") or "map", lambda: found, unit)]


def _named(line: str) -> list[tuple[str, str | None]]:
    """Returns the names of columns with their units: "x (nm), y [nm], phase/deg"."""
    words = re.split(r"\s*[,;\t]\s*", line.strip(" ,;\t")) if re.search(r"[,;\t]", line) else re.split(r"\s+(?![(\[/])", line)
    found = []
    for word in words:
        word = word.strip(" \"'")
        parted = re.fullmatch(r"(.*?)\s*(?:[(\[]\s*([^)\]]*?)\s*[)\]]|/\s*(\S+)|_([^\W_]+))", word)
        unit = next((g for g in parted.groups()[1:] if g), None) if parted else None
        if parted and (parted[4] is None or is_length(unit)):
            found.append((parted[1].strip(), unit))
        else:
            found.append((word, None))
    return found


def _table(text: Text) -> list[Channel]:
    """Returns the maps of points under a line of names; none if the first line is no such line."""
    names = _named(text.lines[0][1])
    below = Text(text.path, text.header, text.lines[1:])
    below.take_commas()
    try:
        rows = below.rows()
    except InputOutputError:
        return []
    if len(names) < 3 or not rows or any(len(row) != len(names) for _, row in rows):
        return []
    labels = [name.lower() for name, _ in names]
    if not {"x", "y"} <= set(labels):
        raise refuse(f"{text.path}:{text.lines[0][0]}", "its columns are no points of a map", "they are called "
                     + ", ".join(name for name, _ in names) + ", and none are x and y",
                     "call the columns of the places x and y; or put a # before the names if the lines below are rows of a map")
    x, y = labels.index("x"), labels.index("y")
    if names[x][1] != names[y][1]:
        raise refuse(f"{text.path}:{text.lines[0][0]}", "its x and y have different units", f"{names[x][1]} and {names[y][1]}",
                     "write both in one unit")
    size_unit = {} if names[x][1] is None else {"size_unit": names[x][1]}

    def column(k: int, unit: str | None) -> dict[str, Any]:
        return _points(below, (x, y, k), len(names)) | {"unit": unit} | size_unit

    return [Channel(name, partial(column, k, unit), unit)
            for k, (name, unit) in enumerate(names) if k not in (x, y)]


def of_text(path: Path, content: str) -> list[Channel]:
    """Returns the maps of a text."""
    found = parts(path, content)
    if not found or "\0" in content:
        return []
    start = found[0].lines[0][1].lower()
    if start.startswith("ncols"):
        return [Channel("map", lambda: _esri(_joined(found)))]
    if not re.match(r"[-+.,\d]|nan|inf|bad|void", start):
        return _table(_joined(found))
    if path.suffix == ".xyz":
        return [Channel("height", lambda: _points(_joined(found)))]
    maps = _maps_of(found)
    if len(maps) > 1:
        whole = _joined(found)
        with contextlib.suppress(InputOutputError):  # points may have a blank line behind each row of the grid
            _points(whole)
            maps = [whole]
    if len(maps) == 1:
        return _matrix_or_points(maps[0])
    channels = []
    for k, one in enumerate(maps, 1):
        title = one.translate() or f"lines {one.lines[0][0]} to {one.lines[-1][0]}"
        unit = one.header.get("value units") or one.header.get("z-unit") or ("nm" if "bit2nm" in one.header else None)
        channels.append(Channel(title, partial(_matrix, one), unit))
    return channels
