// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/equilibrium_run.hpp"

#include "engine/equilibrium.hpp"
#include "engine/recorder.hpp"
#include "engine/run_record.hpp"
#include "engine/summary.hpp"
#include "engine/units.hpp"
#include "io/error.hpp"
#include "io/progress.hpp"

#include <omp.h>

#include <chrono>
#include <fmt/format.h>
#include <limits>
#include <memory>
#include <optional>
#include <string>

namespace asperity {

namespace {

class EquilibriumRun {
public:
    EquilibriumRun(const Scene& scene, const RunOptions& options, const Communicator& ranks)
        : scene_(scene), ranks_(ranks), setup_(make_setup(scene, ranks.size())),
          surface_(scene_surface(scene)), grid_(ranks.size(), ranks.rank(), scene.surface.sites,
                                                static_cast<int>(setup_.levels.size())),
          interface_(surface_, grid_.tile(0), scene.surface.spacing, setup_.simulation.interface),
          block_(make_equilibrium(scene, setup_, ranks, grid_)),
          progress_(options.progress, !ranks.root()) {
        ranks_.on_root([&] {
            const auto place =
                io::choose_result_directory(options.out, scene.name, false); // nothing to resume
            directory_ = place.directory;
            if (!place.note.empty()) progress_.say(place.note);
            if (options.resuming())
                progress_.say("a relaxation keeps no checkpoints: starting from the beginning");
        });
    }

    int go() {
        ranks_.on_root([&] { io::make_directory(directory_); });
        try {
            if (ranks_.root())
                print_opening(stdout, scene_, setup_, surface_, grid_, omp_get_max_threads(),
                              block_->bytes() + interface_.bytes(), directory_);
            relax();
        } catch (const io::Error& e) {
            progress_.finish();
            record_failure(e);
            throw;
        }
        progress_.finish();
        write_record({});
        for (const std::string& difference : differences_)
            fmt::print("  NOT AS PLANNED: {}\n", difference);
        if (ranks_.root())
            print_summary(stdout, scene_, setup_, findings_,
                          std::numeric_limits<double>::quiet_NaN(), directory_);
        return io::exit_code::done;
    }

private:
    void relax() {
        Recorder& recorder = recorder_.emplace(directory_ + "/run.h5", surface_, ranks_, false, 0);
        const double height =
            height_of_strongest_attraction(*block_, interface_, surface_.statistics.lowest, ranks_);
        {
            const auto t = phases_.time(Phase::relax);
            findings_.zero_load =
                find_zero_load(*block_, interface_, height, scene_, setup_, progress_);
        }
        const auto t = phases_.time(Phase::output);
        if (setup_.effects.on(Effect::maps))
            recorder.fields("zero-load", block_->lowest_layer(), grid_, interface_, height);
        recorder.flush();
    }

    void record_failure(const io::Error& e) {
        io::ResultRecord::Failure failure;
        failure.exit_code = e.code();
        failure.reason = e.what();
        try {
            write_record(failure);
        } catch (const std::exception&) { // the first error is the one to report
        }
    }

    void write_record(const io::ResultRecord::Failure& failure) {
        if (!ranks_.root()) return;
        io::ResultRecord r = run_record(scene_, surface_, setup_, findings_, ranks_.size());
        r.run.wall_seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
        r.run.steps = 0;
        if (findings_.zero_load) {
            const double area = scene_.edge() * scene_.edge() / units::milli_per_unit;
            r.energy.kinetic = 0.0;
            r.energy.elastic = findings_.zero_load->elastic * area;
            r.energy.interface = -findings_.zero_load->pairwise * area;
        }
        add_phases(phases_, r);
        differences_ = add_effects(setup_.effects, books(), failure.exit_code == 0, r);
        r.failure = failure;
        io::write_result(directory_, r);
    }

    /// What was done of each effect, by this rank.
    EffectBooks books() const {
        EffectBooks done = common_books(surface_, interface_, findings_);
        const long long iterations = done[Effect::relaxation].calls;
        done[Effect::relaxation].bytes = block_->bytes();
        done[Effect::lateral] = {iterations, 2 * block_->bytes() / 3};
        done[Effect::coarse_levels] = {block_->coarse_bytes() > 0 ? iterations : 0,
                                       block_->coarse_bytes()};
        if (recorder_) done[Effect::maps] = {recorder_->maps(), 0};
        return done;
    }

    const Scene& scene_;
    Communicator ranks_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    Setup setup_;
    Surface surface_;
    ProcessGrid grid_;
    Interface interface_;
    std::unique_ptr<Equilibrium> block_;
    io::Progress progress_;
    Phases phases_;
    std::optional<Recorder> recorder_;
    Findings findings_;
    std::vector<std::string> differences_; ///< between the effects planned and done
    std::string directory_;
};

} // namespace

int run_equilibrium(const Scene& scene, const RunOptions& options,
                    const Communicator& communicator) {
    return EquilibriumRun(scene, options, communicator).go();
}

} // namespace asperity
