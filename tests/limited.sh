#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
# limited.sh SECONDS COMMAND...: a command each of whose processes may take so many seconds of the processor. Time that other
# programs take of a loaded machine does not count.
ulimit -S -t "$1"
shift
exec "$@"
