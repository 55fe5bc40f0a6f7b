# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The points of a sweep: every combination of the values of its axes.

key=v1,v2,..., key=start:stop:step or key=start:stop:xFACTOR (stop included) is an axis; it stands behind --set or in the scene's
[sweep], where a --set of the same key replaces it. A single value is no axis: it overrides the key at
every point. The axes surface.seed and drive.seed are repetitions, which tables average over.
"""

from __future__ import annotations

import contextlib
import itertools
import math
import re
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from ..errors import SceneError
from ..running import program
from ..running.scene import toml_value

MOST_POINTS = 10_000
LISTS = ("list", "rows")
"""kinds of keys whose value has commas of its own"""


@dataclass
class Axis:
    """Values of one key, in their order."""

    key: str
    values: list[str]
    """as they stand behind --set"""
    where: str = ""
    """the place of the list of values, for messages"""


def is_seed(key: str) -> bool:
    """Returns True for a key whose values are random numbers' seeds: results are averaged over it."""
    return key.endswith(".seed")


def _number(text: str) -> float:
    """Returns the number in a text, NaN if it is none."""
    with contextlib.suppress(ValueError):
        return float(text)
    return math.nan


def _range(text: str, where: str, whole: bool) -> list[str]:
    """Returns the values of "0.1:25:0.25" or "1e-3:1e3:x10"; none if it is no range."""
    parts = text.split(":")
    by_factor = len(parts) == 3 and parts[2].strip().startswith("x")
    if by_factor:
        parts[2] = parts[2].strip()[1:]
    numbers = [_number(part) for part in parts]
    if len(numbers) < 2 or not all(map(math.isfinite, numbers[:2])):
        return []
    if len(numbers) != 3 or not math.isfinite(numbers[2]):
        raise SceneError(where, "is no range", "a range is start:stop:step or start:stop:xFACTOR, three plain numbers",
                         "for example surface.rms=0.5:10:0.5")
    start, stop, step = numbers
    steps = (stop - start) / step if step else -1.0
    if by_factor:
        growing = start > 0 and stop > 0 and step > 0 and step != 1
        steps = math.log(stop / start) / math.log(step) if growing else -1.0
    if not steps >= 0:
        raise SceneError(where, "is a range without values",
                         f"{'factors' if by_factor else 'steps'} of {step:g} do not lead from {start:g} to {stop:g}",
                         "give start:stop:step with a step towards stop")
    if not steps < MOST_POINTS:
        raise SceneError(where, f"asks for {math.floor(steps) + 1:.3g} values",
                         f"a sweep has {MOST_POINTS} points at most", "take longer steps")
    count = math.floor(steps + 1e-6 if by_factor else steps + 1e-9) + 1
    values = [start * step**i if by_factor else start + i * step for i in range(count)]
    # Twelve digits: 0.1 + 2 x 0.1 is 0.3.
    return [f"{v:.0f}" if whole and v == round(v) else f"{v or 0.0:.12g}" for v in values]


def _axis(key: str, values: str, where: str) -> Axis:
    kind = program.schema()[key]["kind"]
    axis = Axis(key, [], where)
    if re.fullmatch(r"\[[^\[\]]*\]", values.strip()):  # as in a scene's [sweep]
        values = re.sub(r"""(?<![^\s,\[])(["'])(.*?)\1(?=\s*[,\]])""", r"\2", values.strip())[1:-1]
    for part in (p.strip() for p in values.split(",")):
        if not part:
            raise SceneError(where, "has an empty value", "values stand between commas",
                             f"for example --set {key}=v1,v2")
        several = _range(part, where, kind == "integer") if kind in ("integer", "number") else []
        axis.values += several or [part]
    return axis


def _lists(values: str) -> list[Any]:
    """Returns the lists that stand side by side, as in [1], [2]; no list if the text is something else."""
    try:
        return program.json.loads(f"[{values}]")
    except ValueError:
        return []


def _several_lists(values: str, kind: str) -> bool:
    """Returns True if the text has several values of a key that is a list, side by side or in brackets of their own."""
    found = _lists(values)
    inner = found[0] if len(found) == 1 and isinstance(found[0], list) and kind == "list" else found
    return (len(inner) > 1 or inner is not found) and bool(inner) and all(isinstance(one, list) for one in inner)


def _first_list(values: str) -> str:
    found = _lists(values)
    return toml_value(found[0] if len(found) > 1 else found[0][0])


def axes_of(assignments: list[str], of_scene: list[dict[str, str]]) -> tuple[list[Axis], list[str]]:
    """Separates the keys that are swept from those that are fixed. Raises SceneError."""
    schema = program.schema()
    found: dict[str, Axis] = {}
    fixed: list[str] = []
    for assignment in assignments:
        where = "--set " + assignment
        key, equals, values = assignment.partition("=")
        key = key.strip()
        if key in schema and schema[key]["kind"] in LISTS and _several_lists(values, schema[key]["kind"]):
            raise SceneError(where, f"{key} cannot be swept", "its value is a list itself", "write one scene for each, or one run "
                             f"for each: asperity run SCENE --set '{key}={_first_list(values)}'")
        if not equals or key not in schema or schema[key]["kind"] in LISTS:
            fixed.append(assignment)  # a list has commas of its own; the program finds mistakes
            continue
        if key in found:
            raise SceneError(where, f"{key} is given twice", "every key is one axis of the sweep",
                             f"put its values into one list: --set {key}=v1,v2")
        found[key] = _axis(key, values, where)
    for variation in (v for v in of_scene if v["key"] not in found):
        if schema[variation["key"]]["kind"] in LISTS:
            raise SceneError(variation["where"], f"{variation['key']} cannot be swept",
                             "its value is a list itself", "write one scene for each")
        found[variation["key"]] = _axis(**variation)
    fixed += [f"{axis.key}={axis.values[0]}" for axis in found.values() if len(axis.values) == 1]
    axes = [axis for axis in found.values() if len(axis.values) > 1]
    if math.prod(len(axis.values) for axis in axes) > MOST_POINTS:
        raise SceneError("sweep", f"the grid has more than {MOST_POINTS} points", f"{MOST_POINTS} are the most",
                         "sweep fewer values or fewer keys")
    return axes, fixed


def in_decades(values: Iterable[Any]) -> bool:
    """Returns True if values are spread over more than two decades, which are then the scale of a plot."""
    numbers = list(values)
    return bool(numbers) and all(isinstance(v, (int, float)) and v > 0 for v in numbers) and bool(max(numbers) > 100 * min(numbers))


def points_of(axes: list[Axis]) -> list[list[str]]:
    """Returns every combination, the last axis fastest, each as a list of "key=value"."""
    return [list(point) for point in itertools.product(*([f"{a.key}={v}" for v in a.values] for a in axes))]


def shown(value: Any) -> str:
    """Returns a value of a key as it stands in tables and names: "3", "multiscale"."""
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        return f"{value:.12g}"
    return value if isinstance(value, str) else toml_value(value)
