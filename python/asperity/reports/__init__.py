# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""What readers of results are given: pages, tables, and files for other programs.

    page, sentences             how pages are built, and what is said in words
    run, sweep, estimate, cost  the report of each
    export                      states and trajectories as XYZ, VTK and PNG
"""
