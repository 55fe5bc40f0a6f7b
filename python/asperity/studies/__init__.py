# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Studies: many runs of a scene, and the numbers that follow from them.

    grid, tables, sweeps                         sweeps over keys of a scene
    quantities, variations                       quantities that are stated; a scene with one setting varied at a time, and its runs
    estimate_parts, stated_number, estimates     numbers with their errors
    cost_parameters, cost                        what each setting costs and what error it makes
    map_scene                                    the scene of a measured map
    states                                       the stable states of a contact under its load
"""
