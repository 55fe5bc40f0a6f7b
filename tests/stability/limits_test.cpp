// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Hard cases that need the engine itself: where a path cannot start, or where a limit is sharp.
// Each test says first what stable means for it. With ASPERITY_LONG set, long paths are as long as
// in the issue (10^6 steps).
#include "engine/equilibrium/spectral_relaxation.hpp"
#include "engine/run/checkpoint.hpp"
#include "engine/run/theory_command.hpp"
#include "engine/setup/setup.hpp"
#include "io/error.hpp"
#include "support/cases.hpp"
#include "support/elastic_operator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include <unistd.h>

using namespace asperity;

namespace {

const bool at_length = std::getenv("ASPERITY_LONG") != nullptr;

Simulation make(const SimulationOptions& options, const Surface& surface) {
    return Simulation(options, surface, Communicator(), test::serial_grid(options.block));
}

/// A contact of N = 8 sites without drive or damping.
SimulationOptions free_contact(double dt) {
    SimulationOptions options;
    options.block = test::paper_block(8, 7, 2);
    options.interface = test::paper_interface();
    options.drive.velocity = 0.0;
    options.dt = dt;
    return options;
}

/// Worst energy residual of some observed steps; infinite where something is no number.
double worst_residual(Simulation& s, int steps) {
    double worst = 0.0;
    for (int n = 0; n < steps; ++n) {
        s.step(true);
        const double r = std::abs(s.energy_residual());
        worst = std::isfinite(r) ? std::max(worst, r) : INFINITY;
    }
    return worst;
}

} // namespace

// Overlap. Stable: a relaxation from inside the wall ends in the same state as one from outside,
// for no site jumps. A site that starts below the tops of the substrate may be pushed through, for
// the wall is one layer of atoms: then the end is another state, but still one. (No run starts
// there: it comes from out of reach.) A motion from inside the wall keeps its energy if
// the step fits the collision; if it does not, the balance says so at once.

TEST(Overlap, RelaxationComesOutOfTheWall) {
    for (const char* map : {"n8_a_rms0.4", "n8_b_rms1.0"}) {
        const Surface surface = test::reference_surface(map);
        const BlockOptions options = test::paper_block(8, 8, 0);
        const InterfaceOptions potential = test::paper_interface();
        const double outside =
            test::relax_from_attraction(options, potential, surface, 1e-6).binding_energy;
        const auto from = [&](double height) {
            Block block(options, Communicator(), test::serial_grid(options), Motion::at_rest);
            Interface interface(surface, block.grid().tile(0), options.spacing, potential);
            RelaxOptions how;
            how.tolerance = 1e-6;
            Phases phases;
            const RelaxedState state = relax(block, interface, height, how, phases);
            EXPECT_TRUE(state.converged) << map << " from " << height;
            const double edge = options.sites * options.spacing;
            const double binding =
                -1e3 * (state.interface_energy + state.elastic_energy) / (edge * edge);
            std::printf("overlap %s from %.2f A: %lld iterations, %.6f (outside %.6f)\n", map,
                        height, state.iterations, binding, outside);
            return binding;
        };
        for (double above : {1.0, 0.5, 0.1})
            EXPECT_NEAR(from(surface.statistics.highest + above), outside, 1e-7 * outside) << map;
        EXPECT_TRUE(std::isfinite(from(surface.statistics.lowest + 0.1))) << map;
    }
}

TEST(Overlap, MotionKeepsItsEnergyOrSaysSo) {
    // 23 eV a site, 4.7 km/s.
    SimulationOptions options = free_contact(0.5);
    Simulation fine = make(options, test::flat_surface(8));
    fine.start(1.8);
    const double kept = worst_residual(fine, 1000);
    options.dt = 20.0;
    Simulation coarse = make(options, test::flat_surface(8));
    coarse.start(1.8);
    const double lost = worst_residual(coarse, 20);
    std::printf("overlap of 23 eV a site: residual %.1e at 0.5 fs, %.1e at 20 fs\n", kept, lost);
    EXPECT_LT(kept, 1e-2);
    EXPECT_GT(lost, 0.02) << "the guard's limit";
}

// Time step. Stable: below the limit the energy of a free block stays bounded, above it diverges,
// and a scene over the limit is refused with the limit and a step to take.

TEST(TimeStep, TheLimitIsSharp) {
    BlockOptions block = test::paper_block(8, 64, 0);
    const double limit = 2.0 / block.highest_frequency(0.0);
    const auto energy_growth = [&](double dt) {
        SimulationOptions options;
        options.block = block;
        options.interface = test::paper_interface();
        options.drive.velocity = 0.0;
        options.dt = dt;
        Simulation s = make(options, test::flat_surface(8));
        s.start(40.0); // out of reach
        for (int z = 0; z < block.thickness; ++z)
            for (int y = 0; y < 8; ++y)
                for (int x = 0; x < 8; ++x)
                    s.block().levels()[0].u.z.view()(x, y, z) =
                        (z % 2 ? 1e-3 : -1e-3) * (1 + x % 3);
        s.block().exchange();
        double early = 0.0, late = 0.0;
        for (int n = 0; n < 4000; ++n) {
            const StepRecord& now = s.step(n < 500 || n >= 3500);
            if (!now.observed) continue;
            double& most = n < 500 ? early : late;
            most = std::max(most, now.elastic_energy);
            if (!std::isfinite(now.elastic_energy)) return double{INFINITY};
        }
        return late / early;
    };
    const double below = energy_growth(0.99 * limit), above = energy_growth(1.01 * limit);
    std::printf("limit %.3f fs: elastic energy grows by %.3g at 99 %%, by %.3g at 101 %%\n", limit,
                below, above);
    EXPECT_LT(below, 3.0);
    EXPECT_GT(above, 1e6);
}

TEST(TimeStep, ASceneOverTheLimitIsRefused) {
    const auto setup_at = [](double dt) {
        return make_setup(read_scene_text("[surface]\nsites = 16\n", "test.toml",
                                          {"drive.timestep=" + std::to_string(dt)}),
                          1);
    };
    const double limit = setup_at(10.0).longest_timestep;
    EXPECT_NO_THROW(setup_at(0.99 * limit));
    try {
        setup_at(1.01 * limit);
        FAIL() << "accepted";
    } catch (const io::SceneError& error) {
        EXPECT_EQ(error.code(), 2);
        EXPECT_NE(std::string(error.what()).find("is over the stability limit of"),
                  std::string::npos);
    }
}

// Long free oscillation. Stable: the means of the energy over tenths of the path lie together, far
// closer than Verlet's own ripple.

TEST(Oscillation, DoesNotDrift) {
    const int steps = at_length ? 1000000 : 30000;
    Simulation s = make(free_contact(10.0), test::reference_surface("n8_b_rms1.0"));
    s.start(4.5);
    std::array<double, 10> mean{};
    double least = 1e300, most = -1e300;
    for (int n = 0; n < steps; ++n) {
        const StepRecord& now = s.step(true);
        const double energy = now.interface_energy + now.elastic_energy + now.kinetic_energy;
        least = std::min(least, energy), most = std::max(most, energy);
        mean[static_cast<std::size_t>(n / (steps / 10))] += 10.0 * energy / steps;
    }
    const auto [low, high] = std::minmax_element(mean.begin(), mean.end());
    std::printf("%d steps: ripple %.2e eV, means of tenths within %.2e, last minus first %.2e\n",
                steps, most - least, *high - *low, mean.back() - mean.front());
    EXPECT_LT(*high - *low, 0.05 * (most - least));
}

// Poisson's ratio. Stable: the elastic energy of any displacement is positive; no mode is faster
// than the limit taken from the bulk; lattice and spectral block find one state.

TEST(Poisson, EnergyIsPositiveAndTheLimitHolds) {
    for (double poisson : {-0.9, -0.5, 0.0, 0.25, 0.42, 0.49, 0.4999}) {
        for (int layers : {0, 2}) {
            BlockOptions options = test::paper_block(8, layers ? 7 : 5, layers);
            options.poisson = poisson;
            test::ElasticOperator k(options);
            const test::Vector mass = k.tabulate(
                [](const Block::Level& level, int, int z, int, int) { return level.mass(z); });
            double w2 = 0.0, least = 1e300;
            for (unsigned seed : {1u, 2u, 3u, 4u}) {
                test::Vector u = test::random_vector(k.size(), seed);
                for (int iteration = 0; iteration < 60; ++iteration) {
                    k.set(u);
                    const test::Vector f = k.force();
                    double uu = 0.0;
                    for (std::size_t i = 0; i < u.size(); ++i)
                        uu += u[i] * mass[i] * u[i];
                    const double quotient = -test::dot(u, f) / uu;
                    w2 = std::max(w2, quotient), least = std::min(least, quotient);
                    const double norm = std::sqrt(test::dot(f, f));
                    for (std::size_t i = 0; i < u.size(); ++i)
                        u[i] = -f[i] / mass[i] / norm;
                }
            }
            EXPECT_GT(least, 0.0) << poisson;
            EXPECT_LE(std::sqrt(w2), options.highest_frequency(0.0) * (1.0 + 1e-12)) << poisson;
            if (layers == 0)
                std::printf("Poisson %.4f: step limit %.3g fs\n", poisson,
                            2.0 / options.highest_frequency(0.0));
        }
    }
}

TEST(Poisson, LatticeAndSpectralBlockAgree) {
    for (double poisson : {-0.5, 0.0, 0.25, 0.49, 0.4999}) {
        BlockOptions options = test::paper_block(8, 6, 0);
        options.poisson = poisson;
        const Surface surface = test::reference_surface("n8_a_rms0.4");
        const InterfaceOptions potential = test::paper_interface();
        const auto lattice = test::relax_from_attraction(options, potential, surface, 1e-5);
        const auto spectral = test::relax_spectral(options, potential, surface, 1e-5);
        ASSERT_TRUE(lattice.state.converged && spectral.state.converged) << poisson;
        std::printf("Poisson %.4f: lattice %.8f (%lld iterations), spectral %.8f (%lld)\n", poisson,
                    lattice.binding_energy, lattice.state.iterations, spectral.binding_energy,
                    spectral.state.iterations);
        EXPECT_NEAR(lattice.binding_energy, spectral.binding_energy,
                    1e-6 * spectral.binding_energy);
    }
}

// Thickness, levels, sizes. Stable: lattice and spectral block agree where both can be had; a
// uniform column has its stiffness; a path keeps its energy.

TEST(Thickness, OneLayer) {
    const Surface surface = test::reference_surface("n8_b_rms1.0");
    const BlockOptions options = test::paper_block(8, 1, 0);
    const auto lattice =
        test::relax_from_attraction(options, test::paper_interface(), surface, 1e-6);
    const auto spectral = test::relax_spectral(options, test::paper_interface(), surface, 1e-6);
    ASSERT_TRUE(lattice.state.converged && spectral.state.converged);
    EXPECT_NEAR(lattice.binding_energy, spectral.binding_energy, 1e-8 * spectral.binding_energy);
}

TEST(Thickness, FourThousandLayers) {
    // The uniform mode is a spring of (lambda + 2 mu) / thickness, whatever the levels; the
    // spectral block does not feel a clamp so far away.
    for (int sites : {8, 32}) {
        const BlockOptions options = test::paper_block(sites, 4096, 2);
        test::ElasticOperator k(options);
        const test::Vector u = k.tabulate([&](const Block::Level& level, int c, int z, int, int) {
            const double depth = level.depth + z * static_cast<double>(1 << level.plan.level);
            return c == 2 ? 1.0 - depth / options.thickness : 0.0;
        });
        k.set(u);
        const double area = std::pow(options.sites * options.spacing, 2);
        const double expected = (options.lame() + 2.0 * options.shear_modulus()) /
                                (options.thickness * options.spacing);
        EXPECT_NEAR(2.0 * k.energy() / area, expected, 1e-11 * expected) << sites;
    }
    // Sideways the block hangs on a spring of mu / thickness: it binds better the thicker it is,
    // and what is left to gain falls like one over the thickness.
    const Surface surface = test::reference_surface("n8_b_rms1.0");
    const auto binding = [&](int thickness) {
        return test::relax_spectral(test::paper_block(8, thickness, 0), test::paper_interface(),
                                    surface, 1e-7)
            .binding_energy;
    };
    const double first = binding(2048) - binding(1024), second = binding(4096) - binding(2048);
    std::printf("binding gained from 1024 to 2048 layers %.3e, to 4096 %.3e\n", first, second);
    EXPECT_GT(first, 0.0);
    EXPECT_NEAR(first / second, 2.0, 0.05);
}

TEST(Levels, OneAndTen) {
    // Ten levels need 512 sites; 512 cells of 2 layers a level and more.
    const int sites = 512, thickness = 2 * 1023;
    const BlockOptions options = test::paper_block(sites, thickness, 2);
    ASSERT_EQ(plan_levels(options).size(), 10u);
    SimulationOptions s;
    s.block = options;
    s.interface = test::paper_interface();
    s.drive.velocity = 5e-4;
    s.dt = 10.0;
    Simulation ten = make(s, test::flat_surface(sites));
    ten.start(3.3);
    const double residual = worst_residual(ten, at_length ? 500 : 30);
    std::printf("ten levels: residual %.1e\n", residual);
    EXPECT_LT(residual, 1e-3);
    s.block = test::paper_block(16, 16, 0);
    ASSERT_EQ(plan_levels(s.block).size(), 1u);
    Simulation one = make(s, test::flat_surface(16));
    one.start(3.3);
    EXPECT_LT(worst_residual(one, 300), 1e-3);
}

TEST(Sites, AnyNumber) {
    // Odd, prime and small boxes: what cannot be halved stays one level.
    for (int sites : {8, 9, 11, 13, 15, 17}) {
        Surface surface = test::flat_surface(sites);
        for (int y = 0; y < sites; ++y)
            for (int x = 0; x < sites; ++x)
                surface.height[static_cast<std::size_t>(y * sites + x)] =
                    0.5 * std::sin(6.2831853 * x / sites) * std::cos(12.5663706 * y / sites);
        const auto [low, high] = std::minmax_element(surface.height.begin(), surface.height.end());
        surface.statistics.lowest = *low, surface.statistics.highest = *high;
        const InterfaceOptions potential = test::paper_interface(3.0);
        const auto lattice =
            test::relax_from_attraction(test::paper_block(sites, 7, 0), potential, surface, 1e-6);
        const auto spectral =
            test::relax_spectral(test::paper_block(sites, 7, 0), potential, surface, 1e-6);
        const auto levels =
            test::relax_from_attraction(test::paper_block(sites, 7, 2), potential, surface, 1e-6);
        ASSERT_TRUE(lattice.state.converged && spectral.state.converged && levels.state.converged);
        EXPECT_NEAR(lattice.binding_energy, spectral.binding_energy, 1e-7 * spectral.binding_energy)
            << sites;
        EXPECT_EQ(plan_levels(test::paper_block(sites, 7, 2)).size(), sites % 2 ? 1u : 2u);
        EXPECT_NEAR(levels.binding_energy, lattice.binding_energy,
                    (sites % 2 ? 1e-9 : 0.05) * lattice.binding_energy)
            << sites;
    }
}

// Load. Stable: the relaxed state carries what presses it, from nothing to fifty times the largest
// tension.

TEST(Load, FromNothingToHuge) {
    const BlockOptions options = test::paper_block(8, 8, 2);
    const Surface surface = test::reference_surface("n8_b_rms1.0");
    const double area = std::pow(options.sites * options.spacing, 2);
    double height_before = 1e300;
    for (double gpa : {0.0, 1.0, 10.0, 100.0, 500.0}) {
        Block block(options, Communicator(), test::serial_grid(options), Motion::at_rest);
        Interface interface(surface, block.grid().tile(0), options.spacing,
                            test::paper_interface());
        RelaxOptions how;
        how.tolerance = 1e-6;
        how.load = gpa / 160.21766 * area;
        Phases phases;
        const RelaxedState state = relax(block, interface, 4.0, how, phases);
        ASSERT_TRUE(state.converged) << gpa;
        std::printf("load %.0f GPa: %lld iterations, height %.3f A\n", gpa, state.iterations,
                    4.0 + state.mean_height);
        EXPECT_NEAR(state.force, how.load, 1e-6 * 64) << gpa;
        EXPECT_LT(state.mean_height, height_before) << "pressed further";
        height_before = state.mean_height;
    }
}

// Bifurcation. Stable: where the state jumps, the relaxation still ends, in one of the two states,
// forces below the tolerance; either side of the jump is what it was far from it.

TEST(Bifurcation, TheRelaxationEndsOnOneBranch) {
    const BlockOptions options = test::paper_block(8, 200, 0);
    SpectralBlock block(options, Communicator());
    const Interface interface(test::flat_surface(8), block.tile(), options.spacing,
                              test::paper_interface());
    RelaxOptions how;
    how.tolerance = 1e-5;
    how.max_move = 0.2;
    const double start = 12.0;
    const auto state_at = [&](double top) {
        Phases phases;
        block.set_uniform(top);
        block.hold_top(top);
        return relax(block, interface, start, how, phases);
    };
    // From above, out of contact; and, further down, snapped in.
    const auto gap = [&](const RelaxedState& s) { return start + s.mean_height; };
    double above = -1.0, below = -9.0;
    ASSERT_GT(gap(state_at(above)), 8.0);
    ASSERT_LT(gap(state_at(below)), 4.0);
    long long most = 0;
    for (int halving = 0; halving < 40; ++halving) {
        const double middle = 0.5 * (above + below);
        const RelaxedState s = state_at(middle);
        ASSERT_TRUE(s.converged) << "top at " << middle << ", residual " << s.residual;
        most = std::max(most, s.iterations);
        (gap(s) > 4.0 ? above : below) = middle;
    }
    const double out = gap(state_at(above)), in = gap(state_at(below));
    std::printf(
        "snap-in at a top of %.9f A: gap %.4f before, %.4f after, at most %lld iterations\n", above,
        out, in, most);
    EXPECT_GT(out, 4.2);
    EXPECT_LT(in, 3.6);
    EXPECT_LT(above - below, 1e-10);
}

// Restart. Stable: a checkpoint taken while the block snaps in leads to the same bits.

TEST(Restart, InsideASnapIn) {
    SimulationOptions options;
    options.block = test::paper_block(16, 62, 2);
    options.interface = test::paper_interface();
    options.drive.velocity = 2e-4;
    options.damping = 1e-3;
    const Surface surface = test::reference_surface("c1_N16_T16_rms0.5");
    Simulation s = make(options, surface);
    s.start(7.0);
    double fastest = 0.0, height = 7.0;
    for (int n = 0; n < 3000; ++n) { // until the layer falls twice as fast as the top
        s.step(false);
        fastest = (height - s.now().mean_height) / options.dt;
        height = s.now().mean_height;
        if (fastest > 2.0 * options.drive.velocity) break;
    }
    ASSERT_GT(fastest, 2.0 * options.drive.velocity) << "no snap-in";
    const auto path = (std::filesystem::temp_directory_path() /
                       ("asperity-snap-" + std::to_string(::getpid()) + ".h5"))
                          .string();
    write_checkpoint(path, s, {}, "snap");
    Simulation again = make(options, surface);
    read_checkpoint(path, again, "snap");
    std::filesystem::remove(path);
    for (int n = 0; n < 300; ++n)
        s.step(n % 50 == 0), again.step(n % 50 == 0);
    EXPECT_EQ(test::fingerprint(s.block()), test::fingerprint(again.block()));
    EXPECT_EQ(s.now().force, again.now().force);
    EXPECT_EQ(s.energy_residual(), again.energy_residual());
    std::printf("restarted at %.0f m/s of the snap-in, %.2f A above the surface\n", 1e5 * fastest,
                height);
}

// Theory. Stable: at the ends of what a scene may say it gives a finite answer, not below nothing
// and, where the true area is not counted, not above flat; or it says which key it cannot work
// with.

TEST(Theory, AtTheEndsOfItsKeys) {
    int answers = 0, refusals = 0;
    for (const char* rms : {"0.001", "0.5", "3", "30", "300"})
        for (const char* hurst : {"0", "0.5", "1"})
            for (const char* epsilon : {"1e-4", "0.1", "10"})
                for (const char* rolloff : {"1", "3", "200"})
                    for (const char* area : {"gaussian", "none"}) {
                        const std::string what = std::string(rms) + " " + hurst + " " + epsilon +
                                                 " " + rolloff + " " + area;
                        try {
                            const Scene scene =
                                read_scene_text("[surface]\nsites = 512\n", "test.toml",
                                                {std::string("surface.rms=") + rms,
                                                 std::string("surface.hurst=") + hurst,
                                                 std::string("interface.epsilon=") + epsilon,
                                                 std::string("surface.rolloff=") + rolloff,
                                                 std::string("theory.area_factor=") + area});
                            const TheoryCase c = theory_case(scene);
                            const TheoryNumbers n = solve_theory(c);
                            EXPECT_TRUE(std::isfinite(n.gamma_eff)) << what;
                            EXPECT_GE(n.gamma_eff, 0.0) << what;
                            if (std::string(area) == "none") {
                                EXPECT_LE(n.gamma_eff, c.delta_gamma * (1.0 + 1e-9)) << what;
                            }
                            ++answers;
                        } catch (const io::SceneError& error) {
                            EXPECT_NE(std::string(error.what()).find("surface."), std::string::npos)
                                << what << ": " << error.what();
                            ++refusals;
                        }
                    }
    std::printf("theory: %d answers, %d refusals\n", answers, refusals);
    EXPECT_GT(answers, 100);
}
