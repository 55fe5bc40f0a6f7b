# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
# Which compilers, and with which options: targets asperity_flags and asperity_warnings.
foreach(least IN ITEMS GNU:12 Clang:14)
    string(REPLACE ":" ";" least ${least})
    list(GET least 0 id)
    list(GET least 1 version)
    if(CMAKE_CXX_COMPILER_ID STREQUAL id AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS version)
        message(FATAL_ERROR
            "Asperity needs g++ 12 or clang 14, or a newer one; ${CMAKE_CXX_COMPILER} is "
            "version ${CMAKE_CXX_COMPILER_VERSION}, which lacks shuffles of SIMD registers "
            "(__builtin_shufflevector) or parts of C++20.\n"
            "Name another compiler in a new build directory: -DCMAKE_CXX_COMPILER=g++-12 "
            "-DCMAKE_C_COMPILER=gcc-12, or set CXX and CC.")
    endif()
endforeach()
if(NOT CMAKE_CXX_COMPILER_ID MATCHES "^(GNU|Clang)$")
    message(WARNING "Asperity was built with g++ and clang only, not with ${CMAKE_CXX_COMPILER_ID}: run its tests")
endif()

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
if(NOT CMAKE_BUILD_TYPE)
    set(CMAKE_BUILD_TYPE Release)
endif()
string(TOUPPER "${CMAKE_BUILD_TYPE}" build_type)
set(asperity_all_flags "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${build_type}}")
if(asperity_all_flags MATCHES "-Ofast|-ffast-math|-funsafe-math|-fassociative-math|-freciprocal-math|-ffinite-math")
    message(FATAL_ERROR
        "\"${CMAKE_MATCH_0}\" in the compiler's options (${asperity_all_flags}) lets the compiler change the order of "
        "sums and assume that no value is infinite or no number: results would depend on it, and guards be "
        "left out. Take it out of CXXFLAGS or CMAKE_CXX_FLAGS; the speed does not need it.")
endif()

add_library(asperity_flags INTERFACE)
# No contraction behind our back: where a fused multiply-add is meant, the kernel says so. The same
# node then gets a bitwise identical result whichever loop, rank or thread computes it.
target_compile_options(asperity_flags INTERFACE -ffp-contract=off -fopenmp-simd)
add_library(asperity_warnings INTERFACE)
target_compile_options(asperity_warnings INTERFACE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wno-psabi
    $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict> # false alarms of g++ 12 on string concatenation (GCC bug 105651)
    $<$<BOOL:${ASPERITY_WERROR}>:-Werror>
    # A loop that clang leaves scalar costs time and changes no number.
    $<$<CXX_COMPILER_ID:Clang>:-Wno-error=pass-failed>)
