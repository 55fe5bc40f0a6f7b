// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The sweep over cells of substrate atoms: compared with the reference (whose
// gradient interface_test sees), by itself on other tiles, and by the sweeps over the lattice and
// over rows of the same atoms.
#include "engine/interface/interface.hpp"
#include "engine/interface/substrate_cells.hpp"

#include "decomposition/field.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

using namespace asperity;

namespace {

constexpr double a = 2.6;
constexpr int sites = 24; // 62.4 Å: more than twice the cutoff

double scatter(double n) {
    const double s = 1e4 * std::sin(12.9898 * n + 0.7);
    return s - std::floor(s);
}

const PairPotential potential = LennardJones{};
/// Of several types: weaker and narrower, of no atom, stronger and wider and of another form.
const PairPotential by_type[] = {potential, LennardJones{0.03, 2.6, 9.0},
                                 LennardJones{5.0, 3.0, 13.0}, Morse{0.2, 1.2, 4.2, 12.5}};

/// Three rough layers without any lattice, and a step of 4 Å at half the box; of one type or of
/// several.
struct Solid {
    AtomPositions atoms;
    PairTable pairs;
    explicit Solid(bool typed = false) : pairs(typed ? PairTable(by_type, 4) : potential) {
        auto& [x, y, z, type] = atoms;
        for (int i = 0; i < 1500; ++i) {
            x.push_back(sites * a * scatter(3 * i));
            y.push_back(sites * a * scatter(3 * i + 1));
            z.push_back(-7.0 * scatter(3 * i + 2) - (x.back() < 0.5 * sites * a ? 4.0 : 0.0));
            if (typed) type.push_back(std::array{0, 3, 1, 0, 3}[static_cast<std::size_t>(i % 5)]);
        }
    }
    SubstrateCells cells(const Tile& tile, bool mixed, bool skip = true) const {
        std::vector<double> cutoffs;
        for (int t = 0; t < pairs.types; ++t)
            cutoffs.push_back(cutoff_of(pairs.of[t]));
        return {atoms, tile, CellOptions{a, cutoffs, 2.0 * a, !mixed, mixed, skip}};
    }
};

struct Swept {
    std::vector<double> force;
    InterfaceSums sums;
};

/// Displacements by place in the box, up to `size` Å.
VectorField<double> displaced(const Tile& tile, double size) {
    VectorField<double> u(tile, 1);
    const auto v = u.plane(0);
    for (int y = 0; y < tile.ny; ++y)
        for (int x = 0; x < tile.nx; ++x) {
            const int n = (tile.y0 + y) * sites + tile.x0 + x;
            v.x(x, y) = size * (2.0 * scatter(0.1 + n) - 1.0);
            v.y(x, y) = size * (2.0 * scatter(0.2 + n) - 1.0);
            v.z(x, y) = size * (2.0 * scatter(0.3 + n) - 1.0);
        }
    return u;
}

template <class Sweep>
Swept swept(const Tile& tile, const VectorField<double>& u, double height, Sweep sweep) {
    VectorField<double> force(tile, 1);
    InterfaceSites at{u.plane(0), force.plane(0), a, height, tile.x0, tile.y0, {}};
    Swept s;
    sweep(at, s.sums);
    const auto f = force.plane(0);
    for (int y = 0; y < tile.ny; ++y)
        for (int x = 0; x < tile.nx; ++x)
            for (double part : {f.x(x, y), f.y(x, y), f.z(x, y)})
                s.force.push_back(part);
    return s;
}

const Tile whole{0, 0, sites, sites, sites};
Swept by_cells(const SubstrateCells& cells, const PairTable& pairs, const Tile& tile,
               const VectorField<double>& u, double height, bool mixed) {
    const auto& kernels = interface_kernels().cells;
    return swept(tile, u, height, [&](const InterfaceSites& at, InterfaceSums& sums) {
        kernels({.observe = true, .mixed = mixed})(at, cells.view(), pairs, 0, tile.ny, sums);
    });
}

Swept by_reference(const SubstrateCells& cells, const PairTable& pairs,
                   const VectorField<double>& u, double height) {
    return swept(whole, u, height, [&](const InterfaceSites& at, InterfaceSums& sums) {
        reference_sweep(at, cells.atoms(), pairs, 0, sites, sums);
    });
}

} // namespace

TEST(SubstrateCells, AgreeWithTheReference) {
    for (const auto& [typed, mixed] :
         {std::pair{false, false}, {false, true}, {true, false}, {true, true}}) {
        const Solid solid(typed);
        const SubstrateCells cells = solid.cells(whole, mixed);
        // In contact, about to leave, partly out of reach, and almost; one with sites beyond the
        // margin.
        for (const auto& [height, size] :
             {std::pair{2.5, 0.3}, {8.0, 1.0}, {12.0, 0.3}, {13.6, 1.0}, {3.0, 6.0}}) {
            const auto u = displaced(whole, size);
            const Swept reference = by_reference(cells, solid.pairs, u, height),
                        mine = by_cells(cells, solid.pairs, whole, u, height, mixed);
            double largest = 0.0;
            for (double f : reference.force)
                largest = std::max(largest, std::abs(f));
            ASSERT_GT(largest, 0.0);
            const double tolerance = mixed ? 1e-5 : 1e-12;
            for (std::size_t i = 0; i < reference.force.size(); ++i)
                ASSERT_NEAR(mine.force[i], reference.force[i],
                            tolerance * (largest + std::abs(reference.force[i])))
                    << height << " " << i;
            const double energy = reference.sums.energy.value();
            EXPECT_NEAR(mine.sums.energy.value(), energy, tolerance * (1.0 + std::abs(energy)));
            EXPECT_EQ(mine.sums.in_contact, reference.sums.in_contact);
            EXPECT_NEAR(mine.sums.closest_r2, reference.sums.closest_r2, 1e-4);
        }
    }
}

TEST(SubstrateCells, SameBitsOnAnyTile) {
    for (const auto& [typed, mixed] :
         {std::pair{false, false}, {false, true}, {true, false}, {true, true}})
        for (double height : {2.5, 11.0, 13.6}) { // the last one: a few sites are in reach
            const Solid solid(typed);
            const Swept all = by_cells(solid.cells(whole, mixed), solid.pairs, whole,
                                       displaced(whole, 1.0), height, mixed);
            const Swept unskipped = by_cells(solid.cells(whole, mixed, false), solid.pairs, whole,
                                             displaced(whole, 1.0), height, mixed);
            EXPECT_EQ(all.force, unskipped.force);
            InterfaceSums sums;
            for (const Tile& tile : {Tile{0, 0, 7, sites, sites}, Tile{7, 0, sites - 7, 11, sites},
                                     Tile{7, 11, sites - 7, sites - 11, sites}}) {
                const Swept part = by_cells(solid.cells(tile, mixed), solid.pairs, tile,
                                            displaced(tile, 1.0), height, mixed);
                std::size_t i = 0;
                for (int y = 0; y < tile.ny; ++y)
                    for (int x = 0; x < 3 * tile.nx; ++x, ++i)
                        ASSERT_EQ(part.force[i], all.force[static_cast<std::size_t>(
                                                     3 * ((tile.y0 + y) * sites + tile.x0) + x)]);
                sums.merge(part.sums);
            }
            EXPECT_EQ(sums.energy.value(), all.sums.energy.value());
            EXPECT_EQ(sums.force_z.value(), all.sums.force_z.value());
            EXPECT_EQ(sums.in_contact, all.sums.in_contact);
        }
}

namespace {

/// m x m heights, and the same as atoms.
std::pair<Surface, Surface> map_and_atoms(int m) {
    Surface map;
    map.sites = m;
    map.length = sites * a;
    const double b = map.length / m;
    Surface atoms = map;
    for (int j = 0; j < m; ++j)
        for (int i = 0; i < m; ++i) {
            map.height.push_back(3.0 * scatter(0.4 + j * m + i));
            atoms.atoms.x.push_back(i * b);
            atoms.atoms.y.push_back(j * b);
            atoms.atoms.z.push_back(map.height.back());
        }
    atoms.sites = sites;
    atoms.height.assign(sites * sites, map.height.front()); // of maps alone
    return {map, atoms};
}

Swept over(const Surface& substrate, const InterfaceOptions& options, double height, double size) {
    const Interface interface(substrate, whole, a, options);
    const auto u = displaced(whole, size);
    return swept(whole, u, height, [&](const InterfaceSites& at, InterfaceSums& sums) {
        sums = interface.sweep(at.displacement, at.force, height, {.observe = true});
    });
}

void expect_alike(const Swept& one, const Swept& other, double tolerance) {
    double largest = 0.0;
    for (double f : one.force)
        largest = std::max(largest, std::abs(f));
    ASSERT_GT(largest, 0.0);
    for (std::size_t i = 0; i < one.force.size(); ++i)
        ASSERT_NEAR(one.force[i], other.force[i], tolerance * largest) << i;
    const double energy = one.sums.energy.value();
    EXPECT_NEAR(other.sums.energy.value(), energy, tolerance * std::abs(energy));
    EXPECT_EQ(other.sums.in_contact, one.sums.in_contact);
    EXPECT_EQ(other.sums.repulsive, one.sums.repulsive);
}

} // namespace

TEST(SubstrateCells, OfASurfacesAtomsActLikeItsLatticeAndItsRows) {
    for (int m : {sites, 39}) // the block's lattice, and an incommensurate one
        for (bool mixed : {false, true})
            for (double height : {5.0, 13.0}) {
                const auto [map, atoms] = map_and_atoms(m);
                InterfaceOptions options;
                options.mixed = mixed;
                const Interface by_map(map, whole, a, options), by_atoms(atoms, whole, a, options);
                EXPECT_EQ(by_map.method(),
                          m == sites ? InterfaceMethod::lattice : InterfaceMethod::rows);
                EXPECT_EQ(by_atoms.method(), InterfaceMethod::cells);
                expect_alike(over(map, options, height, 0.3), over(atoms, options, height, 0.3),
                             mixed ? 3e-6 : 1e-11);
            }
}

TEST(SubstrateCells, OfSeveralTypesAddUpToThoseOfEach) {
    const Solid solid(true);
    const auto u = displaced(whole, 0.3);
    for (double height : {2.5, 8.0}) {
        const SubstrateCells cells = solid.cells(whole, false);
        const Swept mine = by_cells(cells, solid.pairs, whole, u, height, false);
        const Swept reference = by_reference(cells, solid.pairs, u, height);
        std::vector<double> sum(mine.force.size(), 0.0);
        double energy = 0.0, closest = no_pair, largest = 0.0;
        for (int type = 0; type < 4; ++type) {
            Solid part;
            part.pairs = by_type[type];
            part.atoms = {};
            for (std::size_t i = 0; i < solid.atoms.size(); ++i) {
                if (solid.atoms.type[i] != type) continue;
                part.atoms.x.push_back(solid.atoms.x[i]);
                part.atoms.y.push_back(solid.atoms.y[i]);
                part.atoms.z.push_back(solid.atoms.z[i]);
            }
            if (part.atoms.size() == 0) continue;
            const Swept alone = by_reference(part.cells(whole, false), part.pairs, u, height);
            EXPECT_GT(std::abs(alone.sums.energy.value()), 1e-3) << type;
            EXPECT_LE(alone.sums.in_contact, mine.sums.in_contact);
            for (std::size_t i = 0; i < sum.size(); ++i)
                sum[i] += alone.force[i];
            energy += alone.sums.energy.value();
            closest = std::min(closest, alone.sums.closest_r2);
        }
        for (double f : sum)
            largest = std::max(largest, std::abs(f));
        for (const Swept* all : {&mine, &reference}) {
            for (std::size_t i = 0; i < sum.size(); ++i)
                ASSERT_NEAR(all->force[i], sum[i], 1e-12 * (largest + std::abs(sum[i]))) << i;
            EXPECT_NEAR(all->sums.energy.value(), energy, 1e-11 * std::abs(energy));
            EXPECT_NEAR(all->sums.closest_r2, closest, 1e-9);
        }
    }
}

TEST(SubstrateCells, ASiteIsInContactByTheTypeOfTheAtom) {
    // One atom of each kind below two sites at the same distance, between their two inflections.
    Surface two;
    two.sites = sites;
    two.length = sites * a;
    two.height.assign(sites * sites, 0.0);
    two.atoms = {{0.5 * a, 12.5 * a}, {0.5 * a, 12.5 * a}, {0.0, 0.0}, {0, 1}};
    InterfaceOptions options;
    options.by_type = {LennardJones{0.1, 3.28, 13.12}, LennardJones{0.1, 2.6, 9.0}};
    const double height =
        0.5 * (contact_distance(options.by_type[0]) + contact_distance(options.by_type[1]));
    for (auto method : {InterfaceMethod::cells, InterfaceMethod::reference}) {
        options.method = method;
        const Interface interface(two, whole, a, options);
        const VectorField<double> u(whole, 1);
        const InterfaceMaps maps = interface.maps(u.plane(0), height);
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
