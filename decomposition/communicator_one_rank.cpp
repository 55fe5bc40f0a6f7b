// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// One rank, in a program built without MPI (ASPERITY_WITH_MPI=OFF): collective calls have nothing
// to do. A launcher that starts several such programs is told so (ParallelSession::unconnected()).
#include "decomposition/communicator.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <stdexcept>
#include <string>

#include <omp.h>

namespace asperity {

struct Communicator::Mpi {};

Communicator Communicator::of_fortran(int) {
    throw std::runtime_error(
        "this Asperity was built without MPI and has one rank: build it with an MPI "
        "(docs/howto/install.md), or give no communicator");
}

void Communicator::sum(std::span<double>) const {}
void Communicator::sum(std::span<std::int64_t>) const {}
double Communicator::sum_on_machine(double value) const { return value; }
double Communicator::max(double value) const { return value; }
void Communicator::broadcast(std::span<std::byte>) const {}
void Communicator::barrier() const {}
bool Communicator::all_arrive(double) const { return true; }
Communicator Communicator::split(int) const { return *this; }
void Communicator::abort(int exit_code) const { std::_Exit(exit_code); }

void Communicator::share_processors() const {
    if (!std::getenv("OMP_NUM_THREADS"))
        omp_set_num_threads(std::min(omp_get_num_procs(), omp_get_max_threads()));
}

void Communicator::all_gather(std::span<const double> mine, std::span<const int>,
                              std::span<double> all) const {
    std::copy(mine.begin(), mine.end(), all.begin());
}

void Communicator::exchange(std::span<const Message> messages) const {
    for (const Message& m : messages)
        std::copy(m.send.begin(), m.send.end(), m.receive.begin());
}

ParallelSession::ParallelSession(int&, char**&) {
    if (ranks_launched() > 1) unconnected_ = ranks_launched();
}

ParallelSession::~ParallelSession() = default;

std::string ParallelSession::library() { return no_mpi; }

} // namespace asperity
