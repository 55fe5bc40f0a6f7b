# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""`asperity stress`: the stresses below the surface of a run, and the largest ones with their errors."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..arguments import checks_call
from ..errors import Error, SceneError
from ..files import store
from ..terminal import Voice
from .options import Command, Options as Base, option, out, word

SOLIDS = ("block", "counter")

if TYPE_CHECKING:
    from ..results.result import Result
    from ..studies.stress import Stress


@dataclass(kw_only=True)
class Options(Base):
    """Options of `asperity stress`."""

    result: str = word("DIR", "the result directory")
    state: str | None = option("NAME", "the state (default: relaxed, or the last one)", None)
    solid: str = option("WHICH", "below the surface of which solid: block, or the second one, counter", "block", choices=SOLIDS)
    friction: float | None = option("0.3", "coefficient of a friction in phase with the pressure (default: that of a slide)", None)
    depth: str | None = option("5nm", "largest depth of the section (default: three times that of the largest stress)", None)
    volume: bool = option("", "all points at all depths of the section too", False)
    out: str | None = out("DIR/stress", "directory of the files (of the second solid: DIR/stress-counter)")


@checks_call
def stress(result: Any, state: str | None = None, friction: float | None = None, depth: str | None = None,
           volume: bool = False, out: str | os.PathLike | None = None, solid: str = "block") -> Stress:
    """Computes the stresses below the surface of a run, with the largest ones, their places and their errors.

        found = asperity.stress("results/coated", friction=0.3)
        found.of("tension", layer=0).value, found.of("tension", layer=0).depth    # GPa, Å

    Parameters
    ----------
    result : str, os.PathLike or Result
        Directory of a run over a wall, quasi-static, or its result.
    state : str, optional
        Name of the state; None: the relaxed one, or the last one.
    friction : float, optional
        Friction coefficient of a traction along x in phase with the pressure; None: the friction of a state that a slide has
        reached, none for others.
    depth : str, optional
        Largest depth of the section with its unit, "5 nm"; None: three times that of the largest stress, and all layers.
    volume : bool
        True: all points at all depths too.
    out : str or os.PathLike, optional
        Directory of the files; None: stress in the directory of the run, for the second solid stress-counter.
    solid : str
        "block", or "counter": below the surface of the second solid (surface.counter), with depths from its surface into it.

    Returns
    -------
    Stress
        Largest stresses, profile, section and map.

    Raises
    ------
    SceneError
        The stresses have no meaning, or an argument is refused.
    InputOutputError
        The directory holds no result, or its maps cannot be read.
    """
    from ..results.result import Result

    if not isinstance(result, str | os.PathLike | Result):
        raise SceneError(f"result = {result!r:.60}", "is no result", "", "give the directory of a run, or its result")
    run = result if isinstance(result, Result) else Result(Path(result))
    return _computed(run, state, friction, depth, volume, None if out is None else os.fspath(out), solid)[0]


def _computed(run: Result, state: str | None, friction: float | None, depth: str | None, volume: bool, out: str | None,
              solid: str) -> tuple[Stress, Path]:
    """Computes and writes the stresses. Returns them with the page."""
    from ..reports import stress as report_stress
    from ..results.result import expect
    from ..studies.stress import RESULT, compute

    if solid not in SOLIDS:
        raise SceneError(f'solid = "{solid}"', "is none of them", "", 'take "block" or "counter"')
    place = run.directory / ("stress" if solid == "block" else "stress-counter") if out is None else store.chosen(out, "")
    expect(run.directory, "run.h5")
    if friction is not None and not -2 <= friction <= 2:
        raise SceneError(f"--friction {friction:g}", "is no friction coefficient", "from -2 to 2 are",
                         "for example: --friction 0.3")
    store.require_free({place: report_stress.FILES}, inputs=[str(run.file.path)])
    try:
        with store.outputs(place, [RESULT, report_stress.NUMBERS, report_stress.IMAGE], inputs=[str(run.file.path)]) as files:
            found = compute(run, state, friction, depth, volume, files, solid)
            return found, report_stress.write(found, place, files)
    except Error as error:
        error.rewrite(lambda text: text.replace("--set output.stress_depth=", "--depth ").replace("output.stress_depth", "--depth"))
        raise


def _carry_out(given: Options, voice: Voice) -> int:
    """Carries out `asperity stress`. Returns the exit code."""
    from ..reports import stress as report_stress
    from ..results.result import Result

    run = Result(Path(given.result))
    found, page = _computed(run, given.state, given.friction, given.depth, given.volume, given.out, given.solid)
    voice.tell({**report_stress.answer_of(found), "directory": page.parent})
    voice.show(report_stress.text_of(found))
    voice.say(f"\nwritten: {page.parent}: report.html, stress.json, stress.h5, stress.vti (ParaView)")
    return 0


COMMAND = Command(Options, _carry_out, progress=False, more=(
    "Of a quasi-static run over a wall: von Mises, Tresca and the largest tension in each layer with their places, a section, and "
    "stress.vti for ParaView."))
