# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""`asperity report DIR`: a run or a sweep as one page."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from ..errors import InputOutputError
from ..terminal import Voice
from .options import Command, Options as Base, out, word


@dataclass(kw_only=True)
class Options(Base):
    """Options of `asperity report`."""

    directory: str = word("DIR", "the result directory")
    out: str | None = out("DIR", "directory of report.html and its figures")


def _carry_out(given: Options, voice: Voice) -> int:
    """Carries out `asperity report`. Returns the exit code."""
    from ..reports.sweep import write_page

    page = write_page(Path(given.directory), out=given.out)
    voice.show(page.said)
    voice.tell({"file": page.path, "unread": page.unread})
    if page.unread:
        raise InputOutputError(given.directory, "the page shows only a part of the result", "\n".join(page.unread),
                               "run the scene again, or take a copy of the file that is whole")
    return 0


COMMAND = Command(Options, _carry_out, progress=False)
