# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
# asperity_layer(<name> [SOURCES ...] [VARIANTS ...] DEPENDS ...)
#   One static library a layer. Its include path is a directory that holds nothing but a link named
#   <name> to the layer's folder, and the layers below come with DEPENDS; so
#   #include "<name>/x.hpp" works, and an include that points upwards does not compile.
#   Sources named under VARIANTS are compiled once for each x86-64 level and picked at start
#   (kernels/variant.hpp).
#
# asperity_folder(<layer> <folder> [SOURCES ...] [HEADERS ...] DEPENDS ...)
#   A folder of a layer's in the same way, called in the layer's CMakeLists.txt: the library
#   <layer>_<folder>, with #include "<layer>/<folder>/x.hpp". Of an empty folder's name: headers of the
#   layer's own folder, <layer>_base.

# asperity_precompiled(<target>)
#   The headers that nearly every file of io/ and engine/ includes, parsed once for all targets that ask for
#   it: a third of what those files take to compile. It fits what is compiled with the same macros, so these
#   targets have {fmt}'s and OpenMP's. Not with CMAKE_DISABLE_PRECOMPILE_HEADERS (presets debug and audit, which
#   so find a header that a file forgot to include).

# x86-64 levels that the kernels are compiled for, one table of functions each (kernels/variant.hpp).
set(ASPERITY_LEVELS all CACHE STRING
    "all (for a program that is passed on), native (that of this machine, for short builds), none (any processor)")
set_property(CACHE ASPERITY_LEVELS PROPERTY STRINGS all native none)
set(ASPERITY_KERNEL_OPTIONS "" CACHE STRING "Compiler options of the kernels alone, behind all others")
set(ASPERITY_VARIANTS "")
if(NOT ASPERITY_LEVELS MATCHES "^(all|native|none)$")
    message(FATAL_ERROR "ASPERITY_LEVELS=${ASPERITY_LEVELS}: it is all, native or none")
elseif(NOT ASPERITY_LEVELS STREQUAL "none" AND CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    set(ASPERITY_VARIANTS v2 v3 v4)
    if(ASPERITY_LEVELS STREQUAL "native")
        execute_process(COMMAND ${CMAKE_CXX_COMPILER} -march=native -dM -E -x c++ /dev/null
                        OUTPUT_VARIABLE has ERROR_QUIET)
        if(has MATCHES "__AVX512F__" AND has MATCHES "__AVX512DQ__" AND has MATCHES "__AVX512BW__"
           AND has MATCHES "__AVX512VL__" AND has MATCHES "__AVX512CD__")
            set(ASPERITY_VARIANTS v4)
        elseif(has MATCHES "__AVX2__" AND has MATCHES "__FMA__" AND has MATCHES "__BMI2__")
            set(ASPERITY_VARIANTS v3)
        elseif(has MATCHES "__SSE4_2__")
            set(ASPERITY_VARIANTS v2)
        endif()
    endif()
endif()

# The layers go into the program and into the module of Python, which shows no names of theirs.
set(ASPERITY_IN_A_LIBRARY POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden
                          VISIBILITY_INLINES_HIDDEN ON)

function(asperity_layer name)
    cmake_parse_arguments(ARG "" "" "SOURCES;VARIANTS;DEPENDS" ${ARGN})
    set(include_dir ${PROJECT_BINARY_DIR}/layers/${name})
    file(MAKE_DIRECTORY ${include_dir})
    file(CREATE_LINK ${CMAKE_CURRENT_SOURCE_DIR} ${include_dir}/${name} SYMBOLIC)
    add_library(asperity_${name} STATIC ${ARG_SOURCES})
    set_target_properties(asperity_${name} PROPERTIES ${ASPERITY_IN_A_LIBRARY})
    add_library(asperity::${name} ALIAS asperity_${name})
    target_include_directories(asperity_${name} PUBLIC ${include_dir})
    target_link_libraries(asperity_${name} PUBLIC asperity_flags ${ARG_DEPENDS}
                                           PRIVATE asperity_warnings)
    set_source_files_properties(${ARG_VARIANTS} PROPERTIES COMPILE_OPTIONS "${ASPERITY_KERNEL_OPTIONS}")
    if(ARG_VARIANTS AND NOT ASPERITY_VARIANTS)
        target_sources(asperity_${name} PRIVATE ${ARG_VARIANTS})
    endif()
    foreach(variant IN LISTS ASPERITY_VARIANTS)
        if(ARG_VARIANTS)
            add_library(asperity_${name}_${variant} OBJECT ${ARG_VARIANTS})
            set_target_properties(asperity_${name}_${variant} PROPERTIES ${ASPERITY_IN_A_LIBRARY})
            target_include_directories(asperity_${name}_${variant} PRIVATE ${include_dir})
            target_link_libraries(asperity_${name}_${variant}
                                  PRIVATE asperity_flags asperity_warnings ${ARG_DEPENDS})
            target_compile_definitions(asperity_${name}_${variant}
                                       PRIVATE ASPERITY_VARIANT=${variant})
            target_compile_options(asperity_${name}_${variant} PRIVATE -march=x86-64-${variant})
            target_sources(asperity_${name}
                           PRIVATE $<TARGET_OBJECTS:asperity_${name}_${variant}>)
        endif()
    endforeach()
    if(ARG_VARIANTS)
        foreach(variant IN ITEMS v2 v3 v4) # ASPERITY_HAS_V2 and so on: 0 or 1
            string(TOUPPER ASPERITY_HAS_${variant} macro)
            target_compile_definitions(asperity_${name}
                PRIVATE ${macro}=$<IN_LIST:${variant},${ASPERITY_VARIANTS}>)
        endforeach()
    endif()
endfunction()

function(asperity_folder layer folder)
    cmake_parse_arguments(ARG "" "" "SOURCES;HEADERS;DEPENDS" ${ARGN})
    set(name ${layer}_${folder})
    if(NOT folder)
        set(name ${layer}_base)
    endif()
    set(include_dir ${PROJECT_BINARY_DIR}/layers/${name})
    file(MAKE_DIRECTORY ${include_dir}/${layer})
    foreach(link IN LISTS folder ARG_HEADERS)
        file(CREATE_LINK ${CMAKE_CURRENT_SOURCE_DIR}/${link} ${include_dir}/${layer}/${link} SYMBOLIC)
    endforeach()
    if(NOT ARG_SOURCES)
        add_library(asperity_${name} INTERFACE)
        target_include_directories(asperity_${name} INTERFACE ${include_dir})
        target_link_libraries(asperity_${name} INTERFACE asperity_flags ${ARG_DEPENDS})
    else()
        list(TRANSFORM ARG_SOURCES PREPEND ${folder}/)
        add_library(asperity_${name} STATIC ${ARG_SOURCES})
        set_target_properties(asperity_${name} PROPERTIES ${ASPERITY_IN_A_LIBRARY})
        target_include_directories(asperity_${name} PUBLIC ${include_dir})
        target_link_libraries(asperity_${name} PUBLIC asperity_flags ${ARG_DEPENDS}
                                               PRIVATE asperity_warnings)
        asperity_precompiled(asperity_${name})
    endif()
    add_library(asperity::${name} ALIAS asperity_${name})
endfunction()

function(asperity_precompiled target)
    if(CMAKE_DISABLE_PRECOMPILE_HEADERS)
        return()
    endif()
    set(headers asperity_precompiled_headers)
    if(NOT TARGET ${headers})
        file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/precompiled.cpp CONTENT "")
        add_library(${headers} OBJECT ${PROJECT_BINARY_DIR}/precompiled.cpp)
        set_target_properties(${headers} PROPERTIES ${ASPERITY_IN_A_LIBRARY})
        target_link_libraries(${headers} PRIVATE asperity_flags asperity_warnings fmt::fmt OpenMP::OpenMP_CXX)
        target_precompile_headers(${headers} PRIVATE
            <algorithm> <array> <chrono> <cmath> <cstdint> <functional> <map> <memory> <numbers> <optional>
            <span> <stdexcept> <string> <string_view> <variant> <vector> <fmt/format.h>)
    endif()
    target_precompile_headers(${target} REUSE_FROM ${headers})
    target_link_libraries(${target} PRIVATE fmt::fmt OpenMP::OpenMP_CXX)
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
        # For ccache; and against false alarms of g++ 12 about std::string where it is precompiled.
        target_compile_options(${target} PRIVATE
            -fpch-preprocess -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread)
    endif()
endfunction()
