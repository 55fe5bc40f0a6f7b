# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Files that matter: written whole or not at all, and checked by the digests that they hold.

A digest is the CRC-32 of all bytes before it: the last member of a JSON object (`digest`), the last 32 bytes
of an HDF5 file of the program (io/output_file.cpp).
"""

from __future__ import annotations

import contextlib
import json
import os
import re
import zlib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from .errors import InputOutputError


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
        beside.unlink(missing_ok=True)


def write(path: Path, content: str | bytes) -> None:
    """Writes a file whole, or leaves the old one."""
    with replacing(path) as beside:
        beside.write_bytes(content.encode() if isinstance(content, str) else content)


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


def hdf5_is_whole(path: Path) -> bool | None:
    """Whether an HDF5 file is as its digest says; None: it does not end in one. Raises OSError."""
    with open(path, "rb") as file:
        length = max(0, file.seek(0, os.SEEK_END) - 32)
        file.seek(length)
        end = file.read(32)
        if not end.startswith(_HDF5_END):
            return None
        file.seek(0)
        value, left = 0, length
        while left and (part := file.read(min(left, 1 << 20))):
            value = zlib.crc32(part, value)
            left -= len(part)
    return end[16:] == length.to_bytes(8, "little") + value.to_bytes(8, "little")
