// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What does the spectral block's own relaxation gain over FIRE? Both start from the same state, use
// the same block and preconditioner (S(q) + k)^-1, and end at the same largest force of 1e-4 eV/Å.
//
//     spectral_fire SITES RMS [double | single | own = double] [k of FIRE = 3] [largest move = 1 Å]
//
// FIRE (Bitzek et al. 2006) in the metric of the preconditioner, with settings tuned for it, all
// inner products in one pass. It is a baseline, no part of the product. In double precision it is
// what one would write down; in single it has what own has as well: vectors in single precision and
// sweeps in mixed. "own" leaves it out (peak memory is then the product's). Times are the
// processor's, all threads together, for wall time says little on a machine that is shared.
#include "rough_contact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <string>
#include <type_traits>
#include <utility>

using namespace asperity;

namespace {

constexpr double tolerance = 1e-4; // eV/Å

template <class T>
double largest(const SiteField<T>& field) {
    const PlaneView<const T> x = field[0].plane(0), y = field[1].plane(0), z = field[2].plane(0);
    T longest = 0;
#pragma omp parallel for schedule(static) reduction(max : longest)
    for (int j = 0; j < x.ny; ++j)
        for (int i = 0; i < x.nx; ++i)
            longest = std::max(longest, x(i, j) * x(i, j) + y(i, j) * y(i, j) + z(i, j) * z(i, j));
    return std::sqrt(static_cast<double>(longest));
}

struct Stopwatch {
    std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
    std::clock_t work = std::clock();
    double wall() const { return seconds_since(start); }
    double processor() const { return static_cast<double>(std::clock() - work) / CLOCKS_PER_SEC; }
};

struct Answer {
    long long iterations = 0;
    double wall = 0.0, processor = 0.0; ///< s
    double energy = 0.0;                ///< eV
    bool converged = false;
};

template <class T>
Answer fire(SpectralBlock& block, const Interface& interface, double height, double k,
            double max_move) {
    constexpr double dt_max = 1.0;
    constexpr bool single = std::is_same_v<T, float>;
    const Stopwatch watch;
    const int n = block.options().sites;
    const Preconditioner preconditioner(block, k);
    // v and its momentum p = (S + k) v; a = (S + k)^-1 g.
    auto g = block.new_waves<double>();
    auto v = block.new_waves<T>(), p = block.new_waves<T>(), a = block.new_waves<T>();
    auto work = block.new_waves<T>();
    auto at_sites = block.new_field<T>();
    double dt = 0.3 * dt_max, mixing = 0.1;
    int downhill = 0;
    Answer answer;
    for (; answer.iterations < 20000; ++answer.iterations) {
        interface.sweep(block.lowest_layer(), block.interface_force(), height, false, single);
        block.gradient(g);
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
        const auto kept = static_cast<T>(keep), gained = static_cast<T>(gain);
#pragma omp parallel for schedule(static)
        for (int y = 0; y < n; ++y)
            for (int c = 0; c < 3; ++c) {
                T *speed = v.row(c, y), *copy = work.row(c, y), *momentum = p.row(c, y);
                const T* push = a.row(c, y);
                const double* slope = g.row(c, y);
                for (int i = 0; i < g.length(); ++i) {
                    speed[i] = copy[i] = kept * speed[i] - gained * push[i];
                    momentum[i] = kept * momentum[i] - gained * static_cast<T>(slope[i]);
                }
            }
        block.at_sites(work, at_sites);
        const double move = dt * largest(at_sites);
        block.displace(move > max_move ? dt * max_move / move : dt, v, at_sites);
        if (single && answer.iterations % 16 == 15) block.settle();
    }
    block.settle();
    const auto sums = interface.sweep(block.lowest_layer(), block.interface_force(), height, true);
    answer.energy = sums.energy.value() + block.elastic_energy();
    answer.wall = watch.wall();
    answer.processor = watch.processor();
    return answer;
}

Answer own(SpectralBlock& block, const Interface& interface, double height) {
    const Stopwatch watch;
    Phases phases;
    const RelaxedState s = relax(block, interface, height, spectral_options(tolerance), phases);
    for (std::size_t i = 0; i < phase_names.size(); ++i)
        if (const PhaseClock& c = phases[static_cast<Phase>(i)]; c.calls > 0)
            fmt::print("         {:10} {:7.3f} s in {} calls\n", phase_names[i], c.seconds,
                       c.calls);
    return {s.iterations, watch.wall(), watch.processor(), s.interface_energy + s.elastic_energy,
            s.converged};
}

} // namespace

int main(int argc, char** argv) {
    const int sites = argc > 1 ? std::atoi(argv[1]) : 256;
    const double rms = argc > 2 ? std::atof(argv[2]) : 3.0;
    const std::string baseline = argc > 3 ? argv[3] : "double";
    const double k = argc > 4 ? std::atof(argv[4]) : 3.0;
    const double max_move = argc > 5 ? std::atof(argv[5]) : 1.0;
    RoughContact contact(sites, rms);
    const auto say = [&](const std::string& what, const Answer& a) {
        fmt::print("{:12} {} sites, rms {} Å: {:5} iterations, {:8.2f} s of processors, {:8.2f} s, "
                   "{:.10f} meV/Å²{}\n",
                   what, sites, rms, a.iterations, a.processor, a.wall, contact.binding(a.energy),
                   a.converged ? "" : "  NOT CONVERGED");
    };
    const Answer mine = own(contact.block, contact.interface, contact.height);
    say("own", mine);
    fmt::print("         S(q) {:.3f} s; peak memory {:.0f} MB\n", contact.making, peak_megabytes());
    if (baseline == "own") return 0;
    contact.block.set_uniform(0.0);
    const auto follow = baseline == "single" ? fire<float> : fire<double>;
    const Answer its = follow(contact.block, contact.interface, contact.height, k, max_move);
    say("FIRE, " + baseline, its);
    fmt::print("         own takes 1/{:.2f} of the processors' time, 1/{:.2f} of the wall's\n",
               its.processor / mine.processor, its.wall / mine.wall);
    return 0;
}
