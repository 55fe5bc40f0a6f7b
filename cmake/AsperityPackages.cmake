# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
# Everything comes from the distribution; nothing is downloaded at configure time.
find_package(OpenMP REQUIRED COMPONENTS CXX)
find_package(MPI REQUIRED COMPONENTS C)
find_package(fmt REQUIRED)
find_package(PkgConfig REQUIRED)
find_package(Boost 1.74 REQUIRED)
pkg_check_modules(FFTW REQUIRED IMPORTED_TARGET fftw3)
pkg_check_modules(FFTWF REQUIRED IMPORTED_TARGET fftw3f)

# HDF5: the build that matches Open MPI where there is one. The C API alone is used. pkg-config first:
# CMake's own search runs h5pcc, which fails where a path has a space in it.
pkg_check_modules(HDF5_PC IMPORTED_TARGET hdf5-openmpi)
if(HDF5_PC_FOUND)
    set(HDF5_C_LIBRARIES PkgConfig::HDF5_PC)
    set(HDF5_C_INCLUDE_DIRS ${HDF5_PC_INCLUDE_DIRS})
else()
    set(HDF5_PREFER_PARALLEL ON)
    find_package(HDF5 REQUIRED COMPONENTS C)
endif()

find_package(tomlplusplus REQUIRED)
find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)
if(ASPERITY_TESTS)
    find_package(GTest REQUIRED)
endif()
if(ASPERITY_PERF)
    find_package(benchmark REQUIRED)
endif()
