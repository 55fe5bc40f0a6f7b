# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""No command replaces a file that Asperity did not write there, nor one of its inputs.

The files of each command are those that a run of it leaves. Files of somebody else are put in their places in an otherwise
empty directory: the same command ends with exit code 2 and names them, and nothing is changed or written.
"""

import json
import os
import re
import shutil
from pathlib import Path

import h5py
import numpy as np
import pytest

import asperity
import test_curve
from asperity.files import store
from conftest import command, without_pictures

SCENE = """
[surface]
sites = 16
rms = 0.6
[block]
thickness = 16
[drive]
mode = "quasistatic"
path = ["relax"]
[interface]
kind = "wall"
range = "2 nm"
"""
MOVING = """
[surface]
sites = 16
rms = 0.5
[drive]
velocity = 200
timestep = 20
path = ["approach"]
[output]
series = 10
"""
MINE = b"written by hand\n"
MAP = ["map.npy", "--size", "32nm", "--unit", "Å", "--sites", "16", "--E", "1GPa", "--nu", "0.49", "--work", "50mJ/m2"]
COMMANDS = {
    "run": ["run", "q.toml", "--out", "out"],
    "moving": ["run", "d.toml", "--out", "out"],
    "stopped": ["run", "d.toml", "--out", "out", "--set", "drive.max_steps=20", "output.trajectory=10"],
    "surface": ["surface", "q.toml", "--out", "out"],
    "theory": ["theory", "q.toml", "--out", "out"],
    "sweep": ["sweep", "q.toml", "--set", "surface.rms=0.5,0.6", "--out", "out"],
    "theory-only": ["sweep", "q.toml", "--set", "surface.rms=0.5,0.6", "surface.seed=1", "--theory-only", "--out", "out"],
    "two": ["sweep", "q.toml", "r.toml", "--set", "surface.seed=1,2", "--out", "out"],
    "cost": ["cost", "q.toml", "--parameters", "tolerance", "--out", "out"],
    "estimate": ["estimate", "q.toml", "--parts", "convergence,width", "--seeds", "2", "--out", "out"],
    "adhesion": ["adhesion", *MAP, "--out", "out"],
    "tip": ["tip", "--radius", "20nm", "--E", "3GPa", "--nu", "0.3", "--w", "50mJ/m2", "--stiffness", "20N/m", "--sites", "24", "--out", "out"],
    "curve": ["curve", "force.csv", "--radius", "20nm", "--stiffness", "2N/m", "--out", "out"],
    "states": ["states", "q.toml", "--starts", "1", "--out", "out"],
}
"""Each with the directory "out" for its files."""
AFTER = {
    "report": (["run"], ["report", "out"]),
    "report of a sweep": (["sweep"], ["report", "out"]),
    "report of an estimate": (["estimate"], ["report", "out"]),
    "stress": (["run"], ["stress", "out", "--out", "out"]),
    "export xyz": (["run"], ["export", "out", "--to", "xyz"]),
    "export vtk": (["stopped"], ["export", "out", "--to", "vtk"]),
    "export png": (["run"], ["export", "out", "--to", "png"]),
}
"""Commands on the result of another."""


def there(place: Path) -> dict[str, bytes]:
    """Every file and link below a directory, with its content."""
    return {str(path.relative_to(place)): os.readlink(path).encode() if path.is_symlink() else path.read_bytes()
            for path in sorted(place.rglob("*")) if path.is_symlink() or not path.is_dir()}


@pytest.fixture(scope="module", autouse=True)
def light():
    with without_pictures():
        yield


@pytest.fixture(scope="module")
def inputs(tmp_path_factory):
    place = tmp_path_factory.mktemp("inputs")
    (place / "q.toml").write_text(SCENE)
    (place / "d.toml").write_text(MOVING)
    (place / "r.toml").write_text(SCENE.replace("0.6", "0.7"))
    draw, n = np.random.default_rng(1), 32
    q = np.hypot(np.fft.fftfreq(n)[:, None], np.fft.fftfreq(n)) * n
    q[0, 0] = 1
    heights = np.fft.ifft2(np.fft.fft2(draw.normal(size=(n, n))) * np.maximum(q, 3) ** -1.8).real
    np.save(place / "map.npy", 5 * heights / heights.std())
    (place / "force.csv").write_text(test_curve.text_of(*test_curve.measured("jkr")))
    (place / "map.txt").write_text("1 2 3 4\n2 3 4 5\n3 4 5 6\n1 2 1 2\n")
    return place


@pytest.fixture(scope="module")
def results(inputs, tmp_path_factory):
    """What each command leaves, made when it is first asked for."""
    made: dict[str, Path] = {}

    def of(name: str) -> Path:
        if name not in made:
            place = tmp_path_factory.mktemp("result")
            shutil.copytree(inputs, place, dirs_exist_ok=True)
            if name in AFTER:
                shutil.copytree(of(*AFTER[name][0]) / "out", place / "out", ignore=shutil.ignore_patterns("report*"))
            before = there(place)
            command(*words_of(name), cwd=place)
            made[name] = place
            after = there(place)
            assert all(after[file] == before[file] for file in before if Path(file).name != store.RECORD), "a file was changed"
        return made[name]

    return of


def words_of(name: str) -> list[str]:
    return AFTER[name][1] if name in AFTER else COMMANDS[name]


def written_by(name: str, results) -> list[str]:
    """Files that a command left in "out", but for the records of them."""
    before = there(results(*AFTER[name][0]) / "out") if name in AFTER else {}
    before = {file: content for file, content in before.items() if "report" not in file}
    after = there(results(name) / "out")
    return [file for file in after if after[file] != before.get(file) and Path(file).name != store.RECORD]


@pytest.mark.parametrize("name", [*COMMANDS, *AFTER])
def test_foreign_files_are_kept(name, results, inputs, tmp_path):
    """All of them are planted, and those that the refusal names taken away, until each was named."""
    waiting = written_by(name, results)
    assert waiting
    while waiting:
        place = tmp_path / f"{len(waiting)} files"
        shutil.copytree(inputs, place)
        if name in AFTER:
            shutil.copytree(results(*AFTER[name][0]) / "out", place / "out")
        for file in waiting:
            (place / "out" / file).parent.mkdir(parents=True, exist_ok=True)
            (place / "out" / file).write_bytes(MINE)
            os.utime(place / "out" / file, (0, 0))  # older than the result: a page of a point that is newer is taken as it is
        before = there(place)
        said = command(*words_of(name), cwd=place, expect=2)
        after = there(place)
        if name in ("adhesion", "tip") and not {"out/map.npy", "out/tip.toml"} & before.keys():  # they are there when its runs are known
            after = {path: content for path, content in after.items()
                     if path in before or not path.endswith((".npy", ".toml", store.RECORD))}
        assert after == before
        named = [file for file in waiting if f"out/{file}: is there already and is not replaced" in said
                 or re.search(rf"out: (already holds a (result|sweep)|holds an unfinished run), {file}", said)]
        assert named, f"{said}\nnames none of {waiting}"
        waiting = [file for file in waiting if file not in named]


@pytest.mark.parametrize("name", ["report", "report of a sweep", "report of an estimate", "export xyz", "export vtk", "export png",
                                  "sweep", "two", "cost", "estimate", "adhesion", "curve", "tip"])
def test_own_files_are_renewed_unless_they_were_changed(name, results, tmp_path):
    place = tmp_path / "again"
    shutil.copytree(results(name), place)  # a copy has other times, and the same record
    command(*words_of(name), cwd=place)
    file = next(file for file in ("report.html", "export/relaxed.xyz", "export/substrate.vti", "export/gap-relaxed.png", "gamma.svg", "q/sweep.csv",
                                  "cost.csv") if (place / "out" / file).exists())
    (place / "out" / file).write_bytes((place / "out" / file).read_bytes() + b" ")
    before = there(place)
    command(*words_of(name), cwd=place, expect=2, says=[f"out/{file}: is there already", "changed after Asperity wrote it"])
    assert there(place) == before


@pytest.mark.parametrize("name", ["run", "surface", "theory", "theory-only", "states"])
def test_an_earlier_result_is_kept_without_its_last_file(name, results, tmp_path):
    place = tmp_path / "again"
    shutil.copytree(results(name), place)
    last = {"theory-only": "sweep.json", "states": "states.json"}.get(name, "result.json")
    (place / "out" / last).unlink()
    left = [file for file in written_by(name, results) if file != last]
    before = there(place)
    if left:
        command(*words_of(name), cwd=place, expect=2, says=["belongs to an earlier result"])
        if name == "run":
            command(*words_of(name), "--resume", "auto", cwd=place, expect=2, says=["belongs to an earlier result"])
        assert there(place) == before
    (place / "out" / store.RECORD).unlink()
    if left:
        command(*words_of(name), cwd=place, expect=2, says=["has no record", "a version without records"])
        assert there(place) == {path: content for path, content in before.items() if not path.endswith(store.RECORD)}


def test_a_record_that_is_none_is_kept(results, tmp_path):
    for name in ("run", "theory"):
        place = tmp_path / name
        shutil.copytree(results(name), place)
        shutil.rmtree(place / "out")
        (place / "out").mkdir()
        (place / "out" / store.RECORD).write_bytes(MINE)
        command(*words_of(name), cwd=place, expect=2, says="is no record of the files that Asperity wrote")
        assert there(place / "out") == {store.RECORD: MINE}


def test_an_unfinished_run_goes_on_and_its_files_are_its_own(inputs, tmp_path):
    shutil.copytree(inputs, tmp_path / "a")
    words = ["run", "q.toml", "--out", "out", "--set", "drive.path=approach,pull-off"]
    command(*words, "--wall-limit", "0.001s", cwd=tmp_path / "a", expect=75)
    record = json.loads((tmp_path / "a/out" / store.RECORD).read_text())["files"]
    assert record["run.h5"] == record["checkpoint.h5"] == store.UNFINISHED and "checkpoint-damaged.h5" not in record
    shutil.copytree(tmp_path / "a", tmp_path / "b")
    command(*words, "--resume", "auto", cwd=tmp_path / "a")
    record = json.loads((tmp_path / "a/out" / store.RECORD).read_text())["files"]
    assert record.keys() == {"run.h5", "result.json"} and store.UNFINISHED not in record.values()
    command(*words, "--restart", cwd=tmp_path / "b")
    for foreign in ("last-good.h5", "movie.mp4.part"):
        (tmp_path / "a/out" / foreign).write_bytes(MINE)
    (tmp_path / "a/out/result.json").unlink()
    (tmp_path / "a/out/run.h5").unlink()
    command(*words, cwd=tmp_path / "a", expect=2, says="last-good.h5: is there already")
    (tmp_path / "a/out/last-good.h5").unlink()
    command(*words, cwd=tmp_path / "a")
    assert (tmp_path / "a/out/movie.mp4.part").read_bytes() == MINE


@pytest.mark.parametrize("name", ["run", "theory"])
def test_a_file_named_as_the_lock_is_kept(name, inputs, tmp_path):
    shutil.copytree(inputs, tmp_path / "a")
    (tmp_path / "a/out").mkdir()
    (tmp_path / "a/out/run.lock").write_bytes(MINE)
    command(*words_of(name), cwd=tmp_path / "a", expect=2, says="it is not the lock of a run")
    assert there(tmp_path / "a/out") == {"run.lock": MINE}


# Inputs.

@pytest.mark.parametrize("how", ["itself", "symbolic link", "hard link", "folder that is a link"])
def test_an_input_is_kept(how, inputs, results, tmp_path):
    """A map under the name that the command gives to its own, also where the record of an earlier call names it."""
    for named in (False, True):
        place = tmp_path / f"{named}"
        shutil.copytree(results("adhesion") if named else inputs, place)
        (place / "out").mkdir(exist_ok=True)
        (place / "out/map.npy").unlink(missing_ok=True)
        kept = place / "out/map.npy"
        source = Path("out/map.npy")
        if how == "folder that is a link":
            (place / "link").symlink_to("out")
            source = Path("link/map.npy")
        if how in ("symbolic link", "hard link"):
            source = Path("map.npy")
            kept.symlink_to("../map.npy") if how == "symbolic link" else os.link(place / "map.npy", kept)
        else:
            shutil.copy(place / "map.npy", kept)
        if named:  # as if it were Asperity's own
            record = json.loads((place / "out" / store.RECORD).read_text())["files"]
            record["map.npy"] = store._digest_of(kept)
            (place / "out" / store.RECORD).write_text(store.sealed_json({"files": record}))
        before = there(place)
        command("adhesion", source, *MAP[1:], "--out", "out", cwd=place, expect=2,
                says=["out/map.npy: is there already and is not replaced", "which the command reads"])
        assert there(place) == before


def test_the_heights_of_a_scene_are_kept(results, tmp_path):
    place = tmp_path / "a"
    shutil.copytree(results("surface"), place)
    (place / "s.toml").write_text(SCENE.replace("rms = 0.6", 'kind = "file"\nfile = "out/heights.h5"'))
    (place / "out/result.json").unlink()
    record = {"heights.h5": store.UNFINISHED}  # of a command that was killed
    (place / "out" / store.RECORD).write_text(store.sealed_json({"files": record}))
    before = there(place)
    command("surface", "s.toml", "--out", "out", cwd=place, expect=2, says="out/heights.h5, which the command reads")
    assert there(place) == before


def test_digests_of_python_are_those_of_the_program(tmp_path):
    """Each reads what the other has sealed, JSON and HDF5, and refuses it when the digest is not right."""
    out, scene = tmp_path / "out", tmp_path / "s.toml"
    scene.write_text(SCENE)
    command("surface", "s.toml", "--out", "out", cwd=tmp_path)
    record = json.loads((out / store.RECORD).read_text())["files"]
    assert store.json_is_whole((out / store.RECORD).read_bytes()) is True
    assert store.hdf5_is_whole(out / "heights.h5") is True
    assert record["heights.h5"] == store._digest_of(out / "heights.h5")
    assert record["result.json"] == store._digest_of(out / "result.json")

    heights = tmp_path / "map.h5"
    with h5py.File(heights, "w") as file:
        file["heights"] = np.random.default_rng(1).normal(size=(16, 16))
    bare = heights.read_bytes()
    store.seal_hdf5(heights)
    scene.write_text(SCENE.replace("rms = 0.6", 'kind = "file"\nfile = "map.h5"'))
    command("surface", "s.toml", "--out", "read", cwd=tmp_path)
    sealed = heights.read_bytes()
    heights.write_bytes(bare + sealed[len(bare):-8] + bytes([sealed[-8] ^ 1]) + sealed[-7:])
    command("surface", "s.toml", "--out", "damaged", cwd=tmp_path, expect=2, says="digest")

    empty = {"files": {"heights.h5": store.UNFINISHED}}  # of a command that was killed
    (out / store.RECORD).write_text(store.sealed_json(empty))
    (out / "result.json").unlink()
    scene.write_text(SCENE)
    command("surface", "s.toml", "--out", "out", cwd=tmp_path)
    (out / store.RECORD).write_text(store.sealed_json(empty).replace("heights", "Heights"))
    (out / "result.json").unlink()
    command("surface", "s.toml", "--out", "out", cwd=tmp_path, expect=2, says="is no record of the files that Asperity wrote")


# Single files.

def test_single_files_are_never_replaced(inputs, place):
    shutil.copytree(inputs, ".", dirs_exist_ok=True)
    os.symlink("nowhere.h5", "dangling.h5")
    Path("there.h5").write_bytes(MINE)
    Path("there.toml").write_bytes(MINE)
    before = there(Path("."))
    for words in (["convert", "map.txt", "dangling.h5"], ["convert", "map.txt", "there.h5"], ["init", "there.toml"]):
        command(*words, expect=2, says=f"{words[-1]}: is there already")
    os.symlink("nowhere.toml", "dangling.toml")
    command("init", "dangling.toml", expect=2, says="dangling.toml: is there already")
    Path("dangling.toml").unlink()
    assert there(Path(".")) == before


def test_what_python_writes(results, inputs, tmp_path):
    """The calls of the package that the commands do not share."""
    shutil.copytree(results("run"), tmp_path / "a")
    run = asperity.load(tmp_path / "a/out")
    (run.directory / "report.html").write_bytes(MINE)
    before = there(run.directory)
    with pytest.raises(asperity.SceneError, match="report.html: is there already"):
        run.report()
    shutil.copytree(results("sweep"), tmp_path / "b")
    sweep = asperity.load_sweep(tmp_path / "b/out")
    (sweep.directory / "sweep.h5").write_bytes(MINE)
    with pytest.raises(asperity.SceneError, match="changed after Asperity wrote it"):
        sweep.write()
    assert there(run.directory) == before and (sweep.directory / "sweep.h5").read_bytes() == MINE
    pytest.importorskip("asperity.running.engine")
    sim = asperity.Simulation(inputs / "d.toml")
    for file in ("run.h5", "result.json"):
        out = tmp_path / file
        out.mkdir()
        (out / file).write_bytes(MINE)
        with pytest.raises(asperity.SceneError):
            sim.write(out)
        assert there(out) == {file: MINE}
    (tmp_path / "mine.h5").write_bytes(MINE)
    with pytest.raises(asperity.SceneError):
        sim.save(tmp_path / "mine.h5")
    assert (tmp_path / "mine.h5").read_bytes() == MINE
