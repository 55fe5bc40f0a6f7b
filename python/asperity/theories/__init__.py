# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Theories of contact.

    renormalised effective potential of rough surfaces from that of two flat ones sphere the smooth adhesive sphere, alone and in a
    periodic box viscoelastic Persson's theory of rubber friction combined the theories of scenes and runs, as results name them
"""
