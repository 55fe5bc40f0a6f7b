# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Keys of an experiment (spring, free edges, layers, surface stress, a law for each site) in every kind of scene: each is
simulated, or refused or noted by its name with what to do. Values that mean nothing are refused."""

import json
import os
import subprocess

import numpy as np
import pytest

KEYS = {
    "drive.stiffness": ("5 N/m", "spring of the machine"),
    "drive.mass": ("1 ng", None),
    "surface.boundary": ("free", "free edges"),
    "block.layers": ('[["2 nm", "10 GPa", 0.3]]', "layers"),
    "block.surface_stress": ("0.05", "surface stress"),
    "interface.adhesion": ("stripes 50 10 4nm", "numbers of each site"),
    "interface.law": ("dugdale", None),
}
SPHERE = {"surface.kind": "flat", "surface.radius": "20 nm", "surface.sites": "16", "surface.spacing": "1 nm", "block.thickness": "16"}
WALL = {**SPHERE, "interface.kind": "wall", "interface.adhesion": "50 mJ/m^2", "interface.range": "0.3 nm", "drive.mode": "quasistatic"}
SCENES = {
    "wall": WALL,
    "wall, mean height": {**WALL, "drive.control": "mean-height"},
    "wall, viscoelastic": {**WALL, "block.prony": '[[1.0, "1 ns"]]', "drive.velocity": "1 m/s"},
    "wall, slide": {**WALL, "surface.radius": "none", "drive.path": '["approach", "slide x 2 nm"]'},
    "wall, one state": {**WALL, "drive.path": '["relax"]'},
    "atoms": {"surface.sites": "16", "drive.mode": "quasistatic"},
    "atoms, dynamic": {"surface.sites": "16", "drive.mode": "dynamic"},
    "atoms, finite strain": {"surface.sites": "16", "drive.mode": "dynamic", "block.strain": "finite"},
    "atoms, device": {"surface.sites": "16", "drive.mode": "dynamic", "numerics.device": "emulated"},
    "atoms, warm": {"surface.sites": "16", "drive.mode": "dynamic", "drive.temperature": "300"},
}


@pytest.fixture()
def ask(place):
    (place / "s.toml").write_text("")

    def ask(settings):
        """Returns what `check --json` prints of a scene, or its problems."""
        sets = [f"{key}={value}" for key, value in settings.items()]
        done = subprocess.run([os.environ["ASPERITY_PROGRAM"], "check", "s.toml", "--json", "--set", *sets], capture_output=True, text=True)
        assert done.returncode in (0, 2), done.stderr
        if not done.stdout:
            return json.loads(done.stderr)["error"]["problems"]
        answer = json.loads(done.stdout)
        assert bool(answer["problems"]) == (done.returncode == 2)
        return answer["problems"] or answer
    return ask


@pytest.mark.parametrize("scene", SCENES)
def test_each_key_is_simulated_or_named(ask, scene):
    for key, (value, effect) in KEYS.items():
        answer = ask({**SCENES[scene], key: value})
        if isinstance(answer, list):
            assert any(key in "".join(p.values()) or key.split(".")[1] in p["what"] for p in answer), (key, answer)
            assert all(p["what"] and p["why"] and p["fix"] for p in answer), (key, answer)
            continue
        noted = any(note.startswith(f"{key} has no effect") for note in answer["notes"])
        if effect is None:
            without = ask(SCENES[scene])
            assert noted or answer["scene"] != without["scene"], (key, answer["notes"])
        else:
            assert answer["effects"][effect]["on"] != noted, (key, answer["effects"][effect], answer["notes"])


@pytest.mark.parametrize("key, value", [
    ("drive.stiffness", "0"), ("drive.stiffness", "-5 N/m"), ("drive.stiffness", "5 nN"), ("drive.stiffness", "nan"),
    ("drive.stiffness", "5 MPa"), ("drive.mass", "0"), ("drive.mass", "-1 ng"), ("drive.mass", "5 nm"),
    ("block.layers", '[["2 nm", "10 GPa"]]'), ("block.layers", '[["2 nm", "10 GPa", 0.6]]'), ("block.layers", '[["2 nm", "-1 GPa", 0.3]]'),
    ("block.layers", '[["0 nm", "1 GPa", 0.3]]'), ("block.layers", '[["2 GPa", "1 nm", 0.3]]'), ("block.layers", '[["200 nm", "1 GPa", 0.3]]'),
    ("block.layers", "coating.toml"), ("block.surface_stress", "-0.1"), ("block.surface_stress", "0.1 N"), ("block.surface_stress", "inf"),
    ("surface.boundary", "open"), ("surface.boundary", "1"), ("interface.adhesion", "-5"), ("interface.adhesion", "stripes 50 10"),
    ("interface.adhesion", "stripes 50 10 4GPa"), ("interface.adhesion", "stripes 50 10 0nm"), ("interface.adhesion", "spots 50 10 4nm"),
    ("interface.adhesion", "nowhere.npy"), ("interface.adhesion", "nan.npy"), ("interface.adhesion", "shape.npy"),
    ("interface.adhesion", "negative.npy"), ("interface.adhesion", "complex.npy"), ("interface.law", "gaussian"), ("interface.range", "0"),
    ("drive.load", "5 N/m"), ("drive.load", "1 N"), ("drive.load", "nan")])
def test_what_means_nothing_is_refused(ask, place, key, value):
    good = np.full((16, 16), 50.0)
    for name, field in {"nan": np.where(np.eye(16) > 0, np.nan, good), "shape": np.ones((2, 3, 4)), "negative": -good,
                        "complex": good * 1j}.items():
        np.save(place / f"{name}.npy", field)
    free = key == "drive.load"  # of a half-space, without a thickness
    scene = {k: v for k, v in WALL.items() if not free or k != "block.thickness"}
    problems = ask({**scene, key: value, **({"surface.boundary": "free"} if free else {})})
    assert isinstance(problems, list), (key, value)
    assert any(key in p["what"] or key.split(".")[1] in p["what"] or key in p["where"] or value in p["where"] + p["what"] for p in problems), problems
    assert all(p["what"] and p["why"] and p["fix"] for p in problems), problems
