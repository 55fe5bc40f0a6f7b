# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Names of arguments: the words of a scene's keys, on the command line and in Python, with shorter ones as aliases.

    young = chosen("young", 'young="100 GPa"', young=young, E=E)      # an argument of a function
    command.add_argument(*options("young"), required=True)            # an option: --young, --E
"""

from __future__ import annotations

from typing import Any

from .errors import SceneError

ALIASES = {"young": ("E",), "poisson": ("nu",), "adhesion": ("work", "w"), "size": ("file_size",), "unit": ("file_unit",)}
"""Other names of an argument. Each argument has the last word of a key of the scene, as itself or as an alias."""


def options(name: str) -> list[str]:
    """Returns the options of an argument: "--young", "--E"."""
    return ["--" + word.replace("_", "-") for word in (name, *ALIASES.get(name, ()))]


def chosen(name: str, example: str = "", **given: Any) -> Any:
    """Returns the value of an argument that has several names.

    Parameters
    ----------
    name : str
        Name of the argument.
    example : str
        Argument as it could be written, for the message; "": it can be left out.
    **given : Any
        Value by each name; None: not given.

    Returns
    -------
    Any
        The value; None if it is not given.

    Raises
    ------
    SceneError
        Two of the names are given, or none of an argument that is needed.
    """
    there = {word: value for word, value in given.items() if value is not None}
    if len(there) > 1:
        raise SceneError(" and ".join(there), "are names of one argument", f"its name is {name}", f"give {name} alone")
    if not there and example:
        raise SceneError(name, "is not given", "the function needs it" + f" (also named {', '.join(ALIASES.get(name, ()))})" * (name in ALIASES),
                         f"for example {example}")
    return next(iter(there.values()), None)
