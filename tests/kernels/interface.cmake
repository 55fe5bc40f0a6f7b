# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
asperity_test(interface_pair_test
    SOURCES ${CMAKE_CURRENT_LIST_DIR}/interface_pair_test.cpp
    LINK asperity::kernels LABELS unit)
