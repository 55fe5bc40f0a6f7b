# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""What lies under the name of a file of a result may be anything: a pipe, a device, a text of another program, a record that
somebody has made with the right digest. Every command that meets one ends with an error or does without it, at once, and leaves it."""

import itertools
import os
import shutil
import signal
import subprocess
from pathlib import Path

import pytest

from asperity.errors import Error
from asperity.files import store
from asperity.plots import style
from asperity.running import lock
from conftest import OF_PYTHON, command, in_this_process, without_pictures
from test_files import SCENE, inputs as inputs  # the fixture

DEEP = 100_000
MANY = 50_000


def sealed(text):
    """Returns the text of an object with the digest of a file of the program. text: without the closing brace."""
    return f'{text},\n  "digest": "{store.digest_text(store.zlib.crc32(text.encode("utf-8", "surrogateescape")))}"\n}}\n'


def write(text):
    return lambda path: path.write_bytes(text.encode("utf-8", "surrogateescape"))


OBJECTS = {
    "pipe": os.mkfifo,
    "folder": lambda path: path.mkdir(),
    "device": lambda path: path.symlink_to("/dev/zero"),
    "other text": write("host foo\n  HostName bar\n"),
}
RECORDS = {
    "text of no UTF-8": write(sealed('{\n  "files": {"\udcff": "unfinished"}')),
    "text with half a pair": write(sealed('{\n  "files": {"\\ud800": "unfinished"}, "name": "\\ud800"')),
    "list of lists of lists": write(sealed('{\n  "files": ' + "[" * DEEP + "]" * DEEP)),
    "list of many names": write(sealed('{\n  "files": {' + ",".join(f'"{k}": "unfinished"' for k in range(MANY)) + "}")),
    "text of other types": write(sealed('{\n  "files": {"run.h5": 3, "result.json": null}, "run": [], "scene": 7, "points": {}, "units": []')),
}
"""Texts of JSON, whose digests are right."""
BAD = OBJECTS | RECORDS


@pytest.fixture(scope="module")
def made(inputs, tmp_path_factory):
    """Directories of results: of a run that was stopped, of one that has ended, of a sweep and of a search for states."""
    place = tmp_path_factory.mktemp("made")
    shutil.copytree(inputs, place, dirs_exist_ok=True)
    command("run", "q.toml", "--out", "stopped", "--set", "drive.path=approach", "--wall-limit", "0.001s", cwd=place, expect=75)
    command("run", "q.toml", "--out", "ended", cwd=place)
    with without_pictures():
        command("sweep", "q.toml", "--set", "surface.rms=0.5,0.6", "--out", "sweep", cwd=place)
    command("states", "q.toml", "--starts", "1", "--out", "states", cwd=place)
    (place / "again.toml").write_text(SCENE.replace('"relax"', '"approach"'))
    return place


READERS = {
    "stopped": [["run", "again.toml", "--out", "stopped", "--resume", "auto"], ["run", "again.toml", "--out", "stopped", "--restart"],
                ["hold", "stopped"]],
    "ended": [["run", "q.toml", "--out", "ended"], ["report", "ended"], ["export", "ended", "--to", "xyz"]],
    "sweep": [["report", "sweep"]],
    "states": [["states", "q.toml", "--starts", "1", "--out", "states"]],
}
"""Commands that read the files of a directory."""


def late(*_):
    raise AssertionError("the command waits")


def called(words):
    """Carries out a command. Returns its exit code and what it says; in half a minute, and by an error of its own if it fails."""
    before = signal.signal(signal.SIGALRM, late)
    signal.alarm(30)
    try:
        if words[0] == "hold":
            try:
                with lock.in_use(Path(words[1])):
                    return 0, ""
            except Error as error:
                return error.code, str(error)
        if words[0] in OF_PYTHON:
            code, *streams = in_this_process(words)
            return code, "".join(streams)
        done = subprocess.run([os.environ["ASPERITY_PROGRAM"], *words], capture_output=True, text=True, timeout=30)
        return done.returncode, done.stdout + done.stderr
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGALRM, before)


@pytest.fixture()
def without_figures(light, monkeypatch):
    """Leaves the figures out of pages: a page is made of every bad object."""
    monkeypatch.setattr(style, "make", lambda draw: None)


@pytest.fixture()
def copy(made, tmp_path, monkeypatch):
    """Returns what makes a fresh copy of the directories the current one."""
    def of(kind, folder, name):
        place = tmp_path / "copy"
        shutil.rmtree(place, ignore_errors=True)
        place.mkdir()
        monkeypatch.chdir(place)
        shutil.copytree(made / folder, folder)
        for scene in made.glob("*.toml"):
            shutil.copy(scene, place)
        path = Path(folder) / name
        if kind:
            path.unlink(missing_ok=True)
            BAD[kind](path)
        return path

    return of


@pytest.fixture(scope="module")
def read(made):
    """Returns the names of a directory that a command reads: those under which a pipe makes a difference."""
    found = {}

    def of(copy, folder, words):
        if (key := (folder, *words)) not in found:
            there = {path.name for path in (made / folder).iterdir() if path.is_file()}
            names = sorted({*there, store.RECORD, store.LOCK, *(store.RUN_FILES if folder in ("stopped", "ended") else ())})
            copy("", folder, "")
            as_it_is = called(words)[0]
            found[key] = []
            for name in names:
                copy("pipe", folder, name)
                if called(words)[0] != as_it_is:
                    found[key].append(name)
        return found[key]

    return of


@pytest.mark.parametrize("words", [words for of in READERS.values() for words in of], ids=" ".join)
def test_a_bad_object_ends_no_command_badly(words, read, copy, without_figures):
    folder = next(folder for folder, of in READERS.items() if words in of)
    names = read(copy, folder, words)
    assert names
    for name, kind in itertools.product(names, BAD):
        if kind in RECORDS and not name.endswith(".json"):
            continue
        path = copy(kind, folder, name)
        ours = kind == "list of many names" if name == store.RECORD else store.is_named(Path(folder), name)  # a record that is whole is replaced
        was = os.lstat(path)
        code, said = called(words)
        assert code in (0, 2, 4) and "Traceback" not in said and "internal error" not in said, f"{name} is a {kind}: {code}\n{said}"
        there = os.path.lexists(path) and os.lstat(path).st_ino == was.st_ino
        assert there or ours, f"{name}, a {kind}, was taken away:\n{said}"
