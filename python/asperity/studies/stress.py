# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Stresses below the surface of a run: read from run.h5 (output.stress), or computed by the program from the pressure of a state."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from ..arguments import checks_calls
from ..errors import Named, SceneError, UnknownName
from ..files import store
from ..results.result import Result, State
from ..results.run_file import RunFile
from ..running import program
from ..running.scene import scene_file

RESULT = "stress.h5"
MEASURES = {"von_mises": "von Mises", "tresca": "Tresca", "tension": "largest tension"}
"""Measures of a stress by their names in the program: von Mises' stress, the difference of the outer principal stresses, and the
largest principal stress."""
COMPONENTS = ("xx", "yy", "zz", "xy", "xz", "yz")
UNRESOLVED = ("it lies less than half a spacing below the surface, where the pressure within a site counts, or at the end of the search")
"""Reason of a value without an error, where the file tells none."""


@dataclass
class LargestStress(Named):
    """Largest value of a measure in a layer: value (GPa), place x, y and depth (Å), and its error (GPa), the sum of its parts: the
    change between the depths of the search, from the sites to twice the points, with a pressure that is constant on each site, and by
    images of a contact with free edges; without an error the reason."""

    measure: str
    layer: int
    value: float
    error: float | None
    x: float
    y: float
    depth: float
    reason: str = ""
    parts: dict[str, float] = field(default_factory=dict)


@checks_calls
@dataclass
class Stress(Named):
    """Stresses below a state, GPa; tension is positive, and depths (Å) lead from the surface into the block.

    layers [layer]: depths (from, to) that were searched; largest: LargestStress of each layer and measure; profile [depth]: the
    measures by name, at profile_depth; solid: "block" or "counter"; section {component: [depth, x]} through the largest
    stress of von Mises, at y = section_y, at depth, and tension_section through the largest tension, at tension_y; map {component: [y, x]} at
    map_depth; volume {component: [depth, y, x]}, empty unless asked for. Components: xx, yy, zz, xy, xz, yz.
    """

    directory: Path
    state: str
    friction: float
    slid: bool
    free_edges: bool
    edge: float
    layers: list[tuple[float, float]]
    largest: list[LargestStress]
    profile_depth: np.ndarray
    profile: dict[str, np.ndarray]
    depth: np.ndarray
    section: dict[str, np.ndarray]
    section_y: float
    tension_section: dict[str, np.ndarray]
    tension_y: float
    map: dict[str, np.ndarray]
    map_depth: float
    volume: dict[str, np.ndarray]
    solid: str = "block"

    def of(self, measure: str, layer: int = 0) -> LargestStress:
        """Returns the largest value of a measure in a layer.

        Parameters
        ----------
        measure : str
            "von_mises", "tresca" or "tension".
        layer : int
            Index of the layer, from the surface.

        Returns
        -------
        LargestStress
            Value, place and error.
        """
        for one in self.largest:
            if (one.measure, one.layer) == (measure, layer):
                return one
        raise UnknownName.among("Stress", measure, [f"{one.measure} of layer {one.layer}" for one in self.largest])


def von_mises(stress: dict[str, np.ndarray]) -> np.ndarray:
    """Returns the stress of von Mises."""
    xx, yy, zz, xy, xz, yz = (stress[name] for name in COMPONENTS)
    return np.sqrt(0.5 * ((xx - yy)**2 + (yy - zz)**2 + (zz - xx)**2) + 3 * (xy**2 + xz**2 + yz**2))


def largest_tension(stress: dict[str, np.ndarray]) -> np.ndarray:
    """Returns the largest principal stress."""
    xx, yy, zz, xy, xz, yz = (np.asarray(stress[name], float) for name in COMPONENTS)
    rows = [np.stack(row, -1) for row in ((xx, xy, xz), (xy, yy, yz), (xz, yz, zz))]
    return np.linalg.eigvalsh(np.stack(rows, -2))[..., -1]


def stresses_in(run: Result) -> list[Stress]:
    """Returns the stresses that a run has recorded (output.stress)."""
    return [_read(run.file, run, state) for state in run.file.members("/stress")]


def _read(file: RunFile, run: Result, state: str, told: dict[str, Any] | None = None) -> Stress:
    """Returns the stresses of a file. told: answer of the program, with the parts of the errors."""
    group = f"/stress/{state}"

    def array(name: str, dimensions: int) -> np.ndarray:
        return file.array(f"{group}/{name}", dimensions)

    def number(name: str) -> float:
        return float(file.attribute(group, name) or 0.0)

    def components(name: str, dimensions: int) -> dict[str, np.ndarray]:
        return dict(zip(COMPONENTS, array(name, dimensions)))

    values, errors, places = array("largest", 2), array("largest_error", 2), array("largest_place", 3)
    largest = []
    for layer, of_layer in enumerate(values):
        for m, measure in enumerate(MEASURES):
            one = told["layers"][layer][measure] if told else {}
            reason = one.get("reason", "" if np.isfinite(errors[layer, m]) else UNRESOLVED)
            parts = {name: one[name] for name in ("between_depths", "between_points", "within_site", "images") if name in one}
            error = None if reason else float(one.get("error", errors[layer, m]))
            x, y, depth = (float(v) for v in places[layer, m])
            largest.append(LargestStress(measure, layer, float(of_layer[m]), error, x, y, depth, reason, parts))
    section, tension_section = array("section", 4)
    section_y, tension_y = array("section_y", 1)
    moved = state in run.fields and run.fields[state].slide != (0.0, 0.0)
    return Stress(run.directory, state, number("friction"), moved and number("friction") == 0.0, run.has_free_edges, run.edge,
                  [(float(a), float(b)) for a, b in array("layers", 2)], largest, array("profile_depth", 1),
                  dict(zip(MEASURES, array("profile", 2).T)), array("depth", 1),
                  dict(zip(COMPONENTS, section)), float(section_y), dict(zip(COMPONENTS, tension_section)), float(tension_y),
                  components("map", 3), number("map_depth"),
                  components("volume", 4) if "volume" in file.members(group) else {})


def _state_of(run: Result, name: str | None) -> State:
    """Returns the state that is asked for; by default the relaxed one, or else the last one."""
    if name is not None:
        return run.fields[name]
    if not run.fields:
        raise SceneError(str(run.directory), "holds no maps of a state", "the stresses follow from the pressure of a state",
                         'run the scene with output.fields = ["relaxed"], or ["segments"]')
    return run.fields.get("relaxed") or list(run.fields.values())[-1]


def refuse(run: Result, solid: str = "block") -> None:
    """Checks that the stresses of a run have a meaning. Raises SceneError."""
    place = str(run.directory)
    if solid == "counter" and not run.number("scene.surface.counter_young"):
        raise SceneError(place, "has no stresses in a second solid", "the second solid is rigid (surface.counter_young)" if
                         run.number("surface.counter.rms") is not None else "it has none (surface.counter)",
                         "leave --solid out for those in the block")
    if run.key("interface.kind") != "wall":
        raise SceneError(place, "has no stresses of a continuum", "interface.kind is not \"wall\": the forces between single atoms are no "
                         "pressure on a continuum", "run the scene with interface.kind = \"wall\"")
    if run.key("interface.law") == "smeared" or run.key("block.model") in ("lattice", "multiscale"):
        if run.key("block.model") != "continuum":
            raise SceneError(place, "has no stresses of a continuum", "its block is a lattice",
                             "run the scene with block.model = \"continuum\"")


def _scene_of(run: Result, solid: str) -> dict[str, Any]:
    """Returns a scene of the run's block, or of its second solid, over a flat wall, for the program."""
    free = run.has_free_edges
    surface = {"kind": "flat", "sites": int(run.needed("scene.surface.sites")), "spacing": run.needed("scene.surface.spacing"),
               "boundary": "free" if free else "periodic"}
    keys = {"block": ("block.young", "block.poisson", "block.layers", "block.surface_stress"),
            "counter": ("surface.counter_young", "surface.counter_poisson", "surface.counter_layers", "surface.counter_surface_stress")}[solid]
    block = {name: run.key(key) for name, key in zip(("young", "poisson", "layers", "surface_stress"), keys) if run.key(key)}
    if not free:
        block["thickness"] = int(run.needed("scene.block.thickness"))
    return {"name": "stress", "surface": surface, "block": {**block, "model": "continuum"}, "interface": {"kind": "wall"},
            "drive": {"path": ["relax"]}}


def compute(run: Result, state: str | None, friction: float | None, depth: str | None, volume: bool, out: store.Outputs,
            solid: str = "block") -> Stress:
    """Computes the stresses below a state by the program, and writes stress.h5. Raises SceneError."""
    refuse(run, solid)
    of = _state_of(run, state)
    slid = friction is None and of.slide != (0.0, 0.0)
    if slid and run.number("surface.counter.rms") is not None:
        raise SceneError(of.name, "has a friction that is not known at each place", "of two rough solids the pressure acts on slopes of both",
                         "give a friction in phase with the pressure: --friction 0.3")
    sign = -1.0 if solid == "counter" else 1.0  # the traction on one solid is opposite to that on the other
    overrides = [f"output.stress={'volume' if volume else 'section'}"]
    overrides += [f"output.stress_friction={sign * friction}"] if friction is not None else []
    overrides += [f"output.stress_depth={depth}"] if depth is not None else []
    with scene_file(_scene_of(run, solid)) as scene, out.replacing(RESULT) as beside:
        told = program.stress_below(scene, overrides, str(run.file.path), of.name, slid, str(beside))
        found = _read(RunFile(beside), run, of.name, told)
    found.slid, found.solid, found.friction = slid, solid, sign * found.friction
    return found
