# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Theories of adhesive contact.

    renormalised   what roughness leaves of the potential of two flat surfaces
    sphere         the smooth adhesive sphere, alone and in a periodic box
    combined       the theories of scenes and runs, as results name them
"""
