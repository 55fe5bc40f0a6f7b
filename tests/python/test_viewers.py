# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Exports opened by the programs that they are for: ASE, OVITO, MDAnalysis, VTK (ParaView's readers) and LAMMPS.

Needs them (PyPI: ase ovito MDAnalysis vtk; LAMMPS as `lmp`); tests of what is not there are skipped.
"""

import os
import shutil
import subprocess

import numpy as np
import pytest

from conftest import command

os.environ.setdefault("OVITO_GUI_MODE", "0")
os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
SITES = 32 * 32


@pytest.fixture(scope="module")
def exported(path_run):
    for kind in ("xyz", "lammps", "xdmf", "vtk"):
        command("export", path_run.directory, "--to", kind)
    return path_run.directory / "export"


@pytest.fixture(scope="module")
def block(path_run):
    """Positions of the block's atoms at zero load, [site, 3]: what every reader must find."""
    state = path_run.fields["zero-load"]
    y, x = np.divmod(np.arange(SITES), 32)
    spacing = path_run.edge / 32
    rest = np.column_stack([(x + 0.5) * spacing, (y + 0.5) * spacing, np.full(SITES, state.reference_height)])
    return rest + np.column_stack([state[name].ravel() for name in ("u_x", "u_y", "u_z")])


@pytest.fixture(scope="module")
def frames(path_run):
    return path_run.file.array("/particles/trajectory/position/value", 3)


def test_ase_reads_extended_xyz(path_run, exported, block, frames):
    io = pytest.importorskip("ase.io")
    atoms = io.read(exported / "zero-load.xyz")
    assert atoms.positions[SITES:] == pytest.approx(block, abs=1e-5)
    pressure = path_run.fields["zero-load"].pressure.ravel()
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


@pytest.mark.parametrize("end", ["xyz", "dump"])
def test_ovito_reads_atoms(path_run, exported, block, frames, end):
    import_file = pytest.importorskip("ovito.io").import_file
    data = import_file(str(exported / f"zero-load.{end}")).compute()
    assert data.particles.count == 2 * SITES
    assert data.particles.positions[SITES:] == pytest.approx(block, abs=1e-4)
    assert data.cell[0][0] == pytest.approx(path_run.edge) and list(data.cell.pbc) == [True, True, False]
    pressure = path_run.fields["zero-load"].pressure.ravel()
    assert data.particles["pressure"][SITES:] == pytest.approx(pressure, rel=1e-5, abs=1e-9)
    film = import_file(str(exported / f"trajectory.{end}"))
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


def test_paraviews_reader_of_xdmf(path_run, exported, frames):
    vtk = pytest.importorskip("vtk")
    reader = vtk.vtkXdmfReader()
    reader.SetFileName(str(path_run.directory / "run.xdmf"))
    reader.UpdateInformation()
    times = path_run.file.array("/particles/trajectory/position/time", 1)
    reader.UpdateTimeStep(float(times[-1]))
    blocks, found = reader.GetOutputDataObject(0), {}
    for k in range(blocks.GetNumberOfBlocks()):
        found[blocks.GetMetaData(k).Get(vtk.vtkCompositeDataSet.NAME())] = blocks.GetBlock(k)
    state = found["zero-load"]
    assert state.GetDimensions() == (32, 32, 1)
    arrays = vtk_arrays(state)
    assert arrays["gap (Å)"] == pytest.approx(path_run.fields["zero-load"].gap.ravel(), nan_ok=True)
    assert arrays["pressure (GPa)"] == pytest.approx(path_run.fields["zero-load"].pressure.ravel())
    assert state.GetSpacing()[0] == pytest.approx(path_run.edge / 32)
    assert vtk_arrays(found["substrate"])["height (Å)"] == pytest.approx(path_run.substrate.height.ravel())
    from vtkmodules.util.numpy_support import vtk_to_numpy

    layer = next(found[name] for name in found if name.startswith("lowest layer"))
    layer = layer.GetBlock(0) if layer.IsA("vtkMultiBlockDataSet") else layer
    assert vtk_to_numpy(layer.GetPoints().GetData()) == pytest.approx(frames[-1], abs=1e-4)


def test_vtk_reads_maps(path_run, exported):
    vtk = pytest.importorskip("vtk")
    for name, at, maps in (("zero-load", 0.5, path_run.fields["zero-load"]), ("substrate", 0.0, None)):
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


def lammps(script, place):
    program = shutil.which("lmp")
    if not program:
        pytest.skip("LAMMPS is not installed")
    (place / "in.lammps").write_text(script)
    done = subprocess.run([program, "-in", "in.lammps", "-log", "none"], cwd=place, capture_output=True, text=True,
                          env={**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"})
    assert done.returncode == 0 and "ERROR" not in done.stdout, done.stdout + done.stderr
    lines = (place / "back.dump").read_text().split("ITEM: ATOMS")[1].splitlines()[1:]
    return np.array([line.split() for line in lines], float)


def test_lammps_reads_data_and_dump(path_run, exported, block, frames, tmp_path):
    for name in ("zero-load.data", "trajectory.dump"):  # LAMMPS takes no path with a space
        shutil.copy(exported / name, tmp_path)
    start = "units metal\natom_style atomic\nboundary p p f\npair_style zero 3\n"
    end = "pair_coeff * *\nwrite_dump all custom back.dump id type x y z vx vy vz modify sort id format float %.10g\n"
    back = lammps(f"{start}read_data zero-load.data\n{end}", tmp_path)
    assert back[SITES:, 2:5] == pytest.approx(block, abs=1e-5)
    assert (back[:, 1] == np.repeat([1, 2], SITES)).all()
    last = path_run.file.array("/particles/trajectory/position/step", 1)[-1]
    back = lammps(f"{start}read_data zero-load.data\n"
                  f"read_dump trajectory.dump {last} x y z vx vy vz box yes\n{end}", tmp_path)
    assert back[SITES:, 2:5] == pytest.approx(frames[-1], abs=1e-4)
    assert back[SITES:, 5:] == pytest.approx(path_run.file.array("/particles/trajectory/velocity/value", 3)[-1],
                                             rel=1e-4, abs=1e-5)
