# shellcheck shell=bash disable=SC2034
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
# For the scripts of this folder: $asperity is the program, $source the project's root, and the working
# directory an empty one that is removed at the end.
set -u
asperity=$1
source=$(cd -- "$2" && pwd)
work=$(mktemp -d "${TMPDIR:-/tmp}/asperity cli.XXXXXX") # with a space in its name
trap 'rm -rf -- "$work"' EXIT
cd -- "$work" || exit 1
failures=0

# The words that start ranks, before -n RANKS, as CMake found them; none: there is no launcher.
read -ra mpirun <<<"${ASPERITY_MPIRUN:-mpirun --oversubscribe --allow-run-as-root --bind-to none}"
command -v "${mpirun[0]}" >/dev/null || mpirun=()

fail() {
    echo "FAILED: $*" >&2
    failures=$((failures + 1))
}

# expect CODE ARGUMENTS...: runs the program; its output is left in $out.
expect() {
    local code=$1
    shift
    out=$("$asperity" "$@" 2>&1)
    local got=$?
    [ $got -eq "$code" ] || fail "exit code $got instead of $code: asperity $*
$out"
}

# says TEXT: the last output holds this text.
says() {
    case $out in
    *"$1"*) ;;
    *) fail "the output lacks '$1':
$out" ;;
    esac
}

finish() {
    [ $failures -eq 0 ] && echo "all fine"
    exit $((failures > 0))
}
