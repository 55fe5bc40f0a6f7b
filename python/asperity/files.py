# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Files that matter: written whole or not at all, and checked by the digests that they hold.

A digest is the CRC-32 of all bytes before it: the last member of a JSON object (`digest`), the last 32 bytes
of an HDF5 file of the program (io/files.cpp).
"""

from __future__ import annotations

import contextlib
import csv
import fcntl
import io
import itertools
import json
import math
import os
import re
import socket
import time
import zlib
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import Any

from .errors import InputOutputError, SceneError


def _refuse(path: Path, error: OSError, what: str = "cannot be written") -> InputOutputError:
    return InputOutputError(str(path), what, error.strerror or str(error),
                            "check its permissions and the space on its disk")


def directory(path: Path) -> Path:
    """Makes it and its parents."""
    try:
        path.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise _refuse(path, error, "cannot be made") from None
    return path


@contextlib.contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """A path beside `path` to write to; it takes the place of `path` when all went well and it is on the disk."""
    beside = path.with_name(f"{path.name}.{os.getpid()}.tmp")
    try:
        yield beside
        with open(beside, "rb") as written:
            os.fsync(written.fileno())
        os.replace(beside, path)
        entry = os.open(path.parent, os.O_RDONLY | os.O_DIRECTORY)
        try:
            with contextlib.suppress(OSError):  # not every file system brings a directory to the disk
                os.fsync(entry)
        finally:
            os.close(entry)
    except OSError as error:
        raise _refuse(path, error) from None
    finally:
        with contextlib.suppress(OSError):  # no such place, or not a directory
            beside.unlink(missing_ok=True)


def write(path: Path, content: str | bytes) -> None:
    """Writes a file whole, or leaves the old one."""
    with replacing(path) as beside:
        beside.write_bytes(content.encode() if isinstance(content, str) else content)


def set_aside(path: Path) -> None:
    """Of a damaged file: "result.json" becomes "result-damaged.json"."""
    try:
        path.replace(path.with_name(f"{path.stem}-damaged{path.suffix}"))
    except OSError as error:
        raise _refuse(path, error, "cannot be set aside") from None


def csv_text(rows: Iterable[Iterable[str | float]], digits: int = 10) -> str:
    """Lines of comma-separated values: numbers with so many digits, those that are not finite as nothing."""
    stream = io.StringIO()
    csv.writer(stream, lineterminator="\n").writerows(
        [v if isinstance(v, str) else f"{v:.{digits}g}" if math.isfinite(v) else "" for v in row] for row in rows)
    return stream.getvalue()


def chosen(out: str | None, otherwise: str) -> Path:
    """The directory that --out names, or else the default one. Raises SceneError for what can be none."""
    place = Path(otherwise if out is None else out)
    if out == "":
        raise SceneError("--out", "is empty", "it names the directory of the results", f"leave it out for {otherwise}")
    if place.exists() and not place.is_dir():
        raise SceneError(f"--out {place}", "is not a directory", "a file of that name is there",
                         "name another directory")
    if place.resolve() == Path("/"):
        raise SceneError(f"--out {place}", "is the root of all directories", "results have a directory of their own",
                         "name another directory")
    return place


def numbered(first: Path, taken: Callable[[Path], bool]) -> Path:
    """This one, or else the first of first-2, first-3, ... that is not taken."""
    others = (first.with_name(f"{first.name}-{number}") for number in itertools.count(2))
    return next(place for place in itertools.chain([first], others) if not taken(place))


LOCK = "run.lock"
"""The same file, content and rules as of the directory of a run (io/result_directory.hpp), so that runs and sweeps
keep each other out as well."""


def _in_place(handle: int, path: Path) -> bool:
    with contextlib.suppress(FileNotFoundError):
        return os.path.samestat(os.fstat(handle), os.lstat(path))
    return False


def _take(place: Path) -> int:
    """Opens the lock of a directory and keeps it; raises InputOutputError where another process has it."""
    path, host = place / LOCK, socket.gethostname()
    while True:
        made = True
        try:
            handle = os.open(path, os.O_RDWR | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW, 0o666)
        except FileExistsError:
            made = False
            try:
                handle = os.open(path, os.O_RDWR | os.O_NOFOLLOW)
            except FileNotFoundError:  # given back just now
                continue
        kept = by_other = False
        try:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
            kept = True
        except BlockingIOError:
            by_other = True
        except OSError:  # a file system without such locks: whoever makes the file has it
            pass
        if not kept or _in_place(handle, path):
            break
        os.close(handle)  # given back just now
    lines = os.read(handle, 4096).decode("utf-8", "replace").splitlines()
    holder = {key: value for key, _, value in (line.partition(" ") for line in lines)}
    if "since" not in holder:
        holder = {}
    here = holder.get("host") == host
    if by_other if made else not kept or (holder and not here):
        os.close(handle)
        raise InputOutputError(
            str(place), "is in use by another process",
            f"process {holder['process']} on host {holder['host']} has had it since {holder['since']} ({path})"
            if {"process", "host"} <= set(holder) else f"{path} does not say by whom",
            "wait for its end, stop it, or name another directory: --out" if by_other and here else
            f"wait for its end, or name another directory (--out); where it is certain that no such process lives, "
            f"remove {path}")
    os.ftruncate(handle, 0)
    since = time.strftime("%Y-%m-%d %H:%M:%S")
    os.pwrite(handle, f"host {host}\nprocess {os.getpid()}\nsince {since}\n".encode(), 0)
    return handle


@contextlib.contextmanager
def in_use(place: Path) -> Iterator[None]:
    """Makes a directory, and keeps other sweeps and runs out of it; it goes again if nothing was written into it."""
    made = [path for path in (place, *place.parents) if not path.exists()]
    directory(place)
    try:
        handle = _take(place)
    except OSError as error:
        raise _refuse(place / LOCK, error) from None
    try:
        yield
    finally:
        with contextlib.suppress(OSError):
            if _in_place(handle, place / LOCK):
                os.unlink(place / LOCK)
        os.close(handle)
        with contextlib.suppress(OSError):  # something is in it
            for path in made:
                path.rmdir()


def kept(place: Path) -> bool:
    """Whether another process has the directory in use."""
    if not (place / LOCK).exists():
        return False
    try:
        with in_use(place):
            return False
    except InputOutputError:
        return True


_JSON_END = re.compile(rb',\n  "digest": "crc32:([0-9a-f]{8})"\n}\n\Z')
_HDF5_END = b"asperity digest\n"


def sealed_json(members: dict[str, Any]) -> str:
    """An object as text, with its digest."""
    text = json.dumps(members, indent=2, ensure_ascii=False).removesuffix("\n}")
    return f'{text},\n  "digest": "crc32:{zlib.crc32(text.encode()):08x}"\n}}\n'


def json_is_whole(content: bytes) -> bool | None:
    """Whether a JSON file is as its digest says; None: it does not end in one."""
    found = _JSON_END.search(content)
    return int(found[1], 16) == zlib.crc32(content[:found.start()]) if found else None


def hdf5_digest(path: Path) -> int | None:
    """The digest at the end of an HDF5 file, as it is stated there; None: it does not end in one. Raises OSError."""
    with open(path, "rb") as file:
        file.seek(max(0, file.seek(0, os.SEEK_END) - 32))
        end = file.read(32)
        return int.from_bytes(end[24:], "little") if end.startswith(_HDF5_END) else None


def _digest(file, length: int) -> bytes:
    """Of its first bytes: how many they are, and their CRC-32."""
    file.seek(0)
    value, left = 0, length
    while left and (part := file.read(min(left, 1 << 20))):
        value = zlib.crc32(part, value)
        left -= len(part)
    return length.to_bytes(8, "little") + value.to_bytes(8, "little")


def seal_hdf5(path: Path) -> None:
    """Appends the digest, which HDF5 ignores."""
    with open(path, "r+b") as file:
        end = _HDF5_END + _digest(file, file.seek(0, os.SEEK_END))
        file.seek(0, os.SEEK_END)
        file.write(end)


def hdf5_is_whole(path: Path) -> bool | None:
    """Whether an HDF5 file is as its digest says; None: it does not end in one. Raises OSError."""
    with open(path, "rb") as file:
        length = max(0, file.seek(0, os.SEEK_END) - 32)
        file.seek(length)
        end = file.read(32)
        return end[16:] == _digest(file, length) if end.startswith(_HDF5_END) else None
