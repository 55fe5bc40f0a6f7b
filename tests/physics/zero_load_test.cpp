// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The relaxed state under zero load against numbers from elsewhere: flat on flat for each cutoff
// (docs/explanation/model.md), and rough maps relaxed by an independent program
// (tests/physics/data/README.md).
#include "engine/case/flat_reference.hpp"
#include "support/cases.hpp"
#include "support/run_scene.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

using namespace asperity;

namespace {

struct FlatContact {
    double cutoff, binding, separation; ///< r0; meV/Å^2; Å
};
/// Reference: lattice sums of the independent program, to all its digits.
constexpr FlatContact flats[] = {{4.0, 98.86330213, 3.108052807},
                                 {3.0, 95.36179297, 3.108516390},
                                 {2.5, 90.14696074, 3.109148676},
                                 {2.0, 77.57820422, 3.114810519}};

struct Reference {
    const char* map;
    int sites, thickness;
    double cutoff;
    double binding, pairwise, mean_height, elastic; ///< meV/Å^2, meV/Å^2, Å, eV
    int contact, repulsive;                         ///< sites
    /// Relative (Å for the height). Binding is stationary: residual forces of 1e-6 eV/Å enter
    /// squared, and what is left is 1 GPa = 1/160.21766 there and 1/160.21766208 here, 1.3e-8 of
    /// the elastic energy, which is 0.05 to 0.7 of the binding. The others feel the residual
    /// itself. At 2.5 r0 the force's step at the cutoff (1.2e-3 eV/Å) leaves pairs of states: 1e-8
    /// and 1e-5 where they were seen.
    double binding_tolerance = 2e-8, first_order = 2e-5;
};
constexpr Reference cases[] = {
    {"n8_a_rms0.4", 8, 8, 4.0, 90.720765166, 94.536799579, 3.1689135122, 1.6509691284, 64, 33},
    {"n8_b_rms1.0", 8, 6, 4.0, 53.287038883, 74.798578058, 3.5015820661, 9.3067523023, 58, 24},
    {"n8_c_rms1.0_rc2.5", 8, 8, 2.5, 48.808228633, 66.084626116, 3.5609709770, 7.4744606068, 59, 23,
     2e-7, 1e-4},
    {"c1_N16_T16_rms0.5", 16, 16, 4.0, 88.372233166, 93.523071171, 3.1877012835, 8.9138342175, 255,
     120},
    {"c2_N16_T8_rms1.5", 16, 8, 4.0, 42.996885869, 57.331688216, 4.1879305271, 24.807235549, 173,
     89},
    {"c3_N32_T32_rms1.5", 32, 32, 4.0, 46.032643602, 63.843325343, 3.9306596641, 123.28981358, 742,
     361},
    {"c4_N32_T16_rms3", 32, 16, 4.0, 9.7751757096, 16.935910817, 7.6480865892, 49.568326990, 209,
     112},
    {"c5_N24_T24_rms1", 24, 24, 4.0, 72.455116529, 86.130292338, 3.3259294110, 53.247852560, 543,
     264},
    {"c3_N32_T32_rms1.5", 32, 32, 2.5, 38.241783093, 55.477269670, 3.9562864596, 119.30817460, 732,
     358, 2e-7, 1e-4},
};

void PrintTo(const Reference& c, std::ostream* out) {
    *out << c.map << " cut at " << c.cutoff << " r0";
}

class ReferenceCase : public testing::TestWithParam<Reference> {};

} // namespace

TEST(ZeroLoad, FlatOnFlatBindsAsTheTableSays) {
    for (const FlatContact& flat : flats) {
        const InterfaceOptions interface = test::paper_interface(flat.cutoff);
        const Surface surface = test::flat_surface(8);
        const BlockOptions lattice = test::paper_block(8, 6, 0),
                           levels = test::paper_block(8, 6, 2);
        for (const auto& relaxed :
             {test::relax_levels(lattice, interface, surface, 1e-7),
              test::relax_levels(levels, interface, surface, 1e-7),
              test::relax_spectral(lattice, interface, surface, 1e-7),
              test::relax_spectral(lattice, interface, surface, 1e-7, true)}) {
            ASSERT_TRUE(relaxed.state.converged);
            EXPECT_NEAR(relaxed.binding_energy, flat.binding, 2e-7) << flat.cutoff;
            EXPECT_NEAR(relaxed.mean_height, flat.separation, 1e-6);
            EXPECT_NEAR(relaxed.state[Term::elastic], 0.0, 1e-10);
            EXPECT_EQ(relaxed.state.in_contact, 64);
        }
        // What gamma_eff is divided by is the same number.
        const FlatReference reference = flat_reference(interface, 2.6, 8, 8);
        EXPECT_NEAR(reference.work_of_adhesion, flat.binding, 1e-7);
        EXPECT_NEAR(reference.separation, flat.separation, 1e-7);
    }
}

/// Node by node (support/levels_at_rest.cpp), in maps of 16 sites: it is slow. Its residual is that
/// of single nodes: soft waves of the whole block are then further off, in what is of first order.
TEST_P(ReferenceCase, LatticeAndSpectral) {
    const Reference& c = GetParam();
    const BlockOptions block = test::paper_block(c.sites, c.thickness, 0);
    const InterfaceOptions interface = test::paper_interface(c.cutoff);
    const Surface surface = test::reference_surface(c.map);
    for (const bool lattice : {true, false}) {
        if (lattice && c.sites > 16) continue;
        SCOPED_TRACE(lattice ? "lattice" : "spectral");
        const auto r = lattice ? test::relax_levels(block, interface, surface, 1e-6)
                               : test::relax_spectral(block, interface, surface, 1e-6);
        const double first_order = (lattice ? 10.0 : 1.0) * c.first_order;
        ASSERT_TRUE(r.state.converged)
            << why_not_converged(r.state, 1e-6) << " after " << r.state.iterations;
        EXPECT_NEAR(r.binding_energy, c.binding, c.binding_tolerance * c.binding);
        EXPECT_NEAR(r.pairwise, c.pairwise, first_order * c.pairwise);
        EXPECT_NEAR(r.state[Term::elastic], c.elastic, 2.0 * first_order * c.elastic);
        EXPECT_NEAR(r.mean_height, c.mean_height, first_order);
        EXPECT_EQ(r.state.in_contact, c.contact);
        EXPECT_EQ(r.state.repulsive, c.repulsive);
        // No load: what every node may keep, summed.
        EXPECT_NEAR(r.state.force, 0.0, 1e-6 * c.sites * c.sites * (lattice ? c.thickness + 1 : 1));
    }
}

TEST_P(ReferenceCase, Multiscale) {
    // The block is stiffer by at most 1.7 % (4 layers a level) or 0.4 % (8) for the worst wave, of
    // which the elastic energy, a part of the whole, sees some. It may only bind less.
    const Reference& c = GetParam();
    for (int layers : {4, 8}) {
        if (c.thickness < 3 * layers || c.sites > 32) continue; // one level: the lattice
        const auto r = test::relax_levels(test::paper_block(c.sites, c.thickness, layers),
                                          test::paper_interface(c.cutoff),
                                          test::reference_surface(c.map), 1e-5);
        ASSERT_TRUE(r.state.converged)
            << why_not_converged(r.state, 1e-6) << " after " << r.state.iterations;
        const double off = r.binding_energy / c.binding - 1.0;
        EXPECT_LT(std::abs(off), layers == 4 ? 5e-3 : 5e-4);
        EXPECT_LT(off, 1e-7) << "constraints cannot lower the energy";
        EXPECT_NEAR(static_cast<double>(r.state.in_contact), c.contact, 0.02 * c.contact);
    }
}

TEST(ZeroLoad, SpectralOnALargerMap) {
    const auto r = test::relax_spectral(test::paper_block(64, 64, 0), test::paper_interface(),
                                        test::reference_surface("c7_N64_T64_rms2"), 1e-6);
    ASSERT_TRUE(r.state.converged);
    EXPECT_NEAR(r.binding_energy, 35.68851389, 2e-8 * 35.7);
    EXPECT_NEAR(r.pairwise, 58.794007, 2e-5 * 58.8);
    EXPECT_NEAR(r.mean_height, 4.1968680, 2e-5);
    EXPECT_EQ(r.state.in_contact, 2585);
    EXPECT_EQ(r.state.repulsive, 1315);
}

/// An approach to a wall that attracts nothing ends where the first site touches, without a force,
/// on boxes of any size.
TEST(ZeroLoad, WallThatAttractsNothingBearsNothing) {
    for (const int sites : {24, 48, 96}) {
        SCOPED_TRACE(sites);
        const test::Written run(
            fmt::format("[surface]\nsites = {}\nspacing = 2\nrms = 1.6\nq_max = 12\nseed = 3\n"
                        "[block]\nyoung = 10\npoisson = 0\n[interface]\nkind = \"wall\"\n"
                        "adhesion = 0\n[drive]\nmode = \"quasistatic\"\ncontrol = "
                        "\"mean-height\"\npath = [\"approach\"]\n",
                        sites));
        EXPECT_NEAR(run("binding_energy"), 0.0, 1e-9);
        EXPECT_LE(run("contact_fraction") * sites * sites, 2.0);
    }
}

INSTANTIATE_TEST_SUITE_P(Maps, ReferenceCase, testing::ValuesIn(cases));
