# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
# Everything comes from the system; nothing is downloaded at configure time. All that is missing is said
# at once, with the packages that have it (packages.txt).

# asperity_need(<found> <name>)
#   Notes that the package <name> of packages.txt is missing unless the variable <found> is true.
set(asperity_missing "")
macro(asperity_need found name)
    if(NOT ${found})
        list(APPEND asperity_missing "${name}")
    endif()
endmacro()

# asperity_packages_of(<variable> <column>)
#   The packages of that column of packages.txt that have what is missing, on one line.
function(asperity_packages_of variable column)
    set(all "")
    file(STRINGS ${PROJECT_SOURCE_DIR}/cmake/packages.txt rows REGEX "^[^#]")
    foreach(row IN LISTS rows)
        string(REGEX REPLACE " *[|] *" ";" row "${row}")
        list(GET row 1 name)
        list(GET row ${column} packages)
        if(name IN_LIST asperity_missing AND NOT packages STREQUAL "-")
            if(ASPERITY_MPI STREQUAL "MPICH")
                string(REPLACE "openmpi" "mpich" packages "${packages}")
            endif()
            string(APPEND all " ${packages}")
        endif()
    endforeach()
    set(${variable} "${all}" PARENT_SCOPE)
endfunction()

function(asperity_say_what_is_missing)
    if(NOT asperity_missing)
        return()
    endif()
    list(JOIN asperity_missing ", " names)
    asperity_packages_of(debian 2)
    asperity_packages_of(fedora 3)
    asperity_packages_of(conda 4)
    asperity_packages_of(homebrew 5)
    # The script `asperity` reads the line of Debian's packages.
    message(FATAL_ERROR "Asperity lacks: ${names}\n"
        "  Debian, Ubuntu: apt-get install --no-install-recommends${debian}\n"
        "  Fedora:         dnf install${fedora}\n"
        "  conda-forge:    conda install -c conda-forge${conda}\n"
        "  Homebrew:       brew install${homebrew}\n"
        "  or load modules; what lies elsewhere is found by CMAKE_PREFIX_PATH and PKG_CONFIG_PATH "
        "(docs/install.md)")
endfunction()

find_package(OpenMP QUIET COMPONENTS CXX)
asperity_need(OpenMP_CXX_FOUND "OpenMP")
include(AsperityMpi)
find_package(PkgConfig QUIET)
asperity_need(PkgConfig_FOUND "pkg-config")
if(PkgConfig_FOUND)
    pkg_check_modules(FFTW QUIET IMPORTED_TARGET fftw3)
    pkg_check_modules(FFTWF QUIET IMPORTED_TARGET fftw3f)
    set(asperity_fftw_found FALSE)
    if(FFTW_FOUND AND FFTWF_FOUND)
        set(asperity_fftw_found TRUE)
    endif()
    asperity_need(asperity_fftw_found "FFTW in double and single precision")
    include(AsperityHdf5)
else() # by which they are looked for
    list(APPEND asperity_missing "FFTW in double and single precision" "HDF5")
endif()
find_package(Boost 1.74 QUIET)
asperity_need(Boost_FOUND "Boost 1.74")
find_package(fmt QUIET)
asperity_need(fmt_FOUND "{fmt}")
find_package(tomlplusplus QUIET)
asperity_need(tomlplusplus_FOUND "toml++")
find_package(CLI11 QUIET)
asperity_need(CLI11_FOUND "CLI11")
find_package(nlohmann_json QUIET)
asperity_need(nlohmann_json_FOUND "nlohmann-json")
find_path(RANDOM123_INCLUDE_DIR Random123/philox.h DOC "The folder that holds Random123/")
asperity_need(RANDOM123_INCLUDE_DIR "Random123")
find_package(Python3 QUIET COMPONENTS Interpreter)
asperity_need(Python3_FOUND "Python 3")

# asperity_optional(<option> <found> <name>)
#   AUTO becomes ON or OFF by what was found; ON needs it.
macro(asperity_optional option found name)
    if(${option} STREQUAL "AUTO")
        set(${option} ${${found}})
    elseif(${option})
        asperity_need(${found} "${name}")
    endif()
endmacro()
if(ASPERITY_TESTS)
    find_package(GTest QUIET)
endif()
asperity_optional(ASPERITY_TESTS GTest_FOUND "GoogleTest")
if(ASPERITY_PERF)
    find_package(benchmark QUIET)
endif()
asperity_optional(ASPERITY_PERF benchmark_FOUND "Google Benchmark")

asperity_say_what_is_missing()

add_library(asperity_random123 INTERFACE)
target_include_directories(asperity_random123 SYSTEM INTERFACE ${RANDOM123_INCLUDE_DIR})

# The run path of what is installed: the folders of libraries that the loader does not look into by itself,
# such as those of modules. (CMake's own search leaves out folders of LIBRARY_PATH, which modules set.)
set(libraries ${MPI_C_LIBRARIES} ${HDF5_FILES} ${FFTW_LINK_LIBRARIES} ${FFTWF_LINK_LIBRARIES})
foreach(name IN LISTS OpenMP_CXX_LIB_NAMES)
    list(APPEND libraries ${OpenMP_${name}_LIBRARY})
endforeach()
foreach(target IN ITEMS fmt::fmt tomlplusplus::tomlplusplus)
    get_target_property(library ${target} LOCATION)
    list(APPEND libraries ${library})
endforeach()
execute_process(COMMAND ${CMAKE_CXX_COMPILER} -print-file-name=libstdc++.so.6 OUTPUT_VARIABLE library
                OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
list(APPEND libraries ${library})
foreach(library IN LISTS libraries)
    if(IS_ABSOLUTE "${library}" AND library MATCHES "[.]so")
        file(REAL_PATH "${library}" library)
        get_filename_component(folder ${library} DIRECTORY)
        if(NOT (folder MATCHES "^/(usr/)?lib" AND folder IN_LIST CMAKE_CXX_IMPLICIT_LINK_DIRECTORIES))
            list(APPEND CMAKE_INSTALL_RPATH ${folder})
        endif()
    endif()
endforeach()
list(REMOVE_DUPLICATES CMAKE_INSTALL_RPATH)
if(CMAKE_INSTALL_RPATH)
    message(STATUS "Run path of the installed program: ${CMAKE_INSTALL_RPATH}")
endif()
