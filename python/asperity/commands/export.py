# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""`asperity export DIR --to FORMAT`: maps and trajectory of a run for other programs."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

from ..arguments import checks_call
from ..terminal import Voice
from .options import Command, Options as Base, option, out, word


@dataclass(kw_only=True)
class Options(Base):
    """Options of `asperity export`."""

    directory: str = word("DIR", "the result directory")
    to: str = option("FORMAT", "xyz (OVITO, ASE), vtk (ParaView) or png")
    out: str | None = out("DIR/export", "directory of the files")


@checks_call
def export(directory: str | os.PathLike, to: str, out: str | os.PathLike | None = None) -> list[Path]:
    """Writes the maps and the trajectory of a run for other programs.

    Parameters
    ----------
    directory : str or os.PathLike
        Result directory of a run.
    to : str
        "xyz" (OVITO, ASE), "vtk" (ParaView) or "png".
    out : str or os.PathLike, optional
        Directory of the files; None: export in the directory of the run.

    Returns
    -------
    list of Path
        The written files.

    Raises
    ------
    InputOutputError
        The directory has no maps and no trajectory.
    SceneError
        The format is unknown.
    """
    from ..reports.export import export as write

    return write(Path(directory), to, None if out is None else os.fspath(out))


def _carry_out(given: Options, voice: Voice) -> int:
    """Carries out `asperity export`. Returns the exit code."""
    files = export(given.directory, given.to, given.out)
    voice.show("\n".join(map(str, files)))
    voice.tell({"files": files})
    return 0


COMMAND = Command(Options, _carry_out, progress=False)
