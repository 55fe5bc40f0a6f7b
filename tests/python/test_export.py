# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Atoms and maps for other programs: read back as plain text and XML, and the same through a stop."""

import base64
import re
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


def test_states_and_trajectory_as_atoms(path_run):
    place = path_run.directory
    said = command("export", place, "--to", "xyz")
    assert f"{place}/export/relaxed.xyz" in said and f"{place}/export/trajectory.xyz" in said
    (head, rows), = frames_of_xyz(place / "export/relaxed.xyz")
    state = path_run.fields["relaxed"]
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

    with h5py.File(place / "run.h5") as file:
        value = file["particles/trajectory/position/value"][:]
        velocity = file["particles/trajectory/velocity/value"][:]
        steps = list(file["particles/trajectory/position/step"])
    texts = frames_of_xyz(place / "export/trajectory.xyz")
    assert len(texts) == len(value) > 3
    assert [int(re.search(r"step=(\d+)", head)[1]) for head, _ in texts] == steps
    for k in (0, len(value) - 1):
        assert texts[k][1][1024:, :3] == pytest.approx(value[k], abs=1e-4)
        # What OVITO and ASE take for velocities (test_viewers.py asks them).
        head, rows = texts[k]
        assert ":velo:R:3:masses:R:1:momenta:R:3" in head
        assert rows[1024:, 4:7] == pytest.approx(velocity[k], rel=1e-5, abs=1e-5)
        assert (rows[:, 7] == 197.0).all() and (rows[:1024, 4:7] == 0.0).all()
        # u Å/ps in sqrt(u eV): 1 u Å²/ps² is 1.036427e-4 eV.
        assert rows[1024:, 8:] == pytest.approx(197.0 * np.sqrt(1.036427e-4) * velocity[k], rel=1e-5, abs=1e-5)
    assert "time=" in texts[0][0]


def packed(item, form):
    """The values of an array of VTK's XML: base64, the length first."""
    data = base64.b64decode(item.text)
    assert int.from_bytes(data[:8], "little") == len(data) - 8
    return np.frombuffer(data[8:], form)


def test_maps_and_trajectory_for_paraview(path_run):
    place = path_run.directory
    assert f"{place}/export/trajectory.pvd" in command("export", place, "--to", "vtk")
    state = path_run.fields["relaxed"]
    found = {}
    for item in tree.parse(place / "export/relaxed.vti").iter("DataArray"):
        found[item.get("Name")] = packed(item, "<f8" if item.get("type") == "Float64" else "u1")
    assert (found["pressure (GPa)"] == state.pressure.ravel()).all() and (found["contact"] == state.contact.ravel()).all()
    assert (found["displacement (Å)"].reshape(-1, 3)[:, 2] == state.u_z.ravel()).all()
    with h5py.File(place / "run.h5") as run:
        group = run["particles/trajectory"]
        value, velocity, times = group["position/value"][:], group["velocity/value"][:], group["position/time"][:]
    frames = list(tree.parse(place / "export/trajectory.pvd").iter("DataSet"))
    assert [float(frame.get("timestep")) for frame in frames] == pytest.approx(times, rel=1e-11)
    for k in (0, len(value) - 1):
        points = tree.parse(place / "export" / frames[k].get("file")).find("PolyData/Piece")
        assert points.get("NumberOfPoints") == points.get("NumberOfVerts") == "1024"
        assert (packed(points.find("Points/DataArray"), "<f4").reshape(-1, 3) == value[k].astype("f4")).all()
        assert (packed(points.find("PointData/DataArray"), "<f4").reshape(-1, 3) == velocity[k].astype("f4")).all()
        connected, ends = (packed(item, "<i8") for item in points.find("Verts"))
        assert (connected == np.arange(1024)).all() and (ends == connected + 1).all()


def test_maps_lie_where_the_atoms_are(path_run):
    """Substrate and sites as an image (VTK) and atoms (XYZ): the same places, of the sites at rest."""
    place = path_run.directory
    for kind in ("xyz", "vtk"):
        command("export", place, "--to", kind)
    (_, rows), = frames_of_xyz(place / "export/relaxed.xyz")
    rigid, sites = rows[rows[:, 3] == 1, :2], rows[rows[:, 3] == 2]
    for name, expected in {"substrate": rigid, "relaxed": sites[:, :2] - sites[:, 4:6]}.items():
        image = tree.parse(place / f"export/{name}.vti").find("ImageData")
        origin, spacing = ([float(v) for v in image.get(key).split()] for key in ("Origin", "Spacing"))
        n = int(image.get("WholeExtent").split()[1]) + 1
        y, x = np.divmod(np.arange(n * n), n)
        places = np.column_stack([origin[0] + spacing[0] * x, origin[1] + spacing[1] * y])
        assert places == pytest.approx(expected, abs=1e-4), name


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
        assert matplotlib.image.imread(path_run.directory / f"export/{name}-relaxed.png")[..., :3].std() > 0.02


def test_a_trajectory_changes_no_numbers_and_survives_a_stop(path_run, tmp_path):
    plain = asperity.run(SMALL, out=tmp_path / "plain")
    assert plain.binding_energy == path_run.binding_energy
    assert plain.find("work_of_interface") == path_run.find("work_of_interface")
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
    assert "formats: xyz, vtk, png" in command("export", path_run.directory, "--to", "pdb", expect=2)
    command("export", path_run.directory, "--to", "lammps", expect=2, says=f"{path_run.directory} --to xyz")
    command("export", path_run.directory, "--to", "xdmf", expect=2, says=f"{path_run.directory} --to vtk")
    command("export", path_run.directory, expect=2)
    command("export", tmp_path / "gone", "--to", "xyz", expect=4)
    scene = tmp_path / "s.toml"
    scene.write_text("[surface]\nsites = 32\nrms = 0.5\n")
    command("theory", scene, "--out", tmp_path / "theory")
    assert "run.h5 is not in it" in command("export", tmp_path / "theory", "--to", "xyz", expect=4)
    asperity.run(SMALL, {"drive.max_steps": 5}, out=tmp_path / "short")
    said = command("export", tmp_path / "short", "--to", "xyz", expect=4)
    assert "neither maps of a state nor a trajectory" in said
    command("export", tmp_path / "short", "--to", "vtk")  # the substrate is there


@pytest.mark.parametrize("name, shape", [("substrate/height", (3000, 1)), ("substrate/height", ()),
                                         ("fields/relaxed/u_x", (7,)), ("fields/relaxed/gap", (5, 5))])
@pytest.mark.parametrize("kind", ["xyz", "vtk"])
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
    run = asperity.run({"surface": {"sites": 16, "rms": 0.5}, "block.thickness": 4,
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
