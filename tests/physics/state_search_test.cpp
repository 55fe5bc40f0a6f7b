// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// All stable states of a contact. A summit holds two flat solids apart: besides the state in which
// it alone touches there is one of full contact, and a barrier between them. Each state is stable
// in every direction (smallest eigenvalue of its Hessian), their energies differ by the work of the
// force between them, and neither the step nor the block's model nor a resume changes them.
#include "engine/equilibrium/state_search.hpp"
#include "engine/interface/flat_reference.hpp"
#include "engine/run/checkpoint.hpp"
#include "engine/scene/surface.hpp"
#include "engine/units.hpp"
#include "support/elastic_operator.hpp"
#include "support/nodes.hpp"
#include "support/path_case.hpp"
#include "support/scratch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <utility>
#include <vector>

using namespace asperity;
using test::energy;
using Solids = test::PathCase;

namespace {

constexpr double tolerance = 1e-5;

/// A round hill on a flat surface, periodic.
Surface hill(int sites, double height, double width) {
    return test::surface_from(sites, [=](int x, int y) {
        const double away = 2.6 * std::hypot(x - sites / 2, y - sites / 2);
        return height * std::exp(-0.5 * away * away / (width * width));
    });
}

/// Without friction displacements are normal only: with lateral ones, sites between atoms of the
/// substrate are states of their own, and slip from one to the next.
using test::Friction;

/// Over such a hill, with 32 layers.
Solids over_hill(double height, double width, Friction friction = Friction::with) {
    return Solids(test::paper_block(32, 32, 0), hill(32, height, width), friction);
}
/// Relaxed energy where the summit alone touches, full contact, and a single way between them.
Solids two_states(Friction friction = Friction::with) { return over_hill(12.0, 6.0, friction); }

/// The same hill as a wall of smeared atoms.
Solids two_states_over_a_wall() {
    return Solids(test::paper_block(32, 32, 0), hill(32, 12.0, 6.0),
                  SmearedWall(LennardJones{0.1, 3.28, 13.12}, 1.0 / (2.6 * 2.6), false));
}

double area(const Solids& c) { return 6.76 * c.sites(); }

ZeroLoad relax_free(Solids& c, double load = 0.0) {
    const RelaxedState s = c.relax(Constraint::load(load), tolerance);
    ZeroLoad z;
    z.binding_energy = -1e3 * energy(s) / area(c);
    z.contact_fraction = static_cast<double>(s.in_contact) / c.sites();
    z.mean_height = c.interface.start_height() + s.mean_height;
    return z;
}

/// Displacements of the lowest layer.
using Layer = std::vector<double>;
Layer layer_of(const SpectralBlock& block) { return test::values_of(block.lowest_layer()); }

struct Search {
    Solids& c;
    std::vector<Layer> layers; ///< of the states, in the order in which they were relaxed
    double load;               ///< eV/Å, pressing down
    StateSearch search;

    explicit Search(Solids& contact, double step = 0.25, bool to_the_end = true, double press = 0.0)
        : c(contact), load(press), search(c.block, c.interface, options(step, to_the_end)) {}
    /// To the end: until no area is left to attract, after every instability.
    StateSearchOptions options(double step, bool to_the_end) {
        StateSearchOptions o;
        o.step = step;
        o.tolerance = tolerance;
        o.load = load;
        o.reference_height = c.interface.start_height();
        o.area = area(c);
        o.largest_tension = 9.0 * units::gigapascal;
        if (to_the_end)
            o.least_loss = 0.0;
        else
            o.flat_energy = [this](double distance) {
                return flat_pair_sum(c.interface.options(), 2.6, 1, 1, distance).energy / 6.76;
            };
        o.softest_wave = c.options.softest_wave();
        o.relax_free = [this] { return relaxed(); };
        return o;
    }
    ZeroLoad relaxed() {
        const ZeroLoad z = relax_free(c, load);
        layers.push_back(layer_of(c.block));
        return z;
    }
    void start() {
        c.block.set_uniform(height_of_strongest_attraction(c.block, c.interface, -20.0) -
                            c.interface.start_height());
        search.start(relaxed());
    }
    StateList run() {
        start();
        for (int i = 0; search.advance() != StateSearch::Outcome::done; ++i)
            if (i > 1000) {
                ADD_FAILURE() << "no end";
                break;
            }
        return search.found();
    }
};

StateList all_states(Solids& c, double step = 0.25, bool to_the_end = true) {
    return Search(c, step, to_the_end).run();
}

/// The smallest eigenvalue that Lanczos' method finds of the Hessian of the energy under no load.
class Hessian {
public:
    Hessian(const Solids& c, const Layer& at)
        : block_(c.options, Communicator()), interface_(c.interface),
          height_(c.interface.start_height()), at_(at) {}

    double smallest(int steps) {
        std::mt19937_64 random(3);
        std::normal_distribution<double> normal;
        std::vector<Layer> basis(1, Layer(at_.size()));
        for (double& v : basis[0])
            v = normal(random);
        scale(basis[0], 1.0 / std::sqrt(test::dot(basis[0], basis[0])));
        std::vector<double> diagonal, beside;
        for (int i = 0; i < steps; ++i) {
            Layer next = times(basis.back());
            diagonal.push_back(test::dot(next, basis.back()));
            for (int twice = 0; twice < 2; ++twice)
                for (const Layer& b : basis)
                    add(-test::dot(next, b), b, next);
            beside.push_back(std::sqrt(test::dot(next, next)));
            scale(next, 1.0 / beside.back());
            basis.push_back(std::move(next));
        }
        // By bisection: below x lie as many eigenvalues as pivots of T - x are negative.
        double low = -100.0, high = 100.0;
        for (int i = 0; i < 60; ++i) {
            const double x = 0.5 * (low + high);
            bool negative = false;
            double pivot = 1.0;
            for (std::size_t k = 0; k < diagonal.size(); ++k) {
                pivot = diagonal[k] - x - (k > 0 ? beside[k - 1] * beside[k - 1] / pivot : 0.0);
                negative = negative || pivot < 0.0;
            }
            (negative ? high : low) = x;
        }
        return low;
    }

private:
    static void scale(Layer& a, double by) {
        for (double& v : a)
            v *= by;
    }
    static void add(double by, const Layer& a, Layer& to) {
        for (std::size_t i = 0; i < a.size(); ++i)
            to[i] += by * a[i];
    }
    Layer gradient(const Layer& u) {
        const VectorPlane<double> layer = block_.layer().plane(0);
        std::size_t i = 0;
        for (const auto& component : {layer.x, layer.y, layer.z})
            for (int y = 0; y < component.ny; ++y)
                for (int x = 0; x < component.nx; ++x)
                    component(x, y) = u[i++];
        block_.apply_constraint();
        interface_.sweep(block_.lowest_layer(), block_.interface_force(), height_, {});
        auto waves = block_.new_waves<double>();
        block_.gradient(waves);
        auto sites = block_.new_field<double>();
        block_.at_sites(waves, sites);
        Layer g;
        for (auto& component : sites) {
            const Layer one = test::values_of(component.plane(0));
            g.insert(g.end(), one.begin(), one.end());
        }
        return g;
    }
    Layer times(const Layer& v) {
        constexpr double h = 1e-3;
        Layer above = at_, below = at_;
        add(h, v, above);
        add(-h, v, below);
        Layer product = gradient(above);
        add(-1.0, gradient(below), product);
        scale(product, 0.5 / h);
        return product;
    }

    SpectralBlock block_;
    const Interface& interface_;
    double height_;
    Layer at_;
};

void expect_same(const StateList& a, const StateList& b, double fraction) {
    ASSERT_EQ(a.all.size(), b.all.size());
    for (std::size_t i = 0; i < a.all.size(); ++i) {
        const ZeroLoad &x = a.all[i].numbers, &y = b.all[i].numbers;
        EXPECT_NEAR(x.binding_energy, y.binding_energy, fraction * std::abs(x.binding_energy)) << i;
        EXPECT_NEAR(x.mean_height, y.mean_height, 0.02) << i;
    }
}

/// The force between two states, integrated, is what their energies differ by.
void expect_work_of_the_force(Solids c) {
    Search s(c);
    const StateList states = s.run();
    ASSERT_EQ(states.all.size(), 2u);
    EXPECT_EQ(states.instabilities, 0);
    const double z0 = states.all[0].numbers.mean_height, z1 = states.all[1].numbers.mean_height;
    s.search.restore_first();
    constexpr int pieces = 200; // of Simpson's rule
    double work = 0.0;
    for (int i = 0; i <= pieces; ++i) {
        const double z = z0 + (z1 - z0) * i / pieces - c.interface.start_height();
        const double weight = i == 0 || i == pieces ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
        work += weight * c.relax(Constraint::mean_height(z), tolerance).force;
    }
    work *= (z1 - z0) / pieces / 3.0;
    const double gained =
        states.all[1].numbers.binding_energy - states.all[0].numbers.binding_energy;
    // What the work lacks was dissipated where a few sites jumped; the search tells larger ones.
    const double dissipated = gained - 1e3 * work / area(c);
    EXPECT_GE(dissipated, -1e-4 * gained);
    EXPECT_LE(dissipated, 5e-3 * gained);
}

/// A search that stops every so many points and goes on from its checkpoint.
void expect_same_when_resumed(int points, const std::function<Solids()>& contact) {
    const io::Scratch scratch;
    const std::string file = scratch / "search.h5";
    Solids undisturbed = contact();
    const StateList states = all_states(undisturbed);
    bool done = false;
    for (int part = 0; !done; ++part) {
        Solids c = contact();
        Search s(c);
        if (part == 0) {
            s.start();
        } else {
            const StateNumbers numbers = read_checkpoint(file, Communicator(), c.grid, {}, "it");
            read_checkpoint(file, Communicator(), c.grid, s.search.states(), "it");
            RestoreNumbers restore(numbers);
            restore("search", s.search);
            s.search.resume();
        }
        for (int i = 0; i < points && !done; ++i)
            done = s.search.advance() == StateSearch::Outcome::done;
        CollectNumbers collect;
        collect("search", s.search);
        write_checkpoint(file, Communicator(), c.grid, s.search.states(), collect.numbers, "it");
        if (!done) continue;
        const StateList found = s.search.found();
        EXPECT_GT(part, 3);
        EXPECT_EQ(found.points, states.points);
        ASSERT_EQ(found.all.size(), states.all.size());
        for (std::size_t i = 0; i < found.all.size(); ++i) {
            EXPECT_EQ(found.all[i].numbers.binding_energy, states.all[i].numbers.binding_energy);
            EXPECT_EQ(found.all[i].numbers.mean_height, states.all[i].numbers.mean_height);
            EXPECT_EQ(found.all[i].barrier, states.all[i].barrier);
        }
    }
}

} // namespace

TEST(StateSearch, StatesAreStableAndTheBarrierIsNot) {
    Solids c = two_states();
    Search s(c);
    const StateList states = s.run();
    ASSERT_EQ(states.all.size(), 2u);
    EXPECT_LT(states.all[0].numbers.contact_fraction, 0.05);
    EXPECT_GT(states.all[1].numbers.contact_fraction, 0.95);
    EXPECT_GT(states.deepest().numbers.binding_energy, 20.0);
    EXPECT_FALSE(states.all[1].barrier);
    ASSERT_EQ(s.layers.size(), 2u);
    for (const Layer& layer : s.layers)
        EXPECT_GT(Hessian(c, layer).smallest(80), 0.0);

    // The force between them: zero where it rises with the height is a saddle; its largest on the
    // way in is the barrier.
    const double z0 = states.all[0].numbers.mean_height - c.interface.start_height(),
                 z1 = states.all[1].numbers.mean_height - c.interface.start_height();
    s.search.restore_first();
    double outer = z0, inner = z0, largest = 0.0;
    for (double z = z0 - 0.05; z > z1; z -= 0.05) {
        const double force = c.relax(Constraint::mean_height(z), tolerance).force;
        largest = std::max(largest, force);
        if (force < 0.0 && largest > 1.0) {
            inner = z;
            break;
        }
        outer = z;
    }
    ASSERT_LT(inner, outer);
    EXPECT_NEAR(states.all[0].barrier.value_or(0.0), largest / area(c), 0.02 * largest / area(c));
    for (int i = 0; i < 30; ++i) {
        const double z = 0.5 * (inner + outer);
        (c.relax(Constraint::mean_height(z), tolerance).force < 0.0 ? inner : outer) = z;
    }
    EXPECT_LT(Hessian(c, layer_of(c.block)).smallest(80), -1e-4);
}

// A state on a branch that was followed outwards: to come to it the first one has to be pressed in
// as far as the instability, beyond the height at which the other state is.
TEST(StateSearch, ABarrierReachesDownToTheInstabilityThatHasToBeCrossed) {
    Solids c = over_hill(20.0, 6.0);
    Search s(c, 0.25, false);
    const StateList states = s.run();
    ASSERT_GE(states.all.size(), 2u);
    ASSERT_EQ(states.instabilities, 1);
    s.search.restore_first();
    constexpr double step = 0.25;
    double largest = 0.0, largest_above = 0.0, lost = 0.0, z = c.block.mean_height();
    for (RelaxedState last = c.relax(Constraint::mean_height(z), tolerance); lost < 5.0;) {
        const double height = c.interface.start_height() + z;
        ASSERT_GT(height, 3.0);
        largest = std::max(largest, last.force);
        if (height > states.all[1].numbers.mean_height) largest_above = largest;
        z -= step;
        const RelaxedState now = c.relax(Constraint::mean_height(z), tolerance);
        lost = energy(last) + 0.5 * step * (last.force + now.force) - energy(now);
        last = now;
    }
    const double barrier = states.all[0].barrier.value_or(0.0) * area(c);
    EXPECT_GT(barrier, 2.0 * largest_above); // above the other state's height
    EXPECT_LT(barrier, 1.01 * largest);      // of all points down to the instability
}

TEST(StateSearch, EnergiesDifferByTheWorkOfTheForce) {
    expect_work_of_the_force(two_states(Friction::without));
    expect_work_of_the_force(two_states_over_a_wall());
}

TEST(StateSearch, SameStatesWithAnotherStep) {
    Solids c = two_states(), fine = two_states();
    const StateList states = all_states(c);
    ASSERT_EQ(states.all.size(), 2u);
    expect_same(states, all_states(fine, 0.1), 1e-4);
}

TEST(StateSearch, NoneIsDeeperFromABlockDrapedOverTheSubstrate) {
    // Every site at the equilibrium distance from the substrate below it: full contact, which no
    // path leads to. On steep hills relaxations from there end in states that are not in the list.
    int others = 0;
    for (const auto& [height, width] : {std::pair{12.0, 6.0}, {16.0, 5.0}, {12.0, 3.0}, {8.0, 3.0}})
        for (const Friction friction : {Friction::with, Friction::without}) {
            Solids c = over_hill(height, width, friction),
                   draped = over_hill(height, width, friction);
            const StateList states = all_states(c);
            draped.block.set_uniform(0.0);
            const InterfaceMaps maps =
                draped.interface.maps(draped.block.lowest_layer(), draped.interface.start_height());
            const PlaneView<double> z = state_of(draped.block)[2].field->view()[0];
            constexpr double separation = 3.11; // of flat on flat, Å
            for (int y = 0; y < z.ny; ++y)
                for (int x = 0; x < z.nx; ++x)
                    z(x, y) += separation - maps.gap[static_cast<std::size_t>(y * maps.nx + x)];
            const ZeroLoad state = relax_free(draped);
            EXPECT_GT(state.contact_fraction, 0.9);
            const double deepest = states.deepest().numbers.binding_energy;
            EXPECT_LE(state.binding_energy, deepest + 1e-3) << height << " " << width;
            others += state.binding_energy < deepest - 1.0;
        }
    EXPECT_GT(others, 0);
}

TEST(StateSearch, WhatAShortSearchLeavesOutIsNotDeeper) {
    std::vector<Surface> surfaces;
    for (const double rms : {4.0, 6.0, 9.0, 14.0})
        for (const std::uint64_t seed : {1, 2, 3})
            surfaces.push_back(test::self_affine(64, rms, seed));
    // Full contact is the deepest state of some hills, far inside of the first one.
    for (const auto& [height, width] : {std::pair{12.0, 6.0}, {16.0, 5.0}, {12.0, 3.0}, {8.0, 3.0}})
        surfaces.push_back(hill(32, height, width));
    // The work of pressing the hill in has to be outweighed by all that is out of reach at first.
    surfaces.push_back(hill(96, 30.0, 8.0));
    int shorter = 0, several = 0;
    for (const Surface& surface : surfaces) {
        const BlockOptions block = test::paper_block(surface.sites, surface.sites, 0);
        Solids a(block, surface, Friction::without), b(block, surface, Friction::without);
        const StateList quick = all_states(a, 0.25, false), whole = all_states(b, 0.25, true);
        const auto& deepest = whole.deepest().numbers;
        EXPECT_NEAR(quick.deepest().numbers.binding_energy, deepest.binding_energy, 1e-3)
            << surface.statistics.highest;
        shorter += quick.end == StateList::End::energy;
        several += &whole.deepest() != &whole.all[whole.first];
    }
    EXPECT_GT(shorter, 0);
    EXPECT_GT(several, 0);
}

TEST(StateSearch, GoesTheSameWayOverASurfaceTurnedRound) {
    // A ridge along y and one along x: what each site may still gain is that of its own place.
    for (const double height : {12.0, 30.0}) {
        std::vector<StateList> found;
        for (const bool along_y : {true, false}) {
            const Surface ridge = test::surface_from(64, [=](int x, int y) {
                const double away = 2.6 * ((along_y ? x : y) - 32);
                return height * std::exp(-0.5 * away * away / 64.0);
            });
            Solids c(test::paper_block(64, 64, 0), ridge, Friction::without);
            found.push_back(all_states(c, 0.25, false));
        }
        EXPECT_EQ(found[0].end, StateList::End::energy);
        EXPECT_EQ(found[1].end, found[0].end);
        EXPECT_EQ(found[1].points, found[0].points);
        expect_same(found[0], found[1], 1e-6);
    }
}

TEST(StateSearch, ALoadThatStretchesTheBlockIsNoInstability) {
    Solids c = two_states(Friction::without);
    Search s(c, 0.25, true, 100.0 * units::gigapascal * 1e-3 * area(c)); // 100 MPa
    const StateList states = s.run();
    EXPECT_EQ(states.all.size(), 2u);
    EXPECT_EQ(states.instabilities, 0);
}

TEST(StateSearch, ALoadIsNoPartOfABarrier) {
    // The same force along the same way: a load takes away what it holds.
    constexpr double step = 0.05; // the largest force is that of a point
    const auto barrier = [](double load) {
        Solids c = two_states(Friction::without);
        Search s(c, step, true, load);
        const StateList states = s.run();
        EXPECT_EQ(states.all.size(), 2u) << load;
        return states.all[0].barrier.value_or(0.0);
    };
    Solids c = two_states();
    const double pressure = 0.2 * units::gigapascal; // a good part of the barrier
    const double alone = barrier(0.0), pressed = barrier(pressure * area(c)),
                 pulled = barrier(-0.05 * pressure * area(c));
    ASSERT_GT(pressure, 0.1 * alone);
    ASSERT_LT(pressure, 0.9 * alone);
    EXPECT_NEAR(pressed, alone - pressure, 5e-3 * alone);
    EXPECT_NEAR(pulled, alone + 0.05 * pressure, 5e-3 * alone);
}

TEST(StateSearch, UnderALoadTheEnergyOfThePointsIsTheIntegralOfTheForceAboveIt) {
    // U + P z rises on the way in by the integral of F - P, whatever the sign of the load.
    for (const double pressure : {0.0, 0.05, -0.01}) { // GPa
        Solids c = two_states(Friction::without);
        const double load = pressure * units::gigapascal * area(c);
        Search s(c, 0.05, true, load);
        s.start();
        const double start = c.block.mean_height();
        double height = start, above = 0.0, risen = 0.0, deepest = 0.0, highest = 0.0;
        while (height > start - 3.0) {
            ASSERT_EQ(s.search.advance(), StateSearch::Outcome::point);
            const double now = c.block.mean_height();
            const double force =
                c.interface
                    .sweep(c.block.lowest_layer(), c.block.interface_force(),
                           c.interface.start_height(), {})
                    .force_z.value() -
                load;
            risen += 0.5 * (force + above) * (height - now);
            deepest = std::min(deepest, risen);
            highest = std::max(highest, risen - deepest);
            height = now;
            above = force;
            EXPECT_NEAR(s.search.climb(), risen - deepest, 0.01 * highest + 1e-3) << height;
        }
        // What a load of the other sign would make of it.
        EXPECT_GT(highest, pressure == 0.0 ? 1.0 : 0.05 * std::abs(load)) << pressure;
    }
}

TEST(StateSearch, FullContactIsTheOnlyState) {
    Solids c = over_hill(2.0, 8.0);
    const StateList states = all_states(c);
    EXPECT_EQ(states.all.size(), 1u);
    EXPECT_EQ(states.points, 1);
    EXPECT_EQ(states.end, StateList::End::contact);
}

TEST(StateSearch, ResumedItFindsTheSameBits) {
    expect_same_when_resumed(11, [] { return over_hill(16.0, 5.0); });
    expect_same_when_resumed(4, two_states_over_a_wall);
}
