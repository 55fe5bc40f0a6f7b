# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Objects of JSON whose members are attributes, with what is asked of them by path."""

from __future__ import annotations

import contextlib
import json
import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, cast, overload

from ..errors import UnknownName
from ..terminal import html_table


@overload
def finite(value: Any, otherwise: float) -> float: ...
@overload
def finite(value: Any, otherwise: None = None) -> float | None: ...
def finite(value: Any, otherwise: float | None = None) -> float | None:
    """Returns a value of a JSON file if it is a finite number."""
    with contextlib.suppress(OverflowError):
        if isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value):
            return float(value)
    return otherwise


class Attributes:
    """Mapping whose members are attributes too."""

    _called = "the result"

    if not TYPE_CHECKING:  # type checkers know the names (names.pyi)
        def __getattr__(self, key: str) -> Any:
            if key.startswith("_"):
                raise AttributeError(key)
            try:
                return self[key]
            except KeyError:
                raise UnknownName.among(self._called, key, self) from None

    def __missing__(self, key: str) -> Any:
        raise UnknownName.among(self._called, key, cast(Mapping[str, Any], self))

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *cast(Mapping[str, Any], self)]


class Values(Attributes, dict):
    """A JSON object: v.theory.persson.gamma_eff, v["theory"]["persson"]["gamma_eff"]."""

    def __repr__(self) -> str:
        return json.dumps(self, indent=2, ensure_ascii=False)

    def _repr_html_(self) -> str:
        return html_table(self._called, (), [(name, f"{value:.6g}") for name, value in self.numbers().items()])

    def find(self, name: str) -> Any:
        """Returns a value by its path, None if there is none.

        Parameters
        ----------
        name : str
            Path of the value, "theory.persson.gamma_eff".

        Returns
        -------
        object
            The value: number, text, list or Values.
        """
        value: Any = self
        for part in name.split("."):
            if not isinstance(value, dict) or part not in value:
                return None
            value = value[part]
        return value

    @overload
    def number(self, name: str, otherwise: float) -> float: ...
    @overload
    def number(self, name: str, otherwise: None = None) -> float | None: ...
    def number(self, name: str, otherwise: float | None = None) -> float | None:
        """Returns a value by its path if it is a finite number.

        Parameters
        ----------
        name : str
            Path of the value, "theory.persson.gamma_eff".
        otherwise : float, optional
            Returned for every other value.

        Returns
        -------
        float or None
            The number, in the unit of unit(name).
        """
        return finite(self.find(name), otherwise)

    def needed(self, name: str) -> float:
        """Returns a number by its path that every such file has, as a key of a resolved scene.

        Parameters
        ----------
        name : str
            Path of the value, "block.young".

        Returns
        -------
        float
            The number, in the unit of unit(name).

        Raises
        ------
        UnknownName
            There is no such number.
        """
        number = self.number(name)
        if number is None:
            raise UnknownName.among(self._called, name, self, what="number")
        return number

    def text(self, name: str) -> str:
        """Returns a value by its path if it is a text, else "".

        Parameters
        ----------
        name : str
            Path of the value, "theory.persson.gamma_eff".

        Returns
        -------
        str
            The text.
        """
        value = self.find(name)
        return value if isinstance(value, str) else ""

    def part(self, name: str) -> Values:
        """Returns a value by its path if it is an object, else an empty one.

        Parameters
        ----------
        name : str
            Path of the value, "theory.persson.gamma_eff".

        Returns
        -------
        Values
            The object.
        """
        value = self.find(name)
        return Values(value) if isinstance(value, dict) else Values()

    def listed(self, name: str, kind: type = object) -> list:
        """Returns the members of a kind of a list by its path, [] if the value is no list.

        Parameters
        ----------
        name : str
            Path of the value, "theory.persson.gamma_eff".
        kind : type
            Type of the members that are returned.

        Returns
        -------
        list
            The members.
        """
        value = self.find(name)
        return [member for member in value if isinstance(member, kind)] if isinstance(value, list) else []

    def numbers(self) -> dict[str, float]:
        """Returns all finite numbers by their paths, in the order of the file.

        Returns
        -------
        dict of str to float
            The numbers, in the units of unit(path).
        """
        found: dict[str, float] = {}
        for key, value in self.items():
            if isinstance(value, dict):
                found |= {f"{key}.{name}": number for name, number in Values(value).numbers().items()}
            elif (number := finite(value)) is not None:
                found[key] = number
        return found
