// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// JKR and Maugis-Dugdale against theory.md's digits and against each other's limits.
#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "theory/error.hpp"
#include "theory/half_space.hpp"
#include "theory/jkr.hpp"
#include "theory/maugis.hpp"
#include "theory/periodic_sphere.hpp"

namespace asperity::theory {
namespace {

constexpr double pi = std::numbers::pi;
const AdhesiveSphere paper_sphere{4410, contact_modulus(77.2 / 160.21766, 0.42), 0.1};

TEST(Jkr, MaugisUnits) {
    const AdhesiveSphere s{1 / pi, 0.75 / pi, 1}; // πwR = 1 and radius unit 1
    EXPECT_NEAR(s.force_unit(), 1, 1e-15);
    EXPECT_NEAR(s.radius_unit(), 1, 1e-15);
    const SphereState off = jkr::pull_off(s);
    EXPECT_NEAR(off.force / s.force_unit(), -1.5, 1e-14);
    EXPECT_NEAR(off.approach / s.approach_unit(), -0.4368, 0.5e-4);
}

TEST(Jkr, PaperSphere) {
    EXPECT_NEAR(-jkr::pull_off(paper_sphere).force, 2078.16, 0.5e-2);
    EXPECT_NEAR(jkr::pull_off(paper_sphere).radius, 227.33, 0.5e-2);
    const SphereState free = jkr::at_radius(paper_sphere, 360.87); // no load
    EXPECT_NEAR(free.force, 0, 0.5);
    EXPECT_NEAR(free.approach, 9.84, 0.5e-2);
    EXPECT_NEAR(jkr::work_from_pull_off(jkr::pull_off(paper_sphere).force, 4410), 0.1, 1e-15);
}

TEST(Jkr, BindingEnergyIsTheWorkAlongTheCurve) {
    // From a = 0, where force and approach are zero, to the contact without a load.
    double energy = 0;
    SphereState last{};
    const double end = std::cbrt(6.0) * paper_sphere.radius_unit();
    constexpr int steps = 20000; // even in the root of a, of which the approach is smooth
    for (int i = 1; i <= steps; ++i) {
        const double root = static_cast<double>(i) / steps;
        const SphereState s = jkr::at_radius(paper_sphere, root * root * end);
        energy -= 0.5 * (s.force + last.force) * (s.approach - last.approach);
        last = s;
    }
    EXPECT_NEAR(last.force, 0, 1e-9 * paper_sphere.force_unit());
    EXPECT_NEAR(jkr::work_from_binding_energy(energy, 4410, paper_sphere.contact_modulus), 0.1,
                1e-7);
    EXPECT_EQ(jkr::work_from_binding_energy(0, 4410, paper_sphere.contact_modulus), 0);
    EXPECT_THROW((void)jkr::work_from_binding_energy(1, 0, 1), InvalidInput);
}

TEST(Jkr, AnEdgeCarriesTheWorkOfAdhesion) {
    // Griffith: K_I of the edge carries w. F_Hertz(a) - F = √(8πwE*a³).
    const double a = 300;
    const double hertz_force = 4 * paper_sphere.contact_modulus * a * a * a / (3 * 4410.0);
    const double missing = hertz_force - jkr::at_radius(paper_sphere, a).force;
    EXPECT_NEAR(missing * missing / (8 * pi * paper_sphere.contact_modulus * a * a * a), 0.1,
                1e-12);
    EXPECT_THROW((void)jkr::pull_off({4410, 1, 0}), InvalidInput);
}

TEST(Maugis, PullOff) {
    for (const auto& [lambda, force] :
         {std::array{0.1, 1.9506}, std::array{0.5, 1.7182}, std::array{1.0, 1.6007},
          std::array{2.0, 1.5346}, std::array{5.0, 1.5063}})
        EXPECT_NEAR(-maugis::pull_off(lambda).force, force, 0.51e-4) << lambda;
    EXPECT_NEAR(-maugis::pull_off(1e-6).force, 2, 1e-6);  // DMT
    EXPECT_NEAR(-maugis::pull_off(1e4).force, 1.5, 1e-6); // JKR
    EXPECT_NEAR(maugis::pull_off(1e4).radius, std::cbrt(1.5), 1e-3);
}

TEST(Maugis, EquationsAsPrinted) {
    for (double lambda : {0.1, 1.0, 5.0})
        for (double m : {1.0001, 1.02, 1.5, 10.0}) {
            const auto r = maugis::at_ratio(lambda, m);
            const double s = std::sqrt(m * m - 1), phi = std::atan(s), a = r.radius;
            const double opening = lambda * a * a / 2 * (s + (m * m - 2) * phi) +
                                   4 * lambda * lambda * a / 3 * (s * phi - m + 1);
            EXPECT_NEAR(opening, 1, 1e-6) << lambda << ' ' << m;
            EXPECT_NEAR(r.force, a * a * a - lambda * a * a * (s + m * m * phi),
                        1e-8 * (1 + a * a * a));
            EXPECT_NEAR(r.approach, a * a - 4.0 / 3 * lambda * a * s, 1e-8 * (1 + a * a));
        }
}

TEST(Maugis, WithUnits) {
    const double tabor_paper = tabor_number(4410, 0.1, 77.2 / 160.21766, 3.28);
    EXPECT_NEAR(tabor_paper, 1.75, 0.5e-2);
    EXPECT_NEAR(tabor_number(4410, 0.1, paper_sphere.contact_modulus, 3.28), 1.54, 0.5e-2);
    // model.md: 1 to 2.3 % above JKR.
    const double lambda = 1.157 * tabor_paper;
    const double excess =
        maugis::pull_off(paper_sphere, lambda).force / jkr::pull_off(paper_sphere).force - 1;
    EXPECT_GT(excess, 0.01);
    EXPECT_LT(excess, 0.023);
    EXPECT_THROW((void)maugis::pull_off(0), InvalidInput);
}

// The lattice sums, added up over squares of images; what lies outside is an integral.
TEST(PeriodicSphere, SumsOverTheImages) {
    constexpr int far = 400;
    double first = 0, third = 0;
    for (int y = -far; y <= far; ++y)
        for (int x = -far; x <= far; ++x) {
            if (x == 0 && y == 0) continue;
            const double r = std::hypot(x, y);
            first += 1 / r;
            third += 1 / (r * r * r);
        }
    const double edge = far + 0.5;
    const double outside = 8 * std::sin(pi / 4) / edge; // of 1/r³
    first -= 8 * edge * std::log(1 + std::sqrt(2));     // the background's
    first -= outside / 24; // a sum is an integral less 1/24 of the Laplacian
    third += outside;

    const PeriodicSphere p{paper_sphere, 1331.2, 3.11};
    const double E = paper_sphere.contact_modulus, L = p.period, force = -1500;
    EXPECT_NEAR((1 / p.radius_under(force) - 1 / paper_sphere.radius) / force,
                third / (2 * pi * E * L * L * L), 1e-5 / (E * L * L * L));
    const PeriodicState s = jkr_at_radius(p, 300);
    EXPECT_NEAR(s.height, 3.11 - s.contact.approach - first / (pi * E * L) * s.contact.force, 1e-5);
}

TEST(PeriodicSphere, IsASphereWithoutItsImages) {
    const PeriodicSphere far{paper_sphere, 1e7, 3};
    for (const double a : {50.0, 200.0, 361.0}) {
        const PeriodicState s = jkr_at_radius(far, a);
        const SphereState alone = jkr::at_radius(paper_sphere, a);
        EXPECT_NEAR(s.contact.force, alone.force, 1e-4 + 1e-6 * std::abs(alone.force));
        EXPECT_NEAR(s.height, 3 - alone.approach, 1e-3);
    }
    EXPECT_NEAR(jkr_pull_off(far).contact.force, jkr::pull_off(paper_sphere).force, 1e-3);
    // A wall that gives way at no stress is JKR's.
    EXPECT_NEAR(maugis_pull_off(far, 100.0).contact.force, jkr::pull_off(paper_sphere).force, 1.0);
    const double stress = 0.05, lambda = maugis_parameter(paper_sphere, stress);
    EXPECT_NEAR(maugis_pull_off(far, stress).contact.force,
                maugis::pull_off(paper_sphere, lambda).force, 1e-3);
}

TEST(PeriodicSphere, PullOffIsTheCurvesMinimum) {
    const PeriodicSphere p{paper_sphere, 1331.2, 3.11};
    const double force = jkr_pull_off(p).contact.force;
    double lowest = 0;
    for (double a = 150; a < 300; a += 0.05)
        lowest = std::min(lowest, jkr_at_radius(p, a).contact.force);
    EXPECT_NEAR(force, lowest, 1e-6 * std::abs(force));
    // F = -(3/2)πw / (1/R + kF) by the quadratic formula; model.md: about 1 % more than JKR.
    const double k = (1 / p.radius_under(-1) - 1 / paper_sphere.radius) / -1;
    const double b = 1 / paper_sphere.radius, c = 1.5 * pi * paper_sphere.work_of_adhesion;
    EXPECT_NEAR(force, (-b + std::sqrt(b * b - 4 * k * c)) / (2 * k), 1e-6 * std::abs(force));
    const double excess = force / jkr::pull_off(paper_sphere).force - 1;
    EXPECT_GT(excess, 0.007);
    EXPECT_LT(excess, 0.013);
    EXPECT_THROW((void)PeriodicSphere({paper_sphere, 200, 3}).radius_under(-3000), NoSolution);
    EXPECT_THROW((void)PeriodicSphere({paper_sphere, 0, 3}).radius_under(-1), InvalidInput);
}

} // namespace
} // namespace asperity::theory
