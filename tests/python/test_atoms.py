# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""A substrate of atoms from a file, as a user meets it: a flat layer written as atoms gives the numbers of the flat
surface, a run is resumed with the same bits over the same file only, and what does not apply is said."""

import json
import subprocess
from pathlib import Path

import numpy
import pytest

import asperity
from conftest import ROOT, command, found

ATOMS = ROOT / "scenes/atoms"
FAST = ["drive.velocity=100", "block.layers_per_level=3", "drive.mode=dynamic"]
PAIRS = 'interface.pairs=["1 100 meV 3.28", "2 0.03 3.0 10"]'


def run(scene, out, *sets, more=(), **keys):
    return command("run", scene, "--progress", "off", "--out", out, *more, "--set", *sets, **keys)


def resume(scene, out, *sets, **keys):
    return run(scene, out, *sets, more=["--resume", "auto"], **keys)


@pytest.fixture(scope="module")
def data():
    """The atoms of the scene that comes with Asperity, as text."""
    return subprocess.run([ATOMS / "stepped.py"], capture_output=True, text=True, check=True).stdout


@pytest.fixture()
def stepped(place):
    """That scene beside its atoms."""
    (place / "stepped.h5").symlink_to(ATOMS / "stepped.h5")
    (place / "stepped.toml").write_text((ATOMS / "stepped.toml").read_text())
    return "stepped.toml"


def convert(text):
    """Takes its place."""
    Path("changed.data").write_text(text)
    Path("stepped.h5").unlink()
    command("convert", "changed.data", "stepped.h5")


def test_a_flat_layer_is_the_flat_surface(place):
    """16 x 16 atoms at height 57 Å, from the last to the first, some of them outside of the box."""
    lines = [f"{n + 1} 1 {10 + 2.6 * (n % 16) - (0 if n % 5 else 41.6):.17g} {-5 + 2.6 * (n // 16):.17g} 57\n"
             for n in reversed(range(256))]
    Path("flat.data").write_text("a flat layer, units = metal\n\n256 atoms\n1 atom types\n10 51.6 xlo xhi\n"
                                 "-5 36.6 ylo yhi\n50 60 zlo zhi\n\nAtoms\n\n" + "".join(lines))
    command("check", ATOMS / "stepped.toml", "--set", f"surface.file={place}/flat.data", expect=2,
            says=f"convert it first: asperity convert '{place}/flat.data' flat.h5")
    command("convert", "flat.data", "flat.h5", says="52 coordinates of atoms lay outside of the box")
    says = {"flat": [], "atoms": ["256 atoms", "a unit of measure", "over one flat layer, 98.86"]}
    for kind, file in ("flat", ""), ("atoms", 'file = "flat.h5"\n'):
        surface = f'[surface]\nkind = "{kind}"\n{file}sites = 16\n'
        Path(f"{kind}.toml").write_text(surface + '[drive]\npath = ["relax"]\n')
        run(f"{kind}.toml", kind, "drive.tolerance=1e-8", says=says[kind])
    flat, atoms = asperity.load("flat"), asperity.load("atoms")
    numbers = ([of.binding_energy, of.contact_fraction, of.relaxed.mean_height] for of in (atoms, flat))
    assert next(numbers) == pytest.approx(next(numbers), abs=1e-8, rel=0)
    assert atoms.surface.atoms == 256
    assert atoms.theory.persson.note.startswith("the substrate's atoms stand anywhere") and "gamma_eff" not in atoms.theory.persson


def test_the_scene_that_comes_with_asperity(stepped, data):
    command("check", stepped, says="a unit of measure")
    command("plan", stepped, says="the theories are of one layer with heights")
    Path("stepped.data").write_text(data)
    command("convert", "stepped.data", "again.h5")
    command("surface", stepped, "--out", "again", "--set", "surface.file=again.h5")
    command("surface", stepped, "--out", "heights", says=["555", "heights of the topmost atoms"])
    # stepped.h5 is what stepped.py writes
    assert asperity.load("heights").surface.file_digest == asperity.load("again").surface.file_digest
    command("theory", stepped, expect=2, says="no theory applies")
    command("check", stepped, "--set", "surface.sites=32", expect=2,
            says="the periodic box of the atoms in stepped.h5 is 41.6 x 41.6 Å")
    command("check", stepped, "--set", "interface.tail=true", "numerics.device=emulated", expect=2,
            says=["interface.tail", "numerics.device"])
    command("sweep", stepped, "--progress", "off", "--out", "swept", "--set", "drive.path=relax",
            "drive.load=0,100")
    assert [point["status"] for point in json.loads(Path("swept/sweep.json").read_text())["points"]] == ["done"] * 2
    command("sweep", stepped, "--set", "drive.load=0,100", "--theory-only", expect=2)


@pytest.mark.parametrize("mode", ["dynamic", "quasistatic"])
def test_a_run_in_parts(stepped, mode, data):
    """The same bits, and over other atoms not at all."""
    fast = [*FAST, f"drive.mode={mode}"]
    run(stepped, "whole", *fast)
    run(stepped, "parts", *fast, "drive.max_steps=25")
    if mode == "dynamic":
        convert(data.replace("\n3 1 5.5467", "\n3 1 5.5468", 1))
        resume(stepped, "parts", *fast, expect=2)
        convert(data)
    resume(stepped, "parts", *fast)
    assert found("whole") == found("parts")


def typed(data, odd):
    """Every other atom is of type 2."""
    lines = [line.split(" ") for line in data.replace("\n1 atom types", "\n2 atom types").split("\n")]
    for words in lines:
        if len(words) == 5 and words[1] == "1" and int(words[0]) % 2 == odd:
            words[1] = "2"
    return "\n".join(map(" ".join, lines))


def test_types(stepped, data):
    """Nor is a run resumed over atoms of other types."""
    run(stepped, "one", *FAST)
    convert(typed(data, 1))
    command("check", stepped, expect=2, says=["are of 2 types: 2 (278 atoms), 1 (277)", "interface.pairs"])
    command("check", stepped, "--set", 'interface.pairs=["1 0.1 3.28"]', expect=2, says="has no type '2'")
    command("check", stepped, "--set", PAIRS, says="a unit of measure")
    run(stepped, "types", *FAST, PAIRS)
    run(stepped, "parts", *FAST, PAIRS, "drive.max_steps=25")
    convert(typed(data, 0))
    resume(stepped, "parts", *FAST, PAIRS, expect=2)
    convert(typed(data, 1))
    resume(stepped, "parts", *FAST, PAIRS)
    assert found("types") == found("parts")
    # A weaker type attracts less.
    assert asperity.load("types").work_of_interface.approach < asperity.load("one").work_of_interface.approach
    command("export", "types", "--to", "xyz")
    written = list(Path("types/export").glob("*.xyz"))
    for file in written:
        kinds = numpy.loadtxt(file, usecols=4, skiprows=2).astype(int)
        assert numpy.bincount(kinds).tolist() == [0, 277, 278, 256]
    assert written


def test_a_map(place):
    """Nor over another map, nor with other frames."""
    def write(bump):
        heights = numpy.zeros((16, 16))
        heights[5, 3] = bump
        numpy.savetxt("map.txt", heights, "%g")
    Path("map.toml").write_text('[surface]\nkind = "file"\nfile = "map.txt"\nfile_unit = "Å"\nsites = 16\n')
    frames = [*FAST, "output.trajectory=10"]
    write(1)
    run("map.toml", "mapped", *frames, "drive.max_steps=25")
    write(1.001)
    resume("map.toml", "mapped", *FAST, expect=2)
    write(1)
    resume("map.toml", "mapped", *frames, "output.velocities=true", expect=2, says="it in output.velocities")
    resume("map.toml", "mapped", *frames, "drive.max_steps=50")
