# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""`asperity states`: the stable states of a contact under its load."""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from pathlib import Path

from ..terminal import Progress, Voice, millijoules, table
from ..units import MILLIJOULE
from .options import COUNT, Command, OfScene, option, out
from .studies import EARLY


@dataclass(kw_only=True)
class Options(OfScene):
    """Options of `asperity states`."""

    out: str | None = out("results/<scene>-states")
    starts: int = option("N", "states from so many layers laid on the substrate at random heights (default: 20)", 20, limits=COUNT)


def _carry_out(given: Options, voice: Voice) -> int:
    """Carries out `asperity states`. Returns the exit code."""
    from ..studies.states import NEAR, NUMBERS, RESULT, states

    warnings.showwarning = lambda message, *_: voice.say(f"note: {message}")
    scene = given.scene()
    place, shown = Path(given.out if given.out is not None else f"results/{Path(scene).stem}-states"), Progress(voice.progress)
    try:
        found = states(scene, given.sets, place, given.starts, lambda text: shown.update(text) if shown.due() else None)
    except KeyboardInterrupt:
        voice.show(EARLY)
        return 75
    finally:
        shown.finish()

    def cell(state: dict, name: str) -> str:
        return f"{state[name]:.4g}" + f" ({millijoules(state[name])})" * (name in ("binding_energy", "elastic_energy"))

    rows = [[*(cell(s, name) for name in NUMBERS), f"{s['barrier']:.3g}" if s["barrier"] else "-",
             ", ".join(s["found"])] for s in found["states"]]
    voice.tell({**found, "directory": place})
    rows = [[str(i), *row] for i, row in enumerate(rows)]
    voice.show(table(["state", "binding energy, meV/Å² (mJ/m²)", "elastic, meV/Å² (mJ/m²)", "mean height, Å", "contact", "repulsive",
                       "to the next, MPa", "found by"], rows, left=(0, 7)))
    deepest = found["states"][found["deepest_found"]]["binding_energy"]
    voice.show(f"The deepest state found by the path and {found['starts']} random starts has a binding energy of {deepest:.4g} meV/Å² "
          f"({millijoules(deepest)} mJ/m²)" + (
              f"; {found['starts_at_deepest']} of the starts ended within {NEAR:.0%} of it. A further start ends deeper with a "
              f"probability of at most {found['deeper_next']:.2g}." if found["starts"] else "."))
    voice.show(f"The path went in to a mean height of {found['innermost']:.2f} Å and {found['pressed_to']:.4g} MPa; "
          f"it ended because: {found['ended']}.")
    if found["approach_less_run"]:
        less = found["approach_less_run"]
        voice.show(f"The state after an approach binds by {less:+.3g} meV/Å² ({less * MILLIJOULE:+.3g} mJ/m²) relative to that of a run.")
    voice.show("May be missed: " + "; ".join(found["may_miss"]) + f".\n{place / RESULT}")
    return 0


COMMAND = Command(Options, _carry_out, more=(
    "A path at a held mean height goes inwards and back; the states are told with the pressures between them. The same command goes on "
    "where it was stopped."))
