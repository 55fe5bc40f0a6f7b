// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What does it cost that the program could do more? A scene with every effect off (no damping, no
// temperature, no tail, one level) against a loop written by hand over the same kernels: forces of
// the interface, kick and drift, periodic halos, and the two sums that a drive needs. Both are
// timed by turns; the ratio is that of the shortest.
//
//     build/release/perf/minimal_loop [sites] [layers] [seconds]
#include "engine/scene/scene.hpp"
#include "engine/setup/case.hpp"

#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>

using namespace asperity;

namespace {

using Clock = std::chrono::steady_clock;

/// A lattice of one rank, its loop spelt out.
class ByHand {
public:
    ByHand(const SimulationOptions& options, const Surface& surface, double height)
        : options_(options), tile_{0, 0, options.block.sites, options.block.sites,
                                   options.block.sites},
          cells_(options.block.thickness), height_(height),
          interface_(surface, tile_, options.block.spacing, options.interface),
          u_(tile_, cells_ + 1), v_(tile_, cells_), force_(tile_, 1), top_(tile_, 1),
          lower_(make_stencil(options.block.elasticity(0), Face::lower)),
          inner_(make_stencil(options.block.elasticity(0), Face::inner)),
          upper_(make_stencil(options.block.elasticity(0), Face::upper)) {
        kick_.kick = options.dt / options.block.atom_mass;
        for (int z = 0; z < cells_; ++z)
            for (int y = 0; y < tile_.ny; ++y)
                for (int x = 0; x < tile_.nx; ++x)
                    v_.z.view()(x, y, z) = -options.drive.velocity;
    }

    void step() {
        const InterfaceSums sums =
            interface_.sweep(std::as_const(u_).plane(0), force_.plane(0), height_, {});
        ExactSum lowest, pulled;
        const ElasticKernels& kernels = elastic_kernels();
        const ElasticLevel level = {cells_,          u_.view(),     v_.view(),
                                    force_.plane(0), top_.plane(0), lower_,
                                    inner_,          upper_,        {}};
        const LevelKicks kicks = {kick_, kick_, kick_, cells_};
        const auto z = std::as_const(u_).plane(0).z;
        const int n = tile_.nx;
#pragma omp parallel
        {
            ExactSum mine;
            KickSums none;
            // Rows drift behind the forces; the ends of a thread's share when all are done.
            const int bands = (n + 7) / 8, thread = omp_get_thread_num(),
                      threads = omp_get_num_threads();
            const int begin = std::min(n, 8 * (bands * thread / threads)),
                      end = std::min(n, 8 * (bands * (thread + 1) / threads));
            for (int y = begin; y < end; y += 8) {
                kernels.sum(z, y, std::min(end, y + 8), mine);
                kernels.advance(level, kicks, options_.dt, {y, std::min(end, y + 8), begin, end},
                                {}, none);
            }
#pragma omp barrier
            kernels.drift(level, options_.dt, begin, std::min(begin + 1, end));
            kernels.drift(level, options_.dt, std::max(end - 1, begin + 1), end);
#pragma omp critical
            lowest.merge(mine);
        }
        kernels.sum(std::as_const(top_).plane(0).z, 0, n, pulled);
        top_displacement_ -= options_.dt * options_.drive.velocity;
        wrap();
        force = sums.force_z.value();
        mean_height = height_ + lowest.value() / (static_cast<double>(n) * n);
        top_force = pulled.value();
    }

    double force = 0.0, mean_height = 0.0, top_force = 0.0;

private:
    /// Halos of the moving planes; the top plane.
    void wrap() {
        constexpr int h = halo_width;
        const int n = tile_.nx;
        for (Field<double>* f : {&u_.x, &u_.y, &u_.z}) {
            for (int z = 0; z < cells_; ++z) {
                const PlaneView<double> p = f->plane(z);
                for (int y = 0; y < n; ++y)
                    for (int i = 0; i < h; ++i)
                        p(-1 - i, y) = p(n - 1 - i, y), p(n + i, y) = p(i, y);
                for (int i = 0; i < h; ++i) {
                    std::copy(p.line(n - 1 - i) - h, p.line(n - 1 - i) + n + h, p.line(-1 - i) - h);
                    std::copy(p.line(i) - h, p.line(i) + n + h, p.line(n + i) - h);
                }
            }
            const PlaneView<double> p = f->plane(cells_);
            if (f == &u_.z)
                for (int y = -h; y < n + h; ++y)
                    std::fill(p.line(y) - h, p.line(y) + n + h, top_displacement_);
        }
    }

    SimulationOptions options_;
    Tile tile_;
    int cells_;
    double height_, top_displacement_ = 0.0;
    Interface interface_;
    VectorField<double> u_, v_, force_, top_;
    Stencil lower_, inner_, upper_;
    Kick kick_;
};

} // namespace

int main(int argc, char** argv) {
    const std::string sites = argc > 1 ? argv[1] : "128", layers = argc > 2 ? argv[2] : "8";
    const double seconds = argc > 3 ? std::atof(argv[3]) : 10.0;
    const Scene scene = read_scene_text(
        "[surface]\nrms = 1.0\n[block]\nmodel = \"lattice\"\n[drive]\ndamping = 0\n", "minimal",
        {"surface.sites=" + sites, "block.thickness=" + layers});
    const Case setup = resolve(scene);
    const Surface surface = surface_of(resolve(scene));
    const double height = surface.statistics.highest + 3.0; // in contact
    const ProcessGrid grid(1, 0, scene.surface.sites, 1);

    constexpr int steps = 8, turns = 12;
    double program = 1e300, hand = 1e300;
    const auto timed = [](auto&& step) {
        const auto start = Clock::now();
        for (int n = 0; n < steps; ++n)
            step();
        return std::chrono::duration<double>(Clock::now() - start).count() / steps;
    };
    // Where the pages of an array lie decides up to a fifth of its speed: both are made anew many
    // times, in turns the one and the other first.
    const auto start = Clock::now();
    int rounds = 0;
    bool same = true;
    for (; std::chrono::duration<double>(Clock::now() - start).count() < seconds; ++rounds) {
        std::optional<Simulation> simulation;
        std::optional<ByHand> by_hand;
        for (int turn : {rounds % 2, 1 - rounds % 2})
            if (turn)
                simulation.emplace(setup.simulation, surface, Communicator(), grid);
            else
                by_hand.emplace(setup.simulation, surface, height);
        simulation->start(height);
        for (int turn = 0; turn < turns; ++turn) {
            program = std::min(program, timed([&] { simulation->step(false); }));
            hand = std::min(hand, timed([&] { by_hand->step(); }));
        }
        const StepRecord& now = simulation->now();
        same = same && now.force == by_hand->force && now.mean_height == by_hand->mean_height &&
               now.top_force == by_hand->top_force;
    }
    std::printf("%s x %s sites, %s layers, %d rounds of %d turns of %d steps: %s\n", sites.c_str(),
                sites.c_str(), layers.c_str(), rounds, turns, steps,
                same ? "the same motion" : "NOT THE SAME MOTION");
    std::printf("a step: program %.1f us, by hand %.1f us, ratio %.4f\n", 1e6 * program, 1e6 * hand,
                program / hand);
    return same ? 0 : 1;
}
