#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
# asperity export, and the trajectories it exports: the same frames on any ranks and through a stop. Formats are
# read back by ASE, MDAnalysis, h5py and xmllint where they are installed.
# shellcheck source=tests/cli/common.sh
. "$(dirname "$0")/common.sh"

printf '[surface]\nsites = 32\nrms = 0.5\n[drive]\nvelocity = 100\ntimestep = 20\n' >small.toml
frames="--set output.trajectory=100 --set output.velocities=true"
# shellcheck disable=SC2086  # two overrides
expect 0 run small.toml --progress off --out run $frames
expect 0 run small.toml --progress off --out plain # without: no group, the same numbers
for directory in run plain; do
    sed '/"run"/,$d; /"trajectory"\|"velocities"/d' $directory/result.json >$directory.numbers
done
cmp run.numbers plain.numbers || fail "a trajectory changed the numbers"

expect 0 export run --to xyz
says "run/export/zero-load.xyz"
says "run/export/trajectory.xyz"
expect 0 export run --to lammps
expect 0 export run --to xdmf
says "run/export/trajectory.h5"
expect 0 export run --to png
for map in gap pressure contact; do
    [ "$(head -c 4 "run/export/$map-zero-load.png" | tail -c 3)" = PNG ] || fail "$map is no PNG"
done
# Two layers of 32 x 32 atoms, as many columns as are named.
[ "$(head -n 1 run/export/zero-load.xyz)" = 2048 ] || fail "not 2048 atoms"
[ "$(wc -l <run/export/zero-load.xyz)" = 2050 ] || fail "not one frame of 2048 atoms"
[ "$(tail -n 2048 run/export/zero-load.xyz | awk '{ print NF }' | sort -u)" = 12 ] || fail "ragged columns"
[ "$(awk '$1 == "Au" && $10 == 1' run/export/zero-load.xyz | wc -l)" = "$(tr ',' '\n' \
    <<<"$("$asperity" report run >/dev/null && cat run/report/contact-zero-load.csv)" | grep -c 1)" ] ||
    fail "the contact flags are not those of the map"
[ "$(grep -c '^ITEM: TIMESTEP' run/export/trajectory.dump)" = "$(grep -c '^2048$' run/export/trajectory.xyz)" ] ||
    fail "dump and xyz differ in frames"
[ "$(grep -c '^ITEM: TIMESTEP' run/export/trajectory.dump)" -gt 5 ] || fail "hardly any frames"

# Stopped and taken up on other ranks: the same text, to the last digit.
# shellcheck disable=SC2086
expect 0 run small.toml --progress off --out parts $frames --set drive.max_steps=345
mpirun=$(command -v mpirun)
if [ -n "$mpirun" ]; then
    export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
    # shellcheck disable=SC2086
    out=$(OMP_NUM_THREADS=1 timeout 120 "$mpirun" --oversubscribe --bind-to none -n 2 "$asperity" run small.toml \
        --progress off --out parts --resume auto $frames 2>&1) || fail "no resumption: $out"
else
    # shellcheck disable=SC2086
    expect 0 run small.toml --progress off --out parts --resume auto $frames
fi
expect 0 export parts --to xyz
cmp run/export/trajectory.xyz parts/export/trajectory.xyz || fail "a stop changed the trajectory"

expect 2 export run --to pdb
says "formats: xyz, lammps, xdmf, png"
expect 2 export run
expect 4 export gone --to xyz
expect 0 theory small.toml --out theory
expect 4 export theory --to xyz
says "run.h5 is not in it"
expect 0 run small.toml --progress off --out short --set drive.max_steps=5
expect 4 export short --to lammps
says "neither maps of a state nor a trajectory"
expect 0 export short --to xdmf # the substrate is there

command -v xmllint >/dev/null && { xmllint --noout --nowarning run/run.xdmf 2>/dev/null || fail "run.xdmf is no XML"; }
cat >ase_reads.py <<'END'
import sys, warnings
warnings.filterwarnings("ignore")
try:
    import ase.io, h5py, numpy as np
except ImportError:
    sys.exit(77)
run = h5py.File("run/run.h5")
state = run["fields/zero-load"]
xyz = ase.io.read("run/export/zero-load.xyz")
block = xyz.arrays["type"] == 2
for name in ("pressure", "gap", "distance"):
    assert np.allclose(xyz.arrays[name][block], state[name][:].ravel(), rtol=1e-5, atol=1e-6), name
assert (xyz.arrays["contact"][block] == state["contact"][:].ravel()).all()
assert np.allclose(xyz.arrays["displacement"][block][:, 2], state["u_z"][:].ravel(), rtol=1e-5)
assert np.allclose(xyz.positions[~block][:, 2], run["substrate/height"][:].ravel(), atol=1e-6)
assert list(xyz.pbc) == [True, True, False]
# The distances are those of the positions.
near = xyz.get_distances(5 + 1024, range(1024), mic=True).min()
assert abs(near - state["distance"][:].ravel()[5]) < 1e-5
dump = ase.io.read("run/export/zero-load.dump", format="lammps-dump-text")
assert np.allclose(dump.positions, xyz.positions, atol=1e-6)
frames = ase.io.read("run/export/trajectory.xyz", index=":")
value = run["particles/trajectory/position/value"]
assert len(frames) == len(value)
assert all(np.allclose(f.positions[1024:], v, atol=1e-4) for f, v in zip(frames, value))
END
cat >xdmf_reads.py <<'END'
import sys
import xml.etree.ElementTree as tree
try:
    import h5py, numpy as np
except ImportError:
    sys.exit(77)
# Every data set is where the XML says, of the shape and kind that it says, and the frames are the trajectory's.
run = h5py.File("run/run.h5")
value = run["particles/trajectory/position/value"]
frames = 0
for item in tree.parse("run/run.xdmf").iter("DataItem"):
    if item.get("Format") != "HDF":
        continue
    file, dataset = item.text.split(":")
    data = h5py.File("run/" + file)[dataset]
    said = [int(n) for n in item.get("Dimensions").split()]
    assert [n for n in said if n > 1] == list(data.shape), dataset
    assert data.dtype.itemsize == int(item.get("Precision")), dataset
    if dataset.startswith("/position-"):
        assert (data[:] == value[frames]).all()
        frames += 1
assert frames == len(value)
END
cat >mdanalysis_reads.py <<'END'
import sys, warnings
warnings.filterwarnings("ignore")
try:
    import MDAnalysis, h5py, numpy as np
except ImportError:
    sys.exit(77)
value = h5py.File("run/run.h5")["particles/trajectory/position/value"]
universe = MDAnalysis.Universe.empty(value.shape[1], velocities=True)
universe.load_new("run/run.h5", format="H5MD")
assert len(universe.trajectory) == len(value)
for frame, ts in enumerate(universe.trajectory):
    assert np.allclose(ts.positions, value[frame])
    assert abs(ts.time - 2.0 * frame) < 1e-9 # 100 steps of 20 fs, in ps
    assert np.allclose(ts.dimensions[:2], 32 * 2.6)
    if frame == 0:
        assert np.allclose(ts.velocities, [0, 0, -1.0]) # 100 m/s, in Å/ps
END
for reader in ase xdmf mdanalysis; do
    [ -x /usr/bin/python3 ] || continue
    out=$(/usr/bin/python3 ${reader}_reads.py 2>&1)
    case $? in
    0) ;;
    77) echo "$reader is not installed: its reading is not tested" ;;
    *) fail "$reader: $out" ;;
    esac
done
finish
