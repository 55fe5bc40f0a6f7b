# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
asperity_test(interface_test
    SOURCES ${CMAKE_CURRENT_LIST_DIR}/interface_test.cpp
    LINK asperity::engine OpenMP::OpenMP_CXX LABELS unit)
# The kernels of the other processor levels; a level that the processor lacks runs its best.
foreach(level v2 v3)
    if(NOT level IN_LIST ASPERITY_VARIANTS)
        continue()
    endif()
    add_test(NAME interface_test_${level} COMMAND interface_test)
    set_tests_properties(interface_test_${level} PROPERTIES LABELS unit TIMEOUT 300
                         ENVIRONMENT "OMP_NUM_THREADS=2;OMP_WAIT_POLICY=passive;ASPERITY_KERNELS=${level}")
endforeach()
# Threads that spin would wait for one another where the cores are shared.
set_property(TEST interface_test APPEND PROPERTY ENVIRONMENT "OMP_WAIT_POLICY=passive")
asperity_test(interface_flat_test
    SOURCES ${CMAKE_CURRENT_LIST_DIR}/interface_flat_test.cpp
    LINK asperity::engine OpenMP::OpenMP_CXX LABELS "unit;physics")
asperity_test(surface_test
    SOURCES ${CMAKE_CURRENT_LIST_DIR}/surface_test.cpp
    LINK asperity::engine LABELS unit)
