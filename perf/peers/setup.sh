#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
# The programs that compare.py compares with, from PyPI, in a virtual environment: perf/peers/setup.sh DIR. 77 where it cannot be made.
set -u
place=${1:?usage: setup.sh DIR}
python3 -m venv "$place" && "$place/bin/pip" install -q tamaas==2.9.0 contactmechanics==1.8.3 adhesion==0.93 && exit 0
echo "peers: the virtual environment in $place could not be made (is there a network, and python3-venv?)" >&2
exit 77
