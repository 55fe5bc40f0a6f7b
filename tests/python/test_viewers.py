# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Exports opened by the programs that they are for: ASE, OVITO, MDAnalysis and VTK (ParaView's readers).

Needs them (PyPI: ase ovito MDAnalysis vtk); tests of what is not there are skipped.
"""

import os
import xml.etree.ElementTree as tree

import numpy as np
import pytest

import asperity
from conftest import command

os.environ.setdefault("OVITO_GUI_MODE", "0")
os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
SITES = 32 * 32


@pytest.fixture(scope="module")
def exported(path_run):
    for kind in ("xyz", "vtk"):
        command("export", path_run.directory, "--to", kind)
    return path_run.directory / "export"


@pytest.fixture(scope="module")
def block(path_run):
    """Positions of the block's atoms at zero load, [site, 3]: what every reader must find."""
    state = path_run.fields["relaxed"]
    y, x = np.divmod(np.arange(SITES), 32)
    spacing = path_run.edge / 32
    rest = np.column_stack([(x + 0.5) * spacing, (y + 0.5) * spacing, np.full(SITES, state.reference_height)])
    return rest + np.column_stack([state[name].ravel() for name in ("u_x", "u_y", "u_z")])


@pytest.fixture(scope="module")
def frames(path_run):
    return path_run.file.array("/particles/trajectory/position/value", 3)


def test_ase_reads_extended_xyz(path_run, exported, block, frames):
    io = pytest.importorskip("ase.io")
    atoms = io.read(exported / "relaxed.xyz")
    assert atoms.positions[SITES:] == pytest.approx(block, abs=1e-5)
    pressure = path_run.fields["relaxed"].pressure.ravel()
    assert atoms.arrays["pressure"][SITES:] == pytest.approx(pressure, rel=1e-5, abs=1e-9)
    assert list(atoms.pbc) == [True, True, False] and atoms.cell[0][0] == pytest.approx(path_run.edge)
    assert list(atoms.symbols[:1]) + list(atoms.symbols[-1:]) == ["X", "Au"]
    films = io.read(exported / "trajectory.xyz", index=":")
    assert len(films) == len(frames)
    assert films[-1].positions[SITES:] == pytest.approx(frames[-1], abs=1e-4)
    units = pytest.importorskip("ase.units")
    velocity = path_run.file.array("/particles/trajectory/velocity/value", 3)[-1]
    assert films[-1].get_velocities()[SITES:] * 1e3 * units.fs == pytest.approx(velocity, rel=1e-4, abs=1e-5)
    kinetic = films[-1].get_kinetic_energy()  # eV; u Å²/ps² is 1.0364e-4 of it
    assert kinetic == pytest.approx(0.5 * 197.0 * (velocity.astype(float)**2).sum() * 1.036427e-4, rel=1e-4)


def test_ovito_reads_atoms(path_run, exported, block, frames):
    import_file = pytest.importorskip("ovito.io").import_file
    data = import_file(str(exported / "relaxed.xyz")).compute()
    assert data.particles.count == 2 * SITES
    assert data.particles.positions[SITES:] == pytest.approx(block, abs=1e-4)
    assert data.cell[0][0] == pytest.approx(path_run.edge) and list(data.cell.pbc) == [True, True, False]
    pressure = path_run.fields["relaxed"].pressure.ravel()
    assert data.particles["pressure"][SITES:] == pytest.approx(pressure, rel=1e-5, abs=1e-9)
    film = import_file(str(exported / "trajectory.xyz"))
    assert film.source.num_frames == len(frames)
    last = film.compute(len(frames) - 1)
    assert last.particles.positions[SITES:] == pytest.approx(frames[-1], abs=1e-4)
    assert last.particles.velocities[SITES:] == pytest.approx(
        path_run.file.array("/particles/trajectory/velocity/value", 3)[-1], rel=1e-4, abs=1e-5)


def test_mdanalysis_reads_the_h5md_of_a_run(path_run, frames):
    MDAnalysis = pytest.importorskip("MDAnalysis")
    universe = MDAnalysis.Universe.empty(SITES, trajectory=True, velocities=True)
    universe.load_new(str(path_run.directory / "run.h5"), format="H5MD")
    assert len(universe.trajectory) == len(frames)
    times = path_run.file.array("/particles/trajectory/position/time", 1)
    for frame in (0, len(frames) - 1):
        now = universe.trajectory[frame]
        assert now.positions == pytest.approx(frames[frame], abs=1e-4)
        assert now.time == pytest.approx(times[frame], rel=1e-6)
        assert now.dimensions[:2] == pytest.approx([path_run.edge] * 2, rel=1e-5)
    assert now.has_velocities


def vtk_arrays(data):
    from vtkmodules.util.numpy_support import vtk_to_numpy

    points = data.GetPointData()
    return {points.GetArrayName(k): vtk_to_numpy(points.GetArray(k)) for k in range(points.GetNumberOfArrays())}


def test_vtk_reads_maps(path_run, exported):
    vtk = pytest.importorskip("vtk")
    for name, at, maps in (("relaxed", 0.5, path_run.fields["relaxed"]), ("substrate", 0.0, None)):
        reader = vtk.vtkXMLImageDataReader()
        reader.SetFileName(str(exported / f"{name}.vti"))
        reader.Update()
        image = reader.GetOutput()
        spacing = path_run.edge / 32
        assert image.GetDimensions() == (32, 32, 1)
        assert image.GetSpacing()[:2] == pytest.approx((spacing, spacing))
        assert image.GetOrigin()[:2] == pytest.approx((at * spacing, at * spacing))
        arrays = vtk_arrays(image)
        if maps is None:
            assert arrays["height (Å)"] == pytest.approx(path_run.substrate.height.ravel(), rel=1e-12)
            continue
        assert arrays["pressure (GPa)"] == pytest.approx(maps.pressure.ravel(), rel=1e-12)
        assert arrays["displacement (Å)"][:, 2] == pytest.approx(maps["u_z"].ravel(), rel=1e-12)
        assert (arrays["contact"] == maps.contact.ravel()).all()


def test_vtk_reads_the_trajectory(path_run, exported, frames):
    vtk = pytest.importorskip("vtk")
    from vtkmodules.util.numpy_support import vtk_to_numpy

    film = list(tree.parse(exported / "trajectory.pvd").iter("DataSet"))  # that ParaView itself reads
    assert len(film) == len(frames)
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(str(exported / film[-1].get("file")))
    reader.Update()
    layer = reader.GetOutput()
    assert vtk_to_numpy(layer.GetPoints().GetData()) == pytest.approx(frames[-1], abs=1e-4)
    assert layer.GetNumberOfVerts() == SITES
    velocity = path_run.file.array("/particles/trajectory/velocity/value", 3)[-1]
    assert vtk_arrays(layer)["velocity (Å/ps)"] == pytest.approx(velocity, rel=1e-5, abs=1e-6)


def test_vtk_reads_the_stresses(tmp_path):
    vtk = pytest.importorskip("vtk")
    run = asperity.run({"surface": {"sites": 24, "spacing": 2.0, "rms": 0.6, "rolloff": 2, "q_max": 6}, "block": {"young": 20, "poisson": 0.3},
                        "interface": {"kind": "wall", "adhesion": 2.0, "range": 3.0},
                        "drive": {"path": ["relax"], "load": 600.0, "mode": "quasistatic"}}, out=tmp_path / "run")
    for whole in (True, False):
        found = asperity.stress(run, volume=whole, out=tmp_path / f"volume-{whole}")
        reader = vtk.vtkXMLImageDataReader()
        reader.SetFileName(str(tmp_path / f"volume-{whole}/stress.vti"))
        reader.Update()
        image = reader.GetOutput()
        values = found.volume if whole else {name: one[:, None, :] for name, one in found.section.items()}
        assert image.GetDimensions() == values["zz"].shape[::-1] and image.GetPointData().GetNumberOfArrays() == 8
        assert image.GetSpacing() == pytest.approx((2.0, 2.0, found.depth[1])) and image.GetOrigin()[2] == 0
        arrays = vtk_arrays(image)
        for name, one in values.items():
            assert arrays[f"stress {name} (GPa)"] == pytest.approx(one.ravel(), rel=1e-5, abs=1e-6 * abs(one).max()), name
