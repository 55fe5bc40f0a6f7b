# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""A call with nonsense for an argument ends in an error of the package that names what is wrong: every function for users, every
argument, every kind of nonsense."""

import inspect
import math
import subprocess
from pathlib import Path

import numpy as np
import pytest

import asperity
import asperity.crack
from asperity.studies import map_scene

SCENE = {"name": "a", "surface": {"sites": 16, "rms": 0.6}, "block": {"thickness": 16}, "drive": {"mode": "quasistatic", "path": ["relax"]},
         "interface": {"kind": "wall", "range": "2 nm"}}
SENSE = {"scene": SCENE, "map": "map.npy", "source": "map.txt", "target": "map.h5", "directory": "out", "to": "xyz", "young": "1 GPa", "poisson": 0.3,
         "adhesion": "50 mJ/m2", "size": "32 nm", "unit": "Å", "sites": 16, "radius": "20 nm", "stiffness": "20 N/m",
         "prony": [(2.0, "1 ns")], "frequency": "1 GHz", "velocity": "1 m/s", "tip_radius": "10 nm", "values": {"surface.rms": [0.5, 0.6]}}
"""Arguments of a call that works, by their names in all functions."""
NONSENSE = {"an object": object(), "nan": math.nan, "a negative number": -3, "a text": "nonsense \x1b[31m\n", "bytes": b"bytes",
            "a list": [3.5, None],
            "True": True}
PUBLIC = {name: getattr(asperity, name) for name in sorted(asperity._LAZY) if inspect.isfunction(getattr(asperity, name))} | {
    "Simulation": asperity.Simulation, "Statics": asperity.Statics} | {
    f"crack.{name}": getattr(asperity.crack, name) for name in asperity.crack.__all__}


class Works(asperity.Stopped):
    """A run would start."""


@pytest.fixture()
def place(place, monkeypatch):
    """A folder with the files of the calls, in which no run is started."""
    waves = np.hypot(*np.meshgrid(np.fft.fftfreq(32), np.fft.fftfreq(32)))
    np.save("map.npy", np.fft.ifft2(np.fft.fft2(np.random.default_rng(3).normal(0, 3, (32, 32))) / (1 + (waves / 0.05) ** 2)).real)
    np.savetxt("map.txt", np.random.default_rng(1).normal(size=(16, 16)))

    def popen(*words, **options):
        raise Works("a run would start")

    run = subprocess.run
    monkeypatch.setattr("asperity.running.pool.subprocess.Popen", popen)
    monkeypatch.setattr("subprocess.run", lambda *a, **b: _undisturbed(monkeypatch, run, *a, **b))
    return place


def _undisturbed(monkeypatch, run, *given, **named):
    with monkeypatch.context() as patch:
        patch.setattr("subprocess.Popen", POPEN)
        return run(*given, **named)


POPEN = subprocess.Popen


@pytest.mark.parametrize("name", PUBLIC)
def test_nonsense_is_refused_by_an_error_of_the_package(name, place):
    function = PUBLIC[name]
    known = inspect.signature(function).parameters
    sense = {key: value for key, value in SENSE.items() if key in known and
             (known[key].default is inspect.Parameter.empty or name in ("adhesion", "tip"))}
    for key in known:
        if known[key].kind in (inspect.Parameter.VAR_KEYWORD, inspect.Parameter.VAR_POSITIONAL):
            continue
        for kind, value in NONSENSE.items():
            if kind == "a text" and key in ("out", "target"):
                continue  # the name of a folder
            try:
                function(**{**sense, key: value})
            except asperity.Error as error:
                said = str(error)
                assert said and "\x1b" not in said and not isinstance(error, asperity.InternalError), f"{name}({key}={kind}): {said!r}"
            except Exception as error:
                pytest.fail(f"{name}({key}={kind}): {type(error).__name__}: {error}")


@pytest.mark.parametrize("sites", [3, 15, 2.5, "16", True, None])
def test_sites_of_a_map_are_those_that_are_asked_for(sites, place):
    if sites is None:
        Path("made").mkdir()
        made = map_scene.scene_of("map.npy", "100 GPa", 0.3, "50 mJ/m2", Path("made"), size="32 nm", unit="Å", sites=16)
        assert "sites = 16" in made.file.read_text()
        return
    with pytest.raises(asperity.SceneError, match="sites"):
        asperity.adhesion("map.npy", "1 GPa", 0.3, "50 mJ/m2", size="32 nm", unit="Å", sites=sites)


def test_a_wrong_kind_says_which_is_right():
    with pytest.raises(asperity.WrongCall, match=r"(?s)adhesion\(\): sites is 2.5.*it is of type float.*give a whole number"):
        asperity.adhesion("map.npy", sites=2.5)
    with pytest.raises(asperity.WrongCall, match=r"(?s)prony\(\): source is None.*give a text or Path"):
        asperity.prony(None)
