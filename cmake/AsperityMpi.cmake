# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
# One MPI, and the launcher that belongs to it: ASPERITY_MPI is "Open MPI", "MPICH" (with what descends
# from it: Intel MPI, MVAPICH, Cray) or "another"; ASPERITY_MPIRUN is the launcher with the options that
# let tests start more ranks than there are cores, to be followed by -n RANKS.
include(CheckSymbolExists)
find_package(MPI QUIET COMPONENTS C)
asperity_need(MPI_C_FOUND "MPI")
if(MPI_C_FOUND AND MPI_C_VERSION VERSION_LESS 3.0)
    message(FATAL_ERROR "Asperity needs MPI 3.0; ${MPI_C_COMPILER} has ${MPI_C_VERSION}. "
                        "Name another one: -DMPI_C_COMPILER=mpicc, in a new build directory.")
endif()

set(CMAKE_REQUIRED_LIBRARIES MPI::MPI_C)
if(MPI_C_FOUND)
    check_symbol_exists(OMPI_MAJOR_VERSION mpi.h ASPERITY_OPEN_MPI)
    check_symbol_exists(MPICH_VERSION mpi.h ASPERITY_MPICH)
    check_symbol_exists(I_MPI_VERSION mpi.h ASPERITY_INTEL_MPI)
endif()
unset(CMAKE_REQUIRED_LIBRARIES)
set(ASPERITY_MPI "another")
if(ASPERITY_OPEN_MPI)
    set(ASPERITY_MPI "Open MPI")
    set(suffix openmpi)
elseif(ASPERITY_MPICH OR ASPERITY_INTEL_MPI)
    set(ASPERITY_MPI "MPICH")
    set(suffix mpich)
endif()

# asperity_launches(<variable> <program>)
#   The MPI whose launcher that program is, of the two above; else "another".
function(asperity_launches variable program)
    execute_process(COMMAND ${program} --version OUTPUT_VARIABLE text ERROR_VARIABLE text TIMEOUT 20)
    set(${variable} "another" PARENT_SCOPE)
    if(text MATCHES "OpenRTE|Open MPI|PRTE|open-mpi.org")
        set(${variable} "Open MPI" PARENT_SCOPE)
    elseif(text MATCHES "HYDRA|MPICH|Intel")
        set(${variable} "MPICH" PARENT_SCOPE)
    endif()
endfunction()

# CMake takes the first mpiexec in PATH, which may be that of another MPI.
if(MPI_C_FOUND AND MPIEXEC_EXECUTABLE AND NOT ASPERITY_MPI STREQUAL "another")
    asperity_launches(launched ${MPIEXEC_EXECUTABLE})
    if(NOT launched STREQUAL ASPERITY_MPI AND NOT launched STREQUAL "another")
        get_filename_component(beside "${MPI_C_COMPILER}" DIRECTORY)
        find_program(ASPERITY_OWN_LAUNCHER NAMES mpiexec.${suffix} mpirun.${suffix} mpiexec HINTS ${beside})
        if(ASPERITY_OWN_LAUNCHER)
            asperity_launches(launched ${ASPERITY_OWN_LAUNCHER})
        endif()
        if(launched STREQUAL ASPERITY_MPI)
            set(MPIEXEC_EXECUTABLE ${ASPERITY_OWN_LAUNCHER} CACHE FILEPATH "The launcher of the MPI" FORCE)
        else()
            message(WARNING "${MPIEXEC_EXECUTABLE} is the launcher of ${launched}, but the MPI is ${ASPERITY_MPI} "
                            "(${MPI_C_COMPILER}): set MPIEXEC_EXECUTABLE for tests on several ranks")
        endif()
    endif()
endif()
set(ASPERITY_MPIRUN ${MPIEXEC_EXECUTABLE})
if(ASPERITY_MPI STREQUAL "Open MPI")
    list(APPEND ASPERITY_MPIRUN --oversubscribe --allow-run-as-root --bind-to none)
endif()
if(MPI_C_FOUND)
    message(STATUS "MPI: ${ASPERITY_MPI}, ${MPI_C_COMPILER}, ${MPIEXEC_EXECUTABLE}")
endif()
