# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The program, scenes and runs of them.

    scene     scenes as dictionaries, and as files for the program
    program   where the program is, and what is asked of it
    lock      the lock of a directory of results
    runs      a run of a scene
    pool      many runs, each a process of its own
    engine    the engine in a loop of your own: Simulation and Statics
"""
