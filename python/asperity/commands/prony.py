# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""`asperity prony FILE OUT.toml`: branches of a viscoelastic block from a master curve, their file and a plot."""

from __future__ import annotations

from pathlib import Path

from .. import terminal
from ..files import store
from ..plots.prony import moduli
from ..plots.style import make, picture
from ..studies.prony import Prony, prony


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


def prony_command(source: str, target: str, branches: int | None, poisson: float | None, frequency_unit: str, modulus_unit: str,
                  modulus: str, relaxed: str, voice: terminal.Voice) -> int:
    """Carries out `asperity prony`.

    Parameters
    ----------
    source : str
        File of the master curve.
    target : str
        File to write; the plot has its name with .svg.
    branches : int | None
        Number of branches at most.
    poisson : float | None
        Poisson's ratio, which shear moduli need.
    frequency_unit, modulus_unit, modulus : str
        Units of frequency and moduli, and E or G, if the file does not say them.
    relaxed : str
        Relaxed Young's modulus with its unit; "": that of the fit.
    voice : Voice
        Output of the command.

    Returns
    -------
    int
        The exit code.
    """
    plot = Path(target).with_suffix(".svg")
    store.require_new(plot)
    found = prony(source, target, branches, poisson, frequency_unit=frequency_unit, modulus_unit=modulus_unit, modulus=modulus,
                  relaxed=relaxed)
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
