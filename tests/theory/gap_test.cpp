// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Separations and the attraction across gaps.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "support/paper_contact.hpp"
#include "theory/error.hpp"
#include "theory/gap_attraction.hpp"

namespace asperity::theory {
namespace {

constexpr double pi = std::numbers::pi;
const WallPotential lennard_jones{0.1, 3.28, 2.6, 0};

SqueezedContact squeezed(double p) {
    return {paper::contact(5).spectrum, paper::contact_modulus, p, 0.45, 1};
}

double elastic_energy(double p) {
    AdhesiveContact c = paper::contact(5);
    c.work_of_adhesion = 0;
    c.pressure = p;
    return solve(c).elastic_energy;
}

TEST(Separation, PressureIsTheSlopeOfTheEnergy) {
    // p = -dU_el/dū: Eq. (5) by one module, ū by another.
    for (double p : {1e-5, 1e-3, 1e-2, 5e-2}) {
        const double up = p * 1.001, down = p * 0.999;
        const double dU = elastic_energy(up) - elastic_energy(down);
        const double du = mean_separation(squeezed(up)) - mean_separation(squeezed(down));
        EXPECT_NEAR(-dU / du / p, 1, 1e-5) << p;
    }
}

TEST(Separation, LightContactIsLogarithmic) {
    // ū falls by the same amount for every factor in p, of the order of half the roughness.
    const double a = mean_separation(squeezed(1e-7)), b = mean_separation(squeezed(1e-6)),
                 c = mean_separation(squeezed(1e-5));
    EXPECT_NEAR((a - b) / (b - c), 1, 1e-3);
    EXPECT_NEAR((b - c) / std::log(10.0) / 5, 0.5, 0.1);
}

TEST(Separation, DistributionHoldsWhatIsNotInContact) {
    for (double p : {1e-3, 1e-2, 5e-2}) {
        const SeparationDistribution P(squeezed(p));
        const double T = stress_variance(paper::contact(5), 512 * paper::q_L);
        EXPECT_NEAR(P.contact_area(), std::erf(p / std::sqrt(2 * T)), 1e-14);
        EXPECT_NEAR(P.average([](double) { return 1.0; }), 1 - P.contact_area(), 1e-9);
        // The parts add up to A ū, whatever the folding at u = 0 does to the mean afterwards.
        double sum = 0;
        for (const auto& part : P.parts())
            sum += part.weight * part.centre;
        EXPECT_NEAR(sum, mean_separation(squeezed(p)), 1e-6);
        EXPECT_GT(P.mean(), sum);
        // The density is the one averaged over (its sharp end at u = 0 asks for a fine net).
        double integral = 0, previous = 0;
        for (double x = -12; x < 5; x += 0.01) {
            const double u = std::exp(x);
            integral += P.density(u) * (u - previous);
            previous = u;
        }
        EXPECT_NEAR(integral, 1 - P.contact_area(), 0.02);
        // Twice as fine makes no difference.
        EXPECT_NEAR(SeparationDistribution(squeezed(p), 0.05).mean(), P.mean(), 2e-4 * P.mean());
    }
    EXPECT_THROW((void)mean_separation(squeezed(0)), InvalidInput);
}

TEST(Separation, LoadTakenOffAtFixedAreaLiftsByLoadOverStiffness) {
    for (double p : {1e-3, 3e-2}) {
        SqueezedContact c = squeezed(p);
        const double at_p = mean_separation(c);
        c.share_held = 0;
        const double lifted = mean_separation(c) - at_p;
        const double compliance =
            -(mean_separation(squeezed(p * 1.001)) - mean_separation(squeezed(p * 0.999))) /
            (0.002 * p);
        EXPECT_NEAR(lifted, p * compliance, 1e-5 * lifted);
        c.share_held = 0.5;
        EXPECT_NEAR(mean_separation(c) - at_p, lifted / 2, 1e-9);
    }
}

TEST(WallPotential, IsThePlaneSumOfThePairPotential) {
    // Without cutoff: deepest at r0, 6πε r0²/5a⁴.
    EXPECT_NEAR(lennard_jones.equilibrium_distance(), 3.28, 1e-12);
    EXPECT_NEAR(lennard_jones.depth(), 6 * pi * 0.1 * 3.28 * 3.28 / (5 * std::pow(2.6, 4)), 1e-12);
    const auto pair = [](double r) {
        const double s = std::pow(3.28 / r, 6);
        return 0.4 * (s * s - s);
    };
    // An atom over a real lattice, hollow site, where corrugation is gone.
    for (double d : {6.0, 8.0, 12.0}) {
        double sum = 0;
        for (int i = -400; i < 400; ++i)
            for (int j = -400; j < 400; ++j)
                sum += pair(
                    std::sqrt(d * d + 2.6 * 2.6 * ((i + 0.5) * (i + 0.5) + (j + 0.5) * (j + 0.5))));
        EXPECT_NEAR(lennard_jones.energy(d) / (sum / (2.6 * 2.6)), 1, 1e-3) << d;
    }
    // With a cutoff, against the integral done numerically.
    const WallPotential cut{0.1, 3.28, 2.6, 4 * 3.28};
    for (double d : {3.0, 5.0, 10.0}) {
        double sum = 0;
        const double dr = 1e-4;
        for (double r = d + dr / 2; r < 13.12; r += dr)
            sum += (pair(r) - pair(13.12)) * r * dr;
        EXPECT_NEAR(cut.energy(d), 2 * pi / std::pow(2.6, 4) * sum, 1e-8) << d;
    }
    EXPECT_EQ(cut.energy(13.2), 0);
    const double d0 = cut.equilibrium_distance();
    EXPECT_LT(cut.energy(d0), cut.energy(d0 + 1e-4));
    EXPECT_LT(cut.energy(d0), cut.energy(d0 - 1e-4));
    EXPECT_DOUBLE_EQ(cut.attraction(0), cut.depth());
    EXPECT_THROW(check(WallPotential{0.1, 3.28, 2.6, 3}), InvalidInput);
}

TEST(GapAttraction, AddsToAdhesion) {
    double share_before = 0;
    for (double h : {2.0, 3.0, 5.0, 6.5}) {
        const AdhesiveContact c = paper::contact(h);
        const ContactState s = solve(c);
        const GapAttraction jkr = gap_attraction(c, s, lennard_jones);
        const GapAttraction pressed =
            gap_attraction(c, s, lennard_jones, {.reading = GapReading::pressed});
        EXPECT_NEAR(jkr.gamma_with, s.gamma_eff + jkr.gamma_gap, 1e-15);
        EXPECT_GT(jkr.gamma_gap, 0);
        // Not more than all the open area touching.
        EXPECT_LT(pressed.gamma_gap, (1 - s.area) * lennard_jones.depth());
        // Taking the load off opens the gaps.
        EXPECT_LE(jkr.gamma_gap, pressed.gamma_gap);
        EXPECT_GT(jkr.mean_separation, pressed.mean_separation);
        // Scaled to Δγ at touching it grows in proportion.
        const GapAttraction scaled =
            gap_attraction(c, s, lennard_jones, {.scale = WallScale::work_of_adhesion});
        EXPECT_NEAR(scaled.gamma_gap / jkr.gamma_gap, 0.1 / lennard_jones.depth(), 1e-9);
        // Its part of the whole grows with roughness.
        const double share = jkr.gamma_gap / jkr.gamma_with;
        EXPECT_GT(share, share_before);
        share_before = share;
    }
}

TEST(GapAttraction, Limits) {
    const AdhesiveContact smooth = paper::contact(0.5);
    const GapAttraction none = gap_attraction(smooth, solve(smooth), lennard_jones);
    EXPECT_EQ(none.gamma_gap, 0);
    EXPECT_EQ(none.gamma_with, solve(smooth).gamma_eff);
    const AdhesiveContact rough = paper::contact(9);
    EXPECT_EQ(gap_attraction(rough, solve(rough), lennard_jones).gamma_with, 0);
    // Without adhesion both readings are the published theory at p itself.
    AdhesiveContact bare = paper::contact(5);
    bare.work_of_adhesion = 0;
    bare.pressure = 1e-2;
    const ContactState s = solve(bare);
    const GapAttraction a = gap_attraction(bare, s, lennard_jones);
    const GapAttraction b =
        gap_attraction(bare, s, lennard_jones, {.reading = GapReading::pressed});
    EXPECT_NEAR(a.equivalent_pressure, bare.pressure, 1e-12);
    EXPECT_NEAR(a.gamma_gap, b.gamma_gap, 1e-9);
    EXPECT_THROW((void)equivalent_pressure(bare, 1.5), InvalidInput);
}

TEST(GapAttraction, HoldsSurfacesPastTheCriticalRoughness) {
    const GapAttraction a = wall_bound(paper::contact(7.5), lennard_jones);
    const GapAttraction b = wall_bound(paper::contact(9), lennard_jones);
    EXPECT_GT(a.gamma_with, b.gamma_with);
    EXPECT_GT(b.gamma_with, 0);
    EXPECT_LT(a.gamma_with, 0.01 * paper::work_of_adhesion);
    EXPECT_LT(a.mean_separation, b.mean_separation);
    EXPECT_EQ(wall_bound(paper::contact(0), lennard_jones).gamma_with_ratio, 1);
}

} // namespace
} // namespace asperity::theory
