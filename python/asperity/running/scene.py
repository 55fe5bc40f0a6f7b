# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Scenes as dictionaries: their text, their overrides, and a file of them for the program."""

from __future__ import annotations

import contextlib
import json
import math
import os
import re
import sys
import tempfile
from collections.abc import Iterator, Mapping
from pathlib import Path
from types import FrameType
from typing import Any

from ..errors import Error, SceneError

SceneLike = str | Path | Mapping[str, Any]
Overrides = Mapping[str, Any] | list[str]
STANDARD_INPUT = "-"
"""Name by which a command line asks for the standard input."""
OVERRIDE = "--set "
"""How the place of a problem of an override begins."""


def toml_value(value: Any) -> str:
    """Returns a value as it stands in TOML; a JSON string is a TOML string as well. Raises SceneError for another
    object."""
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(toml_value(v) for v in value) + "]"
    if hasattr(value, "item"):  # a number of numpy
        value = value.item()
    if isinstance(value, Path):
        value = str(value)
    if isinstance(value, float) and not math.isfinite(value):
        return repr(value)  # nan, inf: the program refuses them by the name of their key
    try:
        return json.dumps(value, ensure_ascii=False)
    except TypeError:
        raise SceneError("", f"{value!r:.60} is no value of a key", f"it is of type {type(value).__name__}",
                         "give a number, a text, true or false, or a list of them") from None


def toml_of(scene: Mapping[str, Any]) -> str:
    """Returns the TOML text of {"surface": {"rms": 1}, ...}; keys may also be whole: {"surface.rms": 1}."""
    lines, sections = [], []
    for name, value in scene.items():
        if isinstance(value, Mapping):
            sections.append(f"[{name}]")
            sections += [f"{key} = {toml_value(v)}" for key, v in value.items() if v is not None]
            sections.append("")
        elif value is not None:
            lines.append(f"{name} = {toml_value(value)}")
    return "\n".join(lines + [""] * bool(lines) + sections)


def assignments(overrides: Overrides | None) -> list[str]:
    """Returns overrides as "key=value": of a mapping, whose sections may be mappings themselves, or a list of such strings.
    Raises SceneError for anything else."""
    if overrides is None:
        return []
    if not isinstance(overrides, Mapping):
        if isinstance(overrides, (list, tuple)) and all(isinstance(o, str) for o in overrides):
            return list(overrides)
        raise SceneError("overrides", f"are {overrides!r:.60}", "keys with their values are needed",
                         'for example {"surface.rms": 2.0}, or ["surface.rms=2.0"]')
    found = []
    for key, value in overrides.items():
        if isinstance(value, Mapping):
            found += assignments({f"{key}.{name}": inner for name, inner in value.items()})
        elif value is None:
            raise SceneError(str(key), "= None", "that is no value of a key", "leave the key out, or give it a value")
        else:
            found.append(f"{key}={value if isinstance(value, str) else toml_value(value)}")
    return found


def file_beside(name: str, scene: str) -> str:
    """Returns the path of a file that a scene names: beside the scene, or else in the working directory."""
    beside = Path(scene).parent / name
    return str(beside if Path(str(beside).partition(":/")[0]).exists() else name)


def inputs_of(file: str, scene: Mapping[str, Any]) -> list[str]:
    """Returns the files that a command reads for a scene: its file, maps or atoms, table, and maps of the sites."""
    named = [scene.get(section, {}).get(key) for section, key in (("surface", "file"), ("surface", "counter"), ("interface", "table"))
             if scene.get(section, {}).get(key) != "none"]
    named += [value for key, value in scene.get("interface", {}).items()
              if key != "table" and isinstance(value, str) and Path(file_beside(value, str(file)).partition(":/")[0]).is_file()]
    return [str(file), *(file_beside(name, str(file)) for name in named if name)]


def _caller() -> str:
    """Returns file and line of the script that called the package."""
    package = str(Path(__file__).parents[1])
    frame: FrameType | None = sys._getframe(1)
    while frame and (frame.f_code.co_filename.startswith(package) or frame.f_code.co_filename == contextlib.__file__):
        frame = frame.f_back
    return f"{os.path.basename(frame.f_code.co_filename)}:{frame.f_lineno}" if frame else "the scene"


@contextlib.contextmanager
def scene_given(scene: SceneLike, overrides: Overrides | None) -> Iterator[tuple[str, list[str]]]:
    """Yields the file of a scene and its overrides as "key=value". Errors name the line of the script in place of --set."""
    try:
        with scene_file(scene) as file:
            yield file, assignments(overrides)
    except Error as error:
        if overrides:
            caller = _caller()
            error.rewrite(lambda text: f"{caller}: {text[len(OVERRIDE):]}" if text.startswith(OVERRIDE) else text)
        raise


@contextlib.contextmanager
def scene_file(scene: SceneLike, folder: str = "") -> Iterator[str]:
    """Yields the file of a scene; for a dictionary a temporary one, named by its entry "name". Raises SceneError for anything else."""
    piped = str(scene) == STANDARD_INPUT
    if isinstance(scene, Mapping):
        name, text = scene.get("name", "scene"), toml_of({key: value for key, value in scene.items() if key != "name"})
    elif piped:  # once: the commands start the program several times
        name, text = "stdin", sys.stdin.read()
    elif not isinstance(scene, (str, os.PathLike)):
        raise SceneError("scene", f"is {scene!r:.60}", f"it is of type {type(scene).__name__}",
                         'give a file, "scene.toml", or a dictionary: {"surface": {"sites": 64}}')
    else:
        yield str(scene)
        return
    with tempfile.TemporaryDirectory(prefix="asperity-", dir=folder or None) as directory:
        file = Path(directory) / f"{name}.toml"
        file.write_text(text, encoding="utf-8")
        try:
            yield str(file)
        except Error as error:  # the caller has not seen this file
            place, caller = re.escape(str(file)) + ("" if piped else r"(:\d+)*"), "stdin" if piped else _caller()
            error.rewrite(lambda text: re.sub(place, caller, text))
            raise
