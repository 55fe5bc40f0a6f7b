// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What every run has, whatever it does in between: the scene made ready, a result directory, a
// progress display, signals, the wall limit and checkpoints, what was found, result.json and the
// summary.
//
// A kind of run derives from it and follows its path: run.cpp in time, equilibrium_run.cpp without.
#pragma once

#include "decomposition/communicator.hpp"
#include "decomposition/process_grid.hpp"
#include "engine/equilibrium/findings.hpp"
#include "engine/run/checkpoint.hpp"
#include "engine/run/curve.hpp"
#include "engine/run/recorder.hpp"
#include "engine/run/run.hpp"
#include "engine/setup/setup.hpp"
#include "io/error.hpp"
#include "io/progress.hpp"
#include "io/result.hpp"

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace asperity {

class RunFrame {
public:
    RunFrame(const Scene& scene, const RunOptions& options, const Communicator& ranks);
    virtual ~RunFrame() = default;
    RunFrame(const RunFrame&) = delete;
    RunFrame& operator=(const RunFrame&) = delete;

    /// The whole run. Returns the exit code.
    int go();

protected:
    // What a kind of run knows.
    virtual void follow() = 0; ///< to the end, or until stopped_ says why not
    virtual std::size_t bytes() const = 0;
    virtual double energy_residual() const = 0; ///< NaN: there is no balance
    virtual Phases& phases() = 0;
    virtual void complete(io::ResultRecord& record) const = 0; ///< steps and energies
    virtual void write_state(const std::string& path) = 0;     ///< a checkpoint
    virtual std::string position() const = 0;                  ///< "step 1200"

    enum class Due { nothing, save, stop };
    /// Signals, the wall limit, checkpoints: what has to be done now. The root decides for all;
    /// stopped_ is set with stop. Collective.
    Due due();
    /// Does it, between two steps. True: the run must end here.
    bool time_to_stop();
    void save_checkpoint();
    void say_where_stopped();
    /// The checkpoint to go on from, if one was asked for and is there. Its series is brought
    /// along.
    std::optional<std::string> checkpoint_to_take_up();
    void open_recorder(bool taken_up);

    /// Maps that the scene asks for along the path: now, if this step is one of every so many; and
    /// those of the largest attraction of the pull-off, kept until they are written. Collective.
    void watch_fields(long long step, Leg leg, double attraction,
                      const VectorPlane<const double>& layer, const Interface& interface,
                      double reference_height);

    /// The numbers of the run for a checkpoint, and back: rows written, results found.
    RunScalars run_scalars();
    void restore_run(const RunScalars& scalars);

    /// Done of the whole way from start_height (above the substrate's zero), 0 to 1, as far as the
    /// top plane's displacement tells.
    double way_done(Leg leg, double top, double start_height) const;
    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

    const Scene& scene_;
    const std::optional<long long> field_stride_ = scene_.field_stride();
    const RunOptions& options_;
    Communicator ranks_;
    Setup setup_;
    Surface surface_;
    ProcessGrid grid_;
    io::Progress progress_;
    std::optional<Recorder> recorder_;
    Findings findings_;
    std::string directory_, fingerprint_, stopped_;

private:
    /// Of this rank with all its threads, from the first start of the run on.
    double processor_seconds() const;
    void choose_directory();
    std::string fingerprint() const;
    void bring_series(const std::string& checkpoint) const;
    void write_strongest();
    void record_failure(const io::Error& e);
    void write_record(const io::ResultRecord::Failure& failure);

    /// The lowest layer where the pull-off attracted most.
    struct Strongest {
        double attraction = 0.0, reference_height = 0.0;
        const Interface* interface = nullptr; ///< null: there is nothing to be written
        VectorField<double> layer;
    } strongest_;

    PathSeries curve_; ///< read back at the end, on the root
    std::uint64_t rows_at_start_ = 0;
    double processor_before_ = 0.0; ///< s, before the checkpoint that was taken up
    double last_checkpoint_ = 0.0;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

} // namespace asperity
