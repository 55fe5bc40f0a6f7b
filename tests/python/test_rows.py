# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The main numbers of a run are formed once, as `rows` and `sentences` of result.json: the terminal, the page and the notebook say the
same ones, and they are those of the result."""

import html
import re

import pytest

import asperity
from asperity.reports import sentences
from asperity.reports.sweep import write_page
from asperity.running.scene import toml_of
from asperity.units import ATTOJOULE, NANONEWTON
from conftest import SMALL, STATE, command

WALL = {"kind": "wall", "adhesion": "50 mJ/m^2"}
SCENES = {
    "state": {**STATE, "surface": {"sites": 24, "rms": 0.5}},
    "state over a wall": {**STATE, "surface": {"sites": 32, "rms": 0.5}, "interface": WALL},
    "path": SMALL,
    "cycle": {"surface": {"sites": 16, "rms": 0.5}, "block": {"thickness": 16}, "drive": {"mode": "quasistatic"}},
    "segments": {"surface": {"sites": 16, "rms": 0.5}, "block": {"thickness": 16},
                 "drive": {"mode": "quasistatic", "path": ["approach", "load 50 MPa", "slide x 5 Å", "pull-off"]}},
    "sphere": {"surface": {"kind": "flat", "sites": 72, "spacing": "0.5 nm", "radius": "20 nm", "boundary": "free"},
               "block": {"young": "1 GPa", "poisson": 0.3}, "interface": {**WALL, "range": "1 nm"},
               "drive": {"mode": "quasistatic", "path": ["approach", "load 5 nN", "pull-off"], "displacement_step": "0.5 nm"}},
}
NUMBERS = {"binding energy": ["binding_energy"], "energy of the pairs alone": ["pair_binding_energy"],
           "elastic energy stored": ["relaxed.elastic_energy"], "contact fraction": ["contact_fraction"],
           "repulsive sites, fraction": ["repulsive_fraction"], "convergence": ["binding_energy_uncertainty"],
           **{f"work of the {who}": [f"work_of_{who}.{way}" for way in ("approach", "pull_off")] for who in ("interface", "drive")},
           "largest attraction": ["approach_force", "pull_off_force"], "pull-off stress": ["pull_off_force"],
           "contact radius": ["contact_radius.relaxed"], "energy lost in a cycle": ["lost.cycle"]}
"""Numbers of the result behind some of the rows."""


def unit_of(run, path, unit):
    """A number of the result in the unit of a row."""
    own = run.unit(path)
    area = run.edge**2
    factors = {("meV/Å^2", "aJ"): 1e-3 * area / ATTOJOULE, ("eV/Å", "nN"): 1 / NANONEWTON, ("Å", "nm"): 0.1,
               **{("eV/Å", stress): 160.2176634 / area / size for stress, size in (("GPa", 1), ("MPa", 1e-3), ("kPa", 1e-6))}}
    return run.number(path) * factors.get((own, unit), 1.0)


@pytest.mark.parametrize("name", SCENES)
def test_the_terminal_the_page_and_the_notebook_say_the_same_numbers(place, light, name):
    (place / "scene.toml").write_text(toml_of({key: value for key, value in SCENES[name].items() if key != "name"}))
    said = [re.split(r" {2,}", line.strip()) for line in command("run", "scene.toml", "--progress", "off", "--out", "out").splitlines()]
    run = asperity.load("out")
    assert write_page(run.directory, kinds=())
    page = (run.directory / "report.html").read_text().replace("\u2060", "").replace("\u00a0", " ").replace("\u2011", "-")
    cells = {row[0]: row[1:] for row in ([html.unescape(re.sub("<.*?>", "", cell)) for cell in re.findall(r"<td.*?>(.*?)</td>", line, re.S)]
                                         for line in re.findall(r"<tr>(.*?)</tr>", page, re.S)) if row}
    numbers = {n.name: n for n in sentences.key_numbers(run)}
    first = next(iter(numbers.values()))
    notebook = html.unescape(run._repr_html_())
    assert run.rows and first.value in page
    seen = 0
    for row in run.rows:
        values = [sentences.minus_signs(text) for text in row["texts"]]
        if row["table"]:  # the terminal: the same line
            line = [f"{row['name']}, {row['unit']}".removesuffix(", "), *row["texts"]]
            assert line in said or row["table"] == sentences.SEGMENTS and all(
                any(one[0] == line[0] and text in one for one in said) for text in row["texts"]), line
        for column, value in zip(row["columns"], values):
            if value == "-":
                continue
            if row["table"] == sentences.SEGMENTS:
                assert value in cells[column], (row, cells[column])
            elif row["detail"]:
                assert f"{row['name']}: {value} {row['unit']}".rstrip() in notebook, row
            else:
                number = numbers[", ".join(filter(None, [row["name"], column or row["table"]]))]
                assert (number.value, number.unit) == (value, row["unit"]) and f"{value} {row['unit']}".strip() in notebook
                assert number is first or cells[number.name][:2] == [value, row["unit"]], row
        for path, text in zip(NUMBERS.get(row["name"], ()), row["texts"]):  # the result: the same number
            if row["table"] != sentences.SEGMENTS and text != "-":
                assert float(text.split()[0]) == pytest.approx(unit_of(run, path, row["unit"].split()[0] if row["unit"] else ""), rel=6e-3,
                                                               abs=6e-5), row
                seen += 1
    assert seen >= 3
    told = " ".join(" ".join(one) for one in said)
    for sentence in run.sentences:
        assert " ".join(sentence.split()) in " ".join(told.split()), sentence
        assert html.escape(sentences.minus_signs(sentence), quote=True).replace("&#x27;", "&#39;").replace("&quot;", "&#34;")[:60].split("_")[0] \
            in page, sentence
