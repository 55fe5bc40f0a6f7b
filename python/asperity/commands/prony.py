# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""`asperity prony FILE OUT.toml`: branches of a viscoelastic block from a master curve, their file and a plot."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from .. import terminal
from ..files import store
from .options import COUNT, Command, WithTarget, option, same_as_option, word

if TYPE_CHECKING:
    from ..studies.prony import Prony


@dataclass(kw_only=True)
class Options(WithTarget):
    """Options of `asperity prony`."""

    source: str = word("FILE", "the master curve")
    target: str | None = word("OUT.toml", "the file to write (default: FILE with .toml for its ending)", None)
    out: str | None = same_as_option("OUT.toml")
    branches: int | None = option("N", "at most (default: one a decade of frequency)", None, limits=COUNT)
    poisson: float | None = option("0.49", "Poisson's ratio, which shear moduli need", None)
    relaxed: str = option("60MPa", "the relaxed Young's modulus, where the curve does not determine it", "")
    frequency_unit: str = option("UNIT", "Hz or rad/s; holds over what the file says", "")
    modulus_unit: str = option("UNIT", "for example MPa; holds over what the file says", "")
    modulus: str = option("KIND", "E (Young's) or G (of shear); holds over what the file says", "")


def _time(picoseconds: float) -> str:
    scale, unit = next(((s, u) for s, u in ((1e12, "s"), (1e9, "ms"), (1e6, "µs"), (1e3, "ns")) if picoseconds >= s), (1.0, "ps"))
    return f"{picoseconds / scale:.4g} {unit}"


def _text(found: Prony) -> str:
    rows = [[_time(time), f"{ratio:.4g}", f"{1e3 * ratio * found.young:.4g}"] for ratio, time in found.prony]
    return "\n".join([
        f"{found.source}: {len(found.frequency)} frequencies from {found.frequency[0]:.4g} to {found.frequency[-1]:.4g} rad/s, fitted by "
        f"{len(rows)} branches", "", terminal.table(["relaxation time", "over young", "MPa"], rows), "",
        f"  young          {found.relaxed}",
        f"  at once        {1e3 * found.young * (1 + sum(r for r, _ in found.prony)):.3g} MPa",
        f"  fit            {found.errors}"])


def _carry_out(given: Options, voice: terminal.Voice) -> int:
    """Carries out `asperity prony`. Returns the exit code."""
    from ..plots.prony import moduli
    from ..plots.style import make, picture
    from ..studies.prony import prony

    target = given.place() or str(Path(given.source).with_suffix(".toml"))
    plot = Path(target).with_suffix(".svg")
    store.require_new(plot)
    found = prony(given.source, target, given.branches, given.poisson, frequency_unit=given.frequency_unit,
                  modulus_unit=given.modulus_unit, modulus=given.modulus, relaxed=given.relaxed)
    figure = make(lambda ax: moduli(found, ax))
    assert figure is not None
    with store.new(plot) as beside:
        Path(beside).write_bytes(picture(figure, "svg"))
    voice.tell({**found.scene, "fit": {name: getattr(found, name) for name in (
        "source", "young_range", "stated", "rms_error", "storage_error", "loss_error", "largest_error", "at", "notes")}, "file": target})
    voice.show(_text(found))
    for note in found.notes:
        voice.say(f"  note: {note}")
    voice.say(f"  written: {target} (block.prony = \"{Path(target).name}\" in a scene), {plot}")
    return 0


COMMAND = Command(Options, _carry_out, progress=False, more=(
    "Text of columns: frequency, storage and loss modulus (or tan δ), maybe a shift factor aT; names and units stand above. OUT.toml is "
    "what block.prony of a scene names; OUT.svg shows the fit."))
