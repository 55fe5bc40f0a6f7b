# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Plots on matplotlib: functions that draw into an axes.

    run      of a run: separation, contact, energy, spectrum, maps, ...
    sweep    of sweeps: binding energy, contact area, pull-off force, hysteresis over a swept key
    style    colours, dashes and sizes; figures as PNG, PDF, SVG and CSV
"""
