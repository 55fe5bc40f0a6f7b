# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The command line of a command of this package (options.py), and the form of its help, which is that of the program
(engine/commands/help.hpp): usage, what the command does, arguments, options, exit codes, in 80 columns.
"""

from __future__ import annotations

import argparse
import difflib
import re
import textwrap

from ..errors import SceneError
from ..terminal import WIDTH
from ..units import is_unit

EXIT = "exit codes: 0 done, 1 internal error, 2 usage or scene, 3 physics guard,\n            4 files, 75 stopped early"
INDENT = 26
"""Column of the help in which explanations begin."""
EXAMPLES = {"DIR": "results/first-contact", "MAP": "scan.gwy", "FILE": "measured.csv", "FORMAT": "vtk"}
"""What may stand for a word of the help."""


class Parser(argparse.ArgumentParser):
    """Command line of a command: its mistakes are SceneErrors, its help has the form of the program's."""

    words: tuple[str, ...] = ()
    """Words of the call behind the command, for messages."""

    def _given(self, action: argparse.Action) -> str | None:
        """Returns the word of the call that gives an option or, of what stands without one, the first such word; None: none does."""
        takes_value = {name for one in self._actions if one.nargs != 0 for name in one.option_strings}
        alone = [word for word, before in zip(self.words, ("", *self.words)) if not word.startswith("-") and before not in takes_value]
        names = [word for word in self.words if word.partition("=")[0] in action.option_strings]
        return next(iter(names if action.option_strings else alone), None)

    def error(self, message: str):
        """Throws SceneError, with the option that was meant."""
        fix, why = f"{self.prog} --help", ""
        if unknown := re.match(r"unrecognized arguments: (--[^\s=]+)", message):
            names = [name for action in self._actions for name in action.option_strings if name.startswith("--")]
            near = difflib.get_close_matches(unknown[1].strip("-"), [name.strip("-") for name in names], 1, 0.7)
            message = f"{unknown[1]} is no option of {self.prog.split()[-1]}"
            why, fix = "its options are " + ", ".join(names), f"did you mean --{near[0]}?" if near else fix
        elif alone := re.match(r"unrecognized arguments: ([^\s-]\S*)", message):
            message, why = f"'{alone[1]}' stands alone", "a blank ends a word of the command line"
            fix = "write the unit behind the number, 100GPa, or put both into quotation marks" if is_unit(alone[1]) else fix
        elif message.startswith("the following arguments are required"):
            lacking = [action for action in self._actions if action.required and self._given(action) is None]
            message = ", ".join(map(_name_of, lacking)) + (" is" if len(lacking) == 1 else " are") + " missing"
            why = "; ".join(f"{_name_of(action)}: {action.help}" for action in lacking)
            fix = "for example: " + " ".join([self.prog, *self.words, *(_example(action) for action in lacking)])
        raise SceneError("command line", message if message[:2].isupper() else message[0].lower() + message[1:], why, fix)

    def usage_line(self) -> str:
        """Returns what the command needs, as the help has it: "usage: asperity report DIR [options]"."""
        words = [action for action in self._actions if not action.option_strings]
        needed = [action for action in self._actions if action.option_strings and action.required]
        usage = " ".join([self.prog, *(f"[{a.metavar}]" if a.nargs == "?" else str(a.metavar) for a in words),
                          *(f"{a.option_strings[0]} {a.metavar}" for a in needed), "[options]"])
        return textwrap.fill(f"usage: {usage}", WIDTH, subsequent_indent=" " * 7, break_on_hyphens=False, break_long_words=False)

    def refuse_unknown(self, words: list[str]) -> None:
        """Checks the options of a call before argparse does, which names those that are missing first. Raises SceneError."""
        self.words = tuple(words)
        takes_value = {name for action in self._actions if action.nargs != 0 for name in action.option_strings}
        for word, before in zip(words, ["", *words]):
            name = word.partition("=")[0]
            if word.startswith("--") and len(word) > 2 and before not in takes_value and \
                    not any(known.startswith(name) for known in self._option_string_actions):
                self.error(f"unrecognized arguments: {name}")

    def format_help(self) -> str:
        """Returns the help."""
        of_command = [action for action in self._actions if action.help is not argparse.SUPPRESS]
        words = [action for action in of_command if not action.option_strings]
        parts = [self.usage_line(), textwrap.fill(self.description or "", WIDTH)]
        parts += [textwrap.fill(part, WIDTH, break_on_hyphens=False) for part in (self.epilog or "").split("\n") if part]
        parts += [_listed("arguments", [(str(a.metavar), a) for a in words])] * bool(words)
        parts.append(_listed("options", [(_spelt(a), a) for a in of_command if a.option_strings]))
        return "\n\n".join([*parts, EXIT]) + "\n"


def _name_of(action: argparse.Action) -> str:
    return action.option_strings[0] if action.option_strings else str(action.metavar)


def _example(action: argparse.Action) -> str:
    """Spells an option with a value, or what stands without one, as it may be written."""
    value = EXAMPLES.get(str(action.metavar), str(action.metavar))
    return f"{action.option_strings[0]} {value}" if action.option_strings else value


def _spelt(action: argparse.Action) -> str:
    """Returns an option as the help has it: "-o, --out DIR"; a long one stands where it would behind a short one."""
    short = len(action.option_strings[0]) == 2
    return "    " * (not short) + ", ".join(action.option_strings) + (f" {action.metavar}" if action.nargs != 0 else "")


def _listed(head: str, entries: list[tuple[str, argparse.Action]]) -> str:
    lines = [f"{head}:"]
    for name, action in entries:
        text = textwrap.wrap((action.help or "").replace("%%", "%"), WIDTH - INDENT, break_on_hyphens=False)
        first = f"  {name}"
        lines += [first] * (len(first) > INDENT - 2)
        start = " " * INDENT if len(first) > INDENT - 2 else first.ljust(INDENT)
        lines += [start + text[0], *(" " * INDENT + line for line in text[1:])]
    return "\n".join(lines)
