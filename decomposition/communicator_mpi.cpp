// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The ranks of MPI. Every MPI call of the project is here.
#include "decomposition/communicator.hpp"

#include <mpi.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string>
#include <thread>
#include <utility>

#include <omp.h>
#include <sched.h>

namespace asperity {

struct Communicator::Mpi {
    MPI_Comm all, machine, meeting;
    explicit Mpi(MPI_Comm of) : all(of) {
        MPI_Comm_split_type(all, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
        MPI_Comm_dup(all, &meeting);
    }
};

namespace {

int count(std::size_t n) { return static_cast<int>(n); }

/// Waits until the requests are complete. A rank that waits for longer than messages take sleeps,
/// so that other ranks and programs have its processor: the one that it waits for may be among
/// them. A rank that has slept is woken before programs that compute.
void wait_for(std::span<MPI_Request> requests) {
    constexpr std::chrono::microseconds awake(200), asleep(50);
    using Clock = std::chrono::steady_clock;
    const Clock::time_point begin = Clock::now();
    for (int complete = 0;;) {
        MPI_Testall(count(requests.size()), requests.data(), &complete, MPI_STATUSES_IGNORE);
        if (complete) return;
        if (Clock::now() - begin > awake) std::this_thread::sleep_for(asleep);
    }
}

/// Calls begin(&request), which begins a collective operation, and waits for it.
template <class Begin>
void wait_after(const Begin& begin) {
    MPI_Request request;
    begin(&request);
    wait_for(std::span(&request, 1));
}

/// Returns the processors that this process may use as a number: FNV-1a of their mask.
std::uint64_t processors_allowed() {
    std::vector<cpu_set_t> mask(1);
    // A mask that is too short for the kernel is refused.
    while (sched_getaffinity(0, mask.size() * sizeof(cpu_set_t), mask.data()) != 0 &&
           errno == EINVAL && mask.size() < 1024)
        mask.resize(2 * mask.size());
    std::uint64_t hash = 0xcbf29ce484222325;
    for (const std::byte byte : std::as_bytes(std::span(mask)))
        hash = (hash ^ std::to_integer<std::uint64_t>(byte)) * 0x100000001b3;
    return hash;
}

} // namespace

Communicator::Communicator(std::shared_ptr<const Mpi> mpi) : mpi_(std::move(mpi)) {
    MPI_Comm_rank(mpi_->all, &rank_);
    MPI_Comm_size(mpi_->all, &size_);
    MPI_Comm_rank(mpi_->machine, &local_rank_);
}

Communicator Communicator::of_fortran(int number) {
    MPI_Comm own;
    MPI_Comm_dup(MPI_Comm_f2c(number), &own);
    return Communicator(std::make_shared<const Mpi>(own));
}

void Communicator::sum(std::span<double> v) const {
    if (!mpi_) return;
    wait_after([&](MPI_Request* r) {
        MPI_Iallreduce(MPI_IN_PLACE, v.data(), count(v.size()), MPI_DOUBLE, MPI_SUM, mpi_->all, r);
    });
}

void Communicator::sum(std::span<std::int64_t> v) const {
    if (!mpi_) return;
    wait_after([&](MPI_Request* r) {
        MPI_Iallreduce(MPI_IN_PLACE, v.data(), count(v.size()), MPI_INT64_T, MPI_SUM, mpi_->all, r);
    });
}

double Communicator::sum_on_machine(double value) const {
    if (mpi_)
        wait_after([&](MPI_Request* r) {
            MPI_Iallreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_SUM, mpi_->machine, r);
        });
    return value;
}

void Communicator::share_processors() const {
    int ranks = 1;
    if (mpi_) {
        const std::uint64_t mine = processors_allowed();
        MPI_Comm_size(mpi_->machine, &ranks);
        std::vector<std::uint64_t> all(static_cast<std::size_t>(ranks));
        MPI_Allgather(&mine, 1, MPI_UINT64_T, all.data(), 1, MPI_UINT64_T, mpi_->machine);
        ranks = static_cast<int>(std::count(all.begin(), all.end(), mine));
    }
    const int shared = std::max(1, omp_get_num_procs() / ranks);
    if (!std::getenv("OMP_NUM_THREADS"))
        omp_set_num_threads(std::min(shared, omp_get_max_threads()));
}

double Communicator::max(double value) const {
    if (mpi_)
        wait_after([&](MPI_Request* r) {
            MPI_Iallreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_MAX, mpi_->all, r);
        });
    return value;
}

void Communicator::broadcast(std::span<std::byte> bytes) const {
    if (!mpi_) return;
    constexpr std::size_t chunk = std::size_t{1} << 30; // MPI counts are ints
    for (std::size_t at = 0; at < bytes.size(); at += chunk)
        wait_after([&](MPI_Request* r) {
            MPI_Ibcast(bytes.data() + at, count(std::min(chunk, bytes.size() - at)), MPI_BYTE, 0,
                       mpi_->all, r);
        });
}

void Communicator::all_gather(std::span<const double> mine, std::span<const int> counts,
                              std::span<double> all) const {
    if (!mpi_) {
        std::copy(mine.begin(), mine.end(), all.begin());
        return;
    }
    std::vector<int> offsets(counts.size(), 0);
    for (std::size_t r = 1; r < counts.size(); ++r)
        offsets[r] = offsets[r - 1] + counts[r - 1];
    wait_after([&](MPI_Request* r) {
        MPI_Iallgatherv(mine.data(), count(mine.size()), MPI_DOUBLE, all.data(), counts.data(),
                        offsets.data(), MPI_DOUBLE, mpi_->all, r);
    });
}

void Communicator::exchange(std::span<const Message> messages) const {
    std::vector<MPI_Request> requests;
    if (mpi_) requests.reserve(2 * messages.size());
    const auto to_itself = [this](const Message& m) { return m.from == rank_ && m.to == rank_; };
    for (const Message& m : messages) {
        if (to_itself(m)) continue;
        MPI_Irecv(m.receive.data(), count(m.receive.size()), MPI_DOUBLE, m.from, m.tag, mpi_->all,
                  &requests.emplace_back());
        MPI_Isend(m.send.data(), count(m.send.size()), MPI_DOUBLE, m.to, m.tag, mpi_->all,
                  &requests.emplace_back());
    }
    for (const Message& m : messages)
        if (to_itself(m)) std::copy(m.send.begin(), m.send.end(), m.receive.begin());
    if (requests.empty()) return;
    wait_for(requests);
}

void Communicator::barrier() const {
    if (mpi_) wait_after([&](MPI_Request* r) { MPI_Ibarrier(mpi_->all, r); });
}

bool Communicator::all_arrive(double seconds) const {
    if (!mpi_) return true;
    using Clock = std::chrono::steady_clock;
    const Clock::time_point start = Clock::now();
    MPI_Request all;
    MPI_Ibarrier(mpi_->meeting, &all);
    for (;;) {
        int they_have = 0;
        MPI_Test(&all, &they_have, MPI_STATUS_IGNORE);
        if (they_have) return true;
        if (std::chrono::duration<double>(Clock::now() - start).count() >= seconds) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
}

Communicator Communicator::split(int colour) const {
    if (!mpi_) return *this;
    MPI_Comm part;
    MPI_Comm_split(mpi_->all, colour, rank_, &part);
    return Communicator(std::make_shared<const Mpi>(part));
}

void Communicator::abort(int exit_code) const {
    if (mpi_) MPI_Abort(mpi_->all, exit_code);
    std::_Exit(exit_code);
}

ParallelSession::ParallelSession(int& argc, char**& argv) {
    if (!launched_in_parallel()) return;
    int provided = MPI_THREAD_SINGLE;
    MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
    started_ = true;
    world_ = Communicator(std::make_shared<const Communicator::Mpi>(MPI_COMM_WORLD));
    if (world_.size() == 1 && ranks_launched() > 1) unconnected_ = ranks_launched();
}

ParallelSession::~ParallelSession() {
    if (started_) MPI_Finalize();
}

std::string ParallelSession::library() {
    char text[MPI_MAX_LIBRARY_VERSION_STRING];
    int length = 0;
    MPI_Get_library_version(text, &length);
    // "Open MPI v4.1.4, package: ...", "MPICH Version:      4.0.2\nMPICH Release date: ..."
    std::string version(text, static_cast<std::size_t>(length));
    version = version.substr(0, version.find_first_of(",\n"));
    if (const std::size_t at = version.find(" Version:"); at != std::string::npos)
        version.replace(at, version.find_first_not_of(" \t", at + 9) - at, " ");
    return version;
}

} // namespace asperity
