#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""names.py PROGRAM FILE: writes the names of results and scenes for type checkers and editors, asperity/results/names.pyi.

They are made of what the program says of itself: the numbers of a result (defaults --results) and the keys of a scene
(defaults --json). The build writes the file into the package; the names are of a type checker alone.
"""

import json
import re
import sys
import textwrap
from pathlib import Path

from generate import say

WHOLE = ("exit_code", "segment", "events", "sites_moved", "atoms", "steps", "iterations", "ranks", "threads", "calls")
PAIRS = ("slide", "site", "dissipated.jumps[].mean_height", "dissipated.jumps[].force", "dissipated.jumps[].contact_fraction")
"""Numbers of result.json that are whole, and those that are lists of numbers."""
TEXTS = ("rows[].columns", "rows[].texts", "sentences")
"""Lists of texts."""


def kind_of(path: str, unit: str) -> str:
    """Returns the type of a value of result.json."""
    name = path.rpartition(".")[2]
    if name in ("on", "converged", "detail"):
        return "bool"
    if path in TEXTS:
        return "list[str]"
    if name in PAIRS or path in PAIRS:
        return "list[float]"
    return "int" if name in WHOLE else "float" if unit else "str"


def classes_of(tree: dict, name: str, out: list[str]) -> None:
    """Writes the class of an object, after those of its members; a leaf is a pair of type and meaning."""
    lines = []
    for key, value in tree.items():
        if isinstance(value, tuple):
            lines.append((key, *value))
            continue
        many, star = key.endswith("[]"), "*" in value
        inner = "".join(word.title() for word in key.removesuffix("[]").split("_"))
        inner = inner.removesuffix("s") if many or star else inner
        full = inner if name == "Numbers" else name + inner
        classes_of(value["*"] if star else value, full, out)
        lines.append((key.removesuffix("[]"), f"list[{full}]" if many else f"dict[str, {full}]" if star else full, ""))
    base = "" if name == "Numbers" or name.endswith(("Arrays", "Maps")) else "(Values)"
    out += [f"\nclass {name}{base}:"]
    for key, kind, meaning in lines:
        if (name, key) != ("Numbers", "segments"):  # a property of Result
            out += [f"    {key}: {kind}", *([f'    """{meaning}"""'] if meaning else [])]


def named(rows: list[tuple[str, str]]) -> dict:
    """Returns a tree of the paths of values, "." between its levels; a leaf is what stands beside its path."""
    tree: dict = {}
    for path, leaf in rows:
        *above, last = path.split(".")
        at = tree
        for part in above:
            at = at.setdefault(part, {})
        at.setdefault(last, leaf)
    return tree


def stub(program: str) -> str:
    """Returns the stub of results.names."""

    def said(unit: str, meaning: str) -> str:
        first = re.split("[;:(]", meaning)[0].strip('" ')  # the page has all of it
        return ": ".join(filter(None, ("" if unit == "1" else unit, textwrap.shorten(first.replace('"', "'"), 110, placeholder=" ..."))))

    results = json.loads(say(program, "defaults", "--results", "--json"))
    out: list[str] = []
    rows = [(path, (kind_of(path, q["unit"]), said(q["unit"], q["meaning"]))) for path, q in results.items()
            if not (path.endswith("[]"))]
    classes_of(named(rows), "Numbers", out)
    losses = sorted({path.partition(".")[0] for path in results if path.startswith("dissipated_in_")})
    out += ["\nclass Losses:", *(f"    @property\n    def {name}(self) -> float: ..." for name in losses)]  # of a point (_engine.pyi)
    keys = json.loads(say(program, "defaults", "--json"))
    classes_of(named([(key, ("Any", said(q["unit"], q["doc"]))) for key, q in keys.items() if not key.startswith("sweep")]), "Scene", out)
    table = re.findall(r"^\| `(series|fields/\*|substrate)/(\w+)` \| (.*?) \| .*? \| (.*) \|$", say(program, "defaults", "--results"), re.M)
    for group, name in (("series", "SeriesArrays"), ("fields/*", "StateMaps"), ("substrate", "SubstrateMaps")):
        left_out = ("gap_edges", "gap_density", "atoms", "type", "spectrum_q", "spectrum", "spectrum_target")
        classes_of({key: ("np.ndarray", said(unit, meaning)) for of, key, unit, meaning in table if of == group and key not in left_out},
                   name, out)
    return ("# SPDX-FileCopyrightText: 2026 The Asperity authors\n# SPDX-License-Identifier: MIT\n#\n"
            "# Names of results and of scenes with their types and units, for type checkers and editors: what a run has not is not\n"
            "# there. Made by packaging/names.py of what the program says of itself.\nfrom typing import Any\n\n"
            "import numpy as np\n\nfrom .values import Values\n\nclass Units(Values):\n    def __getattr__(self, name: str) -> Any: ...\n"
            + "\n".join(out) + "\n")


def main() -> None:
    made, file = stub(sys.argv[1]), Path(sys.argv[2])
    if not file.exists() or file.read_text() != made:
        file.write_text(made)


if __name__ == "__main__":
    main()
