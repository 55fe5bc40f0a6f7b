# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Names of arguments: the words of a scene's keys, on the command line and in Python, with shorter ones as aliases.

    young = chosen("young", 'young="100 GPa"', young=young, E=E)      # an argument of a function
    options("young")                                                  # as options: --young, --E
    @checks_call                                                      # run(rnaks=2): "did you mean ranks?"

Messages name options, "--size 100nm"; the functions for Python say them as arguments, size="100nm".
"""

from __future__ import annotations

import contextlib
import difflib
import functools
import inspect
import numbers
import os
import re
import types
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextvars import ContextVar
from pathlib import Path
from typing import Any, TypeVar, Union, cast, get_args, get_origin

from .errors import Error, SceneError, WrongCall
from .units import is_unit

F = TypeVar("F", bound=Callable[..., Any])
K = TypeVar("K", bound=type)

ALIASES = {"young": ("E",), "poisson": ("nu",), "adhesion": ("work", "w"), "size": ("file_size",), "unit": ("file_unit",)}
"""Other names of an argument. Each argument has the last word of a key of the scene, as itself or as an alias."""


_called: ContextVar[Callable[..., Any] | None] = ContextVar("called", default=None)
"""The function of the package that a script has called; command_line on the command line."""
OPTION = re.compile(r"""--(set) ([\w.]+)=(?:"([^"]*)"|'([^']*)'|([^\s;)"']+))|--([a-z][a-z-]+)(?:[ =](?:"([^"]+)"|'([^']+)'|([^\s,;:()"']+)))?""")


@contextlib.contextmanager
def command_line() -> Iterator[None]:
    """Makes the messages within the context name options, as the command line has them."""
    with _calls(command_line):
        yield


@contextlib.contextmanager
def _calls(function: Callable[..., Any]) -> Iterator[None]:
    """Notes the function within the context, unless it is called by another one of the package."""
    if _called.get() is not None:
        yield
        return
    before = _called.set(function)
    try:
        yield
    finally:
        _called.reset(before)


def spoken(text: str, function: Callable[..., Any] | None = None) -> str:
    """Spells the options in a message as arguments of the function that was called; on the command line the message is not changed."""
    function = command_line if _called.get() is command_line else function or _called.get()
    if function in (None, command_line):
        return text
    known = inspect.signature(function).parameters

    def spelt(found: re.Match[str]) -> str:
        place = next((one for one in ("overrides", "values") if one in known), "")
        if found[1]:
            return f'{place}={{"{found[2]}": {_literal(found[3] or found[4] or found[5], "")}}}' if place else found[0]
        name, quoted = found[6].replace("-", "_"), found[7] or found[8]
        name = place if name == "set" and place else name
        if name not in known:
            return found[0]
        value = (found[9] or "").rstrip(".")
        end = (found[9] or "")[len(value):]
        if quoted or re.search(r"\d", value) or is_unit(value) or value.isupper():
            return f"{name}={_literal(quoted or value, str(known[name].annotation))}{end}"
        return name + (f" {value}{end}" if value else "")

    if (whole := re.fullmatch(r"--([a-z][a-z-]+) ([^\"',;:]+)", text)) and (name := whole[1].replace("-", "_")) in known:  # a place
        return f"{name}={_literal(whole[2], str(known[name].annotation))}"
    return OPTION.sub(spelt, text.replace("a --set", "--set"))


def _literal(text: str, annotation: str) -> str:
    """Spells a value in Python: a number if the argument takes one, or if the type is not known; else a text."""
    if "," in text and not annotation:
        return "[" + ", ".join(_literal(one, annotation) for one in text.split(",")) + "]"
    number = re.fullmatch(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?", text)
    return text if number and "str" not in annotation else f'"{text}"'


def options(name: str) -> list[str]:
    """Returns the options of an argument: "--young", "--E"."""
    return ["--" + word.replace("_", "-") for word in (name, *ALIASES.get(name, ()))]


def chosen(name: str, example: str = "", **given: Any) -> Any:
    """Returns the value of an argument that has several names. Raises SceneError."""
    there = {word: value for word, value in given.items() if value is not None}
    if len(there) > 1:
        raise SceneError(" and ".join(there), "are names of one argument", f"its name is {name}", f"give {name} alone")
    if not there and example:
        raise SceneError(name, "is not given", "the function needs it" + f" (also named {', '.join(ALIASES.get(name, ()))})" * (name in ALIASES),
                         f"for example {example}")
    return next(iter(there.values()), None)


def _wrong_call(signature: inspect.Signature, where: str, given: tuple[Any, ...], named: Mapping[str, Any], first: int) -> WrongCall:
    """Returns the error of a call that a signature refuses. first: arguments that the caller did not write: self."""
    kinds = inspect.Parameter
    known = dict(list(signature.parameters.items())[first:])
    names = "its arguments are " + ", ".join(known) if known else "it takes none"
    if unknown := [name for name in named if name not in known]:
        near = difflib.get_close_matches(unknown[0], known, 1)
        keys = [f"keys of the scene go into {name}: {example}" for name, example in
                (("overrides", '{"surface.rms": 2.0}'), ("values", '{"surface.rms": [1, 2]}')) if name in known]
        return WrongCall(where, f"has no argument {unknown[0]!r}", names, "; ".join([f"did you mean {one}?" for one in near] + keys))
    places = [name for name, one in known.items() if one.kind in (kinds.POSITIONAL_ONLY, kinds.POSITIONAL_OR_KEYWORD)]
    if len(given) - first > len(places):
        return WrongCall(where, f"is given {len(given) - first} values without a name, and takes {len(places)}", names,
                         "give the others by their names" if len(known) > len(places) else "")
    there = [*places[:len(given) - first], *named]
    twice = [name for name in named if name in places[:len(given) - first]]
    lacking = [name for name, one in known.items() if one.default is kinds.empty and name not in there]
    return WrongCall(where, f"is given {twice[0]} twice" if twice else "is not given " + ", ".join(lacking),
                     names, "")


NAMED = {int: "a whole number", float: "a number", bool: "True or False", str: "a text", type(None): "None"}
"""How messages call the kinds of values."""
HOLDING = {list: "a list", tuple: "a tuple", dict: "a dict", Sequence: "a list", Iterable: "a list", Mapping: "a dict", Callable: "a function"}
"""How messages call the kinds of values that hold others, and functions."""


def _is_of(value: Any, kind: Any) -> bool:
    """Returns True if a value is of an annotated kind, which is plain. A quantity that is a text may be a number: functions
    say more on a number without a unit."""
    if get_origin(kind) in (Union, types.UnionType):
        is_path = {Path, os.PathLike} & {*get_args(kind)} and isinstance(value, numbers.Real)
        return any(_is_of(value, one) for one in get_args(kind) if not (one is str and is_path))
    numbers_of = {int: numbers.Integral, float: numbers.Real, str: (str, numbers.Real)}
    if kind in numbers_of:
        return isinstance(value, numbers_of[kind]) and not isinstance(value, bool)
    if kind is bool:
        return isinstance(value, bool) or type(value).__name__ == "bool_"
    return isinstance(value, get_origin(kind) or kind)


def _words_of(kind: Any) -> list[str]:
    """Returns the words for an annotated kind."""
    if get_origin(kind) in (Union, types.UnionType):
        return [word for one in get_args(kind) for word in _words_of(one)]
    return [NAMED.get(kind, HOLDING.get(get_origin(kind) or kind, getattr(kind, "__name__", "")))]


@functools.cache
def _kinds(function: Callable[..., Any]) -> dict[str, Any]:
    """Returns the annotated kinds of a function's arguments that are numbers, texts, paths, lists, dicts or functions. Of others,
    scenes and executors for example, the functions themselves say what is needed."""
    found = {}
    for name, written in getattr(function, "__annotations__", {}).items():
        with contextlib.suppress(Exception):  # names of `if TYPE_CHECKING`
            kind = eval(written, function.__globals__) if isinstance(written, str) else written
            parts = get_args(kind) if get_origin(kind) in (Union, types.UnionType) else [kind]
            if {get_origin(part) or part for part in parts} <= {*NAMED, *HOLDING, Path, os.PathLike}:
                found[name] = kind
    return found


def _wrong_kind(function: Callable[..., Any], where: str, bound: inspect.BoundArguments, holding: bool = False) -> WrongCall | None:
    """Returns the error of an argument that is not of the kind that the function takes. Without holding only numbers, texts and paths
    are looked at: many functions say more on a list, a dict or a function that is wrong."""
    for name, value in bound.arguments.items():
        kind, one = _kinds(function).get(name), bound.signature.parameters[name]
        parts = get_args(kind) if get_origin(kind) in (Union, types.UnionType) else [kind]
        if not holding and {get_origin(part) or part for part in parts} & HOLDING.keys():
            continue
        if kind is None or one.kind in (one.VAR_POSITIONAL, one.VAR_KEYWORD) or value is one.default or _is_of(value, kind):
            continue
        words = [word for word in dict.fromkeys(_words_of(kind)) if word != "None"]
        return WrongCall(where, f"{name} is {value!r:.60}", f"it is of type {type(value).__name__}", f"give {' or '.join(words)}")
    return None


def checks_call(function: F) -> F:
    """Makes a function of the package raise WrongCall, with the names of its arguments, if it is called with others, or with a value of another kind
    than the one annotated."""
    signature = inspect.signature(function)
    first = int(next(iter(signature.parameters), "") in ("self", "cls"))

    @functools.wraps(function)
    def checked(*given: Any, **named: Any) -> Any:
        where = function.__qualname__.removesuffix(".__init__").rpartition("<locals>.")[2] + "()"
        try:
            bound = signature.bind(*given, **named)
        except TypeError:
            raise _wrong_call(signature, where, given, named, first) from None
        if wrong := _wrong_kind(function, where, bound):
            raise wrong
        try:
            with _calls(function):
                return function(*given, **named)
        except Error as error:
            error.rewrite(lambda text: spoken(text, function))
            raise
        except (TypeError, AttributeError, ValueError) as error:  # of a list, dict or function that the function does not look at itself
            if wrong := _wrong_kind(function, where, bound, holding=True):
                raise wrong from error
            raise

    return cast("F", checked)


def checks_calls(kind: K) -> K:
    """Makes a class check the calls of its constructor and of its methods, as checks_call() does."""
    for name, thing in list(vars(kind).items()):
        if name.startswith("_") and name != "__init__":
            continue
        if isinstance(thing, classmethod):
            setattr(kind, name, classmethod(checks_call(thing.__func__)))
        elif inspect.isfunction(thing):
            setattr(kind, name, checks_call(thing))
    return kind
