// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The motion: what velocity Verlet promises (an energy error that falls as dt^2, time
// reversal; drift: stability/motion_limits_test), the books of a damped and driven run, a
// temperature that is the one asked for, and a slow approach that ends in the static state.
#include "engine/units.hpp"
#include "support/cases.hpp"
#include "support/elastic_operator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

using namespace asperity;

namespace {

/// A small rough contact with its top held, released from a strained state.
class FreeContact {
public:
    FreeContact(const SimulationOptions& options, const char* map = "n8_b_rms1.0",
                double height = 4.5)
        : simulation(test::simulation(options, test::reference_surface(map))) {
        simulation.start(height);
    }
    /// Energy at the whole step, eV.
    double step() {
        const StepRecord& now = simulation.step(true);
        return now.interface_energy + now.elastic_energy + now.kinetic_energy;
    }
    Simulation simulation;
};

/// Least and greatest energy over a stretch of time.
double energy_ripple(double dt, double duration, bool finite_strain) {
    SimulationOptions options = test::free_contact(dt);
    options.block.finite_strain = finite_strain;
    FreeContact contact(options);
    double least = 1e300, most = -1e300;
    for (int n = 0; n * dt < duration; ++n) {
        const double energy = contact.step();
        least = std::min(least, energy), most = std::max(most, energy);
    }
    return most - least;
}

struct Mean {
    double value = 0.0,
           error = 0.0; ///< standard error of the mean from blocks longer than the memory
};
Mean block_average(const std::vector<double>& series, std::size_t blocks) {
    const std::size_t length = series.size() / blocks;
    std::vector<double> means(blocks);
    for (std::size_t b = 0; b < blocks; ++b) {
        for (std::size_t i = 0; i < length; ++i)
            means[b] += series[b * length + i];
        means[b] /= static_cast<double>(length);
    }
    Mean mean;
    for (double m : means)
        mean.value += m / static_cast<double>(blocks);
    for (double m : means)
        mean.error += (m - mean.value) * (m - mean.value);
    mean.error = std::sqrt(mean.error / static_cast<double>(blocks * (blocks - 1)));
    return mean;
}

} // namespace

TEST(Verlet, EnergyErrorFallsAsTheSquareOfTheStep) {
    // 4 ps of a block that is released pressed into the wall, where the pair's own frequency is
    // several times the bulk's. The next term of the ripple falls as dt^2 too: a ratio off by x at
    // one pair is off by x/4 at the next.
    for (bool finite : {false, true}) {
        const auto ripple = [&](double dt) { return energy_ripple(dt, 4000.0, finite); };
        const double coarse = ripple(8.0), middle = ripple(4.0), fine = ripple(2.0);
        EXPECT_NEAR(coarse / middle, 4.0, 0.15) << finite;
        EXPECT_NEAR(middle / fine, 4.0, 0.05) << finite;
    }
}

namespace {

struct Retraced {
    double moved, off; ///< largest displacement there, largest error back, Å
};

/// Leapfrog is its own mirror image: with v(n+1/2) reversed and the drift undone, the same steps
/// lead back. What remains is rounding, grown by the contact's instability over 200 steps.
Retraced retrace(const SimulationOptions& options) {
    FreeContact contact(options);
    Block& block = contact.simulation.block_to_write();
    std::vector<double> first;
    const auto positions = [&] {
        std::vector<double> all;
        for (const auto& level : block.levels())
            for (const auto* f : {&level.u.x, &level.u.y, &level.u.z})
                for (int z = 0; z < level.shape.cells; ++z)
                    for (int y = 0; y < level.tile.ny; ++y)
                        for (int x = 0; x < level.tile.nx; ++x)
                            all.push_back(f->view()(x, y, z));
        return all;
    };
    for (int n = 0; n < 50; ++n)
        contact.step();
    first = positions();
    constexpr int there = 200;
    for (int n = 0; n < there; ++n)
        contact.step();
    double moved = 0.0;
    const auto far = positions();
    for (std::size_t i = 0; i < far.size(); ++i)
        moved = std::max(moved, std::abs(far[i] - first[i]));
    // u(n+1), v(n+1/2)  ->  u(n), -v(n+1/2): the mirrored state before the step back.
    for (const auto& level : block.levels()) {
        const Block::Fields own = block.fields(level);
        for (const auto& [u, v] :
             {std::pair{&own.u.x, &own.v.x}, {&own.u.y, &own.v.y}, {&own.u.z, &own.v.z}})
            for (int z = 0; z < level.shape.cells; ++z)
                for (int y = 0; y < level.tile.ny; ++y)
                    for (int x = 0; x < level.tile.nx; ++x) {
                        double& speed = v->view()(x, y, z);
                        u->view()(x, y, z) -= options.dt * speed;
                        speed = -speed;
                    }
    }
    block.exchange();
    for (int n = 0; n < there - 1; ++n)
        contact.step();
    const auto back = positions();
    double off = 0.0;
    for (std::size_t i = 0; i < back.size(); ++i)
        off = std::max(off, std::abs(back[i] - first[i]));
    return {moved, off};
}

} // namespace

TEST(Verlet, ReversedVelocitiesRetraceThePath) {
    for (int layers : {0, 2})
        for (bool finite : {false, true})
            for (bool mixed : {false, true}) {
                SimulationOptions options = test::free_contact(10.0, layers);
                options.block.finite_strain = finite;
                options.interface.mixed = mixed;
                const auto [moved, off] = retrace(options);
                EXPECT_GT(moved, 0.3);
                EXPECT_LT(off, 1e-9);
            }
}

TEST(EnergyBalance, ADrivenDampedRunBalances) {
    // Work of the top plane and of the moving medium = change of energy + dissipation, up to the
    // trapezia's dt^2.
    const auto residual = [](double dt) {
        SimulationOptions options = test::free_contact(dt);
        options.drive.velocity = 5e-4; // 50 m/s
        options.damping = 2e-3;
        FreeContact contact(options, "n8_b_rms1.0", 8.0);
        double worst = 0.0;
        while (contact.simulation.time() < 12000.0) {
            contact.step();
            worst = std::max(worst, std::abs(contact.simulation.now().residual));
        }
        const EnergyBalance& l = contact.simulation.balance();
        EXPECT_GT(l.damped, 0.1);
        EXPECT_GT(std::abs(l.top_work), 0.1);
        EXPECT_NE(l.drag_work, 0.0);
        return worst;
    };
    const double coarse = residual(10.0), fine = residual(5.0);
    EXPECT_LT(coarse, 5e-3);
    EXPECT_NEAR(coarse / fine, 4.0, 0.8);
}

TEST(EnergyBalance, DampingAloneTakesWhatTheDissipationSays) {
    // The energy lost over 15 ps, all but a few percent of it damped away; Verlet's own ripple, of
    // order dt^2, is what the first energy is known to.
    const auto error = [](double dt) {
        SimulationOptions options = test::free_contact(dt);
        options.damping = 1e-3;
        FreeContact contact(options);
        const double before = contact.step();
        double after = before;
        while (contact.simulation.time() < 15000.0)
            after = contact.step();
        const EnergyBalance& l = contact.simulation.balance();
        EXPECT_EQ(l.top_work, 0.0) << "the top is held";
        EXPECT_EQ(l.drag_work, 0.0);
        EXPECT_GT(before - after, 1.0);
        return l.damped / (before - after) - 1.0;
    };
    const double coarse = error(4.0), fine = error(2.0);
    EXPECT_LT(std::abs(fine), 1e-3);
    EXPECT_NEAR(coarse / fine, 4.0, 0.4);
}

TEST(Temperature, EquipartitionInEveryLevelAndInTheSprings) {
    // A free surface, 300 K: every mode is a spring, and of a spring of frequency w the moments of
    // the thermostat's recursion have closed forms (thermostat.hpp). Displacements, and velocities
    // at half steps, are those of T / (1 - (w dt/2)^2); the record's kinetic energy, from
    // velocities at whole steps without the present noise, that of T / (1 + Gamma dt/2)^2. A long
    // step and a strong damping make both corrections larger than the statistical error, and
    // nothing else is allowed for.
    SimulationOptions options = test::free_contact(20.0);
    options.damping = 5e-3; // 1/fs: memory of 0.2 ps
    options.temperature = 300.0;
    Simulation simulation = test::simulation(options, test::flat_surface(8));
    simulation.start(30.0);
    const auto& levels = simulation.block().levels();
    ASSERT_EQ(levels.size(), 2u);
    // 1 / (1 - (w dt/2)^2) of each degree of freedom to fourth order in w dt, from W = M^-1 K.
    test::ElasticOperator k(options.block);
    const test::Vector mass =
        k.tabulate([](const Block::Level& level, int, int z, int, int) { return level.mass(z); });
    const test::Vector of_level =
        k.tabulate([](const Block::Level& level, int, int, int, int) { return level.shape.level; });
    const double q = 0.25 * options.dt * options.dt;
    double all = 0.0;
    std::vector<double> by_half_step(levels.size()), freedoms(levels.size());
    test::Vector one(k.size());
    for (std::size_t i = 0; i < k.size(); ++i) {
        one[i] = 1.0;
        k.set(one);
        one[i] = 0.0;
        const test::Vector f = k.force();
        double second = 0.0; // (W^2)_ii; M W is symmetric
        for (std::size_t j = 0; j < k.size(); ++j)
            second += f[j] * f[j] / (mass[i] * mass[j]);
        const double hotter = 1.0 - q * f[i] / mass[i] + q * q * second;
        const auto level = static_cast<std::size_t>(of_level[i]);
        all += hotter, by_half_step[level] += hotter, freedoms[level] += 1.0;
    }
    const double kt = units::boltzmann * options.temperature, n = static_cast<double>(k.size());
    std::vector<double> kinetic, elastic;
    std::vector<std::vector<double>> by_level(levels.size());
    constexpr int steps = 40000, warm_up = 1000; // 800 ps, 4000 memories
    for (int step = 0; step < steps + warm_up; ++step) {
        const StepRecord& now = simulation.step(true);
        if (step < warm_up) continue;
        kinetic.push_back(now.kinetic_energy / (0.5 * kt * n));
        elastic.push_back(now.elastic_energy / (0.5 * kt * n));
        if (step % 5) continue;
        for (std::size_t l = 0; l < levels.size(); ++l) {
            const auto v = levels[l].v.view();
            double sum = 0.0;
            for (int z = 0; z < levels[l].shape.cells; ++z)
                for (int y = 0; y < levels[l].tile.ny; ++y)
                    for (int x = 0; x < levels[l].tile.nx; ++x)
                        sum += levels[l].mass(z) *
                               (v.x(x, y, z) * v.x(x, y, z) + v.y(x, y, z) * v.y(x, y, z) +
                                v.z(x, y, z) * v.z(x, y, z));
            by_level[l].push_back(sum / (kt * freedoms[l]));
        }
    }
    const auto check = [](const char* what, const Mean& mean, double expected) {
        EXPECT_LT(mean.error, 0.003) << "too short a run to tell";
        EXPECT_NEAR(mean.value, expected, 3.0 * mean.error) << what;
    };
    const double gamma = 0.5 * options.damping * options.dt;
    check("kinetic energy", block_average(kinetic, 40), std::pow(1.0 + gamma, -2.0));
    check("elastic energy", block_average(elastic, 40), all / n);
    check("level 0", block_average(by_level[0], 40), by_half_step[0] / freedoms[0]);
    check("level 1", block_average(by_level[1], 40), by_half_step[1] / freedoms[1]);
    // What the noise gives and the damping takes, over the change of energy: the books of a warm
    // run.
    EXPECT_NEAR(simulation.balance().heat, simulation.balance().damped,
                0.02 * simulation.balance().damped);
    EXPECT_LT(std::abs(simulation.now().residual), 0.02);
}

TEST(Temperature, OnlyTheDampedDepthIsDriven) {
    SimulationOptions options = test::free_contact(10.0);
    options.damping = 2e-3;
    options.damping_from = 0.5;
    options.temperature = 300.0;
    Simulation simulation = test::simulation(options, test::flat_surface(8));
    simulation.start(30.0);
    simulation.step(false);
    for (const auto& level : simulation.block().levels())
        for (int z = 0; z < level.shape.cells; ++z) {
            const bool deep = level.depth + z * (1 << level.shape.level) >= 3.5;
            EXPECT_EQ(level.v.view().x(0, 0, z) != 0.0, deep)
                << "level " << level.shape.level << " plane " << z;
        }
}

namespace {

struct Approach {
    double binding = 0.0; ///< relaxed from where the approach ends, meV/Å^2
    double there = 0.0;   ///< -(U_LJ + U_el)/A at that moment
    double work = 0.0;    ///< int F dz / A
};

Approach approach_slowly(const SimulationOptions& options, const Surface& surface) {
    Simulation s = test::simulation(options, surface);
    s.start(surface.statistics.highest + cutoff_of(options.interface.potential));
    for (;;) {
        const StepRecord& now = s.step(true);
        if (s.drive().observe({now.time, now.force, 0.0, false})) break;
        if (s.steps() > 300000) {
            ADD_FAILURE() << "no contact";
            break;
        }
    }
    const double area = std::pow(options.block.sites * options.block.spacing, 2);
    Approach result;
    result.there = -1e3 * (s.now().interface_energy + s.now().elastic_energy) / area;
    result.work = 1e3 * s.balance().interface / area;
    const LayerAtRest rest =
        test::bring_to_rest(s.block(), surface, s.reference_height(), options, 1e-6);
    result.binding = rest.numbers.value().binding_energy;
    return result;
}

} // namespace

TEST(Approach, FlatOnFlatEndsInTheStaticMinimumAndDoesItsWork) {
    // A thin block does not jump: the approach is reversible, so its work, the energy where it ends
    // and the static minimum are one number. 10 m/s, damped; the lag of a moving block and the last
    // step cost some 1e-3.
    SimulationOptions options;
    options.block = test::paper_block(8, 4, 0);
    options.interface = test::paper_interface();
    options.drive.velocity = 1e-4;
    options.drive.path = {Segment{Segment::approach}};
    options.damping = 2e-3;
    const Approach a = approach_slowly(options, test::flat_surface(8));
    EXPECT_NEAR(a.binding, 98.86330213, 2e-6);
    EXPECT_NEAR(a.there, 98.8633, 0.05);
    EXPECT_NEAR(a.work, 98.8633, 0.1);
}

TEST(Approach, RoughContactRelaxesToTheStaticState) {
    // The path of the dynamics and the descent from the strongest attraction lead into the same
    // basin; the reference for the lattice of 8 layers is 90.7207652.
    SimulationOptions options;
    options.block = test::paper_block(8, 8, 0);
    options.interface = test::paper_interface();
    options.drive.velocity = 1e-4;
    options.drive.path = {Segment{Segment::approach}};
    options.damping = 2e-3;
    const Approach a = approach_slowly(options, test::reference_surface("n8_a_rms0.4"));
    EXPECT_NEAR(a.binding, 90.720765166, 1e-5);
    EXPECT_LT(a.there, a.binding + 1e-6) << "a moving state cannot lie below the minimum";
    EXPECT_NEAR(a.there, a.binding, 0.1);
}
