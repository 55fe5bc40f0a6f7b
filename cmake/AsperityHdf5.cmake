# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
# The C interface of HDF5, in HDF5_C_LIBRARIES and HDF5_C_INCLUDE_DIRS; its files in HDF5_FILES. One rank alone writes, so a serial
# build of it serves every MPI, and a parallel one only the MPI that it was built with. pkg-config first:
# CMake's own search runs h5pcc, which fails where a path has a space in it.
set(HDF5_PC_FOUND FALSE)
if(NOT DEFINED HDF5_ROOT AND NOT DEFINED ENV{HDF5_ROOT})
    if(ASPERITY_MPI STREQUAL "Open MPI")
        pkg_check_modules(HDF5_PC QUIET IMPORTED_TARGET hdf5-openmpi)
    elseif(ASPERITY_MPI STREQUAL "MPICH")
        pkg_check_modules(HDF5_PC QUIET IMPORTED_TARGET hdf5-mpich)
    endif()
    if(NOT HDF5_PC_FOUND)
        pkg_check_modules(HDF5_PC QUIET IMPORTED_TARGET hdf5-serial)
    endif()
endif()
if(HDF5_PC_FOUND)
    set(HDF5_C_LIBRARIES PkgConfig::HDF5_PC)
    set(HDF5_C_INCLUDE_DIRS ${HDF5_PC_INCLUDE_DIRS})
    set(HDF5_FOUND TRUE)
    set(HDF5_FILES ${HDF5_PC_LINK_LIBRARIES})
else()
    find_package(HDF5 QUIET COMPONENTS C)
    set(HDF5_FILES ${HDF5_C_LIBRARIES})
endif()
asperity_need(HDF5_FOUND "HDF5")

# Which MPI the library of HDF5 asks the loader for.
foreach(file IN LISTS HDF5_FILES)
    if(NOT file MATCHES "libhdf5[^/]*[.]so" OR NOT EXISTS "${file}")
        continue()
    endif()
    execute_process(COMMAND ldd ${file} OUTPUT_VARIABLE text ERROR_QUIET)
    string(REGEX MATCHALL "/[^ \n]*/lib(mpi|mpich|mpi_cray)[.]so[^ \n]*" theirs "${text}")
    set(ours "")
    foreach(library IN LISTS MPI_C_LIBRARIES)
        file(REAL_PATH "${library}" library)
        list(APPEND ours ${library})
    endforeach()
    foreach(library IN LISTS theirs)
        file(REAL_PATH "${library}" real)
        if(ours AND NOT real IN_LIST ours)
            message(FATAL_ERROR
                "Two MPIs: the HDF5 found (${file}) was built with ${library}, but ${MPI_C_COMPILER} links ${ours}. "
                "A program with both would end in its first message.\n"
                "Take an HDF5 of that MPI or one without MPI (Debian: libhdf5-openmpi-dev, libhdf5-mpich-dev, "
                "libhdf5-dev; elsewhere -DHDF5_ROOT=...), or the other MPI: -DMPI_C_COMPILER=..., in a new build "
                "directory.")
        endif()
    endforeach()
endforeach()
