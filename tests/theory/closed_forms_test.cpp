// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What has a closed form: JKR's numbers, the area factor, moments of a spectrum, rings of atoms.
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/message.hpp"
#include "support/paper_contact.hpp"
#include "theory/error.hpp"
#include "theory/flat_interface.hpp"
#include "theory/jkr.hpp"

namespace asperity::theory {
namespace {

using paper::q_L;

TEST(Jkr, PaperSphere) {
    EXPECT_NEAR(jkr::pull_off_force(0.1, 4410), 2078.16, 0.5e-2);
    EXPECT_NEAR(jkr::work_from_pull_off(-2078.1635, 4410), 0.1, 1e-8);
    EXPECT_THROW((void)jkr::work_from_pull_off(1, 0), InvalidInput);
}

TEST(Jkr, BindingEnergyIsTheWorkAlongTheCurve) {
    // In Maugis' units, ∫ F dδ from a = 0 to the contact without a load, a³ = 6.
    const double K = 4 * paper::contact_modulus / 3, R = 4410, unit = std::numbers::pi * 0.1 * R;
    double energy = 0, force = 0, approach = 0;
    constexpr int steps = 20000; // even in the root of a, of which the approach is smooth
    for (int i = 1; i <= steps; ++i) {
        const double a = std::cbrt(6.0) * i * i / steps / steps;
        const double F = a * a * a - std::sqrt(6 * a * a * a);
        const double d = a * a - 2.0 / 3 * std::sqrt(6 * a);
        energy -= 0.5 * (F + force) * (d - approach);
        force = F;
        approach = d;
    }
    energy *= unit * std::pow(unit * R / K, 2.0 / 3) / R;
    EXPECT_NEAR(jkr::work_from_binding_energy(energy, R, paper::contact_modulus), 0.1, 1e-7);
    EXPECT_EQ(jkr::work_from_binding_energy(0, R, paper::contact_modulus), 0);
    EXPECT_THROW((void)jkr::work_from_binding_energy(1, 0, 1), InvalidInput);
}

TEST(AreaFactor, BothBranchesMeetTheDefinition) {
    const double below = area_factor(AreaFactor::gaussian, 0.0025 * (1 - 1e-9));
    EXPECT_NEAR(below, area_factor(AreaFactor::gaussian, 0.0025 * (1 + 1e-9)), 1e-11);
    for (double s : {1e-6, 1e-3, 0.3, 5.0, 1e4}) {
        double sum = 0;
        const double dt = 1e-3;
        for (double t = dt / 2; t < 40; t += dt)
            sum += std::sqrt(1 + s * t) * std::exp(-t) * dt;
        EXPECT_NEAR(area_factor(AreaFactor::gaussian, s) / sum, 1, 2e-5) << s;
    }
}

TEST(SpectrumOf, MomentsAreThoseOfAQuadrature) {
    for (double hurst : {0.0, 0.8, 1.0}) {
        const Spectrum s = Spectrum::self_affine({q_L, 3 * q_L, 512 * q_L, hurst, 5});
        EXPECT_NEAR(s.rms_height(), 5, 1e-12);
        double slope = 0, energy = 0;
        constexpr int n = 200000;
        const double step = std::log(512.0) / n;
        for (int i = 0; i < n; ++i) {
            const double q = q_L * std::exp((i + 0.5) * step), C = s(q);
            slope += q * q * q * q * C * step;
            energy += q * q * q * C * step;
        }
        EXPECT_NEAR(s.last().slope / slope, 1, 1e-5) << hurst;
        EXPECT_NEAR(s.last().energy / energy, 1, 1e-5) << hurst;
        EXPECT_NEAR(s.from_first(1.5).slope, s.at(q_L * std::exp(1.5)).slope, 1e-12) << hurst;
    }
}

/// Lennard-Jones, r0 where it is zero.
PairInteraction lennard_jones(double epsilon, double r0, double cutoff) {
    const auto at = [=](double r2) {
        const double s = std::pow(r0 * r0 / r2, 3);
        return PairTerms{4 * epsilon * (s * s - s), -24 * epsilon * (2 * s * s - s) / r2,
                         96 * epsilon * (7 * s * s - 2 * s) / (r2 * r2)};
    };
    return {at, r0, std::pow(2.0, 1.0 / 6) * r0, std::pow(26.0 / 7, 1.0 / 6) * r0, cutoff, false};
}

TEST(FlatInterfaceOf, RingsSumOverTheAtoms) {
    const double a = 2.6, u = 3.1;
    const PairInteraction pair = lennard_jones(0.1, 3.28, 13.12);
    double sum = 0; // over hollow sites, atom by atom
    for (int i = -13; i <= 13; i += 2)
        for (int j = -13; j <= 13; j += 2)
            sum += pair(u * u + 0.25 * a * a * (i * i + j * j)).energy;
    const FlatInterface flat = FlatInterface::hollow_sites(pair, a);
    EXPECT_NEAR(flat.energy(u), sum / (a * a), 1e-12);
    // All registries of the same lattices: the mean over places of the block.
    double mean = 0;
    constexpr int places = 64;
    for (int x = 0; x < places; ++x)
        for (int y = 0; y < places; ++y)
            for (int i = -7; i <= 7; ++i)
                for (int j = -7; j <= 7; ++j)
                    mean += pair(u * u + a * a *
                                             (std::pow(i + x / double(places), 2) +
                                              std::pow(j + y / double(places), 2)))
                                .energy /
                            (places * places);
    EXPECT_NEAR(FlatInterface::all_registries(pair, a, a).energy(u), mean / (a * a), 1e-6);
}

/// A block kept over its hollows by a slope of 0.2 (docs/explanation/theory.md).
TEST(FlatInterfaceOf, TiltCostsWhatItCosts) {
    const FlatInterface flat = FlatInterface::hollow_sites(lennard_jones(0.1, 3.28, 13.12), 2.6);
    double u = 3; // where the energy is least
    while (flat.energy(u + 1e-4) < flat.energy(u))
        u += 1e-4;
    EXPECT_NEAR(flat.tilt_cost(u, false), 2.45, 0.5e-2);
    EXPECT_NEAR(flat.tilt_cost(u, true), 0.350, 1e-3);
}

TEST(TheoryErrors, SayWhatIsWrong) {
    const auto broken = [](auto change) {
        return [=] {
            AdhesiveContact c = paper::contact(5);
            change(c);
            (void)solve(c);
        };
    };
    const auto rings = [](const std::vector<double>& q, const std::vector<double>& C) {
        return [=] { (void)Spectrum::rings(q, C); };
    };
    const struct {
        std::function<void()> call;
        std::vector<std::string> words;
    } cases[] = {
        {[] {
             (void)Spectrum::self_affine({q_L, q_L, q_L, 0.8, 1});
         },
         {"no width", "narrow band"}},
        {[] {
             (void)Spectrum::self_affine({3, 2, 1, 0.8, 1});
         },
         {"3", "2", "order"}},
        {[] {
             (void)Spectrum::self_affine({1, 2, 3, 2.5, 1});
         },
         {"Hurst", "2.5"}},
        {rings({1.0, 0.5}, {1.0}), {"ring 0", "rising"}},
        {rings({1.0, 2.0}, {-1.0}), {"ring 0", "C = -1"}},
        {rings({1.0}, {1.0}), {"1 edges for 1 values"}},
        {[] { (void)solve({}); }, {"modulus"}},
        {broken([](auto& c) { c.beta = 1.5; }), {"beta 1.5", "0.45"}},
        {broken([](auto& c) { c.contact_modulus = -2; }), {"-2", "modulus"}},
        {broken([](auto& c) { c.work_of_adhesion = std::nan(""); }), {"work of adhesion"}},
        {broken([](auto& c) { c.pressure = HUGE_VAL; }), {"pressure"}},
        {broken([](auto& c) { c.spectrum = {}; }), {"spectrum"}},
    };
    for (const auto& [call, words] : cases) {
        const std::string text = test::message_of<InvalidInput>(call);
        for (const std::string& word : words)
            EXPECT_TRUE(test::has(text, word)) << word << " not in: " << text;
    }
}

} // namespace
} // namespace asperity::theory
