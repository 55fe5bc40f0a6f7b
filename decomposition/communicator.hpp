// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The ranks of a run behind one value type.
//
// A run started by mpirun uses MPI; a run started alone never initialises it: there, what all ranks
// do together costs nothing. Every MPI call of the project is in communicator.cpp. All member
// functions but abort() and those that only tell (rank, size and the like) are collective: every
// rank calls them in the same order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace asperity {

/// Thrown on the other ranks where the root failed; the root has the reason.
struct RootFailure : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// One message to and from a neighbour in an exchange. The spans must stay valid until it returns.
struct Message {
    int to = 0;
    int from = 0;
    int tag = 0;
    std::span<const double> send;
    std::span<double> receive;
};

class Communicator {
public:
    /// One rank, no MPI.
    Communicator() = default;
    /// The ranks of a communicator in a program that has started MPI itself, by its number in
    /// Fortran (MPI_Comm_c2f). They get one of their own, until MPI ends. Collective.
    static Communicator of_fortran(int number);

    int rank() const { return rank_; }
    int size() const { return size_; }
    /// Number of this rank among those of its machine.
    int local_rank() const { return local_rank_; }
    bool root() const { return rank() == 0; }

    /// Element-wise sum over the ranks, in place. The values must be such that their sum is exact
    /// in any order (ExactSum bins, counts).
    void sum(std::span<double> values) const;
    void sum(std::span<std::int64_t> values) const;
    /// Over the ranks of this machine.
    double sum_on_machine(double value) const;
    /// Threads of this rank, where OMP_NUM_THREADS is not set: the processors it may use, shared
    /// with the ranks of its machine that may use the same ones; never more than it has.
    /// Collective.
    void share_processors() const;
    /// The greatest of the ranks' values.
    double max(double value) const;
    /// Root's bytes to all.
    void broadcast(std::span<std::byte> bytes) const;
    void broadcast(std::span<double> values) const { broadcast(std::as_writable_bytes(values)); }
    /// Every rank's values, one after the other in rank order; counts[r] is rank r's share.
    void all_gather(std::span<const double> mine, std::span<const int> counts,
                    std::span<double> all) const;
    /// As all_gather, on the root only.
    void gather(std::span<const double> mine, std::span<const int> counts,
                std::span<double> all) const;
    /// All messages at once; returns when all have arrived. A message to oneself is a copy.
    void exchange(std::span<const Message> messages) const;
    void barrier() const;
    /// Whether all ranks call this within so many seconds. May be called while others are, or wait,
    /// in another of these functions: it has messages of its own. After false only abort() is left.
    bool all_come(double seconds) const;
    /// The ranks that give the same colour, in the same order, until MPI ends.
    Communicator split(int colour) const;
    /// Ends all ranks with this exit code, now.
    [[noreturn]] void abort(int exit_code) const;

    /// Runs work on the root. If it throws there, every rank throws: the root what it caught, the
    /// others RootFailure, so that all end together and the root alone reports the reason.
    void on_root(const std::function<void()>& work) const;

private:
    friend class ParallelSession;
    /// MPI's communicators: of all ranks, of those of this machine, of all_come().
    struct Mpi;
    explicit Communicator(std::shared_ptr<const Mpi> mpi);
    void gather(std::span<const double> mine, std::span<const int> counts, std::span<double> all,
                bool everywhere) const;

    std::shared_ptr<const Mpi> mpi_; ///< none: one rank
    int rank_ = 0, size_ = 1, local_rank_ = 0;
};

/// True if a launcher says that it has started more than one rank: mpirun of Open MPI, that of
/// MPICH and its like, or srun. Within a batch job SLURM sets SLURM_PROCID and SLURM_NTASKS for the
/// one process of the script too, but SLURM_STEP_NUM_TASKS for what srun starts only. PMIx alone
/// does not tell how many there are: then MPI has to be asked. python/asperity/terminal.py has the
/// same rule.
bool launched_in_parallel();

/// Starts MPI if the process is launched_in_parallel(), and ends it. One in main(), which looks at
/// unconnected().
class ParallelSession {
public:
    ParallelSession(int& argc, char**& argv);
    ~ParallelSession();
    ParallelSession(const ParallelSession&) = delete;
    ParallelSession& operator=(const ParallelSession&) = delete;

    const Communicator& world() const { return world_; }
    /// The number of processes that the launcher says it has started, where MPI has connected none
    /// of them (it is the launcher of another MPI, or srun without the PMI of this one); else 0.
    int unconnected() const { return unconnected_; }
    /// Whether the launcher counts this process as the first.
    static bool first_started();
    /// Name and version of the MPI library, or "none (one process)".
    static std::string library();

private:
    bool started_ = false;
    int unconnected_ = 0;
    Communicator world_;
};

} // namespace asperity
