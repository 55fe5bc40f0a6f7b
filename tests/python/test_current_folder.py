# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""No command runs code of the folder in which it is started: beside the user's data there may be files of anybody."""

import os
import subprocess
import sys

import pytest

from asperity.commands.options import command as of_package, purposes
from asperity.errors import NEEDED
from conftest import ROOT

NAMES = sorted({*sys.stdlib_module_names, *NEEDED, "asperity", "sitecustomize", "usercustomize", "SurfaceTopography", "afmformats", "ase"})
HOSTILE = "import os\nopen(os.environ['READ'], 'a').write(__file__ + '\\n')\nraise SystemExit(7)\n"


@pytest.fixture(scope="module")
def hostile(tmp_path_factory):
    """A folder with a module of every name that a command may import, as a file or as a package."""
    place = tmp_path_factory.mktemp("hostile")
    for k, name in enumerate(NAMES):
        file = place / name / "__init__.py" if k % 2 else place / f"{name}.py"
        file.parent.mkdir(exist_ok=True)
        file.write_text(HOSTILE)
    (place / "matplotlibrc").write_text("text.usetex: True\n")
    (place / "rubber.csv").write_text("f (Hz),E' (MPa),E'' (MPa)\n" + "".join(f"{10**k},{2 + k},{0.2 + 0.1 * k}\n" for k in range(8)))
    return place


def words_of(command: str) -> list[str]:
    """Returns a command line with all arguments that the command needs; its files are missing but for that of `prony`."""
    actions = of_package(command).parser()._actions
    needed = [action for action in actions if action.required or action.dest == "map"]  # without its map `tip` would run
    words = [word for one in needed if one.option_strings for word in (one.option_strings[0], one.metavar)]
    return [command, *("rubber.csv" for one in needed if not one.option_strings), *words]


@pytest.mark.parametrize("command", purposes())
def test_a_command_imports_nothing_of_the_current_folder(command, hostile, tmp_path):
    """Python's own habit is to look there first, and an empty place in PYTHONPATH is that folder, too."""
    read = tmp_path / "read"
    words = [*words_of(command), *(["--out", str(tmp_path / "out.toml")] if command in ("prony", "scenes") else [])]
    done = subprocess.run([os.environ["ASPERITY_PROGRAM"], *words], cwd=hostile, capture_output=True, text=True,
                          env={**os.environ, "PYTHONPATH": "::/nowhere:", "READ": str(read)})
    assert not read.exists(), read.read_text()
    assert done.returncode in (0, 2, 4) and "Traceback" not in done.stderr, done.stderr
    assert "unrecognized" not in done.stderr and "is not given" not in done.stderr, done.stderr  # it went as far as to read its input


def test_the_script_asks_for_modules_outside_of_the_current_folder(hostile, tmp_path):
    """The lines of `./asperity` that look for the modules of a command."""
    script = (ROOT / "asperity").read_text()
    lines = script[script.index("need_modules() {"):]
    lines = lines[:lines.index("\n}\n") + 3]
    read = tmp_path / "read"
    told = "need() { echo missing: $1; }\npackages_of() { :; }\nlines_to_install() { :; }\n"
    done = subprocess.run(["bash", "-c", f"python={sys.executable}; command=report\n{told}{lines}need_modules h5py no_such_module"],
                          cwd=hostile, capture_output=True, text=True, env={**os.environ, "READ": str(read)})
    assert not read.exists(), read.read_text()
    assert "no_such_module" in done.stdout + done.stderr or done.returncode, done
