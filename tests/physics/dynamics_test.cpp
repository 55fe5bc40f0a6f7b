// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The motion: what velocity Verlet promises (an energy error that falls as dt^2, time
// reversal; drift: stability/motion_limits_test), the books of a damped and driven run, a
// temperature that is the one asked for, and a slow approach that ends in the static state.
#include "engine/units.hpp"
#include "support/cases.hpp"
#include "support/elastic_operator.hpp"
#include "support/nodes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

using namespace asperity;

namespace {

/// A small rough contact with its top held, released from a strained state.
test::Driven released(const SimulationOptions& options, double height = 4.5) {
    test::Driven s = test::simulation(options, test::reference_surface("n8_b_rms1.0"));
    s.start(height);
    return s;
}
/// Energy at the whole step, eV.
double energy_of_step(test::Driven& s) {
    const StepRecord& now = s.step(true);
    return now[Term::interface] + now[Term::elastic] + now[Term::kinetic];
}

/// Least and greatest energy over a stretch of time.
double energy_ripple(double dt, double duration, bool finite_strain) {
    SimulationOptions options = test::free_contact(dt);
    options.block.finite_strain = finite_strain;
    test::Driven s = released(options);
    double least = 1e300, most = -1e300;
    for (int n = 0; n * dt < duration; ++n) {
        const double energy = energy_of_step(s);
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

TEST(Verlet, ReversedVelocitiesRetraceThePath) {
    // Leapfrog is its own mirror image: with v(n+1/2) reversed and the drift undone, the same steps
    // lead back. What remains is rounding, grown by the contact's instability over 200 steps.
    constexpr int there = 200;
    for (int layers : {0, 2})
        for (bool finite : {false, true})
            for (bool mixed : {false, true}) {
                SimulationOptions options = test::free_contact(10.0, layers);
                options.block.finite_strain = finite;
                options.interface.mixed = mixed;
                test::Driven s = released(options);
                Block& block = s.block_to_write();
                const auto positions = [&] {
                    std::vector<double> all;
                    test::each_node(block, [&](const Block::Level& l, int x, int y, int z) {
                        for (const double* u : test::components(l.u.view(), x, y, z))
                            all.push_back(*u);
                    });
                    return all;
                };
                const auto steps = [&](int count) {
                    for (int n = 0; n < count; ++n)
                        s.step(true);
                };
                steps(50);
                const auto first = positions();
                steps(there);
                EXPECT_GT(test::largest_difference(positions(), first), 0.3);
                // u(n+1), v(n+1/2)  ->  u(n), -v(n+1/2): the mirrored state before the step back.
                test::each_node(block, [&](const Block::Level& l, int x, int y, int z) {
                    const Block::Fields own = block.fields(l);
                    const auto u = test::components(own.u.view(), x, y, z),
                               v = test::components(own.v.view(), x, y, z);
                    for (std::size_t c = 0; c < 3; ++c) {
                        *u[c] -= options.dt * *v[c];
                        *v[c] = -*v[c];
                    }
                });
                block.exchange();
                steps(there - 1);
                EXPECT_LT(test::largest_difference(positions(), first), 1e-9);
            }
}

TEST(EnergyBalance, ADrivenDampedRunBalances) {
    // Work of the top plane and of the moving medium = change of energy + dissipation, up to the
    // trapezia's dt^2.
    const auto residual = [](double dt) {
        SimulationOptions options = test::free_contact(dt);
        options.drive.velocity = 5e-4; // 50 m/s
        options.damping = 2e-3;
        test::Driven s = released(options, 8.0);
        double worst = 0.0;
        while (s.time() < 12000.0)
            worst = std::max(worst, std::abs(s.step(true).residual));
        const EnergyBalance& l = s.balance();
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
        test::Driven s = released(options);
        const double before = energy_of_step(s);
        double after = before;
        while (s.time() < 15000.0)
            after = energy_of_step(s);
        const EnergyBalance& l = s.balance();
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
    // at half steps, are those of T / (1 - (w dt/2)^2); the record's kinetic energy and the
    // velocities at whole steps those of T. A long step and a strong damping make the first
    // correction, and the 10 % that the mean of two half steps lacks, larger than the statistical
    // error, and nothing else is allowed for.
    SimulationOptions options = test::free_contact(20.0);
    options.damping = 5e-3; // 1/fs: memory of 0.2 ps
    options.temperature = 300.0;
    test::Driven simulation = test::simulation(options, test::flat_surface(8));
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
    std::vector<double> kinetic, elastic, at_step;
    VectorField<double> velocities(simulation.block().grid().tile(0), 1);
    const auto layer = [&](const auto& visit) {
        const auto v = simulation.block().levels().front().v.view()[0];
        const auto to = velocities.plane(0);
        for (const auto& [a, b] : {std::pair{&to.x, &v.x}, {&to.y, &v.y}, {&to.z, &v.z}})
            for (int y = 0; y < a->ny; ++y)
                for (int x = 0; x < a->nx; ++x)
                    visit((*a)(x, y), (*b)(x, y));
    };
    std::vector<std::vector<double>> by_level(levels.size());
    constexpr int steps = 40000, warm_up = 1000; // 800 ps, 4000 memories
    for (int step = 0; step < steps + warm_up; ++step) {
        layer([](double& kept, double v) { kept = v; });
        const StepRecord& now = simulation.step(true);
        if (step < warm_up) continue;
        layer([](double& kept, double v) { kept = 0.5 * (kept + v); });
        simulation.set_velocities_at_step(velocities.plane(0));
        double squares = 0.0;
        layer([&](double& v, double) { squares += v * v; });
        at_step.push_back(squares * levels[0].mass(0) / (3.0 * 64.0 * kt));
        kinetic.push_back(now[Term::kinetic] / (0.5 * kt * n));
        elastic.push_back(now[Term::elastic] / (0.5 * kt * n));
        if (step % 5) continue;
        std::vector<double> sums(levels.size());
        test::each_node(simulation.block(), [&](const Block::Level& l, int x, int y, int z) {
            for (const double* v : test::components(l.v.view(), x, y, z))
                sums[static_cast<std::size_t>(l.shape.level)] += l.mass(z) * *v * *v;
        });
        for (std::size_t l = 0; l < levels.size(); ++l)
            by_level[l].push_back(sums[l] / (kt * freedoms[l]));
    }
    const auto check = [](const char* what, const Mean& mean, double expected) {
        EXPECT_LT(mean.error, 0.003) << "too short a run to tell";
        EXPECT_NEAR(mean.value, expected, 3.0 * mean.error) << what;
    };
    check("kinetic energy", block_average(kinetic, 40), 1.0);
    check("elastic energy", block_average(elastic, 40), all / n);
    check("level 0", block_average(by_level[0], 40), by_half_step[0] / freedoms[0]);
    check("level 1", block_average(by_level[1], 40), by_half_step[1] / freedoms[1]);
    // What the noise gives and the damping takes, over the change of energy: the balance is of
    // what is left of them, which does not grow.
    EXPECT_NEAR(simulation.balance().heat, simulation.balance().damped,
                0.02 * simulation.balance().damped);
    EXPECT_LT(std::abs(simulation.now()[Term::lost]), 2.0 * kt * n);
    EXPECT_GT(simulation.balance().damped, 1000.0 * kt * n);
    EXPECT_LT(std::abs(simulation.now().residual), 1e-8);
    // The lowest layer's velocities, as a trajectory has them.
    const Mean of_layer = block_average(at_step, 40);
    EXPECT_LT(of_layer.error, 0.006);
    EXPECT_NEAR(of_layer.value, 1.0, 3.0 * of_layer.error);
}

namespace {

/// A warm block beyond the interaction range (30 Å), or in contact.
SimulationOptions warm_block(double dt, double damping, double from, double temperature,
                             double stiffer, double heavier) {
    SimulationOptions options = test::free_contact(dt);
    options.damping = damping;
    options.damping_from = from;
    options.temperature = temperature;
    options.block.young *= stiffer;
    options.block.atom_mass *= heavier;
    return options;
}

/// The largest error of the energy balance over some steps.
double largest_error(test::Driven& s, int steps) {
    double worst = 0.0;
    for (int n = 0; n < steps; ++n)
        worst = std::max(worst, std::abs(s.step(true).residual));
    return worst;
}

} // namespace

TEST(Temperature, TheBalanceOfSpringsIsExactFromTheFirstStep) {
    // Work, friction, noise and energies of one time level: over springs nothing is left, whatever
    // the step, also while a cold block warms up and where its top plane moves.
    for (const double dt : {5.0, 20.0, 40.0})
        for (const double damping : {1e-4, 1e-3, 2e-2})
            for (const double from : {0.0, 0.5})
                for (const auto& [stiffer, heavier] : {std::pair{1.0, 1.0}, {1.5, 0.7}}) {
                    SimulationOptions options =
                        warm_block(dt, damping, from, 300.0, stiffer, heavier);
                    options.drive.velocity = 5e-4;
                    options.drive.path = {{Segment::pull_off, 0.0, 0, "pull-off"}};
                    options.drive.ramp = 500.0;
                    test::Driven s = test::simulation(options, test::flat_surface(8));
                    s.start(30.0);
                    EXPECT_LT(largest_error(s, 200), 1e-10)
                        << dt << " fs, " << damping << " / fs from " << from;
                    EXPECT_GT(s.now()[Term::kinetic], 0.0);
                }
}

TEST(Temperature, InContactTheBalanceErrsAsTheSquareOfTheStep) {
    // What springs leave out: the pairs' forces are no springs. The same without a thermostat: a
    // block that is as warm and has no damping errs as much.
    const auto errors = [](double dt) {
        SimulationOptions options = warm_block(dt, 1e-3, 0.0, 300.0, 1.5, 1.0);
        test::Driven warm = test::simulation(options, test::flat_surface(8));
        warm.start(3.2);
        const double with = largest_error(warm, static_cast<int>(8000.0 / dt));
        options.temperature = options.damping = 0.0;
        test::Driven alone = test::simulation(options, test::flat_surface(8));
        alone.start(3.2);
        Block& to = alone.block_to_write();
        test::each_node(warm.block(), [&](const Block::Level& level, int x, int y, int z) {
            const Block::Fields there = to.fields(level);
            for (const auto& [from, into] : {std::pair{&level.u, &there.u}, {&level.v, &there.v}}) {
                into->view().x(x, y, z) = from->view().x(x, y, z);
                into->view().y(x, y, z) = from->view().y(x, y, z);
                into->view().z(x, y, z) = from->view().z(x, y, z);
            }
        });
        to.exchange();
        return std::pair{with, largest_error(alone, static_cast<int>(8000.0 / dt))};
    };
    const auto coarse = errors(20.0), fine = errors(10.0), finest = errors(5.0);
    EXPECT_NEAR(coarse.first / finest.first, 16.0, 8.0);
    EXPECT_LT(fine.first, 2e-3);
    EXPECT_LT(coarse.first, 2.0 * coarse.second);
}

TEST(Temperature, AtRestNoHeatIsLostOnAverage) {
    // In contact and in equilibrium the net heat fluctuates with the energy and does not grow: its
    // rate vanishes within its error, and the error is a small part of what goes to and fro.
    test::Driven s =
        test::simulation(warm_block(10.0, 1e-3, 0.0, 300.0, 1.0, 1.0), test::flat_surface(8));
    s.start(3.2);
    for (int n = 0; n < 2000; ++n)
        s.step(false);
    std::vector<double> rate;
    double gross = -s.balance().damped, before = s.balance().net_damped();
    constexpr int blocks = 40;
    for (int block = 0; block < blocks; ++block) {
        for (int n = 0; n < 250; ++n)
            s.step(false);
        const double now = s.balance().net_damped();
        rate.push_back(now - before);
        before = now;
    }
    gross += s.balance().damped;
    const Mean mean = block_average(rate, 20);
    EXPECT_LT(std::abs(mean.value), 3.0 * mean.error);
    EXPECT_LT(mean.error * blocks, 0.05 * gross);
    EXPECT_LT(std::abs(mean.value) * blocks, 0.02 * gross);
}

TEST(Temperature, OnlyTheDampedDepthIsDriven) {
    SimulationOptions options = test::free_contact(10.0);
    options.damping = 2e-3;
    options.damping_from = 0.5;
    options.temperature = 300.0;
    test::Driven simulation = test::simulation(options, test::flat_surface(8));
    simulation.start(30.0);
    simulation.step(false);
    test::each_node(simulation.block(), [](const Block::Level& l, int x, int y, int z) {
        const bool deep = l.depth + z * (1 << l.shape.level) >= 3.5;
        EXPECT_EQ(l.v.view().x(x, y, z) != 0.0, deep)
            << "level " << l.shape.level << " plane " << z;
    });
}

TEST(Temperature, AnotherSeedIsAnotherNoise) {
    const auto heat = [](std::uint64_t seed) {
        SimulationOptions options = test::free_contact(10.0);
        options.damping = 2e-3;
        options.temperature = 300.0;
        options.seed = seed;
        test::Driven s = released(options);
        for (int n = 0; n < 3; ++n)
            s.step(false);
        return s.balance().heat;
    };
    EXPECT_EQ(heat(1), heat(1));
    EXPECT_NE(heat(1), heat(2));
}

TEST(Damping, ActsOnTheLayersItIsGivenAlone) {
    // One step of the same state, with and without: the layers below damping_from keep their bits.
    SimulationOptions without = test::free_contact(10.0);
    without.block = test::paper_block(8, 8, 0);
    SimulationOptions with = without;
    with.damping = 5e-3;
    with.damping_from = 0.5;
    test::Driven plain = released(without), damped = released(with);
    for (test::Driven* s : {&plain, &damped}) {
        Block& block = s->block_to_write();
        auto& v = block.fields(block.levels().front()).v; // faster than the medium
        for (int z = 0; z < 8; ++z)
            v.plane(z).z(3, 5) = 1e-3;
        s->step(false);
    }
    for (int z = 0; z < 8; ++z) {
        const double free = plain.block().levels().front().v.view()[z].z(3, 5);
        const double slowed = damped.block().levels().front().v.view()[z].z(3, 5);
        if (z < 4)
            EXPECT_EQ(slowed, free) << z;
        else
            EXPECT_LT(std::abs(slowed), std::abs(free)) << z;
    }
}

namespace {

struct Approach {
    double binding = 0.0; ///< relaxed from where the approach ends, meV/Å^2
    double there = 0.0;   ///< -(U_LJ + U_el)/A at that moment
    double work = 0.0;    ///< int F dz / A
};

/// Of a lattice of so many layers, at 10 m/s, damped.
Approach approach_slowly(int layers, const Surface& surface) {
    SimulationOptions options;
    options.block = test::paper_block(8, layers, 0);
    options.interface = test::paper_interface();
    options.drive.velocity = 1e-4;
    options.drive.path = {Segment{Segment::approach}};
    options.damping = 2e-3;
    test::Driven s = test::simulation(options, surface);
    s.start(surface.statistics.highest + cutoff_of(options.interface.potential));
    test::lead(s, [](const StepRecord&, std::size_t, bool) {});
    const double area = std::pow(options.block.sites * options.block.spacing, 2);
    Approach result;
    result.there = -1e3 * (s.now()[Term::interface] + s.now()[Term::elastic]) / area;
    result.work = 1e3 * s.balance().interface / area;
    const LayerAtRest rest =
        test::bring_to_rest(s.block(), surface, s.interface().reference_height(), options, 1e-6);
    result.binding = rest.numbers.value().binding_energy;
    return result;
}

} // namespace

TEST(Approach, FlatOnFlatEndsInTheStaticMinimumAndDoesItsWork) {
    // A thin block does not jump: the approach is reversible, so its work, the energy where it ends
    // and the static minimum are one number. The lag of a moving block and the last step cost some
    // 1e-3.
    const Approach a = approach_slowly(4, test::flat_surface(8));
    EXPECT_NEAR(a.binding, 98.86330213, 2e-6);
    EXPECT_NEAR(a.there, 98.8633, 0.05);
    EXPECT_NEAR(a.work, 98.8633, 0.1);
}

TEST(Approach, RoughContactRelaxesToTheStaticState) {
    // The path of the dynamics and the descent from the strongest attraction lead into the same
    // basin; the reference for the lattice of 8 layers is 90.7207652.
    const Approach a = approach_slowly(8, test::reference_surface("n8_a_rms0.4"));
    EXPECT_NEAR(a.binding, 90.720765166, 1e-5);
    EXPECT_LT(a.there, a.binding + 1e-6) << "a moving state cannot lie below the minimum";
    EXPECT_NEAR(a.there, a.binding, 0.1);
}
