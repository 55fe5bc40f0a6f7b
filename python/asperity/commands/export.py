# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""`asperity export DIR --to FORMAT`: maps and trajectory of a run for other programs."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from ..terminal import Voice
from .options import Command, Options as Base, option, out, word


@dataclass(kw_only=True)
class Options(Base):
    """Options of `asperity export`."""

    directory: str = word("DIR", "the result directory")
    to: str = option("FORMAT", "xyz (OVITO, ASE), vtk (ParaView) or png")
    out: str | None = out("DIR/export", "directory of the files")


def _carry_out(given: Options, voice: Voice) -> int:
    """Carries out `asperity export`. Returns the exit code."""
    from ..reports.export import export

    files = export(Path(given.directory), given.to, given.out)
    voice.show("\n".join(map(str, files)))
    voice.tell({"files": files})
    return 0


COMMAND = Command(Options, _carry_out, progress=False)
