#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
# What `cmake --install` leaves, used where it is: the program away from its build, the man page, the
# completion, the Python package, the scenes.
# shellcheck source=tests/cli/common.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/common.sh"
build=$(cd -- "$3" && pwd)

prefix=$work/prefix
cmake --install "$build" --prefix "$prefix" >"$work/install.log" 2>&1 || fail "cmake --install: $(tail -n 3 "$work/install.log")"
installed=$prefix/bin/asperity

# The program and a scene, with no path into the sources or the build.
scene=$prefix/share/asperity/scenes/first-contact.toml
"$installed" check "$scene" >/dev/null || fail "check of an installed scene"
grep -q "$build\|$source" "$prefix"/share/bash-completion/completions/asperity && fail "the completion names the build"
ldd "$installed" | grep 'not found' && fail "a library is missing"

# The man page: no warning of groff, every command and every key in it.
page=$prefix/share/man/man1/asperity.1
if command -v groff >/dev/null; then
    warnings=$(groff -man -Tutf8 -Kutf8 -ww "$page" 2>&1 >/dev/null)
    [ -z "$warnings" ] || fail "groff on the man page: $warnings"
fi
for command in $("$installed" --help | sed -n '/^commands:/,/^$/s/^  \([a-z-][a-z-]*\) .*/\1/p'); do
    grep -qx "\.SS $command" "$page" || fail "the man page has no $command"
done
for key in $("$installed" defaults --plain | awk '/^\[/ { gsub(/[][]/, ""); section = $0 } / = / { print section "." $1 }'); do
    grep -qF ".B ${key//-/\\-}" "$page" || fail "the man page has no key $key"
done

# The completion, as bash calls it.
complete_words() { # complete_words WORD...: of the last word
    bash -c '. "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _asperity; echo "${COMPREPLY[*]}"' - \
        "$prefix/share/bash-completion/completions/asperity" "$@"
}
[ "$(complete_words asperity pla)" = plan ] || fail "completion of a command"
[ "$(complete_words asperity run --resu)" = --resume ] || fail "completion of an option"
[ "$(complete_words asperity run --set surface.kin)" = "surface.kind=" ] || fail "completion of a key"
[ "$(complete_words asperity run --set surface.kind = fl)" = flat ] || fail "completion of a value"

# That of zsh, in a zsh of its own.
if command -v zsh >/dev/null; then
    zsh_makes() { # zsh_makes TEXT RESULT
        for wait in 1 4 15; do # of a busy machine
            zsh "$source/tests/cli/complete.zsh" "$prefix/share/zsh/site-functions" "$1" $wait | grep -qF -- "$2" && return
        done
        fail "zsh makes no '$2' of '$1'"
    }
    zsh_makes "asperity pla" "asperity plan"
    zsh_makes "asperity adhesion --you" "--young"
    zsh_makes "asperity run --set surface.kind=fl" "surface.kind=flat"
fi

# The Python package finds the program beside it.
PYTHONPATH=$prefix/share/asperity/python python3 - <<END || fail "import asperity"
import os, asperity.running.program
assert os.path.samefile(asperity.running.program.path(), "$installed"), asperity.running.program.path()
END
[ "$(readlink -f "$prefix/lib/python3/dist-packages/asperity")" = "$(readlink -f "$prefix/share/asperity/python/asperity")" ] ||
    fail "the package is not where python3 looks"
finish
