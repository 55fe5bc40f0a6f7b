# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
# asperity_test_program(<folder> LINK ...)
#   One GoogleTest program of the suites of tests/<folder>, test_<folder>. Its arguments name the
#   files whose tests it runs (support/main.cpp). With asperity_test_support it has the precompiled header with the engine's headers.
#   Its files are compiled several at a time: what two of them have in common stands in support/, and their other names differ.
#
# asperity_suite(<folder>/<file> LABELS ... [THREADS n] [RANKS n ...] [KERNELS level ...] [LONG]
#                [TIMEOUT s] [ENVIRONMENT NAME=VALUE ...])
#   Adds tests/<folder>/<file>.cpp to the folder's program, and the tests of that file to ctest under
#   its name; THREADS is ASPERITY_TEST_THREADS (1) and TIMEOUT ASPERITY_TEST_TIMEOUT (300 s) unless given. With
#   RANKS it is run once for each number of ranks, as <file>_ranks<n>. KERNELS repeats it (on one rank) with the
#   kernels of other processor levels, as <file>_<level>. LONG repeats it with ASPERITY_LONG=1 and the label "long",
#   as <file less _test>_long.
#
# asperity_suites(<folder> LABELS ...)
#   The same for every file tests/<folder>/*_test.cpp that is not a suite yet.
#
# asperity_add_test(<name> <seconds> COMMAND ...)
#   A test each of whose processes may take so many seconds of the processor (tests/limited.sh), and all of it six times as long:
#   a loaded machine makes no test fail, and one that hangs ends.

function(asperity_add_test name seconds)
    cmake_parse_arguments(ARG "" "" "COMMAND" ${ARGN})
    math(EXPR wall "6 * ${seconds}")
    add_test(NAME ${name} COMMAND bash ${PROJECT_SOURCE_DIR}/tests/limited.sh ${seconds} ${ARG_COMMAND})
    set_tests_properties(${name} PROPERTIES TIMEOUT ${wall})
endfunction()

function(asperity_test_program folder)
    cmake_parse_arguments(ARG "" "" "LINK" ${ARGN})
    add_executable(test_${folder})
    target_link_libraries(test_${folder} PRIVATE asperity_warnings asperity_test_main ${ARG_LINK})
    if("asperity_test_support" IN_LIST ARG_LINK)
        target_precompile_headers(test_${folder} REUSE_FROM asperity_test_headers)
    else()
        target_precompile_headers(test_${folder} REUSE_FROM asperity_test_main)
    endif()
    target_compile_definitions(test_${folder} PRIVATE ASPERITY_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
    if(NOT files_alone) # several files at a time, as text layers are
        set_target_properties(test_${folder} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
    endif()
endfunction()

function(asperity_suite file)
    cmake_parse_arguments(ARG "LONG" "THREADS;TIMEOUT" "LABELS;RANKS;KERNELS;ENVIRONMENT" ${ARGN})
    if(ARG_UNPARSED_ARGUMENTS)
        message(FATAL_ERROR "asperity_suite(${file}): unknown ${ARG_UNPARSED_ARGUMENTS}")
    endif()
    if(NOT ARG_THREADS)
        set(ARG_THREADS ${ASPERITY_TEST_THREADS})
    endif()
    if(NOT ARG_TIMEOUT)
        set(ARG_TIMEOUT ${ASPERITY_TEST_TIMEOUT})
    endif()
    get_filename_component(folder ${file} DIRECTORY)
    get_filename_component(name ${file} NAME)
    target_sources(test_${folder} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/${file}.cpp)
    set_property(GLOBAL APPEND PROPERTY ASPERITY_SUITES ${file}.cpp)
    # Threads that wait must sleep: spinning takes the processor from the thread that is waited for.
    set(environment OMP_NUM_THREADS=${ARG_THREADS} OMP_WAIT_POLICY=passive ${ARG_ENVIRONMENT})
    set(command $<TARGET_FILE:test_${folder}> ${name})
    if(ARG_RANKS)
        # Ranks of MPICH that wait keep their processors busy, also those that others of them need.
        if(ASPERITY_MPI STREQUAL "MPICH")
            math(EXPR ARG_TIMEOUT "4 * ${ARG_TIMEOUT}")
        endif()
        foreach(ranks IN LISTS ARG_RANKS)
            asperity_add_test(${name}_ranks${ranks} ${ARG_TIMEOUT} COMMAND ${ASPERITY_MPIRUN} -n ${ranks} ${command})
            set_tests_properties(${name}_ranks${ranks} PROPERTIES LABELS "${ARG_LABELS};mpi"
                PROCESSORS ${ranks} ENVIRONMENT "${environment}")
        endforeach()
        set(command ${ASPERITY_MPIRUN} -n 1 ${command})
    else()
        asperity_add_test(${name} ${ARG_TIMEOUT} COMMAND ${command})
        set_tests_properties(${name} PROPERTIES LABELS "${ARG_LABELS}"
                                                ENVIRONMENT "${environment}")
    endif()
    foreach(level IN LISTS ARG_KERNELS)
        if(level IN_LIST ASPERITY_VARIANTS)
            asperity_add_test(${name}_${level} ${ARG_TIMEOUT} COMMAND ${command})
            set_tests_properties(${name}_${level} PROPERTIES LABELS "${ARG_LABELS}"
                ENVIRONMENT "${environment};ASPERITY_KERNELS=${level}")
        endif()
    endforeach()
    if(ARG_LONG)
        string(REGEX REPLACE "_test$" "_long" long_name ${name})
        asperity_add_test(${long_name} 3600 COMMAND ${command})
        set_tests_properties(${long_name} PROPERTIES LABELS long
                                                     ENVIRONMENT "${environment};ASPERITY_LONG=1")
    endif()
endfunction()

function(asperity_suites folder)
    get_property(listed GLOBAL PROPERTY ASPERITY_SUITES)
    file(GLOB found RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} CONFIGURE_DEPENDS ${folder}/*_test.cpp)
    list(REMOVE_ITEM found "" ${listed})
    list(TRANSFORM found REPLACE "\\.cpp$" "")
    foreach(file IN LISTS found)
        asperity_suite(${file} ${ARGN})
    endforeach()
endfunction()
