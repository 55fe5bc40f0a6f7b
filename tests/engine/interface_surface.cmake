# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
asperity_test(interface_test
    SOURCES ${CMAKE_CURRENT_LIST_DIR}/interface_test.cpp
    LINK asperity::engine OpenMP::OpenMP_CXX LABELS unit)
# Threads that spin would wait for one another where the cores are shared.
set_property(TEST interface_test APPEND PROPERTY ENVIRONMENT "OMP_WAIT_POLICY=passive")
asperity_test(interface_mixed_test
    SOURCES ${CMAKE_CURRENT_LIST_DIR}/interface_mixed_test.cpp
    LINK asperity_test_support OpenMP::OpenMP_CXX LABELS "unit;physics")
asperity_test(interface_flat_test
    SOURCES ${CMAKE_CURRENT_LIST_DIR}/interface_flat_test.cpp
    LINK asperity::engine OpenMP::OpenMP_CXX LABELS "unit;physics")
asperity_test(surface_test
    SOURCES ${CMAKE_CURRENT_LIST_DIR}/surface_test.cpp
    LINK asperity::engine LABELS unit)
# The kernels of the other processor levels; a level that the processor lacks runs its best.
foreach(level v2 v3)
    foreach(test interface_test interface_mixed_test)
        if(NOT level IN_LIST ASPERITY_VARIANTS)
            continue()
        endif()
        add_test(NAME ${test}_${level} COMMAND ${test})
        set_tests_properties(${test}_${level} PROPERTIES LABELS unit TIMEOUT 300
            ENVIRONMENT "OMP_NUM_THREADS=2;OMP_WAIT_POLICY=passive;ASPERITY_KERNELS=${level}")
    endforeach()
endforeach()
