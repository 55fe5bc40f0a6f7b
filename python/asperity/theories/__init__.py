# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Theories of contact.

    renormalised   what roughness leaves of the potential of two flat surfaces
    sphere         the smooth adhesive sphere, alone and in a periodic box
    viscoelastic   Persson's theory of rubber friction
    combined       the theories of scenes and runs, as results name them
"""
