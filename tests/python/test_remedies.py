# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Whoever follows the fix of a message comes to what was meant; and no message names a key that does not exist."""

import re

import h5py
import numpy as np
import pytest

import asperity
import asperity.maps.height_map
import asperity.running.program
import asperity.studies.map_scene
from asperity.maps.convert import read_heights
from asperity.studies.grid import axes_of
from conftest import ROOT, command

SMALL = "[surface]\nsites = 16\n[block]\nthickness = 16\n[drive]\npath = [\"relax\"]\n"
SECTIONS = "surface|block|interface|drive|theory|numerics|output"


def test_messages_name_keys_that_exist():
    """Every section.key in the texts of the program and the package is a key of a scene, one that a message says is gone, or
    a number of a result."""
    known = set(asperity.running.program.schema()) | {re.sub(r"\[\]", "", name) for name in asperity.running.program.quantities()}
    parents = {name.rsplit(".", k)[0] for name in known for k in (1, 2)} | known
    scene = (ROOT / "engine/scene/scene.cpp").read_text()
    removed = {*re.findall(r'(?:removed\(|was = )\s*\{"([\w.]+)"', scene), "drive.distance"}
    for file in [*ROOT.glob("engine/**/*.cpp"), *ROOT.glob("io/*.cpp"), *ROOT.glob("python/asperity/**/*.py")]:
        for text in re.findall(r'"((?:[^"\\\n]|\\.)*)"', file.read_text()):
            for key in re.findall(rf"(?<![\w./-])((?:{SECTIONS})\.[a-z]\w*)(?![\w/(])", text):
                ending = key.rpartition(".")[2] in ("h5", "png", "html", "json", "csv", "md", "py", "toml")
                assert key in parents or key in removed or ending, f"{file.name}: \"{text}\" names {key}"


def check(*settings, expect=0, says=()):
    return command("check", "-", "--set", *settings, given=SMALL, expect=expect, says=says)


def test_a_comma_is_a_point_or_a_sweep(place):
    said = check("surface.rms=1,5", expect=2, says="`asperity sweep`")
    check(f"surface.rms={re.search('write .(1.5).', said)[1]}")
    assert [axis.values for axis in axes_of(["surface.rms=1,5"], [])[0]] == [["1", "5"]]
    assert [axis.values for axis in axes_of(["surface.rms=[1, 5]"], [])[0]] == [["1", "5"]]
    assert [axis.values for axis in axes_of(['drive.mode=["dynamic", "quasistatic"]'], [])[0]] == [["dynamic", "quasistatic"]]
    assert axes_of(['drive.path=["approach", "pull-off"]', 'block.prony=[[1, "1 ns"], [2, "2 ns"]]'], [])[0] == []


@pytest.mark.parametrize("lists", ['drive.path=["relax"],["approach", "pull-off"]', 'drive.path=[["relax"], ["approach", "pull-off"]]',
                                   'block.prony=[[1, "1 ns"]], [[2, "1 ns"]]'])
def test_lists_in_a_sweep_are_refused_with_a_run_that_goes(place, lists):
    with pytest.raises(asperity.SceneError, match="its value is a list itself") as error:
        axes_of([lists], [])
    check(re.search(r"--set '(.*?)'", str(error.value))[1], "drive.mode=quasistatic")


def hdf5(name, **attributes):
    heights = np.random.default_rng(1).normal(0, 1, (32, 32)) * 1e-3
    with h5py.File(name, "w") as file:
        file["heights"] = heights
        file["heights"].attrs.update(attributes)
    return name


MAP = (SMALL + '[interface]\nkind = "wall"\n').replace("sites = 16", 'sites = 32\nspacing = "2 nm"\nkind = "file"\nfile = "map.h5"'
                                                               ).replace("thickness = 16", "thickness = 32")


def test_a_unit_that_a_map_does_not_say_right(place):
    hdf5("map.h5", unit="\u00c2\u00b5m", size_x=0.064, size_y=0.064)  # µm in UTF-8, read as Latin-1
    command("check", "-", given=MAP, says="heights in")
    hdf5("map.h5", unit="parsec", size_x=0.064, size_y=0.064)
    said = command("check", "-", given=MAP, expect=2, says="that is no unit of length")
    assert "surface.file_unit" in said
    settings = ["surface.file_unit=µm", "surface.file_size=64 nm"]
    command("check", "-", "--set", *settings, given=MAP, says="640 Å wide, heights in µm")
    hdf5("map.h5", unit="V", size_x=64.0, size_y=64.0, size_unit="V")
    with pytest.raises(asperity.Error, match="another channel"):
        asperity.maps.height_map.read_map("map.h5")
    hdf5("map.h5", unit="nm", size_x=64.0, size_y=64.0, size_unit="V")
    with pytest.raises(asperity.Error, match="unit of its size, V, is none of length") as error:
        asperity.maps.height_map.read_map("map.h5", "nm")
    assert "--unit" not in str(error.value) and "--size" in str(error.value)
    assert asperity.maps.height_map.read_map("map.h5", "nm", 640.0).size == (640.0, 640.0)
    hdf5("map.h5", unit="nm")
    assert asperity.maps.height_map.read_map("map.h5", None, 640.0).size == (640.0, 640.0)


def test_a_line_of_names_above_columns(place):
    rows = "\n".join(f"{x / 10},{y / 5},{1 + x + 10 * y}" for y in range(4) for x in range(4))
    (place / "names.csv").write_text("x,y,z\n" + rows + "\n")
    heights = [[1 + x + 10 * y for x in range(4)] for y in range(4)]
    assert read_heights("names.csv")["heights"].tolist() == heights
    (place / "others.csv").write_text("y,x,z\n" + rows + "\n")
    assert read_heights("others.csv")["heights"].T.tolist() == heights
    (place / "unknown.csv").write_text("easting,northing,z\n" + rows + "\n")
    with pytest.raises(asperity.Error, match="they are called easting, northing, z, and none are x and y"):
        read_heights("unknown.csv")
    matrix = "\n".join(" ".join(str(x + y) for x in range(4)) for y in range(4))
    (place / "titled.txt").write_text("height of the film\n" + matrix + "\n")
    with pytest.raises(asperity.Error, match="put a # before the names"):
        read_heights("titled.txt")
    (place / "titled.txt").write_text("# height of the film\n" + matrix + "\n")
    assert read_heights("titled.txt")["heights"].shape == (4, 4)


@pytest.mark.parametrize("name, key", [("young", "block.young"), ("adhesion", "interface.adhesion"), ("range", "interface.range"),
                                       ("size", "surface.file_size"), ("stiffness", "drive.stiffness")])
def test_a_number_without_a_unit_is_asked_for_with_each(place, name, key):
    with pytest.raises(asperity.SceneError, match="has no unit") as error:
        asperity.studies.map_scene.with_unit(name, 0.05)
    offered = re.findall(r'"(0\.05 [^"]+)"', str(error.value))
    assert offered
    for text in offered:
        assert asperity.studies.map_scene.with_unit(name, text) == text
        of_map = ["surface.kind=file", "surface.file=map.npy", "surface.resample=band-limited"] * (name == "size")
        np.save(place / "map.npy", np.random.default_rng(0).normal(size=(16, 16)))
        command("check", "-", "--set", f"{key}={text}", "interface.kind=wall", *of_map, given=SMALL, expect=0)


@pytest.mark.parametrize("given", [object(), b"1", 1j, None, {1, 2}])
def test_overrides_that_are_no_values(given):
    for lead in (asperity.run, asperity.Statics, asperity.Simulation):
        with pytest.raises(asperity.SceneError, match="no value of a key|= None"):
            lead({"surface": {"sites": 16}}, {"surface.rms": given})
    for overrides in ("surface.rms=1", 5, [1, 2]):
        with pytest.raises(asperity.SceneError, match="are "):
            asperity.run({"surface": {"sites": 16}}, overrides)
        with pytest.raises(asperity.SceneError, match="are "):
            asperity.sweep({"surface": {"sites": 16}}, overrides)


SPHERE = ("surface.kind=flat", "surface.boundary=free", "interface.kind=wall", "drive.mode=quasistatic", "surface.sites=32",
          "surface.spacing=0.4 nm", "surface.radius=20 nm", "block.young=2 GPa", "interface.adhesion=50 mJ/m^2", "interface.range=0.3 nm",
          'drive.path=["approach", "pull-off"]')


@pytest.mark.parametrize("changes", [
    ["drive.load=200 nN"], ["drive.load=700 nN", "surface.sites=80"], ["interface.range=1 nm"],
    ["surface.radius=80 nm"], ["surface.radius=6 nm", "drive.load=60 nN"],
    ["surface.radius=3 nm", "surface.sites=16", "surface.spacing=0.1 nm"], ["interface.law=power", "interface.range=1 nm"],
    ['drive.path=["approach", "load 80 nN"]'], ["drive.load=150 nN", 'block.layers=[["1 nm", "40 GPa", 0.3]]'],
    ["surface.radius=10 um", "surface.spacing=40 nm", "interface.range=20 nm", "block.young=300 Pa", "block.surface_stress=20 mN/m",
     "interface.adhesion=1 mJ/m^2"]])
def test_each_way_out_of_a_box_that_is_too_narrow(changes):
    """A box with free edges, its contact and the attraction beside it: what the messages offer is taken, each on its own."""
    keys = dict(one.split("=", 1) for one in (*SPHERE, *changes))
    said = command("check", "-", "--set", *(f"{k}={v}" for k, v in keys.items()), given="", expect=2)
    problem = said[:said.index("1 problem")]
    assert problem.count("fix: ") == 1, said
    load_key, load = ("drive.path", '["approach", "load {} nN"]') if "load" in keys["drive.path"] else ("drive.load", "{} nN")
    ways = []
    for way in problem.split("fix: ")[1].split(", "):
        sites, most = (re.search(what, way) for what in (r"surface.sites = (\d+)", r"a load of (\S+) nN at most"))
        ways.append({"surface.sites": sites[1]} if sites else {})
        ways[-1] |= {load_key: load.format(most[1])} if most else {}
    ways = [way for way in ways if way]
    assert ways, said
    for way in ways:
        command("check", "-", "--set", *(f"{k}={v}" for k, v in {**keys, **way}.items()), given="", expect=0)


def test_a_slow_slide_is_in_balance(place):
    """The works of long steps in time are those of the energies: a quarter of the spacing has a friction of 0.1463."""
    scene = ("surface.sites=32", "surface.spacing=20", "surface.rms=8", "surface.rolloff=2", "surface.q_max=8", "block.young=0.02",
             "block.poisson=0.48", "block.thickness=64", 'block.prony=[[30, "1 ns"], [9, "20 ns"]]', "interface.kind=wall", "interface.adhesion=2",
             "interface.range=9", "drive.mode=quasistatic", "drive.control=mean-height", "drive.load=2", "drive.velocity=0.01",
             'drive.path=["relax", "slide x 256 nm"]')
    command("run", "-", "--out", "slow", "--set", *scene, given="", expect=0)
    slide = asperity.load("slow")["segments"][-1]
    assert slide["friction_coefficient"] == pytest.approx(0.1463, abs=slide["friction_coefficient_error"])
