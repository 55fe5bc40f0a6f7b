# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Atoms and maps for other programs: read back by plain text, h5py and XML, and the same through a stop."""

import shutil
import xml.etree.ElementTree as tree

import h5py
import matplotlib.image
import numpy as np
import pytest

import asperity
from conftest import SMALL, command, unsealed


def frames_of_xyz(path):
    """Header and columns of every frame."""
    lines = path.read_text().splitlines()
    found = []
    while lines:
        n = int(lines[0])
        found.append((lines[1], np.array([line.split()[1:] for line in lines[2:2 + n]], float)))
        lines = lines[2 + n:]
    return found


def frames_of_dump(path):
    found = []
    for block in path.read_text().split("ITEM: TIME\n")[1:]:
        lines = block.splitlines()[2:]
        names = next(line for line in lines if line.startswith("ITEM: ATOMS")).split()[2:]
        start = next(i for i, line in enumerate(lines) if line.startswith("ITEM: ATOMS")) + 1
        rows = [line.split() for line in lines[start:]]
        found.append((int(lines[0]), {n: [r[k] for r in rows] for k, n in enumerate(names)}))
    return found


def test_states_and_trajectory_as_atoms(path_run):
    place = path_run.directory
    said = command("export", place, "--to", "xyz")
    assert f"{place}/export/zero-load.xyz" in said and f"{place}/export/trajectory.xyz" in said
    (head, rows), = frames_of_xyz(place / "export/zero-load.xyz")
    state = path_run.fields["zero-load"]
    assert len(rows) == 2 * 32 * 32  # two layers
    assert "Properties=species:S:1:pos:R:3:type:I:1:displacement:R:3:pressure:R:1:contact:I:1" in head
    names = ["x", "y", "z", "type", "dx", "dy", "dz", "pressure", "contact", "gap", "distance"]
    column = dict(zip(names, rows.T))
    block = column["type"] == 2
    for name in ("pressure", "contact", "gap", "distance"):
        assert column[name][block] == pytest.approx(state[name].ravel(), rel=1e-5, abs=1e-6), name
        assert (column[name][~block] == 0).all()
    assert column["z"][~block] == pytest.approx(path_run.substrate.height.ravel(), abs=1e-6)
    # The distances are those of the positions, over the periodic box.
    at = np.flatnonzero(block)[5]
    d = rows[at, :3] - rows[~block, :3]
    d[:, :2] -= path_run.edge * np.round(d[:, :2] / path_run.edge)
    assert np.sqrt((d**2).sum(1)).min() == pytest.approx(state.distance.ravel()[5], abs=1e-5)

    command("export", place, "--to", "lammps")
    (step, dump), = frames_of_dump(place / "export/zero-load.dump")
    assert np.array(dump["z"], float) == pytest.approx(column["z"]) and set(dump["element"]) == {"X", "Au"}
    with h5py.File(place / "run.h5") as file:
        value = file["particles/trajectory/position/value"][:]
        velocity = file["particles/trajectory/velocity/value"][:]
        steps = list(file["particles/trajectory/position/step"])
    dumps, texts = frames_of_dump(place / "export/trajectory.dump"), frames_of_xyz(place / "export/trajectory.xyz")
    assert [s for s, _ in dumps] == steps and len(texts) == len(value) > 3
    for k in (0, len(value) - 1):
        assert texts[k][1][1024:, :3] == pytest.approx(value[k], abs=1e-4)
        moving = np.array([dumps[k][1][v][1024:] for v in ("vx", "vy", "vz")], float).T
        assert moving == pytest.approx(velocity[k], abs=1e-5)
        # What OVITO and ASE take for velocities (test_viewers.py asks them).
        head, rows = texts[k]
        assert ":velo:R:3:masses:R:1:momenta:R:3" in head
        assert rows[1024:, 4:7] == pytest.approx(velocity[k], rel=1e-5, abs=1e-5)
        assert (rows[:, 7] == 197.0).all() and (rows[:1024, 4:7] == 0.0).all()
        # u Å/ps in sqrt(u eV): 1 u Å²/ps² is 1.036427e-4 eV.
        assert rows[1024:, 8:] == pytest.approx(197.0 * np.sqrt(1.036427e-4) * velocity[k], rel=1e-5, abs=1e-5)
    assert "time=" in texts[0][0]


def test_xdmf_points_to_what_is_there(path_run):
    place = path_run.directory
    assert "export/trajectory.h5" in command("export", place, "--to", "xdmf")
    with h5py.File(place / "run.h5") as run:
        value = run["particles/trajectory/position/value"][:]
    frames = maps = 0
    for item in tree.parse(place / "run.xdmf").iter("DataItem"):
        if item.get("Format") != "HDF":
            continue
        file, dataset = item.text.split(":")
        with h5py.File(place / file) as opened:
            data = opened[dataset]
            said = [int(n) for n in item.get("Dimensions").split()]
            assert [n for n in said if n > 1] == list(data.shape), dataset
            assert data.dtype.itemsize == int(item.get("Precision")), dataset
            if dataset.startswith("/position-"):
                assert (data[:] == value[frames]).all()
                frames += 1
            else:
                maps += 1
    assert frames == len(value) and maps == 8


def test_maps_lie_where_the_atoms_are(path_run):
    """Substrate and sites as a mesh (XDMF), an image (VTK) and atoms (XYZ): the same places, of the sites at rest."""
    place = path_run.directory
    for kind in ("xyz", "xdmf", "vtk"):
        command("export", place, "--to", kind)
    (_, rows), = frames_of_xyz(place / "export/zero-load.xyz")
    rigid, sites = rows[rows[:, 3] == 1, :2], rows[rows[:, 3] == 2]
    atoms = {"substrate": rigid, "zero-load": sites[:, :2] - sites[:, 4:6]}

    def places(origin, spacing, n):
        y, x = np.divmod(np.arange(n * n), n)
        return np.column_stack([origin[0] + spacing[0] * x, origin[1] + spacing[1] * y])

    found = 0
    for grid in tree.parse(place / "run.xdmf").iter("Grid"):
        if grid.get("Name") not in atoms:
            continue
        found += 1
        n = int(grid.find("Topology").get("Dimensions").split()[-1])
        origin, spacing = ([float(v) for v in item.text.split()][::-1] for item in grid.find("Geometry"))  # z first
        assert places(origin, spacing, n) == pytest.approx(atoms[grid.get("Name")], abs=1e-4), grid.get("Name")
    assert found == 2
    for name, expected in atoms.items():
        image = tree.parse(place / f"export/{name}.vti").find("ImageData")
        origin, spacing = ([float(v) for v in image.get(key).split()] for key in ("Origin", "Spacing"))
        n = int(image.get("WholeExtent").split()[1]) + 1
        assert places(origin, spacing, n) == pytest.approx(expected, abs=1e-4), name


def test_the_h5md_has_what_the_specification_demands(path_run):
    """H5MD 1.1, nongnu.org/h5md: version, author, creator; box; elements with value, step, time and units."""
    with h5py.File(path_run.directory / "run.h5") as file:
        assert list(file["h5md"].attrs["version"]) == [1, 1]
        for group, names in {"author": ["name"], "creator": ["name", "version"]}.items():
            for name in names:
                assert len(file["h5md"][group].attrs[name]) > 0
        box = file["particles/trajectory/box"]
        assert box.attrs["dimension"] == 3
        boundary = [b.decode() if isinstance(b, bytes) else b for b in box.attrs["boundary"]]
        assert boundary == ["periodic", "periodic", "none"]
        count = len(file["particles/trajectory/position/step"])
        for name in ("position", "velocity", "box/edges"):
            element = file["particles/trajectory"][name]
            assert element["value"].shape[0] == count > 3
            assert element["step"].shape == (count,) and element["time"].shape == (count,)
            assert np.all(np.diff(element["step"]) > 0) and np.issubdtype(element["step"].dtype, np.integer)
            assert element["value"].attrs["unit"] and element["time"].attrs["unit"]
        edges = file["particles/trajectory/box/edges/value"][0]  # a vector, or the matrix of a cuboid
        assert edges.shape in ((3,), (3, 3)) and np.all(np.diag(edges) if edges.ndim == 2 else edges)


def test_pictures(path_run):
    command("export", path_run.directory, "--to", "png")
    for name in ("gap", "pressure", "contact"):
        assert matplotlib.image.imread(path_run.directory / f"export/{name}-zero-load.png")[..., :3].std() > 0.02


def test_a_trajectory_changes_no_numbers_and_survives_a_stop(path_run, tmp_path):
    plain = asperity.run(SMALL, out=tmp_path / "plain")
    assert plain.binding_energy == path_run.binding_energy
    assert plain.find("work_of_adhesion") == path_run.find("work_of_adhesion")
    scene = tmp_path / "small.toml"
    scene.write_text("[surface]\nsites = 32\nrms = 0.5\n[drive]\nvelocity = 100\ntimestep = 20\n")
    words = ["run", scene, "--progress", "off", "--set", "output.trajectory=300", "output.velocities=true", "--out",
             tmp_path / "parts"]
    command(*words, "--set", "drive.max_steps=345")
    command(*words, "--resume", "auto")
    for place in (path_run.directory, tmp_path / "parts"):
        command("export", place, "--to", "xyz")
    name = "export/trajectory.xyz"
    assert (tmp_path / "parts" / name).read_bytes() == (path_run.directory / name).read_bytes()


def test_what_cannot_be_exported_is_a_message(path_run, tmp_path):
    assert "formats: xyz, lammps, xdmf, vtk, png" in command("export", path_run.directory, "--to", "pdb", expect=2)
    command("export", path_run.directory, expect=2)
    command("export", tmp_path / "gone", "--to", "xyz", expect=4)
    scene = tmp_path / "s.toml"
    scene.write_text("[surface]\nsites = 32\nrms = 0.5\n")
    command("theory", scene, "--out", tmp_path / "theory")
    assert "run.h5 is not in it" in command("export", tmp_path / "theory", "--to", "xyz", expect=4)
    asperity.run(SMALL, {"drive.max_steps": 5}, out=tmp_path / "short")
    said = command("export", tmp_path / "short", "--to", "lammps", expect=4)
    assert "neither maps of a state nor a trajectory" in said
    command("export", tmp_path / "short", "--to", "xdmf")  # the substrate is there


@pytest.mark.parametrize("name, shape", [("substrate/height", (3000, 1)), ("substrate/height", ()),
                                         ("fields/zero-load/u_x", (7,)), ("fields/zero-load/gap", (5, 5))])
@pytest.mark.parametrize("kind", ["xyz", "xdmf"])
def test_damaged_files_are_a_message(path_run, tmp_path, name, shape, kind):
    copy = tmp_path / "copy"
    shutil.copytree(path_run.directory, copy, ignore=shutil.ignore_patterns("report*", "export"))
    with unsealed(copy / "run.h5") as file:
        del file[name]
        file[name] = np.zeros(shape)
    said = command("export", copy, "--to", kind, expect=4)
    assert "Traceback" not in said


def test_a_slid_block_is_exported_where_it_stands(tmp_path):
    """Over the substrate: the distances of the positions are those of the map, and frames go along."""
    run = asperity.run({"surface": {"sites": 16, "rms": 0.5}, "block.thickness": 4, "theory.renormalised": False,
                        "output": {"fields": ["segments"], "trajectory": 20}, "drive": {
                            "path": ["approach", "slide x 3.1 Å"], "velocity": 60, "timestep": 20, "ramp": 1}},
                       out=tmp_path / "slid")
    state = run.fields["segment-1"]
    assert state.slide == pytest.approx((3.1, 0.0), abs=0.02) and run.fields["segment-0"].slide == (0.0, 0.0)
    command("export", run.directory, "--to", "xyz")
    (_, rows), = frames_of_xyz(run.directory / "export/segment-1.xyz")
    block = rows[:, 3] == 2
    for site in (5, 90, 200):
        d = rows[block][site, :3] - rows[~block, :3]
        d[:, :2] -= run.edge * np.round(d[:, :2] / run.edge)
        assert np.sqrt((d**2).sum(1)).min() == pytest.approx(state.distance.ravel()[site], abs=1e-5)
    frames = frames_of_xyz(run.directory / "export/trajectory.xyz")
    first, last = (f[1][f[1][:, 3] == 2][:, 0] for f in (frames[0], frames[-1]))
    # The lowest layer sticks to the substrate and lags behind the top plane.
    assert 0.0 < np.mean(last - first) < run.series["slide_x"][-1]
