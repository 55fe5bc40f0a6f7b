# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""A module of the package imports only what stands before it here, inside functions too: no circles, between subpackages or
within one. Imports that only type checkers see (if TYPE_CHECKING) count as well."""

import ast
import importlib
import re
from pathlib import Path

import asperity
from asperity.commands.options import purposes

# From the bottom to the top: a subpackage and its modules from the bottom to the top, or modules of the package itself.
SUBPACKAGES = {
    "above": (), "errors": (), "units": (), "arguments": (), "terminal": (),
    "files": ("store",),
    "results": ("values", "run_file", "frames", "losses", "result"),
    "running": ("scene", "program", "lock", "pool", "runs", "engine"),
    "maps": ("channels", "arrays", "text", "columns", "master_curve", "force_curves", "atoms", "convert", "height_map", "missing_waves"),
    "theories": ("renormalised", "sphere", "indentation", "tip_shape", "yielding", "viscoelastic", "combined"),
    "studies": ("grid", "tables", "forecast", "sweeps", "quantities", "variations", "cost_parameters", "cost", "stated_number", "estimate_parts",
                "estimate", "estimates", "map_scene", "tip", "prony", "curve_fit", "curves", "states", "stress"),
    "plots": ("style", "run", "prony", "tip", "curve", "stress", "sweep"),
    "reports": ("page", "sentences", "export", "stress", "run", "cost", "estimate", "tip", "curve", "sweep"),
    "commands": ("command_line", "options", "studies", *purposes()),
    "functions": (), "crack": (), "__init__": (), "__main__": (),
}
ORDER = [name for package, modules in SUBPACKAGES.items()
         for name in ([f"{package}.{module}" for module in ("__init__", *modules)] if modules else [package])]
STUB = "results.names"
"""Types of the names of a result, which a build writes for type checkers (packaging/names.py)."""
PLACE = {name: place for place, name in enumerate(ORDER)}


def imported(text: str, name: str):
    """Modules of the package that the text of a module imports."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.ImportFrom) and node.level:
            above = name.split(".")[:-1][:2 - node.level] if node.level <= 2 else None
            assert above is not None, f"{name} imports from outside of the package"
            module = ".".join(above + (node.module.split(".") if node.module else []))
            inside = [f"{module}.{a.name}".lstrip(".") for a in node.names]
            if module != STUB and inside != ["_engine"]:  # which is compiled
                yield from [i for i in inside if i in PLACE] or [module]


def wrong(text: str, name: str):
    """Imports of a module that do not stand before it."""
    return [other for other in imported(text, name) if PLACE.get(other, len(ORDER)) >= PLACE[name]]


def test_modules_import_only_what_is_below():
    root = Path(asperity.__file__).parent
    files = {str(f.relative_to(root).with_suffix("")).replace("/", "."): f for f in root.rglob("*.py")}
    assert files.keys() == PLACE.keys()
    for name, file in files.items():
        assert not wrong(file.read_text(), name), f"{name} imports what does not stand before it: {wrong(file.read_text(), name)}"


def test_imports_from_above_are_seen():
    for name, text in (("studies.grid", "from .sweeps import sweep"), ("studies.grid", "from . import sweeps"),
                       ("running.scene", "def f():\n    from ..studies import grid"), ("units", "from .running.program import call"),
                       ("results.result", "if TYPE_CHECKING:\n    from ..plots.run import RunPlots"),
                       ("results.result", "from ..nowhere import x"), ("errors", "from . import units")):
        assert wrong(text, name), text


def test_what_is_imported_late_exists_and_stands_above():
    root, found = Path(asperity.__file__).parent, 0
    for file in root.rglob("*.py"):
        name = str(file.relative_to(root).with_suffix("")).replace("/", ".")
        for module, member in re.findall(r'from_above\("([\w.]+)\.(\w+)"\)', file.read_text()):
            assert PLACE[module] > PLACE[name] and hasattr(importlib.import_module(f"asperity.{module}"), member)
            found += 1
    assert found >= 8


ENGINE = Path(__file__).resolve().parents[2] / "engine"
ABOVE_THE_CASE = ("theory", "dynamics", "statics", "path", "run", "plan", "script", "commands")
# A key of the scene that is read; one that is written makes a scene, which resolve() makes a case of.
RAW = re.compile(r"\bscene\.(surface|block|interface|drive|theory|numerics|output)\.(?!\w+( = |\.\w+ = ))\w+")
# One body rigid: E/(1-nu^2).
CONTACT_MODULUS = re.compile(r"\(1\.0? - [\w.]*(poisson|nu)\w* \* [\w.]*(poisson|nu)\w*\)")


def sources(*folders):
    return [f for folder in folders for f in sorted((ENGINE / folder).glob("*.[hc]pp"))]


def test_nothing_above_the_case_reads_a_raw_scene():
    files = [*sources(*ABOVE_THE_CASE), *(ENGINE.parent / "python/binding").glob("*.[hc]pp")]
    assert len(files) > 60
    found = [f"{f.name}: {line.strip()}" for f in files for line in f.read_text().splitlines()
             if RAW.search(line) and "scene.surface.sites = scene.block.thickness = " not in line]
    assert not found, "take it from the case: " + "; ".join(found)
    assert RAW.search("c.scene.drive.load > 0.0") and not RAW.search("scene.drive.mode = DriveMode::quasistatic;")


def test_the_contact_modulus_has_one_home():
    found = [f.name for f in ENGINE.rglob("*.[hc]pp") if CONTACT_MODULUS.search(f.read_text())]
    assert found == ["block_options.hpp"]
