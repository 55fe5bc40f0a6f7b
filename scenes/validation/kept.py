# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Runs that are kept, so that a script that is started again goes on where it was stopped."""
import os
import pathlib
import sys
from typing import Any

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
import asperity


def run(scene: dict | os.PathLike, keys: dict[str, Any], place: pathlib.Path) -> asperity.Result:
    """Returns the result in this directory, made now unless a whole one is there; one that was stopped is refused by the program, which says how
    to go on with it. Its scene is not compared with the one that is asked for."""
    if (place / "result.json").exists():
        result = asperity.load(place)
        if result.stopped in ("", "max_steps"):
            return result
    return asperity.run(scene, keys, place, progress=False)
