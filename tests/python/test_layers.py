# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""A module of the package imports only what stands before it here, inside functions too: no circles."""

import ast
from pathlib import Path

import asperity

# From the bottom to the top: text, files and program, data, execution, drawing, pages, the user's forms.
ORDER = """errors units terminal
    files program scene channels map_arrays map_text atoms_files convert maps
    result grid theory sphere theories
    pool runs tables sweeps variations cost_parameters cost stated_number missing_waves estimate_parts estimates
    plots.__init__ plots.style plots.run plots.sweep
    page sentences report report_cost report_estimate measured report_sweep export commands theory_command
    forms engine crack state_search __init__ __main__""".split()
PLACE = {name: place for place, name in enumerate(ORDER)}


def imported(file: Path, name: str):
    """Modules of the package that a file imports."""
    for node in ast.walk(ast.parse(file.read_text())):
        if isinstance(node, ast.ImportFrom) and node.level:
            above = name.split(".")[:-1] if node.level == 1 else []
            module = ".".join(above + (node.module.split(".") if node.module else []))
            inside = [f"{module}.{a.name}".lstrip(".") for a in node.names]
            if inside != ["_engine"]:  # which is compiled
                yield from [i for i in inside if i in PLACE] or [module]


def test_modules_import_only_what_is_below():
    root = Path(asperity.__file__).parent
    files = {str(f.relative_to(root).with_suffix("")).replace("/", "."): f for f in root.rglob("*.py")}
    assert files.keys() == PLACE.keys()
    for name, file in files.items():
        for other in imported(file, name):
            assert PLACE[other] < PLACE[name], f"{name} imports {other}"
