#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""generate.py PROGRAM FOLDER: writes the man page asperity.1 and the completions asperity.bash and _asperity (zsh).

Both are made of what the program says of itself: its commands (--help), their options (COMMAND --help)
and the keys of a scene (defaults --json).
"""

import json
import re
import subprocess
import sys
from pathlib import Path

# The words that an option takes, as its explanation lists them: "...: keep, align-rows or isotropic".
LISTED = re.compile(r"(?:^|: )((?:[\w-]+, )+(?:[\w-]+ )?or [\w-]+)(?: for programs)?(?: *\(|$)")


def say(program, *words):
    done = subprocess.run([program, *words], capture_output=True, text=True)
    if done.returncode:
        raise SystemExit(f"{program} {' '.join(words)}: exit {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def commands_of(text):
    """[(name, purpose)] of the list of commands in --help; lines that go on are joined."""
    listed = text[text.index("\ncommands:\n") + len("\ncommands:\n"):].split("\n\n")[0]
    return [(name, " ".join(purpose.split())) for name, purpose in re.findall(r"(?m)^  (\S+)((?:.*\n? {26})*.*)$", listed)]


def options_of(text):
    """[(names, value, explanation)] of the options in the help of a command; value "" is a flag."""
    listed = text[text.index("\noptions:\n") + len("\noptions:\n"):].split("\n\n")[0]
    found = []
    for head, more in re.findall(r"(?m)^ {2,6}(-\S.*)$((?:\n {26}.*)*)", listed):
        spelt, _, explanation = head.partition("  ")
        names = re.findall(r"(?:^|, )(-[^\s,]+)", spelt)
        found.append((names, spelt[spelt.rindex(names[-1]) + len(names[-1]):].strip(), " ".join((explanation + more).split())))
    return found


def words_of(value, explanation):
    """Fixed words that an option takes: those of its explanation, and of a value such as "auto|FILE"; "": others."""
    listed = LISTED.search(re.sub(r" \([^:]*?\)", "", explanation))
    words = re.findall(r"[\w-]+", listed[1]) if listed else [one for one in value.split("|") if "|" in value and one.islower()]
    return " ".join(one for one in words if one != "or")


def roff(text):
    """A line of text for groff: nothing in it is a request or an escape."""
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return "\\&" + text if text[:1] in (".", "'") else text


def man_page(version, commands, helps, schema):
    out = [f'.TH ASPERITY 1 "" "asperity {version}" "User Commands"', ".SH NAME",
           "asperity \\- adhesion between randomly rough elastic solids", ".SH SYNOPSIS",
           ".B asperity", ".I COMMAND", "[options]", ".br", ".B mpirun \\-n", ".I N", ".B asperity run",
           ".I SCENE", ".SH DESCRIPTION",
           "Two elastic solids with rough surfaces are brought together, stick, and are pulled apart:",
           "molecular dynamics, quasi\\-static paths and equilibria of an elastic block on a rough substrate.",
           "A scene is a TOML file. A run writes", ".I result.json", "(the numbers) and", ".I run.h5",
           "(the path and the maps) into a directory, and never over an earlier result.", ".SH COMMANDS"]
    for name, purpose in commands:
        out += [".SS " + name, roff(purpose[:1].upper() + purpose[1:] + "."), ".PP", ".nf"]
        out += [roff(line) for line in helps[name].partition("\nexit codes:")[0].splitlines() if line.strip()]
        out += [".fi"]
    out += [".SH SCENE KEYS", "Every key has a default; units may be given, as in", '.BR """0.3 nm""" .']
    for key, about in schema.items():
        default = about["default"]
        default = default if isinstance(default, str) else json.dumps(default, ensure_ascii=False)
        unit = f" {about['unit']}" if about.get("unit") else ""
        out += [".TP", ".B " + roff(key), roff(f"{about['doc']}. Default: {default}{unit}.")]
        if about.get("choices"):
            out += [roff("Choices: " + ", ".join(map(str, about["choices"])) + ".")]
    out += [".SH EXIT STATUS", ".TP", ".B 0", "done", ".TP", ".B 1", "internal error", ".TP", ".B 2",
            "usage or scene", ".TP", ".B 3", "physics guard", ".TP", ".B 4", "files", ".TP", ".B 75",
            "stopped early; the same command with", ".B \\-\\-resume auto", "goes on",
            ".SH ENVIRONMENT", ".TP", ".B OMP_NUM_THREADS", "threads of each rank", ".TP",
            ".B ASPERITY_KERNELS", "kernels for another processor level: v2, v3 or v4",
            ".SH SIGNALS", "USR1, TERM and INT make a run write a checkpoint and end with status 75."]
    return "\n".join(out) + "\n"


def completion(commands, helps, schema):
    """The completion of bash."""
    options = {name: sorted({one for names, _, _ in options_of(helps[name]) for one in names if one.startswith("--")})
               for name, _ in commands}
    choices = {key: [str(c) for c in about["choices"]] for key, about in schema.items() if about.get("choices")}
    cases = "\n".join(f"    {name}) options='{' '.join(words)}' ;;" for name, words in options.items())
    values = "\n".join(f"    {option}) COMPREPLY=($(compgen -W '{words}' -- \"$cur\")); return ;;"
                       for option, words in {names[-1]: words_of(value, text) for name, _ in commands
                                             for names, value, text in options_of(helps[name]) if words_of(value, text)}.items())
    keyed = "\n".join(f"    {key}) words='{' '.join(words)}' ;;" for key, words in choices.items())
    return f"""# bash completion of asperity; made by packaging/generate.py
_asperity() {{
    local cur=${{COMP_WORDS[COMP_CWORD]}} prev=${{COMP_WORDS[COMP_CWORD - 1]}} key='' words='' options=''
    COMPREPLY=()
    if [ "$COMP_CWORD" -eq 1 ]; then
        COMPREPLY=($(compgen -W '{' '.join(name for name, _ in commands)} --help --version' -- "$cur"))
        return
    fi
    # bash splits section.key=value into three words.
    if [ "$prev" = = ]; then
        key=${{COMP_WORDS[COMP_CWORD - 2]}}
    elif [ "$cur" = = ]; then
        key=$prev cur=''
    fi
    case $key in
    '') ;;
{keyed}
    esac
    if [ -n "$key" ]; then
        COMPREPLY=($(compgen -W "$words" -- "$cur"))
        return
    fi
    case $prev in
    --set)
        compopt -o nospace 2>/dev/null
        COMPREPLY=($(compgen -S = -W '{' '.join(schema)}' -- "$cur"))
        return
        ;;
{values}
    esac
    case ${{COMP_WORDS[1]}} in
{cases}
    esac
    case $cur in
    -*) COMPREPLY=($(compgen -W "$options" -- "$cur")) ;;
    *) compopt -o filenames 2>/dev/null; COMPREPLY=($(compgen -f -- "$cur")) ;;
    esac
}}
complete -F _asperity asperity
"""


def quoted(text):
    """A text in single quotes of a shell."""
    return "'" + text.replace("'", "'\\''") + "'"


def zsh_completion(commands, helps, schema):
    """The completion of zsh, with explanations."""
    def spec(names, value, explanation):
        said = re.sub(r"([\[\]:])", r"\\\1", explanation)
        action = ("->keys" if "--set" in names else f"({words_of(value, explanation)})"
                  if words_of(value, explanation) else "_files")
        argument = f":{re.sub('[:]', ' ', value)}:{action}" if value else ""
        repeated = "*" if "--set" in names else ""
        return " ".join(quoted(f"{repeated}{name}[{said}]{argument}") for name in names)

    listed = "\n".join("        " + quoted(f"{name}:{purpose}") for name, purpose in commands)
    cases = "\n".join(f"    {name}) _arguments -C " + " ".join(spec(*one) for one in options_of(helps[name]))
                      + " '*:file:_files' ;;" for name, _ in commands)
    keys = "\n".join("        " + quoted(f"{key}=") for key in schema)
    choices = "\n".join(f"        {key}) compadd -P '{key}=' -- {' '.join(quoted(str(c)) for c in about['choices'])} ;;"
                        for key, about in schema.items() if about.get("choices"))
    return f"""#compdef asperity
# zsh completion of asperity; made by packaging/generate.py
local context state state_descr line
typeset -A opt_args
local -a commands keys
commands=(
{listed}
)
if (( CURRENT == 2 )); then
    _describe -t commands 'command' commands
    return
fi
local command=$words[2]
shift words
(( CURRENT-- ))
case $command in
{cases}
esac
if [[ $state == keys ]]; then
    case $PREFIX in
    *=*)
        case ${{PREFIX%%=*}} in
{choices}
        esac ;;
    *)
        keys=(
{keys}
        )
        compadd -S '' -- $keys ;;
    esac
fi
"""


def main():
    program, folder = sys.argv[1], Path(sys.argv[2])
    overview = say(program, "--help")
    commands = commands_of(overview)
    helps = {name: say(program, name, "--help") for name, _ in commands}
    schema = json.loads(say(program, "defaults", "--json"))
    version = say(program, "--version").split()[-1]
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "asperity.1").write_text(man_page(version, commands, helps, schema))
    (folder / "asperity.bash").write_text(completion(commands, helps, schema))
    (folder / "_asperity").write_text(zsh_completion(commands, helps, schema))


if __name__ == "__main__":
    main()
