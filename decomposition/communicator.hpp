// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The ranks of a run behind one value type.
//
// A run started by mpirun uses MPI; a run of one process never initialises MPI, and collective
// calls cost nothing. Every MPI call of the project is in communicator_mpi.cpp; a program without
// MPI (ASPERITY_WITH_MPI=OFF) has communicator_one_rank.cpp instead. All member functions are
// collective (every rank calls them in the same order) except abort() and those that return a
// property (rank(), size(), root(), local_rank()).
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

/// Error of the other ranks if work failed on the root, which throws the reason.
struct RootFailure : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// One message to a neighbour and one from a neighbour in an exchange. The spans must stay valid
/// until the exchange returns.
struct Message {
    int to = 0;   ///< rank that receives `send`
    int from = 0; ///< rank whose message goes to `receive`
    int tag = 0;
    std::span<const double> send;
    std::span<double> receive;
};

/// The ranks of a run.
class Communicator {
public:
    /// Makes a communicator of one rank, without MPI.
    Communicator() = default;
    /// Returns a duplicate of a communicator of a program that has started MPI itself. number: its
    /// Fortran handle (MPI_Comm_c2f). The duplicate lasts until MPI ends. Collective.
    static Communicator of_fortran(int number);

    int rank() const { return rank_; }
    int size() const { return size_; }
    /// Returns the index of this rank among the ranks of its machine.
    int local_rank() const { return local_rank_; }
    bool root() const { return rank() == 0; }

    /// Sums each element over the ranks, in place. The values must be such that their sum is exact
    /// in any order (bins of ExactSum, counts).
    void sum(std::span<double> values) const;
    void sum(std::span<std::int64_t> values) const;
    /// Returns the sum of the ranks' values over the ranks of this machine.
    double sum_on_machine(double value) const;
    /// Sets the number of threads of this rank, unless OMP_NUM_THREADS is set: its share of the
    /// processors that it may use, divided among the ranks of the machine that may use the same
    /// processors. Never increases the number. Collective.
    void share_processors() const;
    /// Returns the largest of the ranks' values.
    double max(double value) const;
    /// Sends the root's bytes to all ranks.
    void broadcast(std::span<std::byte> bytes) const;
    void broadcast(std::span<double> values) const { broadcast(std::as_writable_bytes(values)); }
    void broadcast(std::string& text) const; ///< sends the root's text to all ranks
    /// Gathers every rank's values on all ranks, in rank order. counts[r]: number of values of rank
    /// r.
    void all_gather(std::span<const double> mine, std::span<const int> counts,
                    std::span<double> all) const;
    /// Exchanges all messages at once and returns when all have arrived. A message to oneself is a
    /// copy.
    void exchange(std::span<const Message> messages) const;
    void barrier() const; ///< waits for all ranks
    /// Returns true if all ranks call this function within `seconds`. Uses a separate MPI
    /// communicator, so that other ranks may be in another collective function meanwhile. If the
    /// result is false, only abort() may follow.
    bool all_arrive(double seconds) const;
    /// Returns a communicator of the ranks that pass the same colour, in the same order. The result
    /// lasts until MPI ends.
    Communicator split(int colour) const;
    /// Ends all ranks at once with this exit code.
    [[noreturn]] void abort(int exit_code) const;

    /// Calls work() on the root. If work() throws, every rank throws, the root the same exception,
    /// the others RootFailure, so that all ranks end together and only the root reports the reason.
    void on_root(const std::function<void()>& work) const;

private:
    friend class ParallelSession;
    /// MPI communicators of all ranks, of the ranks of this machine, and of all_arrive().
    struct Mpi;
    explicit Communicator(std::shared_ptr<const Mpi> mpi);

    std::shared_ptr<const Mpi> mpi_; ///< MPI communicators; nullptr: one rank without MPI
    int rank_ = 0, size_ = 1, local_rank_ = 0;
};

/// Returns true if the environment shows that a launcher has started more than one rank: mpirun of
/// Open MPI, of MPICH or its derivatives, or srun. In a batch job SLURM sets SLURM_PROCID and
/// SLURM_NTASKS also for the single process of the script, but SLURM_STEP_NUM_TASKS only for
/// processes of srun. The variables of PMIx do not contain the number of ranks; the result is then
/// true, and MPI decides. python/asperity/terminal.py has the same rule.
bool launched_in_parallel();

/// Returns the number of ranks that a launcher's environment variables state; 0 if there are none.
int ranks_launched();

/// Name of the MPI library of a program that was built without MPI.
inline constexpr const char* no_mpi = "none (one process)";

/// Session of MPI, from the start to the end of MPI. main() makes one and checks unconnected().
class ParallelSession {
public:
    /// Starts MPI if launched_in_parallel().
    ParallelSession(int& argc, char**& argv);
    ~ParallelSession();
    ParallelSession(const ParallelSession&) = delete;
    ParallelSession& operator=(const ParallelSession&) = delete;

    const Communicator& world() const { return world_; }
    /// Returns the number of processes that the launcher has started if MPI has not connected them,
    /// because the launcher belongs to another MPI or is srun without the PMI of this MPI;
    /// otherwise 0.
    int unconnected() const { return unconnected_; }
    /// Returns true if the launcher's environment variables number this process as the first.
    static bool first_started();
    /// Returns name and version of the MPI library, or no_mpi.
    static std::string library();

private:
    bool started_ = false;
    int unconnected_ = 0;
    Communicator world_;
};

} // namespace asperity
