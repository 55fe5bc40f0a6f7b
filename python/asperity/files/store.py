# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Files that matter: written whole or not at all, never in place of a file that Asperity did not write, and checked by
the digests that they hold.

A digest is the CRC-32 of all bytes before it: the last member of a JSON object (`digest`), the last 32 bytes
of an HDF5 file of the program (io/files.cpp).

Every file of a command is written through `outputs()`, which keeps the record .asperity-files.json of the directory
(io/file_record.hpp): the names of the files that commands wrote there, each with its digest, or "unfinished" while
the command has not come to its end. A file that is there is replaced only if the record names it and it has not been
changed; a file that is a result or an input of the command is not replaced at all.
"""

from __future__ import annotations

import contextlib
import csv
import errno
import fcntl
import io
import itertools
import json
import math
import os
import re
import stat
import zlib
from collections.abc import Callable, Iterable, Iterator, Mapping
from pathlib import Path
from typing import IO, Any

from ..errors import InputOutputError, SceneError


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


LONGEST = 1 << 28
"""Bytes of a file that is read as a whole."""
DEEPEST_JSON = 64
"""Levels of a file; its reader, and whatever walks through it, is recursive."""


def opened(path: str | os.PathLike) -> IO[bytes]:
    """Opens a regular file to read it. Raises OSError, also for a folder, a pipe, a socket or a device, for which it does not wait."""
    file = os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_NOCTTY | os.O_CLOEXEC)
    if not stat.S_ISREG(os.fstat(file).st_mode):
        os.close(file)
        raise OSError(errno.EINVAL, "it is no regular file", str(path))
    return os.fdopen(file, "rb")


def contents(path: str | os.PathLike) -> bytes:
    """Returns the bytes of a regular file. Raises OSError, also for a file of more than LONGEST bytes."""
    with opened(path) as file:
        found = file.read(LONGEST + 1)
    if len(found) > LONGEST:
        raise OSError(errno.EFBIG, f"it has more than {LONGEST} bytes", str(path))
    return found


def json_of(content: bytes, kind: Callable[[dict[str, Any]], Any] | None = None) -> Any:
    """Returns the value of a JSON text. Raises ValueError."""
    try:
        value = json.loads(content, object_hook=kind)
    except RecursionError:
        raise ValueError("it is nested too deeply") from None
    level = [value]
    for _ in range(DEEPEST_JSON + 1):
        level = [member for one in level for member in (one.values() if isinstance(one, dict) else one)
                 if isinstance(member, (dict, list))] if isinstance(level[0], (dict, list)) else []
        if not level:
            break
    else:
        raise ValueError("it is nested too deeply")
    if b"\\ud" in content.lower():
        json.dumps(value, ensure_ascii=False).encode()  # halves of pairs are no text: UnicodeEncodeError
    return value


def _made_beside(path: Path, name: str = "") -> Path:
    """Makes an empty file beside `path`, of a new name: what has that name already is somebody else's. Raises OSError."""
    name = name or f"{path.name}.{os.getpid()}.tmp"
    for number in itertools.count(1):
        beside = path.with_name(name + f"-{number}" * (number > 1))
        try:
            os.close(os.open(beside, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW | os.O_CLOEXEC, 0o666))
        except FileExistsError:
            continue
        return beside
    raise AssertionError


@contextlib.contextmanager
def _replacing(path: Path, name: str = "") -> Iterator[Path]:
    """Yields a path beside `path` to write to; the file replaces `path` when all went well and it is on the disk. name: of the file
    beside; "": any."""
    try:
        beside = _made_beside(path, name)
    except OSError as error:
        raise _refuse(path, error) from None
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


def require_new(path: Path) -> None:
    """Checks that there is no file of this name and no link, wherever it leads. Raises SceneError."""
    if os.path.lexists(path):
        raise SceneError(str(path), "is there already and is not replaced", "it is a symbolic link" * path.is_symlink(),
                         "name another file, or move it away")


@contextlib.contextmanager
def new(path: Path) -> Iterator[Path]:
    """Yields a path beside `path` to write to, for a file that must not be there yet."""
    require_new(path)
    with _replacing(path) as beside:
        yield beside


RECORD = ".asperity-files.json"
UNFINISHED = "unfinished"
Inputs = Iterable["str | os.PathLike"]


# The digest of the program (io/files.hpp), which files of the program and of Python end in: zlib's CRC-32. It is computed here
# too, because files are read without the compiled module.


def _crc(file: IO[bytes], length: int | None = None) -> int:
    """Computes the CRC-32 of the first `length` bytes of an open file; None: of all."""
    file.seek(0)
    value, left = 0, length
    while part := file.read(1 << 20 if left is None else min(left, 1 << 20)):
        value = zlib.crc32(part, value)
        left = None if left is None else left - len(part)
    return value


def digest_text(value: int) -> str:
    """Returns a digest as texts of JSON have it: "crc32:" and eight hexadecimal digits."""
    return f"crc32:{value:08x}"


def _digest_of(path: Path) -> str:
    with opened(path) as file:
        return digest_text(_crc(file))


def _record(place: Path) -> dict[str, str] | None:
    """Reads the record of a directory: digests by name, or None if there is none. Raises SceneError for a file of its
    name that is no record."""
    path = place / RECORD
    try:
        content = contents(path)
    except (FileNotFoundError, NotADirectoryError):
        return None
    except OSError as error:
        raise _refuse(path, error, "cannot be read") from None
    found = {}
    with contextlib.suppress(ValueError):
        found = json_of(content) if json_is_whole(content) and not path.is_symlink() else {}
    files = found.get("files") if isinstance(found, dict) else None
    if not isinstance(files, dict) or not all(isinstance(digest, str) for digest in files.values()):
        raise SceneError(str(path), "is no record of the files that Asperity wrote", "it does not end in its digest: it was "
                         "changed or damaged", "move it away; the files that it named are not replaced then")
    return files


def is_named(place: Path, name: str) -> bool:
    """Returns True if the record of a directory names a file. Raises SceneError."""
    return name in (_record(place) or {})


def _write_record(place: Path, opened_place: int, content: bytes, replace: bool) -> None:
    """Writes the record as io/file_record.cpp does: a new one appears whole, and .asperity-files.json.part belongs to an earlier one."""
    if not replace:
        with contextlib.suppress(OSError):  # a file system without files that have no name
            with os.fdopen(os.open(place, os.O_TMPFILE | os.O_WRONLY | os.O_CLOEXEC, 0o666), "wb") as file:
                file.write(content)
                file.flush()
                os.fsync(file.fileno())
                os.link(f"/proc/self/fd/{file.fileno()}", RECORD, dst_dir_fd=opened_place, follow_symlinks=True)
                return
    beside = RECORD + ".part"
    if replace:
        (place / beside).unlink(missing_ok=True)
    with _replacing(place / RECORD, beside) as written:
        written.write_bytes(content)


def _update(place: Path, change: Callable[[dict[str, str]], dict[str, str]]) -> None:
    """Writes the record that change(record) returns; a record that names nothing is removed."""
    try:
        lock = os.open(place, os.O_RDONLY | os.O_DIRECTORY)
    except OSError as error:
        raise _refuse(place, error, "cannot be opened") from None
    try:
        with contextlib.suppress(OSError):  # a file system without such locks
            fcntl.flock(lock, fcntl.LOCK_EX)
        there = _record(place)
        before = there or {}
        after = change(dict(before))
        if not after:
            (place / RECORD).unlink(missing_ok=True)
        elif after != before:
            _write_record(place, lock, sealed_json({"files": dict(sorted(after.items()))}).encode(), there is not None)
    finally:
        os.close(lock)


def _reason_to_keep(place: Path, name: str, record: dict[str, str] | None, renew: bool, inputs: Inputs) -> str:
    """Explains, for an error message, why a file must not be replaced; "" if it may be."""
    path = place / name
    try:
        there = path.lstat()
    except (FileNotFoundError, NotADirectoryError):
        return ""
    for file in inputs:
        with contextlib.suppress(OSError, ValueError):
            if os.path.samefile(str(file).partition(":/")[0], path):
                return f"it is {file}, which the command reads"
    if stat.S_ISLNK(there.st_mode):
        return "it is a symbolic link"
    if not stat.S_ISREG(there.st_mode):
        return "it is no regular file"
    if name == LOCK and _is_lock(contents(path)):
        return ""
    if record is None:
        return (f"the directory has no record ({RECORD}) of the files that Asperity wrote: the file is another program's, "
                "or of a version without records")
    if name not in record:
        return f"it is not one of the files that Asperity wrote here ({RECORD} lists them)"
    if record[name] == UNFINISHED:
        return "it is a hard link: the same file has another name" * (there.st_nlink > 1)
    if record[name] != _digest_of(path):
        return "it was changed after Asperity wrote it"
    return "" if renew else "it belongs to an earlier result, and results are not written over"


def in_the_way(place: Path, names: Iterable[str], renew: bool = True, inputs: Inputs = ()) -> list[dict[str, str]]:
    """Returns the files that must not be replaced. Raises InputOutputError."""
    names, inputs, record = list(names), list(inputs), _record(place)
    problems = []
    for folder in dict.fromkeys(str(Path(name).parent) for name in names):
        if os.path.lexists(place / folder) and not (place / folder).is_dir():
            problems.append({"where": str(place / folder), "what": "is there already and is not replaced",
                             "why": "it is no directory, and files are to be written into one of its name"})
    try:
        problems += [{"where": str(place / name), "what": "is there already and is not replaced", "why": why}
                     for name in names if (why := _reason_to_keep(place, name, record, renew, inputs))]
    except OSError as error:
        raise _refuse(Path(error.filename or place), error, "cannot be read") from None
    return [{**problem, "fix": "move it away, or name another directory (--out)"} for problem in problems]


def require_free(places: Mapping[Path, Iterable[str]], renew: bool = True, inputs: Inputs = ()) -> None:
    """Checks that a command would replace no file. Raises SceneError."""
    problems = [one for place, names in places.items() for one in in_the_way(place, names, renew, inputs)]
    if problems:
        raise SceneError.of(problems)


class Outputs:
    """The files that a command writes in a directory, by the names that it claimed (`outputs()`)."""

    def __init__(self, place: Path, names: Iterable[str]):
        self.place, self.names = place, frozenset(names)
        self.digests: dict[str, str] = {}
        """of the files that were written"""

    def _path(self, name: str) -> Path:
        if name not in self.names:
            raise KeyError(f"{name} was not claimed in {self.place}")
        directory((self.place / name).parent)
        return self.place / name

    @contextlib.contextmanager
    def replacing(self, name: str) -> Iterator[Path]:
        """Yields a path to write to; the file takes this name when all went well and it is on the disk."""
        self.digests.setdefault(name, UNFINISHED)
        with _replacing(self._path(name)) as beside:
            yield beside
            self.digests[name] = _digest_of(beside)

    def write(self, name: str, content: str | bytes) -> None:
        """Writes a file whole, or leaves the old one. Raises InputOutputError."""
        with self.replacing(name) as beside:
            beside.write_bytes(content.encode() if isinstance(content, str) else content)

    def append(self, name: str) -> IO[bytes]:
        """Opens a file to append to it."""
        self.digests[name] = UNFINISHED
        flags = os.O_WRONLY | os.O_APPEND | os.O_CREAT | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC
        return os.fdopen(os.open(self._path(name), flags, 0o666), "ab")


@contextlib.contextmanager
def outputs(place: Path, names: Iterable[str], renew: bool = True, inputs: Inputs = ()) -> Iterator[Outputs]:
    """Opens a directory, made if it is missing, for the files that a command is about to write. Their names are claimed in the record before, and
    their digests noted there after the work; of work that ends in an exception they stay unfinished. Raises SceneError."""
    written, before = Outputs(place, names), {}
    require_free({place: written.names}, renew, inputs)
    made = [path for path in (place, *place.parents) if not path.exists()]
    directory(place)

    def claim(record: dict[str, str]) -> dict[str, str]:
        before.update(record)
        return record | dict.fromkeys(written.names, UNFINISHED)

    def note(record: dict[str, str]) -> dict[str, str]:
        for name in written.names:
            digest, there = written.digests.get(name), (place / name).exists()
            if digest is None and record.get(name) != UNFINISHED:
                continue  # noted by somebody else meanwhile
            if digest is None:
                digest = before.get(name)
            elif failed:
                digest = UNFINISHED
            elif digest == UNFINISHED and there:
                digest = _digest_of(place / name)
            record.pop(name, None)
            if digest is not None and there:
                record[name] = digest
        return record

    _update(place, claim)
    failed = True
    try:
        yield written
        failed = False
    finally:
        with contextlib.suppress(OSError):  # the directory was removed
            _update(place, note)
        with contextlib.suppress(OSError):  # something is in it
            for path in made:
                path.rmdir()


def set_aside(place: Path, names: Iterable[str]) -> None:
    """Renames damaged files: "result.json" becomes "result-damaged.json", or the next name that is free. Raises InputOutputError."""
    for path in (place / name for name in names if os.path.lexists(place / name)):
        first = path.with_name(f"{path.stem}-damaged{path.suffix}")
        try:
            path.rename(numbered(first, os.path.lexists))
        except OSError as error:
            raise _refuse(path, error, "cannot be set aside") from None


def csv_text(rows: Iterable[Iterable[str | float]], digits: int = 10) -> str:
    """Returns lines of comma-separated values."""
    stream = io.StringIO()
    csv.writer(stream, lineterminator="\n").writerows(
        [v if isinstance(v, str) else f"{v:.{digits}g}" if math.isfinite(v) else "" for v in row] for row in rows)
    return stream.getvalue()


def rows_of(columns: Mapping[str, Iterable[Any]], units: Mapping[str, str]) -> list[list[str | float]]:
    """Returns columns as the lines of csv_text(), below their names and units: "work, mJ/m²"; of "work.error" "work, mJ/m²: error"."""
    heads: list[str | float] = []
    for name in columns:
        path, dot, _ = name.partition(".error")
        heads.append(", ".join(filter(None, (path, units[name]))) + ": error" * bool(dot))
    return [heads, *([one if isinstance(one, str) else float(one) for one in row] for row in zip(*columns.values()))]


def chosen(out: str | None, otherwise: str) -> Path:
    """Returns the directory of a command. Raises SceneError."""
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


def named(out: str | os.PathLike | None) -> Path | None:
    """Returns the directory that a user names; None if none is named. Raises SceneError if it can be none."""
    return None if out is None else chosen(os.fspath(out), "")


def numbered(first: Path, taken: Callable[[Path], bool]) -> Path:
    """Returns the first path that is not taken of first, first-2, first-3, ..."""
    others = (first.with_name(f"{first.stem}-{number}{first.suffix}") for number in itertools.count(2))
    return next(place for place in itertools.chain([first], others) if not taken(place))


LOCK = "run.lock"
"""Lock of a directory of results, which the program takes (running/lock.py)."""
_LOCK_END = re.compile(rb"digest crc32:([0-9a-f]{8})\n\Z")


def _is_lock(content: bytes) -> bool:
    """Returns True if the text of a lock is as its digest says."""
    found = _LOCK_END.search(content)
    return content.startswith(b"host ") and bool(found) and int(found[1], 16) == zlib.crc32(content[:found.start()])


RUN_FILES = ("run.journal", "checkpoint.h5", "checkpoint-before.h5", "checkpoint-damaged.h5", "checkpoint-next.part",
             "run.h5", "result.json", "last-good.h5")
"""What a run may write into its directory (io/result_directory.hpp)."""


_JSON_END = re.compile(rb',\n  "digest": "crc32:([0-9a-f]{8})"\n}\n\Z')
_HDF5_END = b"asperity digest\n"


def sealed_json(members: dict[str, Any]) -> str:
    """Returns an object as text, with its digest."""
    text = json.dumps(members, indent=2, ensure_ascii=False).removesuffix("\n}")
    return f'{text},\n  "digest": "{digest_text(zlib.crc32(text.encode()))}"\n}}\n'


def json_is_whole(content: bytes) -> bool | None:
    """Returns True if a JSON file is as its digest says; None if it does not end in a digest."""
    found = _JSON_END.search(content)
    return int(found[1], 16) == zlib.crc32(content[:found.start()]) if found else None


def hdf5_digest(path: Path) -> int | None:
    """Returns the digest stated at the end of an HDF5 file; None if it does not end in a digest. Raises OSError."""
    with opened(path) as file:
        file.seek(max(0, file.seek(0, os.SEEK_END) - 32))
        end = file.read(32)
        return int.from_bytes(end[24:], "little") if end.startswith(_HDF5_END) else None


def _digest(file: IO[bytes], length: int) -> bytes:
    """Computes the digest of the first bytes of a file: their number and their CRC-32."""
    return length.to_bytes(8, "little") + _crc(file, length).to_bytes(8, "little")


def seal_hdf5(path: Path) -> None:
    """Appends the digest, which HDF5 ignores."""
    with open(path, "r+b") as file:
        end = _HDF5_END + _digest(file, file.seek(0, os.SEEK_END))
        file.seek(0, os.SEEK_END)
        file.write(end)


def hdf5_is_whole(path: Path) -> bool | None:
    """Returns True if an HDF5 file is as its digest says; None if it does not end in a digest. Raises OSError."""
    with opened(path) as file:
        length = max(0, file.seek(0, os.SEEK_END) - 32)
        file.seek(length)
        end = file.read(32)
        return end[16:] == _digest(file, length) if end.startswith(_HDF5_END) else None
