# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""What planted.hpp is to C++, for Python: each planted module runs this file by its path."""

import os

chosen = int(os.environ.get("MUTANT_ON", -1))
marked = set()


def mutant(number):
    if number not in marked and "MUTANTS_REACHED" in os.environ:
        marked.add(number)
        fd = os.open(os.environ["MUTANTS_REACHED"], os.O_WRONLY)
        os.pwrite(fd, b"\1", number)
        os.close(fd)
    return number == chosen
