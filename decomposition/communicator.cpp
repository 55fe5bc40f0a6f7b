// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The part without MPI. The other functions are in communicator_mpi.cpp or, in a build without MPI,
// in communicator_one_rank.cpp.
#include "decomposition/communicator.hpp"

#include <cstdlib>
#include <exception>
#include <span>
#include <utility>

namespace asperity {

namespace {

/// Information of a launcher about this process; 0 ranks: none.
struct Launched {
    int ranks = 0, rank = 0;
};
Launched launched() {
    constexpr std::pair<const char*, const char*> names[] = {
        {"OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK"},
        {"PMI_SIZE", "PMI_RANK"},
        {"SLURM_STEP_NUM_TASKS", "SLURM_PROCID"}};
    for (const auto& [size, rank] : names)
        if (const char* ranks = std::getenv(size)) {
            const char* own = std::getenv(rank);
            return {std::atoi(ranks), own ? std::atoi(own) : 0};
        }
    return {};
}

} // namespace

int ranks_launched() { return launched().ranks; }

bool launched_in_parallel() {
    const int ranks = ranks_launched();
    return ranks > 0 ? ranks > 1 : std::getenv("PMIX_RANK") != nullptr;
}

void Communicator::broadcast(std::string& text) const {
    std::uint64_t size = text.size();
    broadcast(std::as_writable_bytes(std::span(&size, 1)));
    text.resize(size);
    broadcast(std::as_writable_bytes(std::span(text)));
}

void Communicator::on_root(const std::function<void()>& work) const {
    std::exception_ptr failure;
    if (root()) {
        try {
            work();
        } catch (const std::exception&) {
            failure = std::current_exception();
        }
    }
    bool failed = failure != nullptr;
    broadcast(std::as_writable_bytes(std::span(&failed, 1)));
    if (failure) std::rethrow_exception(failure);
    if (failed) throw RootFailure("the root rank failed");
}

bool ParallelSession::first_started() { return launched().rank == 0; }

} // namespace asperity
