# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Commands that are carried out in Python: each runs, writes, prints, and returns the exit code."""
