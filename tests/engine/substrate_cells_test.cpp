// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The sweep over cells of substrate atoms: compared with the reference (whose gradient
// interface_test sees), with itself on other tiles, and with the sum over the types of atoms. (Over
// the atoms of a surface: the paths of atoms_scene_test.)
#include "support/cases.hpp"
#include "support/swept.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

using namespace asperity;
using test::Outcome, test::same_bits, test::State, test::sweep;

namespace {

using test::paper::a;
constexpr int sites = 24; // 62.4 Å: more than twice the cutoff

/// Three rough layers without any lattice, and a step of 4 Å at half the box; of one type, or of
/// four, one of which no atom has.
Surface solid(bool typed) {
    Surface s = test::flat_surface(sites);
    std::mt19937_64 random(17);
    std::uniform_real_distribution<double> part(0.0, 1.0);
    auto& [x, y, z, type] = s.atoms;
    for (std::size_t i = 0; i < 1500; ++i) {
        x.push_back(sites * a * part(random));
        y.push_back(sites * a * part(random));
        z.push_back(-7.0 * part(random) - (x.back() < 0.5 * sites * a ? 4.0 : 0.0));
        if (typed) type.push_back(std::array{0, 3, 1, 0, 3}[i % 5]);
    }
    return s;
}

/// Of several types: weaker and narrower, of no atom, stronger and wider and of another form.
InterfaceOptions options_of(bool typed) {
    InterfaceOptions o;
    if (typed)
        o.by_type = {LennardJones{}, LennardJones{0.03, 2.6, 9.0}, LennardJones{5.0, 3.0, 13.0},
                     Morse{0.2, 1.2, 4.2, 12.5}};
    return o;
}

void expect_close(const Outcome& mine, const Outcome& other, double tolerance) {
    double largest = 0.0;
    for (const auto& force : other.force)
        largest = std::max(largest, test::largest_of(force));
    ASSERT_GT(largest, 0.0);
    for (std::size_t k = 0; k < 3; ++k)
        EXPECT_LT(test::largest_difference(mine.force[k], other.force[k]), tolerance * largest);
    const double energy = other.sums.energy.value();
    EXPECT_NEAR(mine.sums.energy.value(), energy, tolerance * (1.0 + std::abs(energy)));
    EXPECT_NEAR(mine.sums.closest_r2, other.sums.closest_r2, 1e-4);
}

} // namespace

TEST(SubstrateCells, AgreeWithTheReference) {
    for (const bool typed : {false, true}) {
        const Surface surface = solid(typed);
        InterfaceOptions pairs = options_of(typed);
        pairs.method = InterfaceMethod::reference;
        // In contact, about to leave, partly out of reach, and almost; one with sites beyond the
        // margin.
        for (const auto& [height, size] :
             {std::pair{2.5, 0.3}, {8.0, 1.0}, {12.0, 0.3}, {13.6, 1.0}, {3.0, 6.0}}) {
            SCOPED_TRACE(height);
            const State state(sites, size, size, 3);
            const Outcome reference = sweep(surface, state, pairs, height, true),
                          mine = sweep(surface, state, options_of(typed), height, true);
            expect_close(mine, reference, 1e-12);
            EXPECT_EQ(mine.sums.in_contact, reference.sums.in_contact);
            EXPECT_EQ(mine.sums.repulsive, reference.sums.repulsive);
        }
    }
}

TEST(SubstrateCells, SameBitsOnAnyTile) {
    for (const bool typed : {false, true})
        for (double height : {2.5, 11.0, 13.6}) { // the last one: a few sites are in reach
            const Surface surface = solid(typed);
            const State state(sites, 1.0, 1.0, 4);
            InterfaceOptions o = options_of(typed);
            const Outcome whole = sweep(surface, state, o, height, true);
            for (const auto& [nx, ny] : {std::pair{7, sites}, {17, 11}, {5, 13}})
                EXPECT_TRUE(same_bits(whole, sweep(surface, state, o, height, true, nx, ny)));
            o.skip = false;
            EXPECT_TRUE(same_bits(whole, sweep(surface, state, o, height, true)));
            o.mixed = o.mixed_on_request = true; // over a lattice alone
            EXPECT_TRUE(same_bits(whole, sweep(surface, state, o, height, true)));
        }
}

TEST(SubstrateCells, OfSeveralTypesAddUpToThoseOfEach) {
    const Surface surface = solid(true);
    const State state(sites, 0.3, 0.3, 5);
    InterfaceOptions pairs = options_of(true);
    pairs.method = InterfaceMethod::reference;
    for (double height : {2.5, 8.0}) {
        Outcome sum;
        for (auto& force : sum.force)
            force.assign(sites * sites, 0.0);
        sum.sums.closest_r2 = no_pair;
        for (const int type : {0, 1, 3}) {
            Surface part = test::flat_surface(sites);
            const AtomPositions& all = surface.atoms;
            for (std::size_t i = 0; i < all.size(); ++i) {
                if (all.type[i] != type) continue;
                part.atoms.x.push_back(all.x[i]);
                part.atoms.y.push_back(all.y[i]);
                part.atoms.z.push_back(all.z[i]);
            }
            InterfaceOptions alone;
            alone.potential = pairs.by_type[static_cast<std::size_t>(type)];
            alone.method = InterfaceMethod::reference;
            const Outcome of = sweep(part, state, alone, height, true);
            EXPECT_GT(std::abs(of.sums.energy.value()), 1e-3) << type;
            for (std::size_t k = 0; k < 3; ++k)
                for (std::size_t i = 0; i < sum.force[k].size(); ++i)
                    sum.force[k][i] += of.force[k][i];
            sum.sums.energy.merge(of.sums.energy);
            sum.sums.closest_r2 = std::min(sum.sums.closest_r2, of.sums.closest_r2);
        }
        for (const InterfaceOptions& o : {pairs, options_of(true)}) {
            const Outcome mine = sweep(surface, state, o, height, true);
            expect_close(mine, sum, 1e-12);
        }
    }
}

TEST(SubstrateCells, ASiteIsInContactByTheTypeOfTheAtom) {
    const Tile whole{0, 0, sites, sites, sites};
    // One atom of each kind below two sites at the same distance, between their two inflections.
    Surface two = test::flat_surface(sites);
    two.atoms = {{0.5 * a, 12.5 * a}, {0.5 * a, 12.5 * a}, {0.0, 0.0}, {0, 1}};
    InterfaceOptions options;
    options.by_type = {LennardJones{0.1, 3.28, 13.12}, LennardJones{0.1, 2.6, 9.0}};
    const double height =
        0.5 * (contact_distance(options.by_type[0]) + contact_distance(options.by_type[1]));
    for (auto method : {InterfaceMethod::cells, InterfaceMethod::reference}) {
        options.method = method;
        Interface interface(two, whole, a, options);
        interface.set_reference_height(height);
        const VectorField<double> u(whole, 1);
        const InterfaceMaps maps = interface.maps(u.plane(0));
        EXPECT_EQ(maps.contact[0], 1);
        EXPECT_EQ(maps.contact[12 * sites + 12], 0);
        EXPECT_EQ(std::count(maps.contact.begin(), maps.contact.end(), 1), 1);
        EXPECT_NEAR(maps.distance[0], height, 1e-12);
        EXPECT_NEAR(maps.distance[12 * sites + 12], height, 1e-12);
    }
    EXPECT_NEAR(Interface(two, whole, a, options).start_height(), 13.12, 1e-12);
    // A type without a potential, and types where atoms have none.
    two.atoms.type = {0, 2};
    EXPECT_THROW(Interface(two, whole, a, options), std::invalid_argument);
    two.atoms = {};
    EXPECT_THROW(Interface(two, whole, a, options), std::invalid_argument);
}
