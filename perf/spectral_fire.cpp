// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What does the spectral block's own relaxation gain over FIRE? Both start from the same state, use
// the same block, sweep, transforms and preconditioner (S(q) + k)^-1, and end at the same largest
// force of 1e-4 eV/Å.
//
//     spectral_fire SITES RMS [k of FIRE = 3] [its largest move = 1.0 Å] [own = both]
//
// FIRE (Bitzek et al. 2006) in the metric of the preconditioner, its vectors in single precision as
// own's are, with settings tuned for it (docs/relaxation.md). It is a baseline, no part of the
// product. Give "own" as fifth argument to leave it out (peak memory is
// then the product's).
#include "rough_contact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>

using namespace asperity;

namespace {

constexpr double tolerance = 1e-4; // eV/Å

double largest(const SiteField<float>& field) {
    const PlaneView<const float> x = field[0].plane(0), y = field[1].plane(0),
                                 z = field[2].plane(0);
    float longest = 0.0f;
#pragma omp parallel for schedule(static) reduction(max : longest)
    for (int j = 0; j < x.ny; ++j)
        for (int i = 0; i < x.nx; ++i)
            longest = std::max(longest, x(i, j) * x(i, j) + y(i, j) * y(i, j) + z(i, j) * z(i, j));
    return std::sqrt(static_cast<double>(longest));
}

struct Answer {
    long long iterations = 0;
    double seconds = 0.0, energy = 0.0; ///< s, eV
    bool converged = false;
};

Answer fire(SpectralBlock& block, const Interface& interface, double height, double k,
            double max_move) {
    constexpr double dt_max = 1.0;
    const auto start = std::chrono::steady_clock::now();
    const int n = block.options().sites;
    const Preconditioner preconditioner(block, k);
    // v and its momentum p = (S + k) v; a = (S + k)^-1 g.
    auto g = block.new_waves<double>();
    auto v = block.new_waves<float>(), p = block.new_waves<float>(), a = block.new_waves<float>();
    auto work = block.new_waves<float>();
    auto at_sites = block.new_field<float>();
    double dt = 0.3 * dt_max, mixing = 0.1;
    int downhill = 0;
    Answer answer;
    for (; answer.iterations < 20000; ++answer.iterations) {
        interface.sweep(block.lowest_layer(), block.interface_force(), height, false);
        block.gradient(0.0, g);
        // One pass: the preconditioned force and all inner products.
        RowSums sums(block.slab(), 4);
#pragma omp parallel for schedule(static)
        for (int y = 0; y < n; ++y) {
            preconditioner.apply_row(y, g, a);
            for (int c = 0; c < 3; ++c) {
                sums.row(y)[0] += row_dot(g.row(c, y), g.row(c, y), n);
                sums.row(y)[1] -= row_dot(g.row(c, y), v.row(c, y), n);
                sums.row(y)[2] += row_dot(g.row(c, y), a.row(c, y), n);
                sums.row(y)[3] += row_dot(v.row(c, y), p.row(c, y), n);
            }
        }
        const auto all = sums.total();
        const double power = all[1], force2 = all[2], speed2 = all[3];
        if (std::sqrt(all[0]) / n <= tolerance) {
            combine(1.0, g, 0.0, work);
            block.at_sites(work, at_sites);
            answer.converged = largest(at_sites) <= tolerance;
            if (answer.converged) break;
        }
        double keep = 0.0, gain = 0.0;
        if (power > 0.0 || answer.iterations == 0) {
            keep = 1.0 - mixing;
            gain = dt + (force2 > 0.0 ? mixing * std::sqrt(std::max(0.0, speed2) / force2) : 0.0);
            if (++downhill > 5) dt = std::min(1.1 * dt, dt_max), mixing *= 0.99;
        } else {
            downhill = 0;
            dt *= 0.5;
            mixing = 0.1;
            gain = dt;
        }
        const auto kept = static_cast<float>(keep), gained = static_cast<float>(gain);
#pragma omp parallel for schedule(static)
        for (int y = 0; y < n; ++y)
            for (int c = 0; c < 3; ++c)
                for (int i = 0; i < g.length(); ++i) {
                    const float speed = kept * v.row(c, y)[i] - gained * a.row(c, y)[i];
                    v.row(c, y)[i] = work.row(c, y)[i] = speed;
                    p.row(c, y)[i] =
                        kept * p.row(c, y)[i] - gained * static_cast<float>(g.row(c, y)[i]);
                }
        block.at_sites(work, at_sites);
        const double move = dt * largest(at_sites);
        block.displace(move > max_move ? dt * max_move / move : dt, v, at_sites);
        if (answer.iterations % 16 == 15) block.settle();
    }
    block.settle();
    const auto sums = interface.sweep(block.lowest_layer(), block.interface_force(), height, true);
    answer.energy = sums.energy.value() + block.elastic_energy();
    answer.seconds = seconds_since(start);
    return answer;
}

Answer own(SpectralBlock& block, const Interface& interface, double height) {
    const auto start = std::chrono::steady_clock::now();
    Phases phases;
    const RelaxedState s = relax(block, interface, height, spectral_options(tolerance), phases);
    for (std::size_t i = 0; i < phase_names.size(); ++i)
        if (const PhaseClock& c = phases[static_cast<Phase>(i)]; c.calls > 0)
            fmt::print("         {:10} {:7.3f} s in {} calls\n", phase_names[i], c.seconds,
                       c.calls);
    return {s.iterations, seconds_since(start), s.interface_energy + s.elastic_energy, s.converged};
}

} // namespace

int main(int argc, char** argv) {
    const int sites = argc > 1 ? std::atoi(argv[1]) : 256;
    const double rms = argc > 2 ? std::atof(argv[2]) : 3.0;
    const double k = argc > 3 ? std::atof(argv[3]) : 3.0;
    const double max_move = argc > 4 ? std::atof(argv[4]) : 1.0;
    const bool both = argc <= 5 || std::string(argv[5]) != "own";
    RoughContact contact(sites, rms);
    const auto say = [&](const char* what, const Answer& a) {
        fmt::print("{:8} {} sites, rms {} Å: {:5} iterations, {:8.2f} s, {:.10f} meV/Å²{}\n", what,
                   sites, rms, a.iterations, a.seconds, contact.binding(a.energy),
                   a.converged ? "" : "  NOT CONVERGED");
    };
    const Answer mine = own(contact.block, contact.interface, contact.height);
    say("own", mine);
    fmt::print("         S(q) {:.3f} s; peak memory {:.0f} MB\n", contact.making, peak_megabytes());
    if (!both) return 0;
    contact.block.set_uniform(0.0);
    const Answer baseline = fire(contact.block, contact.interface, contact.height, k, max_move);
    say("FIRE", baseline);
    fmt::print("         own is {:.1f} times faster\n", baseline.seconds / mine.seconds);
    return 0;
}
