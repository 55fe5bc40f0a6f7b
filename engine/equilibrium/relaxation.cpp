// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/equilibrium/relaxation.hpp"

#include "decomposition/global_sum.hpp"
#include "engine/equilibrium/coarse_grids.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace asperity {

namespace {

// Of the last move kept: grows while that leads downhill, starts again where it does not.
constexpr double least_momentum = 0.8, most_momentum = 0.95, lost = 0.98;
constexpr double least_stiffness = 0.02; // of the interface under the whole block, eV/Å^2 a site
constexpr double remembered = 0.9;       // of a site's stiffness, from one iteration to the next
constexpr double probe = 1e-3;           // to measure it at first, Å
constexpr double telling = 1e-5; // shorter moves, Å, tell nothing of it for the steps at the cutoff

/// The block on its way down: forces, moves, and what is known of the interface's stiffness.
class Descent {
    using Means = std::array<double, 3>; ///< of a plane, along x, y, z

public:
    Descent(Block& block, Interface& interface, double reference_height,
            const Constraint& constraint, const RelaxOptions& options, Phases& phases)
        : block_(block), interface_(interface), height_(reference_height), constraint_(constraint),
          options_(options), phases_(phases), grids_(block) {
        std::size_t planes = 0;
        for (const Block::Level& level : block.levels()) {
            first_plane_.push_back(planes);
            planes += static_cast<std::size_t>(level.shape.cells);
            nodes_.emplace_back(level.tile, level.shape.cells);
            moves_.emplace_back(level.tile, level.shape.cells);
        }
        last_force_ = VectorField<double>(block.levels().front().tile, 1);
        const BlockOptions& o = block.options();
        sites_ = static_cast<double>(o.sites) * o.sites;
        sweep(reference_height - probe, false);
        follow_stiffness([](int, int) { return std::array{0.0, 0.0, 0.0}; });
        sweep(reference_height, false);
        follow_stiffness([](int, int) { return std::array{0.0, 0.0, probe}; });
    }

    /// Forces at the present positions; the largest on a node. What is left in all of the block
    /// counts too, as a share for each site: the force on a free top plane; under a prescribed one,
    /// what the substrate exerts and the top plane does not feel.
    double evaluate(bool observe) {
        {
            const auto t = phases_.time(Phase::interpolate);
            block_.interpolate();
        }
        sweep(height_, observe);
        {
            const auto t = phases_.time(Phase::advance);
            block_.forces(nodes_);
            if (constraint_.is_mean_height()) remove_mean_force();
        }
        const auto t = phases_.time(Phase::sums);
        const auto moved = std::as_const(moves_.front()).plane(0);
        follow_stiffness([&](int x, int y) {
            return std::array{moved.x(x, y), moved.y(x, y), moved.z(x, y)};
        });
        const auto [above, below, stiffness, power] =
            global_sums(block_.communicator(),
                        std::array{top_sum(), sums_.force_z, stiffness_sum(), power_sum()});
        elastic_top_force_ = above;
        top_force_ = constraint_.is_top() ? 0.0 : above - constraint_.load();
        mean_stiffness_ = std::max(0.0, stiffness / sites_);
        momentum_ =
            power < 0.0 ? least_momentum : std::min(most_momentum, 1.0 - lost * (1.0 - momentum_));
        const double whole = constraint_.is_top() ? below - above : top_force_;
        return block_.communicator().max(std::max(largest_force(), std::abs(whole) / sites_));
    }

    /// One iteration: steps from the forces, moves from the steps, positions from the moves. Forces
    /// are lost.
    void move() {
        const std::vector<Means> mean = mean_steps();
        {
            const auto t = phases_.time(Phase::sums);
            grids_.steps(nodes_);
        }
        {
            const auto t = phases_.time(Phase::advance);
#pragma omp parallel
            each_row([&](std::size_t l, int z, int y, int nx) {
                const Means& m = mean[first_plane_[l] + static_cast<std::size_t>(z)];
                const auto step = lines(nodes_[l].plane(z), y), v = lines(moves_[l].plane(z), y);
                for (std::size_t c = 0; c < 3; ++c)
                    for (int x = 0; x < nx; ++x)
                        v[c][x] = momentum_ * v[c][x] + step[c][x] + m[c];
                cut(v, nx);
                if (!constraint_.is_mean_height()) displace(l, z, y, nx);
            });
        }
        if (!constraint_.is_top())
            top_move_ = std::clamp(momentum_ * top_move_ + mean.back()[2], -options_.max_move,
                                   options_.max_move);
        if (constraint_.is_mean_height()) displace_at_mean_height();
        block_.set_top(block_.top() + top_move_);
        const auto t = phases_.time(Phase::exchange);
        block_.exchange();
    }

    const InterfaceSums& interface_sums() const { return sums_; }
    double elastic_top_force() const { return elastic_top_force_; }

private:
    void sweep(double height, bool observe) {
        const auto t = phases_.time(Phase::interface);
        sums_ = interface_.sweep(block_.lowest_layer(), block_.interface_force(), height, observe);
    }

    /// How stiff the interface is for each site along its last move (nothing new where it hardly
    /// moved): a site's force depends on its own place alone.
    template <class Moved>
    void follow_stiffness(const Moved& moved) {
        const auto now = block_.interface_force(), before = last_force_.plane(0);
        const auto k = grids_.site_stiffness();
#pragma omp parallel for schedule(static)
        for (int y = 0; y < k.ny; ++y)
            for (int x = 0; x < k.nx; ++x) {
                const auto u = moved(x, y);
                const double length2 = u[0] * u[0] + u[1] * u[1] + u[2] * u[2];
                const double work = (before.x(x, y) - now.x(x, y)) * u[0] +
                                    (before.y(x, y) - now.y(x, y)) * u[1] +
                                    (before.z(x, y) - now.z(x, y)) * u[2];
                if (length2 > telling * telling)
                    k(x, y) = std::max(work / length2, remembered * k(x, y));
                before.x(x, y) = now.x(x, y);
                before.y(x, y) = now.y(x, y);
                before.z(x, y) = now.z(x, y);
            }
    }

    ExactSum top_sum() const {
        ExactSum sum;
        block_.add_top_force(sum);
        return sum;
    }
    ExactSum stiffness_sum() {
        ExactSum sum;
        const PlaneView<double> k = grids_.site_stiffness();
        elastic_kernels().sum(k, 0, k.ny, sum);
        return sum;
    }
    /// Forces on the lowest layer times its last moves.
    ExactSum power_sum() const {
        const auto f = nodes_.front().view()[0], v = std::as_const(moves_.front()).view()[0];
        ExactSum sum;
        for (int y = 0; y < f.x.ny; ++y) {
            for (int x = 0; x < f.x.nx; ++x)
                sum.add(f.x(x, y) * v.x(x, y) + f.y(x, y) * v.y(x, y) + f.z(x, y) * v.z(x, y));
            sum.carry();
        }
        return sum;
    }
    double largest_force() {
        double largest2 = 0.0;
#pragma omp parallel reduction(max : largest2)
        each_row([&](std::size_t l, int z, int y, int nx) {
            const auto f = lines(nodes_[l].plane(z), y);
            for (int x = 0; x < nx; ++x)
                largest2 =
                    std::max(largest2, f[0][x] * f[0][x] + f[1][x] * f[1][x] + f[2][x] * f[2][x]);
        });
        return std::sqrt(largest2);
    }
    /// Steps of the means of all planes, the top plane's last. The block holds them like a chain of
    /// springs, the interface its lower end; for that chain they are exact.
    std::vector<Means> mean_steps() {
        std::vector<ExactSum> sums;
        std::vector<double> spring; // to the next plane, over that of a cell of edge a
        each_plane([&](std::size_t l, int z) {
            const Block::Level& level = block_.levels()[l];
            const auto f = nodes_[l].plane(z);
            for (const PlaneView<double>& component : {f.x, f.y, f.z}) {
                sums.emplace_back();
                if (block_.counts(level))
                    elastic_kernels().sum(component, 0, level.tile.ny, sums.back());
            }
            spring.push_back(std::ldexp(1.0, -level.shape.level));
        });
        const std::vector<double> forces = global_sums(block_.communicator(), sums);
        const std::size_t n = spring.size();
        std::vector<Means> step(n + 1, Means{});
        const BlockOptions& o = block_.options();
        const double shear = o.shear_modulus() * o.spacing;
        for (std::size_t c = 0; c < 3; ++c) {
            const double modulus = c == 2 ? o.lame() * o.spacing + 2.0 * shear : shear;
            const bool top_moves = c == 2 && !constraint_.is_top();
            const bool lowest_fixed = c == 2 && constraint_.is_mean_height();
            // Elimination from below: diagonal and force of what is left.
            std::vector<double> diagonal(n + 1), force(n + 1);
            double below = mean_stiffness_ + least_stiffness, handed = 0.0;
            for (std::size_t i = 0; i <= n; ++i) {
                const double above = i < n ? modulus * spring[i] : 0.0;
                const double f = i < n ? forces[3 * i + c] : top_force_;
                diagonal[i] = below + above;
                force[i] = f / sites_ + handed;
                if (i == 0 && lowest_fixed) force[i] = 0.0, diagonal[i] = HUGE_VAL;
                below = above - above * above / diagonal[i];
                handed = force[i] * above / diagonal[i];
            }
            if (top_moves) step[n][c] = force[n] / diagonal[n];
            for (std::size_t i = n; i-- > 0;)
                step[i][c] = (force[i] + modulus * spring[i] * step[i + 1][c]) / diagonal[i];
        }
        return step;
    }
    double mean(const PlaneView<double>& z) const {
        ExactSum sum;
        elastic_kernels().sum(z, 0, z.ny, sum);
        return global_sum(block_.communicator(), sum) / sites_;
    }
    /// Takes the mean normal force off the lowest layer.
    void remove_mean_force() {
        const PlaneView<double> z = nodes_.front().plane(0).z;
        const double whole = mean(z);
        for (int y = 0; y < z.ny; ++y)
            for (int x = 0; x < z.nx; ++x)
                z(x, y) -= whole;
    }
    /// Takes the lowest layer's mean along z out of all moves, which shifts the block and does not
    /// strain it; all are shortened so that none gets longer than it may.
    void displace_at_mean_height() {
        const auto t = phases_.time(Phase::advance);
        const double drift = mean(moves_.front().plane(0).z);
        const double scale = options_.max_move / (options_.max_move + std::abs(drift));
#pragma omp parallel
        each_row([&](std::size_t l, int z, int y, int nx) {
            const auto v = lines(moves_[l].plane(z), y);
            for (int x = 0; x < nx; ++x) {
                v[0][x] *= scale;
                v[1][x] *= scale;
                v[2][x] = scale * (v[2][x] - drift);
            }
            displace(l, z, y, nx);
        });
        top_move_ = scale * (top_move_ - drift);
    }
    /// No node moves further than it may.
    void cut(const std::array<double*, 3>& v, int nx) const {
        const double most2 = options_.max_move * options_.max_move;
        for (int x = 0; x < nx; ++x) {
            const double length2 = v[0][x] * v[0][x] + v[1][x] * v[1][x] + v[2][x] * v[2][x];
            if (length2 <= most2) continue;
            const double scale = options_.max_move / std::sqrt(length2);
            for (std::size_t c = 0; c < 3; ++c)
                v[c][x] *= scale;
        }
    }
    void displace(std::size_t l, int z, int y, int nx) {
        const auto v = lines(moves_[l].plane(z), y),
                   u = lines(block_.fields(block_.levels()[l]).u.plane(z), y);
        for (std::size_t c = 0; c < 3; ++c)
            for (int x = 0; x < nx; ++x)
                u[c][x] += v[c][x];
    }

    template <class Work>
    void each_plane(const Work& work) const {
        for (std::size_t l = 0; l < nodes_.size(); ++l)
            for (int z = 0; z < block_.levels()[l].shape.cells; ++z)
                work(l, z);
    }
    /// Calls work(level, plane, row, nx) for every row of moving nodes; inside a parallel region.
    template <class Work>
    void each_row(const Work& work) const {
        each_plane([&](std::size_t l, int z) {
            const Tile& tile = block_.levels()[l].tile;
#pragma omp for schedule(static) nowait
            for (int y = 0; y < tile.ny; ++y)
                work(l, z, y, tile.nx);
        });
    }

    Block& block_;
    Interface& interface_;
    double height_;
    const Constraint& constraint_;
    const RelaxOptions& options_;
    Phases& phases_;
    CoarseGrids grids_;
    std::vector<VectorField<double>> nodes_; ///< forces, then steps
    std::vector<VectorField<double>> moves_; ///< the last ones
    VectorField<double> last_force_;         ///< of the interface
    InterfaceSums sums_;
    double sites_ = 0.0;
    std::vector<std::size_t> first_plane_; ///< of each level, all counted from below
    double elastic_top_force_ = 0.0;
    double top_force_ = 0.0, top_move_ = 0.0; ///< of the motion
    double mean_stiffness_ = 0.0;             ///< of the interface, eV/Å^2 a site
    double momentum_ = least_momentum;
};

} // namespace

RelaxedState relax(Block& block, Interface& interface, double reference_height,
                   const Constraint& constraint, const RelaxOptions& options, Phases& phases) {
    Descent descent(block, interface, reference_height, constraint, options, phases);
    RelaxedState state;
    Standstill standstill;
    for (;; ++state.iterations) {
        state.residual = descent.evaluate(false);
        if (state.residual <= options.tolerance || !std::isfinite(state.residual) ||
            state.iterations >= options.max_iterations ||
            standstill(state.iterations, state.residual))
            break;
        if (options.report && state.iterations % 50 == 0 &&
            options.report(state.iterations, state.residual)) {
            state.interrupted = true;
            break;
        }
        descent.move();
    }

    descent.evaluate(true);
    const InterfaceSums& sums = descent.interface_sums();
    std::array<ExactSum, 4> energies;
    energies[0] = sums.energy;
    energies[1] = sums.force_z;
    block.add_elastic_energy(energies[2]);
    block.add_lowest_z(energies[3]);
    const auto values = global_sums(block.communicator(), energies);
    state.interface_energy = values[0];
    state.force = values[1];
    state.top_force = constraint.is_mean_height() ? state.force : descent.elastic_top_force();
    state.elastic_energy = values[2];
    // A maximum leaves forces out that are no numbers; sums do not.
    state.converged = state.residual <= options.tolerance && std::isfinite(values[0]) &&
                      std::isfinite(values[1]) && std::isfinite(values[2]);
    state.mean_height =
        values[3] / (static_cast<double>(block.options().sites) * block.options().sites);
    const ContactCount contacts = count_contacts(sums, block.communicator());
    state.in_contact = contacts.in_contact;
    state.repulsive = contacts.repulsive;
    state.closest = contacts.closest;
    return state;
}

} // namespace asperity
