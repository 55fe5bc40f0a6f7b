# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""A viscoelastic block, led from Python: what a state remembers."""
import numpy as np
import pytest

import asperity

SCENE = {"surface.sites": 16, "surface.kind": "flat", "block.thickness": 8, "interface.kind": "wall", "interface.adhesion": "30 mJ/m^2",
         "interface.range": "1 nm", "surface.spacing": "1 nm", "block.young": "20 MPa", "block.prony": [[2.0, "1 ns"], [1.0, "9 ns"]],
         "drive.mode": "quasistatic", "drive.path": ["approach", "pull-off"], "drive.control": "top", "drive.velocity": "10 m/s"}


@pytest.fixture
def pressed():
    statics = asperity.Statics(SCENE)
    statics.top = -statics.now.mean_height - 5.0
    statics.relax()
    return statics


def test_a_state_keeps_what_the_block_remembers(pressed):
    kept = pressed.copy()
    forces = [pressed.hold(0.5).force for _ in range(3)]
    assert forces[0] > forces[1] > forces[2] > 0
    pressed.restore(kept)
    assert [pressed.hold(0.5).force for _ in range(3)] == pytest.approx(forces, rel=1e-9)


def test_a_state_of_displacements_has_relaxed(pressed):
    kept = pressed.copy()
    pressed.hold("1 us")
    relaxed = pressed.now.force
    pressed.restore(asperity.running.engine.State(np.array(kept.u), kept.top))
    assert pressed.relax().force == pytest.approx(relaxed, rel=1e-6)


def test_a_state_of_other_branches_is_refused(pressed):
    other = asperity.Statics(SCENE | {"block.prony": [[2.0, "1 ns"]]})
    with pytest.raises(asperity.SceneError, match="block.prony"):
        other.restore(pressed.copy())
