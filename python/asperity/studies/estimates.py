# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""`asperity estimate`: the numbers of a scene with their errors, from runs of the scene itself with one setting varied at a
time (estimate_parts.py).
"""

from __future__ import annotations

import math
import os
import re
import tempfile
import warnings
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from functools import partial
from numbers import Integral
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from ..arguments import checks_call, spoken
from ..errors import BY_CODE, InternalError, SceneError, SceneWarning, Stopped
from ..files import store
from ..maps import height_map, missing_waves
from ..results.result import Values
from ..running import lock, program
from ..running.pool import DONE, PoolOptions, refuse_jobs, require_free_runs
from ..running.scene import Overrides, SceneLike, file_beside, inputs_of, scene_file, scene_given, toml_of
from ..units import GIGAPASCAL
from .estimate import RESULT, Estimate
from .estimate_parts import Part, Plan, SpacingAlso, edges, finer, places, plan_of, stated
from .forecast import Forecast
from .quantities import CURVED, FLAT, YIELDING, number_of, quantities_of
from .stated_number import Found, Number
from .variations import Study, Variation

SURFACES = {False: 8, True: 4}
"""Surfaces of a scene without and with a path."""
NO_ADHESION = 0.01
"""Of Δγ: surfaces that bind by less do not stick."""
PINNED = 1.3
"""A factor of the pull-off force (Case::edge_pinning) above which a path over a wall says nothing of its strength."""
OF_A_PATH = ("work_of_drive.approach", "work_of_drive.pull_off", "lost.cycle", "pull_off_stress", "pull_off_force", "jkr.pull_off")
"""Numbers that the edge of a contact and the range of the attraction decide."""
OF_YIELD = (*(one.path for one in YIELDING), "dissipated_in_surface.cycle")
"""Numbers that the range of the attraction decides."""


MAP_FILES = ["flat.npy"] + [f"{stem}.{kind}" for stem in ("finer", "mirrored", *(f"quarter-{i}" for i in range(1, 5))) for kind in ("npy", "toml")]
"""What the parts of a measured map are written to, in the folder maps."""
OF_A_MAP = re.compile(r"(scene|finer|mirrored|quarter-\d)(,.*)?|\w+=.*")
"""Folders of the runs of a map's estimate."""



def _map_parts(keys: dict[str, Any], scene: str, place: Path, continuous: bool, spacing_also: SpacingAlso,
               ) -> tuple[tuple[Part, ...], Callable[[float], missing_waves.Law | None], int]:
    """Returns the parts of the error of a measured map (the same waves on half of the spacing, the map in its mirror images, its
    quarters; each a scene of its own in `place`), the law of the waves that sites of a spacing do not show, and the points of the map.

    continuous: the spacing of the sites is no solid's own."""
    of = Values(keys)
    sites, edge = int(of.number("surface.sites", 0)), of.number("surface.sites", 0) * of.number("surface.spacing", 0)
    unit = of.text("surface.file_unit")
    inputs = inputs_of(scene, keys)
    store.require_free({place: MAP_FILES}, inputs=inputs)
    there = height_map.read_map(file_beside(of.text("surface.file"), scene), None if unit in ("", "auto") else unit, assumed="Å")
    heights = height_map.square(there.heights)
    size = of.number("surface.file_size") or (min(there.size) if there.size else edge)
    if size > 1.005 * edge:  # the program takes its middle
        n = max(2, round(len(heights) * edge / size))
        start = (len(heights) - n) // 2
        heights = heights[start:start + n, start:start + n]
    flat: dict[str, Any] = {}
    if of.text("surface.counter") not in ("", "none"):
        # The parts below are of the sum of both maps, on a second solid that is flat.
        points = len(heights) if of.text("surface.resample") == "band-limited" else sites
        with scene_file(_beside(keys, scene) | {"name": "sum"}) as file:
            heights = surface_made(file, [f"surface.sites={points}", f"surface.spacing={edge / points:.12g}", "surface.radius=none",
                                          f"block.thickness={points}"]).heights
        flat = {"counter": "flat.npy", "counter_size": None, "counter_unit": "Å", "counter_crop": "none", "counter_shift_x": 0.0,
                "counter_shift_y": 0.0, "counter_turn": 0.0} if of.number("surface.counter_young") else _without_counter(keys)
        with store.outputs(place, ("flat.npy",), inputs=inputs) as written, written.replacing("flat.npy") as beside, \
                open(beside, "wb") as opened:
            np.save(opened, np.zeros((4, 4)))
    elif of.number("surface.rms") is not None:
        made = {name: {**section} if isinstance(section, dict) else section for name, section in keys.items()}
        size = float(np.nanstd(heights)) or 1.0  # as it is, the map may be of any size
        with tempfile.TemporaryDirectory(prefix="asperity-") as folder:
            np.save(Path(folder) / "map.npy", heights / size)
            made["surface"].update(rms=None, file=f"{folder}/map.npy", file_unit="Å", file_size=edge)
            with scene_file(made) as file:
                heights = heights * (of.needed("surface.rms") / (size * surface_made(file).rms))

    def scenes(name: str, pieces: list[np.ndarray], factor: float, detrend: str, spacing: float = 1.0,
               setting: Sequence[str] = ()) -> list[Variation]:
        rows = []
        for i, piece in enumerate(pieces, 1):
            stem = f"{name}-{i}" if len(pieces) > 1 else name
            box = int(sites * factor / spacing)
            made = {section: dict(values) for section, values in keys.items() if isinstance(values, dict)}
            made["surface"] |= {"file": f"{stem}.npy", "file_unit": "Å", "file_size": factor * edge, "sites": box,
                                "spacing": factor * edge / box, "rms": None, "resample": "band-limited", "detrend": detrend, **flat}
            if name == "finer":  # the surface as it was made: what was taken off it is off
                made["surface"]["line_noise"] = "keep"
            thickness = of.needed("block.thickness")
            made["block"]["thickness"] = box if thickness == sites else int(thickness / spacing)
            made["output"] |= {"fields": ["relaxed"], "trajectory": "none"}
            if of.text("interface.potential") == "table":
                made["interface"]["table"] = str(Path(file_beside(of.text("interface.table"), scene)).resolve())
            made.pop("sweep", None)
            with store.outputs(place, (f"{stem}.npy", f"{stem}.toml"), inputs=inputs) as written:
                with written.replacing(f"{stem}.npy") as beside, open(beside, "wb") as file:
                    np.save(file, piece)
                written.write(f"{stem}.toml", toml_of(made))
            rows.append(Variation(name, stem, list(setting), scene=str(place / f"{stem}.toml")))
        return rows

    parts = [Part("waves", "truncation", "")]
    if continuous:
        with scene_file(_beside(keys, scene)) as file:
            made_of_it = surface_made(file, ["surface.radius=none"]).heights
        order = 1 if spacing_also(0.5) else None  # None: that of the quantity
        parts.append(Part("spacing", "discretisation", f"spacing {0.5 * edge / sites:.4g} Å, the same waves",
                          scenes("finer", [made_of_it], 1.0, "none", 0.5, spacing_also(0.5)), finer(2, order)))
    detrend = of.text("surface.detrend")
    level = heights if detrend == "none" else height_map.without_plane(heights)
    if detrend == "none" and height_map.jump(heights) < height_map.PERIODIC:
        parts.append(Part("edge", "geometry", "none: the map is periodic"))
    else:
        parts.append(Part("edge", "geometry", "the map in its mirror images",
                          scenes("mirrored", [height_map.mirrored(level)], 2.0, "none"), edges))
    if sites % 2 or sites < 32:
        parts.append(Part("places", "realisation", "not varied: the map has too few sites for quarters"))
    else:
        parts.append(Part("places", "realisation", "the quarters of the map",
                          scenes("quarter", height_map.quarters(heights), 0.5, "periodic" if detrend == "none" else detrend),
                          places))
    quiet = _without_line_noise(heights, edge, of.text("surface.line_noise"))
    return tuple(parts), partial(missing_waves.law_of, quiet, edge), len(heights)


def _beside(keys: dict[str, Any], scene: str) -> dict[str, Any]:
    """Returns the keys of a scene whose maps are named by their paths."""
    named = {key: str(Path(file_beside(name, scene)).resolve()) for key in ("file", "counter")
             if isinstance(name := keys["surface"].get(key), str) and name not in ("", "none")}
    return keys | {"surface": keys["surface"] | named}


def _without_counter(keys: dict[str, Any]) -> dict[str, Any]:
    """Returns the keys of a second solid as those of none."""
    return {key: "none" if key == "counter" else None for key in keys["surface"] if key.startswith("counter")}


def _without_line_noise(heights: np.ndarray, edge: float, treatment: str) -> np.ndarray:
    """Returns a map on its own points after the program's treatment of line noise; otherwise its spectrum would be that of the
    noise."""
    if treatment in ("", "keep"):
        return heights
    n = len(heights)
    with tempfile.TemporaryDirectory(prefix="asperity-") as there:
        np.save(Path(there) / "map.npy", heights)
        with scene_file({"surface": {"kind": "file", "file": f"{there}/map.npy", "file_unit": "Å", "file_size": edge, "sites": n,
                                     "spacing": edge / n, "file_missing": "fill", "detrend": "plane", "line_noise": treatment},
                         "block": {"thickness": 1}}) as file:
            return surface_made(file).heights


class SurfaceMade(NamedTuple):
    """Surface of a scene: rms height, Å; rms slope, from neighbouring heights; heights, Å, [y, x]; doubts: possible mistakes in the
    file of a map."""

    rms: float
    slope: float
    heights: np.ndarray
    doubts: list[str]


def surface_made(file: str, overrides: Iterable[str] = ()) -> SurfaceMade:
    """Makes the surface of a scene."""
    with tempfile.TemporaryDirectory(prefix="asperity-") as place:
        made = program.surface(file, overrides, out=str(Path(place) / "surface"))
        heights = height_map.read_map(str(Path(place) / "surface/heights.h5")).heights
    return SurfaceMade(made["rms"], made["slope_of_neighbours"], heights, made["doubts"])


# Carrying it out.

def _numbers(plan: Plan, curved: bool, withheld: str) -> dict[str, Number]:
    """Returns the numbers of the scene with the parts of their errors. withheld: reason why no number is stated; "" if numbers are
    stated."""
    base = plan.scene.outcome.result
    found: dict[str, Number] = {}
    for q in quantities_of(base, curved):
        value = number_of(base, q.path)
        if math.isnan(value):
            continue
        unit = {"binding_energy_ratio": "", "pull_off_stress": "MPa"}.get(q.path)
        if unit is None:
            unit = program.quantity(re.sub("^slide", "segments[]", q.path))["unit"]
        found[q.path] = number = stated(q, unit, value, base)
        for part in plan.parts:
            if (one := part.found(q)) is not None:
                number.parts[part.name] = one
        if plan.rest and "rate" in number.parts:
            # The quasi-static path has no levels and no time steps either: what these have shifted is part of it.
            others = sum(number.parts[n].shift for n in ("levels", "timestep") if n in number.parts)
            number.parts["rate"] = Found(number.parts["rate"].shift - others, 0.0)
    free = found.get("binding_energy")
    parted = free is not None and free.least == 0.0 and free.largest < NO_ADHESION * base.number("delta_gamma", 0.0)
    if free is not None and parted:
        free.unresolved = "no adhesion without load"
    for number in found.values():
        if parted and withheld:
            number.bounded = "roughness that the map does not show lowers it further"
        else:
            number.withheld = withheld
    return found


class Estimating(Study):
    """Planned estimate of a scene in a directory; carry_out() makes the runs."""

    def __init__(self, scene: str, overrides: list[str], out: str | None, options: PoolOptions, seeds: int | None,
                 only: Iterable[str] = (), spacing_also: SpacingAlso = lambda _: [], notes: Iterable[str] | None = None,
                 say: Callable[[str], None] = print, withheld: str = "", condition: str = "", also: Iterable[str] = (),
                 of_sites: str = "surface.sites ="):
        """Plans the estimate. withheld: reason why the numbers OF_A_PATH are not stated; condition: limitation of these numbers;
        also: names of files that the caller will write in the directory; of_sites: how its user sets the sites."""
        super().__init__(scene, overrides, out, "estimate", options, say, [RESULT, *also], notes)
        keys, varied = self.keys, self.varied
        path = keys["drive"]["path"]
        if not {"relax", "approach", "pull-off", "slide"} & {str(one).split()[0] for one in path}:
            raise SceneError(scene, "has no number to estimate", f"its path, {path}, has no state at zero load, no approach, "
                             "no pull-off and no slide", 'for example --set drive.path=relax')
        if seeds is not None and not (isinstance(seeds, Integral) and 2 <= seeds <= 1000):
            raise SceneError(f"seeds = {seeds}", "is no number of surfaces to average over", "it is from 2 to 1000",
                             "leave it out for 8, or 4 with a path")
        self.withheld, self.of_range, self.condition = withheld, withheld, condition
        pinning = self.answer.get("edge_pinning", 1.0)
        if varied.moves and pinning > PINNED and not withheld:
            self.withheld = ("the spacing does not resolve the range of the attraction, and rows of sites hold the edge of the contact "
                             f"(a sphere's pull-off force is about {pinning:.3g} times too large): take a wider interface.range or a "
                             "smaller surface.spacing")
        if varied.moves and self.answer.get("box_softness", 0.0) > 1.0 and not self.withheld:
            widest = keys["surface"]["sites"] * keys["surface"]["spacing"] / self.answer["box_softness"]
            self.withheld = (f"in boxes wider than {widest:.3g} Å flat surfaces jump, so that works and losses are those of the box, not of "
                             "the surface (docs/howto/paths.md)")
        of_file = keys["surface"]["kind"] == "file"
        map_parts: tuple[Part, ...] = ()
        self.law_at: Callable[[float], missing_waves.Law | None] | None = None
        self.points, self.of_sites = 0, of_sites
        if of_file:
            require_free_runs(self.place, OF_A_MAP)
            map_parts, self.law_at, self.points = _map_parts(keys, scene, self.place / "maps", varied.continuous, spacing_also)
        self.plan = plan_of(varied, seeds or SURFACES[varied.moves or varied.dynamic], spacing_also, map_parts)
        only = [name for name in only.split(",") if name] if isinstance(only, str) else list(only)
        self.require_known(only, self.plan.parts, "--parts")
        for part in self.plan.parts if only else []:
            if part.name not in only and (part.rows or part.name == "waves"):
                part.rows, part.what = [], "left out: --parts"
        self.rows = [self.plan.scene]
        for part in self.plan.parts:
            self.rows += [row for row in ([part.base, *part.rows] if part.rows and part.base else []) if row not in self.rows]
        self.jobs = self.runs.jobs(self.rows)
        self.judged = self._judged()
        for part in self.plan.parts if self.judged else []:
            if part.name == "waves":
                part.what, part.relative = self.judged.what, self.judged.relative
        known = CURVED if keys["surface"]["radius"] != "none" else FLAT
        if keys["interface"]["hardness"] != "none" and self.of_range:
            known += YIELDING
        of_path = ", ".join(q.symbol for q in known if q.path in OF_A_PATH + OF_YIELD)
        self.unstated = [("the numbers", self.judged.withheld)] if self.judged and self.judged.withheld else \
            [(of_path, self.withheld)] if self.withheld and varied.moves else []

    @property
    def law(self) -> missing_waves.Law | None:
        """Law of the waves that a map does not show; None if it shows all."""
        return self.law_at(self.varied.edge / self.varied.sites) if self.law_at else None

    def warn(self) -> None:
        """Tells by a warning which numbers will not be stated, before the runs are made."""
        for names, why in self.unstated:
            warnings.warn(f"{names} will not be stated: {spoken(why)}", SceneWarning, stacklevel=4)

    def forecast(self) -> Forecast:
        """Returns the runs that are left, their time, and the numbers that will not be stated."""
        return replace(self.forecast_of(self.rows), unstated=self.unstated)

    def _judged(self) -> missing_waves.Verdict | None:
        """Returns what the waves that a map does not resolve do to the numbers; None if they are not looked at."""
        if self.law_at is None or not any(one.name == "waves" and not one.what for one in self.plan.parts):
            return None
        layers = self.varied.scene.find("block.layers")
        young, poisson = layers[0][1:] if layers else (self.varied.own("block.young"), self.varied.own("block.poisson"))
        modulus = young * GIGAPASCAL / (1.0 - poisson ** 2)  # of the surface, where short waves are
        if self.varied.second_solid and self.varied.own("surface.counter_young"):
            layers = self.varied.scene.find("surface.counter_layers")
            young, poisson = layers[0][1:] if layers else (self.varied.own("surface.counter_young"), self.varied.own("surface.counter_poisson"))
            modulus = 1.0 / (1.0 / modulus + (1.0 - poisson ** 2) / (young * GIGAPASCAL))
        adhesion = Values(self.jobs[0].answer).number("delta_gamma", 0.0) / 1e3
        sites = [n for n in (self.varied.sites * 2**k for k in range(1, 8)) if n < self.points] + [self.points]
        more = next((n for n in sites if n > self.varied.sites and
                     not missing_waves.verdict(self.law_at(self.varied.edge / n), modulus, adhesion).withheld), 0)
        return missing_waves.verdict(self.law, modulus, adhesion, f"{self.of_sites} {more}" * (more > 0))

    def carry_out(self) -> tuple[Estimate | None, bool]:
        """Carries out the runs and writes estimate.json."""
        complete = self.runs.run(self.rows)
        if self.plan.scene.outcome.status != DONE:
            return None, complete
        result = self.plan.scene.outcome.result
        judged = self.judged
        numbers = _numbers(self.plan, result.number("scene.surface.radius") is not None, judged.withheld if judged else "")
        for path in (*OF_A_PATH, *OF_YIELD):
            if path in numbers:
                why = self.withheld if path in OF_A_PATH else self.of_range
                numbers[path].withheld, numbers[path].condition = numbers[path].withheld or why, self.condition
        parts = [{"name": p.name, "group": p.group, "what": p.what, "failed": p.failed if complete else ""}
                 for p in self.plan.parts]
        notes = self.notes + ([judged.note] if judged and judged.note else [])
        if self.varied.moves and self.keys["drive"]["control"] == "top" and self.keys["surface"]["radius"] == "none":
            notes.append("Works and losses of a path with its top held depend on the block's thickness as on the stiffness of "
                         'a machine; drive.control="mean-height" has none.')
        for one in self.plan.parts:
            if one.rule is edges and one.rows and one.base and not one.failed:
                here, there = (number_of(row.outcome.result, "binding_energy") for row in (one.base, one.rows[0]))
                notes.append(f"The map in its mirror images binds by {there:.4g} in place of {here:.4g} meV/Å²: neither way to "
                             "make it periodic is right, and twice the error of the part edge is their difference.")
        estimate = Estimate(self.name, numbers, parts, notes,
                            self.keys, {k: result.part("run").get(k) for k in ("version", "git", "machine")}
                            | {"processor_seconds": sum(row.seconds for row in {id(j): r for j, r in
                               zip(self.jobs, self.rows)}.values() if row.seconds == row.seconds)}, self.place)
        if complete:
            with store.outputs(self.place, [RESULT], inputs=self.inputs) as written:
                written.write(RESULT, store.sealed_json(estimate.json()))
        return estimate, complete


@checks_call
def estimate(scene: SceneLike, overrides: Overrides | None = None, out: str | os.PathLike | None = None, jobs: int = 1,
             seeds: int | None = None, parts: Iterable[str] = ()) -> Estimate:
    """Estimates the numbers of a scene with their errors: .numbers["binding_energy"].estimate and .error (a standard error), and
    the shift by each part of the error. Existing runs are reused.

    Parameters
    ----------
    scene : SceneLike
        Scene file or dictionary.
    overrides : Overrides, optional
        Values of keys in place of the scene's.
    out : str or os.PathLike, optional
        Directory; None: results/<scene>-estimate.
    jobs : int
        Number of simultaneous runs, which share the processors.
    seeds : int, optional
        Number of surfaces over which a self-affine scene is averaged; None: 8, or 4 with a path.
    parts : iterable of str
        Parts of the error to measure, ["tail", "seeds"] or "tail,seeds"; by default all.

    Returns
    -------
    Estimate
        The numbers with their errors.

    Raises
    ------
    SceneError
        The scene or an argument is refused, or files would be replaced.
    Stopped
        The estimate stopped early; the same call continues.
    Error
        The run of the scene failed.
    """
    program.refuse_ranks()
    refuse_jobs(jobs)
    with scene_given(scene, overrides) as (file, sets):
        said: list[str] = []
        making = Estimating(file, sets, None if out is None else str(out),
                            PoolOptions(jobs=jobs, progress="off"), seeds, parts, say=said.append)
        making.warn()
        with lock.in_use(making.place):
            found, complete = making.carry_out()
        if not complete:
            raise Stopped(f"{making.place}: the estimate stopped early", fix="the same call goes on from here")
        if found is None:
            outcome = making.plan.scene.outcome
            raise BY_CODE.get(outcome.exit_code, InternalError)(str(making.place), "the scene itself failed", outcome.reason)
        return found
