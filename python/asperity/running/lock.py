# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The lock of a directory of results, so that runs, sweeps and other commands keep each other out.

The program takes the lock (`asperity hold`, io/directory_lock.hpp) and sends the open file. The flock belongs to that file:
this process has the lock until it closes the file or ends.
"""

from __future__ import annotations

import contextlib
import os
import socket
from collections.abc import Iterator
from pathlib import Path

from ..errors import InputOutputError
from ..files import store
from . import program


def _taken(place: Path) -> int:
    """Returns the open file of the lock."""
    ours, theirs = socket.socketpair(socket.AF_UNIX)
    with ours, theirs:
        program.call(["hold", str(place)], given=theirs)
        handle = socket.recv_fds(ours, 1, 1)[1][0]
        os.set_inheritable(handle, False)  # or a process that this one starts would keep the lock
        return handle


@contextlib.contextmanager
def in_use(place: Path) -> Iterator[None]:
    """Makes a directory, and keeps other commands out of it; the directory is removed again if nothing was written into it. Raises InputOutputError,
    SceneError."""
    made = [path for path in (place, *place.parents) if not path.exists()]
    store.directory(place)
    handle = _taken(place)
    try:
        yield
    finally:
        with contextlib.suppress(OSError):  # the directory was removed, or is another one now
            if os.path.samestat(os.fstat(handle), os.lstat(place / store.LOCK)):
                os.unlink(place / store.LOCK)
        os.close(handle)
        with contextlib.suppress(OSError):  # something is in it
            for path in made:
                path.rmdir()


def is_used(place: Path) -> bool:
    """Returns True if another process has the directory in use."""
    if not (place / store.LOCK).exists():
        return False
    try:
        with in_use(place):
            return False
    except InputOutputError:
        return True
