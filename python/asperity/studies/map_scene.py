# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The scene of a measured map: an elastic half-space on a wall with an exponential attraction of the given work, led in and
out at a held mean height.

The map is read and checked, and written in Å beside the scene.
"""

from __future__ import annotations

import math
import os
import re
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from ..arguments import spoken
from ..errors import SceneError
from ..files import store
from ..maps import height_map, missing_waves
from ..results.result import Values
from ..running import program
from ..running.scene import scene_file, toml_of
from ..units import GIGAPASCAL, MILLIJOULE, conversion, quantity
from .estimate_parts import SpacingAlso
from .estimates import surface_made
from .variations import Setting

SITES = 256
"""Sites along an edge unless others are asked for: a path and its variations take minutes."""
SITE_BYTES = 1200
"""Of a quasi-static path; the finest variation has four times as many sites."""
RANGE = "3 Å"
WIDEST_PIXEL = 1e4
"""Å"""


class Units(NamedTuple):
    """Units in which an argument is usually meant, the unit of SI, and the least and largest value in it that anybody means."""

    usual: tuple[str, ...]
    si: str
    least: float
    most: float

    def meant(self, text: str) -> list[str]:
        """Returns what a number without a unit may mean, each with a unit: "20 nm" of 2e-8."""
        try:
            value = float(text)
        except ValueError:
            value = 1.0
        of_si = {unit: conversion(unit, self.si) or 1.0 for unit in self.usual}
        found = [f"{text} {unit}" for unit, factor in of_si.items() if self.least <= value * factor <= self.most]
        if self.least <= value <= self.most and self.si not in self.usual:
            near = min(of_si, key=lambda unit: abs(math.log(value / of_si[unit] / 30)))
            found.append(f"{value / of_si[near]:.6g} {near}")
        return list(dict.fromkeys(found)) or [f"{text or 1} {unit}" for unit in self.usual]


MODULUS = Units(("GPa", "MPa"), "Pa", 1e3, 3e12)
UNITS = {"young": MODULUS, "counter_young": MODULUS, "hardness": Units(("GPa", "MPa"), "Pa", 1e3, 3e11),
         "load": Units(("MPa", "GPa"), "Pa", 1.0, 3e11), "adhesion": Units(("J/m^2", "mJ/m^2"), "J/m^2", 1e-4, 30.0),
         "range": Units(("Å", "nm"), "m", 1e-12, 1e-5), "size": Units(("nm", "µm"), "m", 1e-9, 1e-2),
         "radius": Units(("nm", "µm"), "m", 1e-10, 1e-3), "stiffness": Units(("N/m", "mN/m"), "N/m", 1e-5, 1e5)}


ARGUMENTS = {"block.young": "young", "block.poisson": "poisson", "interface.adhesion": "adhesion", "interface.range": "range",
             "interface.hardness": "hardness", "drive.load": "load",
             "surface.radius": "radius", "drive.stiffness": "stiffness",
             "surface.file_size": "size", "surface.line_noise": "line_noise"}
"""What a scene's keys are called here."""


def named(text: str) -> str:
    """Returns a text in which the keys of the scene, which nobody has seen, have the names of arguments."""
    for key, name in ARGUMENTS.items():
        text = text.replace(key, name)
    return text


def edge_of(size: object) -> float:
    """Returns the edge of a map, Å. Raises SceneError if it is no length above zero."""
    edge = quantity(with_unit("size", size), "Å")
    if edge is None or not edge > 0.0:
        raise SceneError(f"size = {size}", "is no length above zero", "it is the edge of the map", 'for example "500 nm"')
    return edge


def length(name: str, text: object) -> float:
    """Returns a length above zero, nm. Raises SceneError in the words of the argument."""
    value = quantity(text, "nm")
    if value is None or not 0 < value < math.inf:
        raise SceneError(f"{name} = {text}", "is no length above zero", "", f'for example {name} "20 nm"')
    return value


def with_unit(name: str, value: object) -> str:
    """Returns the text of a quantity with its unit, as scenes have it. Raises SceneError."""
    text = str(value).strip()
    if re.fullmatch(r"[-+\d.eE]*", text):
        raise SceneError(f"{name} = {value!r}", "has no unit", "a bare number may be meant in several",
                         "write the one that is meant: " + " or ".join(f'--{name.replace("_", "-")} "{one}"' for one in UNITS[name].meant(text)))
    return text


def with_hardness(value: object) -> dict[str, str]:
    """Returns the keys of [interface] of a hardness with its unit; none if it is not given."""
    return {} if value is None else {"hardness": with_unit("hardness", value)}


def hardness_of(keys: Values, value: object) -> float | None:
    """Returns the hardness in the keys of a scene, GPa; None if none is given. Raises SceneError if it is not one above zero."""
    found = keys.number("interface.hardness")
    if value is not None and not (found or 0.0) > 0.0:
        raise SceneError(f"hardness = {value}", "is no hardness above zero", "it is the largest pressure that the solid bears",
                         'for example "1 GPa", or leave it out for an elastic solid')
    return found


def with_load(value: object) -> dict[str, str]:
    """Returns the keys of [drive] of a mean pressure; none if it is not given. Raises SceneError if it is not one above zero."""
    if value is None:
        return {}
    pressure = quantity(with_unit("load", value), "MPa")
    if pressure is None or not 0 < pressure < math.inf:
        raise SceneError(f"load = {value}", "is no pressure above zero", "it is the mean pressure on the map at the end of the approach",
                         'for example "100 MPa", or leave it out for an approach without load')
    return {"load": f"{pressure:.10g} MPa"}


def read_square(file: str, unit: str | None, size: float | None, channel: str | None) -> tuple[np.ndarray, float, list[str]]:
    """Reads a square map of which a contact can be computed. Raises SceneError."""
    found = height_map.read_map(file, unit, size or None, channel)
    heights, notes = found.heights, list(found.notes)

    def refuse(what: str, why: str, fix: str) -> SceneError:
        return SceneError(file, what, why, fix)

    rows, columns = heights.shape
    if min(rows, columns) < height_map.FEWEST:
        raise refuse(f"has {columns} x {rows} points", f"{height_map.FEWEST} along an edge are the least of which a surface is "
                     "made", "export the whole map")
    if found.size is None:
        raise refuse("does not tell how wide it is", "", 'name the length of its shorter edge: --size "100 nm"')
    missing = np.isnan(heights)
    if missing.mean() > 0.5:
        raise refuse("has no heights" if missing.all() else f"lacks {100 * missing.mean():.0f} % of its heights",
                     f"{int(missing.sum())} of {missing.size} points are missing", "export a part that was measured")
    pixel = [length / count for length, count in zip(found.size, (columns, rows))]
    if abs(pixel[0] / pixel[1] - 1) > 0.005:
        raise refuse("has pixels that are not square", f"{pixel[0]:.4g} x {pixel[1]:.4g} Å", "resample it before")
    if pixel[0] > WIDEST_PIXEL:
        raise refuse(f"has pixels of {pixel[0] / 1e4:.4g} µm", "adhesion is decided by roughness down to nanometres, which such "
                     "a map does not show", "measure a smaller area, or correct the unit of the file")
    if rows != columns:
        notes.append(f"the map is not square: its middle is taken, {min(rows, columns)} points along an edge")
        heights = height_map.square(heights)
    steepest = max(np.nanmax(abs(np.diff(heights, axis=axis))) for axis in (0, 1))
    highest = float(np.nanmax(heights) - np.nanmin(heights))
    if not highest > 0.0:
        notes.append("the map is flat")
    for axis in (0, 1):
        along = np.abs(np.diff(heights, axis=axis)) > 0.5 * highest
        if highest > 0.0 and along.any(axis=axis).mean() > 0.5:
            raise refuse("has a step edge across it", f"most lines jump by more than half of its height, {highest:.4g} Å, "
                         "from one point to the next, and a plane cannot be subtracted from it",
                         "cut it to one side of the step, or write a scene of it (surface.detrend)")
    if missing.any():
        notes.append(f"{int(missing.sum())} points without a height are filled by Laplace's equation")
    if steepest > pixel[0]:
        notes.append(f"neighbouring points differ in height by up to {steepest / pixel[0]:.3g} pixels: so steep a map shows the side "
                     "of the tip")
    return heights, pixel[0] * len(heights), notes


def _smooth_below(most: int) -> int:
    """Returns the largest even number up to `most` that has no prime factor above 5."""
    def smooth(n: int) -> bool:
        for p in (2, 3, 5):
            while n % p == 0:
                n //= p
        return n == 1

    return next(n for n in range(most - most % 2, 0, -2) if smooth(n))


class SecondSolid(NamedTuple):
    """A second rough solid: file of its map, Young's modulus with its unit (None: rigid), Poisson's ratio (None: that of the first)."""

    file: str
    young: object
    poisson: float | None

    @classmethod
    def given(cls, file: str | None, young: object, poisson: float | None) -> SecondSolid | None:
        """Returns the solid of these arguments; None without a map. Raises SceneError."""
        if file is None and (young is not None or poisson is not None):
            raise SceneError(f"counter_young = {young}" if young is not None else f"counter_poisson = {poisson}", "has no effect",
                             "there is no second solid", "name its map: --counter map2.npy")
        if young is None and poisson is not None:
            raise SceneError(f"counter_poisson = {poisson}", "has no effect", "the second solid is rigid",
                             'give it a modulus: --counter-young "70 GPa"')
        return None if file is None else cls(os.fspath(file), young, poisson)

    def keys(self, poisson: float) -> dict[str, Any]:
        """Returns the keys of its elasticity, GPa. poisson: that of the first solid. Raises SceneError for what is no modulus."""
        if self.young is None:
            return {}
        young, own = quantity(with_unit("counter_young", self.young), "GPa"), poisson if self.poisson is None else self.poisson
        if young is None or not young > 0.0:
            raise SceneError(f"counter_young = {self.young}", "is no modulus above zero", "", 'for example --counter-young "70 GPa"')
        if not -1.0 < own < 0.5:
            raise SceneError(f"counter_poisson = {own}", "is no Poisson's ratio", "it is above -1 and below 0.5",
                             "for example --counter-poisson 0.3")
        return {"counter_young": young, "counter_poisson": own}


def map_files(counter: str | None) -> list[str]:
    """Returns the names of the files of the maps beside a scene."""
    return ["map.npy", *["counter.npy"] * (counter is not None)]


class MapScene(NamedTuple):
    """file: of the scene; notes: on what was made of the map; also: what another spacing sets too; withheld, condition: of
    numbers that depend on the range of the attraction, why they are not stated, or for which range they hold."""

    file: Path
    notes: list[str]
    also: SpacingAlso
    withheld: str
    condition: str


def scene_of(file: str, young: object, poisson: float, adhesion: object, place: Path, *, reach: object = None,
             size: object = None, unit: str | None = None, channel: str | None = None, sites: int | None = None,
             line_noise: str | None = None, hardness: object = None, load: object = None, second: SecondSolid | None = None) -> MapScene:
    """Writes the scene of a map and the map beside it, after all checks. Raises SceneError."""
    sections: dict[str, dict[str, Any]] = {"block": {"young": with_unit("young", young), "poisson": poisson},
                "surface": {"kind": "flat", "sites": 32},
                "interface": {"kind": "wall", "adhesion": with_unit("adhesion", adhesion),
                              "range": with_unit("range", reach or RANGE), **with_hardness(hardness)},
                "drive": {"path": ["approach"], "mode": "quasistatic", **with_load(load)}}
    asked = None if size is None else edge_of(size)
    choices = [None, *program.schema()["surface.line_noise"]["choices"]]
    if line_noise not in choices:
        raise SceneError(f'line_noise = "{line_noise}"', "is no treatment of the noise between lines", "", f"take one of {', '.join(choices[1:])}")
    try:
        with scene_file(sections) as checked:  # the program reads the units
            keys = Values(program.check(checked)["scene"])
    except SceneError as error:
        raise SceneError.of([{**one, "where": "", **{part: named(one[part]) for part in ("what", "why", "fix")}} for one in error.listed]) from None
    hard = hardness_of(keys, hardness)
    if hard is not None and load is not None and keys.needed("drive.load") >= 1e3 * hard:
        raise SceneError(f"load = {load}", f"is not below the hardness of {hard:g} GPa", "the whole surface would yield, and nothing would bear the "
                         "load", f'press less, for example load "{500 * hard:.3g} MPa", or take a larger hardness')
    if not keys.needed("interface.adhesion") > 0.0:
        raise SceneError(f"adhesion = {adhesion}", "is no adhesion", "the work of flat surfaces is above zero", 'for example "50 mJ/m^2"')
    heights, edge, notes = read_square(file, unit, asked, channel)
    points = len(heights)
    elastic = second.keys(poisson) if second else {}
    other = _second_map(second.file, unit, asked, edge, notes) if second else None
    if sites is not None and sites < height_map.FEWEST:
        raise SceneError(f"sites = {sites}", "are too few", "", f"take {height_map.FEWEST} or more, or leave it out")
    memory = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")  # what is free now would be another scene later
    most = min(points, sites or SITES, int(math.sqrt(memory / (2 * 4 * SITE_BYTES))))
    n = _smooth_below(max(most, height_map.FEWEST))
    spacing = edge / n
    stiff = keys.needed("block.young") * GIGAPASCAL / (1 - keys.needed("block.poisson") ** 2)  # eV/Å³
    if elastic:  # both solids in series
        stiff = 1 / (1 / stiff + (1 - elastic["counter_poisson"] ** 2) / (elastic["counter_young"] * GIGAPASCAL))
    work, asked = keys.needed("interface.adhesion") / 1e3, keys.needed("interface.range")

    def resolved(spacing: float) -> float:
        """Returns the range, Å, whose attraction reaches over two spacings beside an edge of the contact (docs/explanation/model.md)."""
        return max(asked, math.sqrt(2 * spacing * work / stiff))

    used = resolved(spacing)
    longer = f'--range "{math.ceil(used * 1e3) / 1e3:g} Å"'

    def sites_for(reach: float) -> str:
        """Spells the option of as many sites as resolve this range, "--sites 96, or "; "" if the map has fewer points."""
        least = edge * 2 * work / (stiff * reach**2)
        enough = next((k for k in range(max(n, math.ceil(least)), points + 1) if _smooth_below(k) == k), 0)
        return f"--sites {enough}, or " * (enough > n)

    if reach is not None and used > 1.001 * asked:
        raise SceneError(f"range = {reach}", f"is not resolved by a spacing of {spacing:.4g} Å", "beside the edge of a contact it "
                         f"would act on less than two sites (w / E* = {work / stiff:.3g} Å)", f"{sites_for(asked)}{longer}; or "
                         "leave it out for the numbers that depend on no range")
    if used > 0.25 * edge:
        raise SceneError(file, f"is too small for so soft a solid: its attraction would reach {used:.3g} Å, and the map is "
                         f"{edge:.4g} Å wide", f"on a spacing of {spacing:.3g} Å the edge of a contact is resolved with a range "
                         f"of {used:.3g} Å (w / E* = {work / stiff:.3g} Å)", "take more sites, a wider map, or a stiffer solid")
    flat = height_map.without_tilt(heights)
    rough = [heights] if other is None else [heights, other]
    rms = math.hypot(*(float(np.nanstd(height_map.without_plane(one))) for one in rough))
    if used > 1.001 * asked and used > rms > 0.0:
        flattened = stiff * sum(missing_waves.energy_shown(one, edge) for one in rough) * 1e3 * MILLIJOULE
        raise SceneError(file, f"is too smooth for so soft a solid: its attraction would reach {used:.3g} Å, and the rms height is "
                         f"{rms:.3g} Å", f"on a spacing of {spacing:.3g} Å the edge of a contact is resolved with that range (w / E* = "
                         f"{work / stiff:.3g} Å), which would act across the roughness in place of pressing it flat; pressed flat, the "
                         f"map stores {flattened:.3g} of the {1e3 * work * MILLIJOULE:.3g} mJ/m^2 of the work of adhesion",
                         f"{sites_for(rms)}a map with smaller pixels; or, if the attraction does reach so far, {longer}")
    if hard is not None and work / used > hard * GIGAPASCAL:
        notes.append(f"the largest tension of the attraction, {work / used / GIGAPASCAL:.3g} GPa, is more than the hardness: beside contacts "
                     "it is more than such a solid bears, and tension does not yield here")
    withheld = condition = ""
    if used > 1.001 * asked:
        notes.append(f"the range of the attraction is {used:.4g} Å in place of {asked:.4g} Å, which a spacing of "
                     f"{spacing:.4g} Å does not resolve; numbers that depend on it are not stated, and the part spacing of the "
                     "others follows it")
        withheld = (f"the range of the attraction decides, and is {0.1 * used:.3g} nm, which the spacing resolves, in place of "
                    f"{0.1 * asked:.3g} nm; {longer} states what holds for that range")
    else:
        condition = f"for a range of {0.1 * used:.3g} nm" + (f", after a load of {keys.number('drive.load'):.4g} MPa" if load is not None else "")
    periodic = all(height_map.jump(height_map.without_tilt(one)) < height_map.PERIODIC for one in rough)
    if periodic:
        heights, other = flat, None if other is None else height_map.without_tilt(other)
    notes.append("its tilt is subtracted, and without it the map is periodic" if periodic else "the mean plane is subtracted, and "
                 "a smooth part that contains the jumps between opposite edges: the part edge is its effect")
    scene = {"surface": {"kind": "file", "file": "map.npy", "file_unit": "Å", "file_size": edge, "file_missing": "fill",
                         "sites": n, "spacing": spacing, "detrend": "none" if periodic else "periodic", "resample": "band-limited",
                         "line_noise": line_noise,
                         **({} if other is None else {"counter": "counter.npy", "counter_unit": "Å", "counter_size": edge,
                                                      "counter_missing": "fill", **elastic})},
             "block": {"young": keys.number("block.young"), "poisson": poisson, "thickness": n},
             "interface": {"kind": "wall", "adhesion": keys.number("interface.adhesion"), "range": used,
                           "frictionless": True, **({} if hard is None else {"hardness": hard})},
             "drive": {"mode": "quasistatic", "control": "mean-height", "path": ["approach", "pull-off"], "displacement_step": 0.25 * used,
                       **with_load(load)}}
    stem = stem_of(file)
    names = map_files(second and second.file)
    with store.outputs(place, (*names, f"{stem}.toml"), inputs=[file, *([second.file] if second else [])]) as out:
        for name, one in zip(names, (heights, other)):
            with out.replacing(name) as beside, open(beside, "wb") as opened:
                np.save(opened, one)
        out.write(f"{stem}.toml", f"# Written by asperity adhesion from {Path(file).name}.\n" + toml_of(scene))
    slope = math.sqrt(np.nanmean(np.diff(flat, axis=0) ** 2) + np.nanmean(np.diff(flat, axis=1) ** 2)) * points / edge
    made = surface_made(str(place / f"{stem}.toml"))
    notes += [doubt.replace("surface.line_noise = ", "--line-noise ") for doubt in made.doubts]
    kept = made.slope
    if other is not None and len(other) != points:
        notes.append(f"the second map has {len(other)} points along an edge")
    if n < points:
        notes.append(f"waves below {2 * spacing / 10:.3g} nm are lost: {n} of {points} points along an edge carry an rms slope of "
                     f"{kept:.3g}; the map's neighbours have {slope:.3g}")
    else:
        notes.append(f"all {points} points along an edge are taken, {spacing / 10:.3g} nm apart; roughness below is not measured")

    def also(factor: float) -> Setting:
        return [f"interface.range={resolved(factor * spacing):.10g}"] * (used > asked)

    return MapScene(place / f"{stem}.toml", [*map(spoken, notes)], also, spoken(withheld), condition)


def _second_map(file: str, unit: str | None, asked: float | None, edge: float, notes: list[str]) -> np.ndarray:
    """Returns the heights of the map of a second solid, Å, and adds to the notes. Raises SceneError if its edge is not that of the first."""
    heights, own, said = read_square(file, unit, asked, None)
    if abs(own / edge - 1) > 0.005:
        raise SceneError(file, f"is {own:.6g} Å wide", f"the first map is {edge:.6g} Å wide, and one lies on the other",
                         "cut both to one size, or give the size of both: --size")
    notes += [f"the second map: {note}" for note in said]
    return heights


def stem_of(file: str) -> str:
    """Returns the name of the scene of a map."""
    return re.sub(r"[^\w.-]", "-", Path(file.partition(":/")[0]).stem) or "map"
