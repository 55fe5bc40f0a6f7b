// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The ranks of a run behind one value type.
//
// A run started by mpirun uses MPI; a run started alone never initialises it: there, collective
// calls cost nothing. Every MPI call of the project is in communicator_mpi.cpp; a program without
// MPI (ASPERITY_WITH_MPI=OFF) has communicator_one_rank.cpp in its place. All member functions are
// collective (every rank calls them in the same order) except abort() and those that return a
// property (rank, size and the like).
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

/// Error on the other ranks if work failed on the root; the root has the reason.
struct RootFailure : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// One message to and from a neighbour in an exchange. The spans must stay valid until the exchange
/// returns.
struct Message {
    int to = 0;
    int from = 0;
    int tag = 0;
    std::span<const double> send;
    std::span<double> receive;
};

/// The ranks of a run.
class Communicator {
public:
    /// Makes one rank without MPI.
    Communicator() = default;
    /// Returns a copy of a communicator of a program that has started MPI itself, by its number in
    /// Fortran (MPI_Comm_c2f). The copy lasts until MPI ends. Collective.
    static Communicator of_fortran(int number);

    int rank() const { return rank_; }
    int size() const { return size_; }
    /// Returns the number of this rank among those of its machine.
    int local_rank() const { return local_rank_; }
    bool root() const { return rank() == 0; }

    /// Sums each element over the ranks, in place. The sum of the values must be exact in any order
    /// (ExactSum bins, counts).
    void sum(std::span<double> values) const;
    void sum(std::span<std::int64_t> values) const;
    /// Returns the sum of the values of the ranks of this machine.
    double sum_on_machine(double value) const;
    /// Sets the number of threads of this rank, unless OMP_NUM_THREADS is set: the processors it
    /// may use, shared with the ranks of its machine that may use the same ones; never more than it
    /// has. Collective.
    void share_processors() const;
    /// Returns the largest of the ranks' values.
    double max(double value) const;
    /// Sends the root's bytes to all ranks.
    void broadcast(std::span<std::byte> bytes) const;
    void broadcast(std::span<double> values) const { broadcast(std::as_writable_bytes(values)); }
    /// Gathers every rank's values on all ranks, in rank order; counts[r] is rank r's share.
    void all_gather(std::span<const double> mine, std::span<const int> counts,
                    std::span<double> all) const;
    /// Gathers every rank's values on the root, in rank order; counts[r] is rank r's share.
    void gather(std::span<const double> mine, std::span<const int> counts,
                std::span<double> all) const;
    /// Exchanges all messages at once and returns when all have arrived. A message to oneself is a
    /// copy.
    void exchange(std::span<const Message> messages) const;
    void barrier() const;
    /// Returns true if all ranks call this function within so many seconds. It has messages of its
    /// own, so other ranks may be in another of these functions meanwhile. After false only abort()
    /// may be called.
    bool all_arrive(double seconds) const;
    /// Returns the ranks that give the same colour, in the same order. The result lasts until MPI
    /// ends.
    Communicator split(int colour) const;
    /// Ends all ranks at once with this exit code.
    [[noreturn]] void abort(int exit_code) const;

    /// Runs work on the root. If it throws there, every rank throws: the root its own error, the
    /// others RootFailure, so that all end together and the root alone reports the reason.
    void on_root(const std::function<void()>& work) const;

private:
    friend class ParallelSession;
    /// MPI's communicators: of all ranks, of those of this machine, of all_arrive().
    struct Mpi;
    explicit Communicator(std::shared_ptr<const Mpi> mpi);
    void gather(std::span<const double> mine, std::span<const int> counts, std::span<double> all,
                bool everywhere) const;

    std::shared_ptr<const Mpi> mpi_; ///< communicators of MPI; null: one rank
    int rank_ = 0, size_ = 1, local_rank_ = 0;
};

/// Returns true if a launcher says that it has started more than one rank: mpirun of Open MPI, that
/// of MPICH and its like, or srun. Within a batch job SLURM sets SLURM_PROCID and SLURM_NTASKS for
/// the one process of the script too, but SLURM_STEP_NUM_TASKS only for the processes of srun. PMIx
/// alone does not tell how many there are: then MPI has to be asked. python/asperity/terminal.py
/// has the same rule.
bool launched_in_parallel();

/// Returns the number of ranks that a launcher says it has started; 0 if no launcher says so.
int ranks_launched();

/// Name of the MPI library of a program that was built without MPI.
inline constexpr const char* no_mpi = "none (one process)";

/// Session of MPI: starts MPI if the process is launched_in_parallel(), and ends it. main() makes
/// one and checks unconnected().
class ParallelSession {
public:
    ParallelSession(int& argc, char**& argv);
    ~ParallelSession();
    ParallelSession(const ParallelSession&) = delete;
    ParallelSession& operator=(const ParallelSession&) = delete;

    const Communicator& world() const { return world_; }
    /// Returns the number of processes that the launcher says it has started if MPI has connected
    /// none of them (the launcher belongs to another MPI, or is srun without the PMI of this one);
    /// otherwise 0.
    int unconnected() const { return unconnected_; }
    /// Returns true if the launcher counts this process as the first.
    static bool first_started();
    /// Returns name and version of the MPI library, or no_mpi.
    static std::string library();

private:
    bool started_ = false;
    int unconnected_ = 0;
    Communicator world_;
};

} // namespace asperity
