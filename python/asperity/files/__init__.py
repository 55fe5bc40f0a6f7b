# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Files that Asperity writes, and the directories that hold them: `store`."""
