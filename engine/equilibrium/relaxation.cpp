// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/equilibrium/relaxation.hpp"

#include "decomposition/global_sum.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace asperity {

namespace {

/// The minimiser's view of the block: positions, fictitious masses, forces, and the top plane.
class Descent {
public:
    Descent(Block& block, Interface& interface, double reference_height,
            const RelaxOptions& options, Phases& phases)
        : block_(block), interface_(interface), height_(reference_height), options_(options),
          phases_(phases) {
        for (const auto& level : block.levels())
            force_.emplace_back(level.tile, level.plan.cells);
        const auto& last = block.levels().back();
        top_mass_ = 0.5 * mass(last) * static_cast<double>(last.plan.sites) * last.plan.sites;
        for (auto& level : block.levels())
            level.v = VectorField<double>(level.tile, level.plan.cells);
    }

    /// Forces at the present positions; the largest on a node. What is left in all of the block
    /// counts too, as a share for each site: the force on a free top plane; under a held one, what
    /// the substrate exerts and the top plane does not feel.
    double evaluate(bool observe) {
        {
            const auto t = phases_.time(Phase::interpolate);
            block_.interpolate();
        }
        {
            const auto t = phases_.time(Phase::interface);
            sums_ =
                interface_.sweep(block_.lowest_layer(), block_.interface_force(), height_, observe);
        }
        const auto t = phases_.time(Phase::advance);
        block_.forces(force_);
        if (options_.mean_height_held) keep_mean_height();
        ExactSum top;
        block_.add_top_force(top);
        const auto [above, below] =
            global_sums(block_.communicator(), std::array{top, sums_.force_z});
        elastic_top_force_ = above;
        top_force_ = options_.top_held ? 0.0 : above - options_.load;
        const double whole = options_.top_held ? below - above : top_force_;

        double largest = 0.0;
        for (std::size_t l = 0; l < force_.size(); ++l) {
            const auto f = std::as_const(force_[l]).view();
            const auto& level = block_.levels()[l];
#pragma omp parallel for schedule(static) reduction(max : largest)
            for (int row = 0; row < level.plan.cells * level.tile.ny; ++row) {
                const int z = row / level.tile.ny, y = row % level.tile.ny;
                for (int x = 0; x < level.tile.nx; ++x) {
                    const double f2 = f.x(x, y, z) * f.x(x, y, z) + f.y(x, y, z) * f.y(x, y, z) +
                                      f.z(x, y, z) * f.z(x, y, z);
                    largest = std::max(largest, f2);
                }
            }
        }
        const double sites = static_cast<double>(block_.options().sites);
        std::array<double, 1> all = {
            std::max(std::sqrt(largest), std::abs(whole) / (sites * sites))};
        block_.communicator().max(all);
        return all[0];
    }

    struct Products {
        double power, speed2, force2; ///< F.v, sum m v^2, sum F^2/m
    };
    Products products() const {
        const auto t = phases_.time(Phase::sums);
        std::array<ExactSum, 3> sums;
#pragma omp parallel
        {
            std::array<ExactSum, 3> mine;
            each_row([&](double m, const double* const f[3], double* const v[3], double* const*,
                         int nx, bool counted) {
                if (!counted) return;
                for (int x = 0; x < nx; ++x) {
                    const double fv = f[0][x] * v[0][x] + f[1][x] * v[1][x] + f[2][x] * v[2][x];
                    const double vv = v[0][x] * v[0][x] + v[1][x] * v[1][x] + v[2][x] * v[2][x];
                    const double ff = f[0][x] * f[0][x] + f[1][x] * f[1][x] + f[2][x] * f[2][x];
                    mine[0].add(fv);
                    mine[1].add(m * vv);
                    mine[2].add(ff / m);
                }
            });
#pragma omp critical(asperity_relax_sums)
            for (std::size_t i = 0; i < 3; ++i)
                sums[i].merge(mine[i]);
        }
        const auto [power, speed2, force2] = global_sums(block_.communicator(), sums);
        return {power + top_force_ * top_speed_, speed2 + top_mass_ * top_speed_ * top_speed_,
                force2 + top_force_ * top_force_ / top_mass_};
    }

    /// v <- keep v + gain F/m, then u <- u + dt v, halos refreshed.
    void move(double keep, double gain, double dt) {
        {
            const auto t = phases_.time(Phase::advance);
#pragma omp parallel
            each_row([&](double m, const double* const f[3], double* const v[3], double* const u[3],
                         int nx, bool) {
                const double a = gain / m;
                for (int c = 0; c < 3; ++c)
                    for (int x = 0; x < nx; ++x) {
                        v[c][x] = keep * v[c][x] + a * f[c][x];
                        u[c][x] += dt * v[c][x];
                    }
            });
        }
        top_speed_ = keep * top_speed_ + gain * top_force_ / top_mass_;
        block_.set_top(block_.top() + dt * top_speed_);
        const auto t = phases_.time(Phase::exchange);
        block_.exchange();
    }

    /// Largest change of position that v brings in dt.
    double largest_speed() const {
        double largest = 0.0;
#pragma omp parallel reduction(max : largest)
        each_row([&](double, const double* const*, double* const v[3], double* const*, int nx,
                     bool) {
            for (int x = 0; x < nx; ++x)
                largest =
                    std::max(largest, v[0][x] * v[0][x] + v[1][x] * v[1][x] + v[2][x] * v[2][x]);
        });
        std::array<double, 1> all = {std::max(std::sqrt(largest), std::abs(top_speed_))};
        block_.communicator().max(all);
        return all[0];
    }

    const InterfaceSums& interface_sums() const { return sums_; }
    double elastic_top_force() const { return elastic_top_force_; }

private:
    /// Takes the mean normal force off the lowest layer.
    void keep_mean_height() {
        const PlaneView<double> z = force_.front().plane(0).z;
        ExactSum sum;
        elastic_kernels().sum(z, 0, z.ny, sum);
        const double sites = static_cast<double>(block_.options().sites);
        const double mean = global_sum(block_.communicator(), sum) / (sites * sites);
        for (int y = 0; y < z.ny; ++y)
            for (int x = 0; x < z.nx; ++x)
                z(x, y) -= mean;
    }

    static double mass(const Block::Level& level) {
        return static_cast<double>(1 << level.plan.level);
    }

    /// Calls work(mass, f, v, u, nx, counted) for every row of moving nodes; inside a parallel
    /// region.
    template <class Work>
    void each_row(const Work& work) const {
        for (std::size_t l = 0; l < force_.size(); ++l) {
            Block::Level& level = block_.levels()[l];
            const auto f = force_[l].view();
            const auto v = level.v.view(), u = level.u.view();
            const bool counted = block_.counts(level);
#pragma omp for schedule(static) nowait
            for (int row = 0; row < level.plan.cells * level.tile.ny; ++row) {
                const int z = row / level.tile.ny, y = row % level.tile.ny;
                const double* const fr[3] = {f.x[z].line(y), f.y[z].line(y), f.z[z].line(y)};
                double* const vr[3] = {v.x[z].line(y), v.y[z].line(y), v.z[z].line(y)};
                double* const ur[3] = {u.x[z].line(y), u.y[z].line(y), u.z[z].line(y)};
                work(mass(level), fr, vr, ur, level.tile.nx, counted);
            }
        }
    }

    Block& block_;
    Interface& interface_;
    double height_;
    const RelaxOptions& options_;
    Phases& phases_;
    std::vector<VectorField<double>> force_;
    InterfaceSums sums_;
    double elastic_top_force_ = 0.0;
    double top_force_ = 0.0, top_speed_ = 0.0, top_mass_ = 1.0; ///< of the motion
};

} // namespace

RelaxedState relax(Block& block, Interface& interface, double reference_height,
                   const RelaxOptions& options, Phases& phases) {
    constexpr int wait = 5; // downhill steps before the step grows
    constexpr double grow = 1.1, shrink = 0.5, mixing0 = 0.1, forget = 0.99;

    Descent descent(block, interface, reference_height, options, phases);
    // Highest frequency for a fictitious mass of one: sqrt of the largest stiffness of a site.
    const double stiffest = block.options().highest_frequency(options.site_stiffness) *
                            std::sqrt(block.options().atom_mass);
    const double dt_max = 1.0 / stiffest;
    double dt = 0.5 * dt_max, mixing = mixing0;
    int downhill = 0;

    RelaxedState state;
    for (;; ++state.iterations) {
        state.residual = descent.evaluate(false);
        if (state.residual <= options.tolerance || !std::isfinite(state.residual) ||
            state.iterations >= options.max_iterations)
            break;
        if (options.report && state.iterations % 50 == 0 &&
            options.report(state.iterations, state.residual)) {
            state.interrupted = true;
            break;
        }

        const auto p = descent.products();
        double keep = 0.0, gain = 0.0;
        if (p.power > 0.0 || state.iterations == 0) {
            // Steer the velocity towards the force, without changing its length.
            keep = 1.0 - mixing;
            gain = dt + (p.force2 > 0.0 ? mixing * std::sqrt(p.speed2 / p.force2) : 0.0);
            if (++downhill > wait) {
                dt = std::min(dt * grow, dt_max);
                mixing *= forget;
            }
        } else {
            downhill = 0;
            dt *= shrink;
            mixing = mixing0;
            gain = dt;
        }
        // The speed after the kick is at most keep |v| + gain |F/m|: where that may exceed
        // max_move, kick first and scale, so that no site jumps.
        const double bound = keep * descent.largest_speed() + gain * state.residual;
        const double scale = bound * dt > options.max_move ? options.max_move / (bound * dt) : 1.0;
        descent.move(scale * keep, scale * gain, dt);
    }

    descent.evaluate(true);
    state.converged = state.residual <= options.tolerance;
    const InterfaceSums& sums = descent.interface_sums();
    std::array<ExactSum, 4> energies;
    energies[0] = sums.energy;
    energies[1] = sums.force_z;
    block.add_elastic_energy(energies[2]);
    block.add_lowest_z(energies[3]);
    const auto values = global_sums(block.communicator(), energies);
    state.interface_energy = values[0];
    state.force = values[1];
    state.top_force = options.mean_height_held ? state.force : descent.elastic_top_force();
    state.elastic_energy = values[2];
    state.mean_height =
        values[3] / (static_cast<double>(block.options().sites) * block.options().sites);
    const ContactCount contacts = count_contacts(sums, block.communicator());
    state.in_contact = contacts.in_contact;
    state.pushed = contacts.pushed;
    state.closest = contacts.closest;
    return state;
}

} // namespace asperity
