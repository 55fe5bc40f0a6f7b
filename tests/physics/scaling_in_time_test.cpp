// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// No length and no energy is hidden in dynamic paths: with all lengths times a and all energies
// times b, and times times a / sqrt(b), a path is the same path. Factors are powers of two (b: of
// four), which leave the bits of all arithmetic alone but for sums over the sites, whose terms are
// rounded to a quantum of 2^-50 Å, eV or eV/Å (kernels/exact_sum.hpp). With factors of energy alone
// the heights of the path are therefore the same bits.
#include "support/factors.hpp"
#include "support/run_scene.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace asperity;

namespace {

using test::Factors;

enum class Contact { lattice, levels, sphere };

std::string text(Contact kind, const Factors& f) {
    const double a = f.length;
    const bool sphere = kind == Contact::sphere;
    std::string s = fmt::format(
        "[surface]\nsites = 16\nspacing = {}\n{}[block]\nyoung = {}\nmodel = \"{}\"\nthickness = "
        "16\n"
        "[output]\nfields = []\nseries = 10\ncheckpoint = \"none\"\n"
        "[drive]\nvelocity = {}\ntimestep = {}\ndamping = {}\n"
        "path = [\"approach\", \"hold {} ps\", \"load {} MPa\", \"pull-off\"]\n[interface]\n",
        2.6 * a,
        sphere ? fmt::format("kind = \"flat\"\nradius = {}\n", 128.0 * a)
               : fmt::format("rms = {}\nrolloff = 2\n", 0.5 * a),
        64.0 * f.pressure(), kind == Contact::lattice ? "lattice" : "multiscale",
        128.0 * a / f.time(), 16.0 * f.time(), 0.5 / f.time(), 0.5 * f.time(),
        256.0 * f.pressure());
    s += fmt::format("epsilon = {}\nr0 = {}\ncutoff = {}\n", 0.125 * f.energy, 3.25 * a, 8.0 * a);
    return s;
}

/// The columns are those of the first path times `unit`: to the last bit, or to what sums of as
/// many terms as the block has nodes round off, `steps` times over.
void expect_scaled(const test::Written& one, const test::Written& other, const char* column,
                   double unit, double steps) {
    const std::vector<double> from = one.series(column), to = other.series(column);
    ASSERT_EQ(from.size(), to.size()) << column;
    double largest = 0.0;
    for (const double value : from)
        largest = std::max(largest, std::abs(value));
    ASSERT_GT(largest, 0.0) << column;
    const double quantum = 16.0 * 16.0 * 16.0 * 0x1p-51 * (1.0 + 1.0 / unit);
    const double allowed = steps == 0.0 ? 0.0 : 1e-12 * largest + steps * quantum;
    ASSERT_LE(allowed, 1e-5 * largest) << column << ": the case must tell";
    for (std::size_t i = 0; i < from.size(); ++i)
        ASSERT_NEAR(to[i] / unit, from[i], allowed) << column << " of row " << i;
}

} // namespace

class ScalingInTime : public testing::TestWithParam<Contact> {};

TEST_P(ScalingInTime, PathsHaveTheSameMantissas) {
    const test::Written one(text(GetParam(), {}));
    ASSERT_GT(one.series("mean_height").size(), 50u);
    for (const Factors& f :
         {Factors{1.0, 0x1p-20}, {1.0, 0x1p10}, {0x1p-3, 1.0}, {0x1p7, 1.0}, {0x1p4, 0x1p-10}}) {
        SCOPED_TRACE(fmt::format("lengths x {}, energies x {}", f.length, f.energy));
        const test::Written other(text(GetParam(), f));
        const double steps = one("run.steps");
        ASSERT_EQ(other("run.steps"), steps);
        for (const char* same : {"contact_fraction", "repulsive_fraction"})
            expect_scaled(one, other, same, 1.0, 0.0);
        expect_scaled(one, other, "time", f.time(), 0.0);
        expect_scaled(one, other, "top_displacement", f.length, 0.0);
        expect_scaled(one, other, "mean_height", f.length, f.length == 1.0 ? 0.0 : 1.0);
        expect_scaled(one, other, "force", f.force(), 1.0);
        for (const char* energy : {"interface_energy", "elastic_energy", "kinetic_energy"})
            expect_scaled(one, other, energy, f.energy, 1.0);
        for (const char* sum : {"work", "damped"})
            expect_scaled(one, other, sum, f.energy, steps);
        for (const char* number : {"work_of_drive.approach", "work_of_drive.pull_off"})
            EXPECT_NEAR(other(number) / f.surface(), one(number), 1e-6 * std::abs(one(number)));
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, ScalingInTime,
                         testing::Values(Contact::lattice, Contact::levels, Contact::sphere));
