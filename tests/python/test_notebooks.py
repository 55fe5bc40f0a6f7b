# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The notebooks among the examples, and the bar of steps in them and elsewhere."""

import sys

import pytest

import asperity
from conftest import ROOT, SMALL

nbclient, nbformat, *_ = [
    pytest.importorskip(name, reason=f"no {name}: apt-get install python3-{name}")
    for name in ("nbclient", "nbformat", "ipykernel", "tqdm")]


@pytest.mark.parametrize("with_tqdm", [True, False])
def test_progress(with_tqdm, capfd, monkeypatch):
    if not with_tqdm:
        monkeypatch.setitem(sys.modules, "tqdm.auto", None)
    plain, sim = asperity.Simulation(SMALL), asperity.Simulation(SMALL)
    assert sim.step(300, progress=True) == plain.step(300) == 300
    assert all((one == other).all() for one, other in zip(sim.u + sim.v, plain.u + plain.v))
    said = capfd.readouterr().err
    assert ("300/300" if with_tqdm else "300 of 300 steps") in said and "MPa" in said, said


def results(notebook):
    """Values that its cells end with."""
    return [output["data"]["text/plain"] for cell in notebook.cells for output in cell.get("outputs", [])
            if output["output_type"] == "execute_result"]


def test_notebooks(tmp_path):
    """From top to bottom, without a display; the outputs that are kept with it are those of today."""
    notebooks = sorted((ROOT / "examples").glob("*.ipynb"))
    assert notebooks
    for file in notebooks:
        notebook = nbformat.read(file, 4)
        kept = results(notebook)
        with pytest.MonkeyPatch.context() as patch:
            patch.setenv("PYTHONPATH", str(ROOT / "python"))
            patch.setenv("MPLBACKEND", "module://matplotlib_inline.backend_inline")
            nbclient.NotebookClient(notebook, timeout=120, resources={"metadata": {"path": str(tmp_path)}}).execute()
        outputs = [output for cell in notebook.cells for output in cell.get("outputs", [])]
        assert [kind for output in outputs for kind in output.get("data", {})].count("image/png") == 3
        assert results(notebook) == kept and len(kept) == 3  # what a reader sees before it is run
        said = "".join(output.get("text", "") for output in outputs)
        assert "400/400" in said, said  # the bar
