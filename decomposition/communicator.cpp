// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "decomposition/communicator.hpp"

#include <mpi.h>
#if __has_include(<mpi-ext.h>)
#include <mpi-ext.h> // Open MPI's own
#endif

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <stdexcept>

namespace asperity {

/// What a communicator can do; the serial one does nothing, at no cost.
class Communicator::Transport {
public:
    virtual ~Transport() = default;
    virtual int rank() const { return 0; }
    virtual int size() const { return 1; }
    virtual int local_rank() const { return 0; }
    virtual bool takes_device_memory() const { return false; }
    virtual void sum(std::span<double>) const {}
    virtual void sum(std::span<std::int64_t>) const {}
    virtual double max(double value) const { return value; }
    virtual void broadcast(std::span<std::byte>) const {}
    virtual void gather(std::span<const double> mine, std::span<const int>, std::span<double> all,
                        bool /*everywhere*/) const {
        std::copy(mine.begin(), mine.end(), all.begin());
    }
    virtual void exchange(std::span<const Message> messages) const {
        for (const Message& m : messages)
            std::copy(m.send.begin(), m.send.end(), m.receive.begin());
    }
    virtual void barrier() const {}
    [[noreturn]] virtual void abort(int exit_code) const { std::_Exit(exit_code); }
};

namespace {

class MpiTransport final : public Communicator::Transport {
public:
    explicit MpiTransport(MPI_Comm comm) : comm_(comm) {
        MPI_Comm_rank(comm_, &rank_);
        MPI_Comm_size(comm_, &size_);
        MPI_Comm machine;
        MPI_Comm_split_type(comm_, MPI_COMM_TYPE_SHARED, rank_, MPI_INFO_NULL, &machine);
        MPI_Comm_rank(machine, &local_rank_);
        MPI_Comm_free(&machine);
    }
    int rank() const override { return rank_; }
    int size() const override { return size_; }
    int local_rank() const override { return local_rank_; }
    bool takes_device_memory() const override {
#if defined(MPIX_CUDA_AWARE_SUPPORT)
        return MPIX_Query_cuda_support() == 1;
#else
        return false;
#endif
    }
    void sum(std::span<double> v) const override {
        MPI_Allreduce(MPI_IN_PLACE, v.data(), count(v.size()), MPI_DOUBLE, MPI_SUM, comm_);
    }
    void sum(std::span<std::int64_t> v) const override {
        MPI_Allreduce(MPI_IN_PLACE, v.data(), count(v.size()), MPI_INT64_T, MPI_SUM, comm_);
    }
    double max(double value) const override {
        MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_MAX, comm_);
        return value;
    }
    void broadcast(std::span<std::byte> bytes) const override {
        constexpr std::size_t chunk = std::size_t{1} << 30; // MPI counts are ints
        for (std::size_t at = 0; at < bytes.size(); at += chunk)
            MPI_Bcast(bytes.data() + at, count(std::min(chunk, bytes.size() - at)), MPI_BYTE, 0,
                      comm_);
    }
    void gather(std::span<const double> mine, std::span<const int> counts, std::span<double> all,
                bool everywhere) const override {
        std::vector<int> offsets(counts.size(), 0);
        for (std::size_t r = 1; r < counts.size(); ++r)
            offsets[r] = offsets[r - 1] + counts[r - 1];
        if (everywhere)
            MPI_Allgatherv(mine.data(), count(mine.size()), MPI_DOUBLE, all.data(), counts.data(),
                           offsets.data(), MPI_DOUBLE, comm_);
        else
            MPI_Gatherv(mine.data(), count(mine.size()), MPI_DOUBLE, all.data(), counts.data(),
                        offsets.data(), MPI_DOUBLE, 0, comm_);
    }
    void exchange(std::span<const Message> messages) const override {
        std::vector<MPI_Request> requests;
        requests.reserve(2 * messages.size());
        for (const Message& m : messages) {
            if (m.from == rank_ && m.to == rank_) continue;
            MPI_Irecv(m.receive.data(), count(m.receive.size()), MPI_DOUBLE, m.from, m.tag, comm_,
                      &requests.emplace_back());
            MPI_Isend(m.send.data(), count(m.send.size()), MPI_DOUBLE, m.to, m.tag, comm_,
                      &requests.emplace_back());
        }
        for (const Message& m : messages)
            if (m.from == rank_ && m.to == rank_)
                std::copy(m.send.begin(), m.send.end(), m.receive.begin());
        MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
    }
    void barrier() const override { MPI_Barrier(comm_); }
    [[noreturn]] void abort(int exit_code) const override {
        MPI_Abort(comm_, exit_code);
        std::_Exit(exit_code);
    }

private:
    static int count(std::size_t n) { return static_cast<int>(n); }
    MPI_Comm comm_;
    int rank_ = 0, local_rank_ = 0;
    int size_ = 1;
};

/// True if a launcher put this process among others.
bool launched_in_parallel() {
    for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK", "MPI_LOCALNRANKS"})
        if (std::getenv(name)) return true;
    return false;
}

} // namespace

Communicator::Communicator() : transport_(std::make_shared<Transport>()) {}
Communicator::Communicator(std::shared_ptr<const Transport> transport)
    : transport_(std::move(transport)) {}

int Communicator::rank() const { return transport_->rank(); }
int Communicator::size() const { return transport_->size(); }
int Communicator::local_rank() const { return transport_->local_rank(); }
bool Communicator::takes_device_memory() const { return transport_->takes_device_memory(); }
void Communicator::sum(std::span<double> values) const { transport_->sum(values); }
void Communicator::sum(std::span<std::int64_t> values) const { transport_->sum(values); }
double Communicator::max(double value) const { return transport_->max(value); }
void Communicator::broadcast(std::span<std::byte> bytes) const { transport_->broadcast(bytes); }
void Communicator::all_gather(std::span<const double> mine, std::span<const int> counts,
                              std::span<double> all) const {
    transport_->gather(mine, counts, all, true);
}
void Communicator::gather(std::span<const double> mine, std::span<const int> counts,
                          std::span<double> all) const {
    transport_->gather(mine, counts, all, false);
}
void Communicator::exchange(std::span<const Message> messages) const {
    transport_->exchange(messages);
}
void Communicator::barrier() const { transport_->barrier(); }
void Communicator::abort(int exit_code) const {
    transport_->abort(exit_code);
    std::_Exit(exit_code); // not reached; g++ does not see that through the virtual call
}

void Communicator::on_root(const std::function<void()>& work) const {
    std::exception_ptr failure;
    std::string text;
    if (root()) {
        try {
            work();
        } catch (const std::exception& e) {
            failure = std::current_exception();
            text = e.what();
            if (text.empty()) text = "unknown error on the root";
        }
    }
    std::int64_t length = static_cast<std::int64_t>(text.size());
    broadcast(std::as_writable_bytes(std::span(&length, 1)));
    if (length == 0) return;
    if (failure) std::rethrow_exception(failure);
    throw RootFailure("the root rank failed");
}

ParallelSession::ParallelSession(int& argc, char**& argv) {
    if (!launched_in_parallel()) return;
    int provided = MPI_THREAD_SINGLE;
    MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
    started_ = true;
    world_ = Communicator(std::make_shared<MpiTransport>(MPI_COMM_WORLD));
}

ParallelSession::~ParallelSession() {
    if (started_) MPI_Finalize();
}

std::string ParallelSession::library() {
    char text[MPI_MAX_LIBRARY_VERSION_STRING];
    int length = 0;
    MPI_Get_library_version(text, &length);
    std::string version(text, static_cast<std::size_t>(length));
    return version.substr(0, version.find_first_of(",\n"));
}

} // namespace asperity
