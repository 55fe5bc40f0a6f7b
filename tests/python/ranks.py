# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""What test_ranks.py starts on some ranks: a simulation of all of them; its numbers as JSON, and its fields.

    mpirun -n 2 python3 ranks.py DIRECTORY
"""

import ctypes
import json
import os
import re
import sys
from pathlib import Path

import numpy
from mpi4py import MPI

import asperity
import conftest

del os.environ["OMP_NUM_THREADS"]  # of conftest
comm, place = MPI.COMM_WORLD, Path(sys.argv[1])
found = {}


def whole(sim):
    """u and v of all ranks on the first."""
    fields = numpy.zeros((6, 32, 32))
    for number, part in enumerate([*sim.u, *sim.v]):
        fields[number][sim.tile] = part
    return comm.allreduce(fields)


sim = asperity.Simulation(conftest.SMALL, comm=comm)
assert sim.u.z.shape == sim.maps().gap.shape == sim.substrate.height[sim.tile].shape
assert sim.u.z.size * comm.size == 32 * 32
sim.every(100, lambda s: s.steps, "count")
while sim.work_of_interface.approach is None:
    sim.step()
openmp = next(line.split()[-1] for line in open("/proc/self/maps") if re.search(r"/lib[gi]?omp\d*\.so", line))
found["threads"] = ctypes.CDLL(openmp).omp_get_max_threads()
rest = sim.relax()
found["binding_energy"], found["contact_fraction"] = rest.binding_energy, rest.contact_fraction
found["gap"] = comm.allreduce(rest.maps.gap.sum())
sim.save(place / "saved.h5")
sim.step(10**9)
found["series"] = {name: values.tolist() for name, values in sim.series.items()}
found["pull_off"] = sim.work_of_interface.pull_off
again = asperity.Simulation.resume(place / "saved.h5", comm=comm)
again.step(10**9)
assert again.work_of_drive.pull_off == sim.work_of_drive.pull_off and (whole(again) == whole(sim)).all()

# What one rank writes is felt by all; forces from outside; a value that is no number is refused on all of them.
sim = asperity.Simulation(conftest.SMALL, comm=comm)
sim.step(20)
rows, columns = sim.tile
if rows.start <= 15 < rows.stop and columns.start <= 15 < columns.stop:  # at the edge between two ranks
    sim.u.z[15 - rows.start, 15 - columns.start] += 0.01
field = numpy.zeros((32, 32, 3))
field[3, :, 0] = 0.02
sim.external = field[sim.tile]
sim.step(40)
found["work"], found["balance"] = sim.external_work, sim.energy.balance_error
fields = whole(sim)
assert sim.write(place / "written") == place / "written"
try:
    sim.write(place / "written")
    found["written_twice"] = True
except asperity.SceneError:
    found["written_twice"] = False
if comm.rank == comm.size - 1:
    kept, sim.u.z[1, 1] = sim.u.z[1, 1], numpy.nan
try:
    sim.step()
    found["refused"] = False
except asperity.SceneError:
    found["refused"] = True
if comm.rank == comm.size - 1:
    sim.u.z[1, 1] = kept
assert sim.step() == 1
if comm.rank == 0:
    numpy.save(place / "fields.npy", fields)
    (place / "found.json").write_text(json.dumps(found))
