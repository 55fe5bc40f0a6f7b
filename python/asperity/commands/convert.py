# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""`asperity convert FILE OUT.h5`: a map of heights or a substrate's atoms as HDF5."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from ..terminal import Voice
from .options import Command, WithTarget, option, same_as_option, word


@dataclass(kw_only=True)
class Options(WithTarget):
    """Options of `asperity convert`."""

    source: str = word("FILE", "the file to convert")
    target: str | None = word("OUT.h5", "the file to write (default: FILE with .h5 for its ending)", None)
    out: str | None = same_as_option("OUT.h5")
    channel: str | None = option("NAME", "of a file with several maps: this one, by name or number", None)


def _carry_out(given: Options, voice: Voice) -> int:
    """Carries out `asperity convert`. Returns the exit code."""
    from ..maps.convert import convert

    target = given.place() or Path(given.source.partition(":/")[0]).with_suffix(".h5")
    said, *notes = convert(given.source, target, given.channel).split("\n")
    voice.show(said)
    for note in notes:
        voice.say(note)
    voice.tell({"file": target, "text": said, "notes": [note.removeprefix("note: ") for note in notes]})
    return 0


COMMAND = Command(Options, _carry_out, progress=False, more=(
    "Maps: text with headers, ESRI grids, XYZ, and by SurfaceTopography Gwyddion and instruments' files. Atoms: LAMMPS data, and by ASE "
    "extended XYZ."))
