// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The renormalised theory: laws that hold whatever the roughness, limits, orders, errors.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/message.hpp"
#include "support/paper_contact.hpp"
#include "theory/error.hpp"
#include "theory/renormalised.hpp"

namespace asperity::theory {
namespace {

constexpr double pi = std::numbers::pi;
PairInteraction lennard_jones(double epsilon = 0.1, double r0 = 3.28, double cutoff = 13.12) {
    const auto at = [=](double r2) {
        const double s = std::pow(r0 * r0 / r2, 3);
        return PairTerms{4 * epsilon * s * (s - 1), -24 * epsilon * s * (2 * s - 1) / r2,
                         4 * epsilon * s * (168 * s - 48) / (r2 * r2)};
    };
    return {at, r0, std::pow(2.0, 1.0 / 6) * r0, std::pow(26.0 / 7, 1.0 / 6) * r0, cutoff};
}

/// The paper's surface, clipped at Nyquist.
Spectrum surface(double rms) {
    return Spectrum::self_affine({paper::q_L, 3 * paper::q_L, 256 * paper::q_L, 0.8, rms});
}

RoughInterface rough(double rms, double pressure = 0, bool friction = true) {
    return {surface(rms), FlatInterface::hollow_sites(lennard_jones(), 2.6),
            StiffnessTable::half_space(paper::contact_modulus, 0.42), friction, pressure};
}

/// A Morse-like law of the gap, w (e^{-2x} - 2 e^{-x}), x = (u - u0)/ρ, with `extra` added to it.
constexpr double depth = 0.1, range = 0.8, rest = 3;
double morse(double u) {
    const double e = std::exp(-(u - rest) / range);
    return depth * (e * e - 2 * e);
}
RoughInterface wall(double rms, const std::function<double(double)>& law, double contact = 3.6,
                    double modulus = paper::contact_modulus) {
    return {surface(rms), FlatInterface::wall(law, 1.2, 22, contact),
            StiffnessTable::half_space(modulus, 0.42), true, 0};
}

// Computed once with eps 1e-6 and compared with an independent program written from the equations
// alone (another grid in u, uniform; other steps); both agree to 1e-4.
struct Row {
    double rms, gamma, contact;
};
class PaperSurface : public testing::TestWithParam<Row> {};
TEST_P(PaperSurface, AgreesWithAnIndependentProgram) {
    const RenormalisedState s = solve(rough(GetParam().rms));
    EXPECT_TRUE(s.converged);
    EXPECT_LE(s.gamma_ratio_error, 1e-4);
    EXPECT_NEAR(s.gamma_ratio, GetParam().gamma, 4e-4);
    EXPECT_NEAR(s.contact_fraction, GetParam().contact, 8e-4);
}
INSTANTIATE_TEST_SUITE_P(Roughnesses, PaperSurface,
                         testing::Values(Row{1, 0.9629, 1.0000}, Row{3, 0.6725, 0.9782},
                                         Row{5, 0.2643, 0.6300}, Row{8, 0.0158, 0.0756}));

TEST(Renormalised, FlatIsFlat) {
    const RenormalisedState s = solve(rough(0));
    EXPECT_EQ(s.gamma_ratio, 1);
    EXPECT_EQ(s.contact_fraction, 1);
    EXPECT_EQ(s.gamma_eff, rough(0).flat.work_of_adhesion());
    EXPECT_NEAR(s.gamma_eff, 0.0988633, 1e-6); // docs/explanation/model.md
    EXPECT_NEAR(s.separation, 3.108, 1e-3);
    EXPECT_NEAR(s.tension / paper::gpa, 9.08, 0.01);
    // Continuous there: 0.1 Å of roughness costs little.
    EXPECT_NEAR(solve(rough(0.1)).gamma_ratio, 1, 5e-4);
}

// S << φ″: the interface follows the surface, and only the energy of full contact is lost.
TEST(Renormalised, SoftBlockIsFullContact) {
    const double rms = 4, modulus = 1e-3 * paper::contact_modulus;
    const RoughInterface soft = wall(rms, morse, 3.6, modulus);
    const double cost = (1 - solve(soft, {.tolerance = 1e-6}).gamma_ratio) * depth;
    double energy = 0; // (E*/4) <q h²>
    const int points = 20000;
    for (int i = 0; i < points; ++i) {
        const double step = std::log(256.0) / points, q = paper::q_L * std::exp((i + 0.5) * step);
        energy += pi / 2 * modulus * q * q * soft.spectrum(q) * q * step;
    }
    EXPECT_NEAR(cost / energy, 1, 1e-2);
}

// S >> φ″: the block stays flat and φ is averaged over the Gaussian heights. Of e^{-x} that is a
// factor e^{h²/2ρ²}, of e^{-2x} e^{2h²/ρ²}.
TEST(Renormalised, RigidBlockAveragesOverTheGaps) {
    const double rms = 0.3, s = rms * rms / (range * range);
    const RoughInterface rigid{
        Spectrum::self_affine({0.5, 0.5, 1.2, 0.8, rms}), FlatInterface::wall(morse, -0.5, 22, 3.6),
        StiffnessTable::half_space(1e3 * paper::contact_modulus, 0.42), true, 0};
    const RenormalisedPotential p = renormalised_potential(rigid, 2);
    int compared = 0;
    for (std::size_t i = 0; i < p.separation.size(); ++i) {
        if (p.separation[i] < 2.9 || p.separation[i] > 12) continue;
        const double e = std::exp(-(p.separation[i] - rest) / range);
        ASSERT_NEAR(p.energy[i], depth * (e * e * std::exp(2 * s) - 2 * e * std::exp(s / 2)),
                    2e-3 * depth)
            << p.separation[i];
        ++compared;
    }
    EXPECT_GT(compared, 50);
}

// An energy per contact area added to the flat law changes γ by as much as there is contact:
// -∂γ/∂λ of φ + λ χ is χ at the minimum. The law is smooth so that it can be added.
TEST(Renormalised, ContactIsTheDerivativeOfTheEnergy) {
    const double width = 0.2, edge = 3.6;
    const auto chi = [&](double u) { return 0.5 * std::erfc((u - edge) / width); };
    RenormalisedOptions fine;
    fine.tolerance = 1e-6;
    fine.max_refinement = 1;
    const double rms = 4;
    const auto with = [&](double lambda) {
        return solve(wall(rms, [=](double u) { return morse(u) + lambda * chi(u); }), fine)
            .gamma_eff;
    };
    const double lambda = 1e-4 * depth;
    const double change = -(with(lambda) - with(-lambda)) / (2 * lambda);
    // The same observable by its own equation: the steps of many sharp edges, χ = Σ weight.
    double contact = 0;
    const int edges = 8;
    for (int i = 0; i < edges; ++i) {
        const double x = -2.4 + 4.8 * (i + 0.5) / edges;
        const double weight = 4.8 / edges * std::exp(-x * x) / std::sqrt(pi);
        contact += weight *
                   solve(wall(rms, morse, edge + width * x), {.tolerance = 1e-3}).contact_fraction;
    }
    EXPECT_NEAR(change, contact, 5e-3);
    EXPECT_GT(contact, 0.1);
}

// Under load: p = -dφ/du, so γ as a function of p has the slope p du/dp.
TEST(Renormalised, PressureIsTheSlopeOfTheEnergy) {
    RenormalisedOptions fine;
    fine.tolerance = 1e-5;
    fine.max_refinement = 1;
    for (const double p : {-0.001, 0.0005, 0.005}) {
        const double d = 1e-4;
        const RenormalisedState up = solve(rough(4, p + d), fine),
                                low = solve(rough(4, p - d), fine);
        EXPECT_LT(up.separation, low.separation);
        EXPECT_NEAR((up.gamma_eff - low.gamma_eff) / (up.separation - low.separation), p,
                    1e-2 * std::abs(p) + 1e-5);
    }
}

TEST(Renormalised, TensionEndsTheBranch) {
    const RenormalisedState free = solve(rough(4));
    const RenormalisedState near_end = solve(rough(4, -0.99 * free.tension));
    EXPECT_LT(near_end.gamma_ratio, free.gamma_ratio);
    EXPECT_LT(near_end.contact_fraction, free.contact_fraction);
    EXPECT_GT(near_end.contact_fraction, 0.1);
    EXPECT_TRUE(test::has(
        test::message_of<NoSolution>([&] { (void)solve(rough(4, -1.01 * free.tension)); }),
        "pull less"));
}

// The orders of the solver: 2 in the steps and in the spacing, each with the other much finer.
TEST(Renormalised, OrderOfConvergence) {
    const auto gamma = [](int steps, double spacing) {
        RenormalisedOptions o;
        o.steps = steps;
        o.spacing = spacing;
        RoughInterface r = wall(3, morse);
        const RenormalisedPotential p = renormalised_potential(r, 0, o);
        // At a fixed separation, by the cubic through four points.
        const double at = 4;
        auto i = static_cast<std::size_t>(
            std::upper_bound(p.separation.begin(), p.separation.end(), at) - p.separation.begin());
        double sum = 0;
        for (std::size_t j = i - 2; j < i + 2; ++j) {
            double weight = 1;
            for (std::size_t k = i - 2; k < i + 2; ++k)
                if (k != j) weight *= (at - p.separation[k]) / (p.separation[j] - p.separation[k]);
            sum += weight * p.energy[j];
        }
        return sum;
    };
    const double a = gamma(50, 0.02), b = gamma(100, 0.02), c = gamma(200, 0.02);
    const double in_steps = std::log2((a - b) / (b - c));
    EXPECT_GT(in_steps, 1.6);
    EXPECT_LT(in_steps, 2.6);
    const double d = gamma(60, 0.08), e = gamma(60, 0.04), f = gamma(60, 0.02);
    const double in_spacing = std::log2((d - e) / (e - f));
    EXPECT_GT(in_spacing, 1.6);
    EXPECT_LT(in_spacing, 2.6);
}

TEST(Renormalised, ErrorEstimateIsHonest) {
    RenormalisedOptions fine;
    fine.tolerance = 1e-5;
    for (const double rms : {0.5, 3.0, 8.0}) {
        const RenormalisedState good = solve(rough(rms), fine), s = solve(rough(rms));
        EXPECT_TRUE(s.converged) << rms;
        EXPECT_LE(std::abs(s.gamma_ratio - good.gamma_ratio),
                  s.gamma_ratio_error + good.gamma_ratio_error)
            << rms;
        EXPECT_LE(std::abs(s.contact_fraction - good.contact_fraction),
                  s.contact_error + good.contact_error)
            << rms;
    }
    // Refinements forbidden: the number comes with the error that it has.
    RenormalisedOptions coarse;
    coarse.tolerance = 1e-9;
    coarse.max_refinement = 0;
    const RenormalisedState s = solve(rough(5), coarse);
    EXPECT_FALSE(s.converged);
    EXPECT_GT(s.gamma_ratio_error, 1e-9);
}

TEST(Renormalised, TheErrorOfAPressedStateIsNoLessThanTheToleranceOfItsValue) {
    // Pressed to many times the work of adhesion, where the grids agree better than that.
    RoughInterface pressed = wall(0.5, morse);
    pressed.pressure = 3.0;
    const RenormalisedState s = solve(pressed);
    ASSERT_GT(std::abs(s.gamma_ratio), 3.0);
    EXPECT_GE(s.gamma_ratio_error, 1e-4 * std::abs(s.gamma_ratio));
}

TEST(Renormalised, RoughnessOnlyWeakens) {
    double before = 1;
    for (double rms = 0.5; rms < 30; rms *= 1.3) {
        const RenormalisedState s = solve(rough(rms));
        EXPECT_TRUE(s.converged) << rms;
        EXPECT_LE(s.gamma_ratio, before + s.gamma_ratio_error) << rms;
        EXPECT_GE(s.gamma_ratio, -s.gamma_ratio_error) << rms;
        EXPECT_GE(s.contact_fraction, 0);
        before = s.gamma_ratio;
    }
    EXPECT_LT(before, 1e-6);
}

// Lateral compliance and friction: tilt costs less where sites may slide.
TEST(Renormalised, SlidingUndoesTilt) {
    for (const double rms : {2.0, 4.0}) {
        const double with = solve(rough(rms)).gamma_ratio,
                     without = solve(rough(rms, 0, false)).gamma_ratio;
        EXPECT_GT(with, without + 0.003) << rms;
        EXPECT_LT(with, without + 0.05) << rms;
    }
}

TEST(Renormalised, ManySmallAtomsAreAWall) {
    // A lattice much finer than the range of the potential: rings become a plane.
    const double a = 0.65;
    const PairInteraction dense = lennard_jones(0.1 * std::pow(a / 2.6, 4));
    const FlatInterface atoms = FlatInterface::hollow_sites(dense, a),
                        plane = FlatInterface::all_registries(dense, a, a);
    for (const double u : {2.6, 3.0, 3.5, 5.0, 9.0})
        EXPECT_NEAR(atoms.energy(u), plane.energy(u), 2e-3 * atoms.work_of_adhesion()) << u;
}

// A rigid tilt of the lattice by the slope 0.2 along x, sites over hollows or free to slide, summed
// atom by atom: 0.924 and 0.987 of the flat interface.
TEST(Renormalised, TiltCostIsThatOfTheTiltedLattice) {
    const double a = 2.6, slope = 0.05;
    const auto tilted = [&](double shift, double u) {
        double sum = 0;
        for (int i = -6; i < 6; ++i)
            for (int j = -6; j < 6; ++j) {
                const double x = (i + 0.5) * a - shift, y = (j + 0.5) * a;
                const double z = u - slope * (i + 0.5) * a, r2 = x * x + y * y + z * z;
                if (r2 >= 13.12 * 13.12) continue;
                const auto v = [](double square) {
                    const double s = std::pow(3.28 * 3.28 / square, 3);
                    return 0.4 * s * (s - 1);
                };
                sum += (v(r2) - v(13.12 * 13.12)) / (a * a);
            }
        return sum;
    };
    const FlatInterface flat = rough(0).flat;
    double kept = 0, slid = 0;
    for (double u = 3; u < 3.25; u += 2e-4) {
        kept = std::min(kept, tilted(0, u));
        for (double shift = -0.3; shift <= 0.3; shift += 0.01)
            slid = std::min(slid, tilted(shift, u));
    }
    const double s = slope * slope;
    EXPECT_NEAR((1 + kept / flat.work_of_adhesion()) / s, flat.tilt_cost(false), 0.05);
    EXPECT_NEAR((1 + slid / flat.work_of_adhesion()) / s, flat.tilt_cost(true), 0.05);
    EXPECT_NEAR(area_factor({AreaFactor::lattice, 1.9}, 0.04), 0.929, 1e-3);
}

// Waves on a square lattice of wavevectors with the spacing q_L, all of one variance: as many as
// there are. The self-affine one by the trapezoidal rule.
TEST(ExpectedError, CountsTheWavesOfTheSpectrum) {
    const std::vector<double> edges = {0.5, 3, 7}, one = {2e-3, 2e-3};
    EXPECT_NEAR(Spectrum::rings(edges, one).waves(), pi * (49 - 0.25) / 0.25, 1e-9);
    const Spectrum s = surface(3);
    double height = 0, squares = 0;
    const int points = 200000;
    for (int i = 0; i < points; ++i) {
        const double q = s.q_L() * std::pow(s.q1() / s.q_L(), (i + 0.5) / points);
        const double dq = q * std::log(s.q1() / s.q_L()) / points;
        height += q * s(q) * dq;
        squares += q * s(q) * s(q) * dq;
    }
    EXPECT_NEAR(s.waves(), 2 * pi * height * height / (squares * s.q_L() * s.q_L()),
                1e-3 * s.waves());
    EXPECT_NEAR(surface(30).waves(), s.waves(), 1e-9 * s.waves());
    EXPECT_EQ(surface(0).waves(), 0);
}

// Small amplitudes: without friction γ is lower than over a wall with the same φ(u) by the tilt.
TEST(ExpectedError, TiltCostIsWhatAtomsLoseAgainstTheirWall) {
    const RoughInterface atoms = rough(1, 0, false);
    RoughInterface same = atoms;
    same.flat =
        FlatInterface::wall([flat = atoms.flat](double u) { return flat.energy(u); },
                            atoms.flat.closest(), atoms.flat.reach(), atoms.flat.inflection());
    const RenormalisedState a = solve(atoms), w = solve(same);
    EXPECT_GT(a.tilt_cost, 2e-3);
    EXPECT_NEAR(a.tilt_cost, w.gamma_ratio - a.gamma_ratio, 0.1 * a.tilt_cost);
    EXPECT_EQ(w.tilt_cost, 0);
    EXPECT_EQ(a.stiffening, 0);
    EXPECT_EQ(w.stiffening, 0);
}

// A block slightly stiffer under lateral forces than without them: to first order γ falls by it.
TEST(ExpectedError, StiffeningIsWhatAStifferBlockCosts) {
    const double S = paper::contact_modulus / 2, more = 0.02;
    for (const double rms : {2.0, 4.0}) {
        RoughInterface same = rough(rms), stiffer = same;
        same.stiffness = StiffnessTable({{1, S, S, 0, S}});
        stiffer.stiffness = StiffnessTable({{1, S * (1 + more), S, 0, S}});
        const RenormalisedState a = solve(same), b = solve(stiffer);
        EXPECT_NEAR(a.stiffening, 0, 1e-12);
        EXPECT_NEAR(b.stiffening, a.gamma_ratio - b.gamma_ratio, 0.05 * b.stiffening + 2e-5);
        EXPECT_GT(b.stiffening, 1e-3);
        // More of it: a larger expected error.
        RoughInterface stiffest = same;
        stiffest.stiffness = StiffnessTable({{1, S * (1 + 10 * more), S, 0, S}});
        EXPECT_GT(solve(stiffest).expected->gamma_ratio, a.expected->gamma_ratio);
    }
}

// Over a wall only few waves matter: none on a smooth one, and half of it on a square twice as
// wide.
TEST(ExpectedError, OfAWallFallsWithItsSize) {
    const auto of = [](double length, double rms, bool ensemble) {
        RoughInterface r = wall(rms, morse);
        r.spectrum = Spectrum::self_affine(
            {paper::q_L / length, 3 * paper::q_L, 256 * paper::q_L, 0.8, rms});
        r.ensemble = ensemble;
        return solve(r);
    };
    EXPECT_EQ(of(1, 0, false).expected->gamma_ratio, 0);
    EXPECT_EQ(of(1, 0, false).expected->contact, 0);
    const RenormalisedState small = of(3, 3, false), wide = of(30, 3, false),
                            ensemble = of(3, 3, true);
    const auto scatter = [](const RenormalisedState& s) {
        return s.expected->gamma_ratio - s.gamma_ratio_error;
    };
    EXPECT_NEAR(scatter(wide), 0.1 * scatter(small), 0.02 * scatter(small));
    EXPECT_LT(wide.expected->gamma_ratio, 0.004);
    EXPECT_LT(wide.expected->contact, 0.006);
    EXPECT_GT(scatter(ensemble), 2 * scatter(small));
    EXPECT_LT(solve(wall(0.3, morse)).expected->gamma_ratio, 1e-3);
}

TEST(ExpectedError, GrowsWithTheSlopeAndIsZeroWithoutRoughness) {
    double gamma = 0, contact = 0;
    for (const double rms : {0.0, 1.0, 2.0, 4.0}) {
        const RenormalisedState s = solve(rough(rms));
        ASSERT_TRUE(s.expected);
        EXPECT_GE(s.expected->gamma_ratio, gamma);
        EXPECT_GE(s.expected->contact, contact);
        gamma = s.expected->gamma_ratio;
        contact = s.expected->contact;
    }
    EXPECT_GT(gamma, 0.01);
    EXPECT_LT(gamma, 0.1);
    // More than the scatter that a wall of the same γ would have.
    const RenormalisedState s = solve(rough(4));
    const double scatter = (1 - s.gamma_ratio) / std::sqrt(surface(4).waves());
    EXPECT_GT(s.expected->gamma_ratio, 0.5 * scatter + s.gamma_ratio_error + 1e-3);
    EXPECT_FALSE(solve(rough(4, 1e-4)).expected);
}

TEST(ExpectedError, HasNoUnits) {
    const double length = 3, energy = 7;
    RoughInterface here = rough(3), there = here;
    const PairInteraction pair = lennard_jones(0.1 * energy, 3.28 * length, 13.12 * length);
    there.flat = FlatInterface::hollow_sites(pair, 2.6 * length);
    there.spectrum = Spectrum::self_affine(
        {paper::q_L / length, 3 * paper::q_L / length, 256 * paper::q_L / length, 0.8, 3 * length});
    there.stiffness =
        StiffnessTable::half_space(paper::contact_modulus * energy / std::pow(length, 3), 0.42);
    const RenormalisedState a = solve(here), b = solve(there);
    EXPECT_NEAR(b.gamma_ratio, a.gamma_ratio, 1e-6);
    EXPECT_NEAR(b.expected->gamma_ratio, a.expected->gamma_ratio,
                1e-3 * a.expected->gamma_ratio + 1e-6);
    EXPECT_NEAR(b.expected->contact, a.expected->contact, 1e-3 * a.expected->contact + 1e-6);
}

TEST(Renormalised, HardInputs) {
    // Wide and narrow spectra, soft and stiff blocks, long and short reach: an error or a bound.
    int answers = 0, refusals = 0;
    for (const double q1 : {2.0, 256.0})
        for (const double modulus : {1e-3, 1.0, 30.0})
            for (const double r0 : {2.2, 3.28, 5.0})
                for (const double rms : {0.3, 3.0}) {
                    const Spectrum C =
                        Spectrum::self_affine({paper::q_L, paper::q_L, q1 * paper::q_L, 1, rms});
                    try {
                        const RenormalisedState s = solve(
                            {C, FlatInterface::hollow_sites(lennard_jones(0.1, r0, 4 * r0), 2.6),
                             StiffnessTable::half_space(modulus * paper::contact_modulus, 0.42),
                             true, 0});
                        EXPECT_TRUE(std::isfinite(s.gamma_ratio) &&
                                    std::isfinite(s.contact_fraction));
                        EXPECT_TRUE(std::isfinite(s.gamma_ratio_error));
                        EXPECT_LE(s.gamma_ratio, 1.05);
                        EXPECT_TRUE(!s.converged || s.gamma_ratio_error <= 1e-4);
                        ++answers;
                        EXPECT_LE(s.gamma_ratio_error, 0.01);
                        EXPECT_LE(s.contact_error, 0.01);
                    } catch (const std::logic_error& error) { // InvalidInput, NoSolution
                        EXPECT_NE(std::string(error.what()).find("; "), std::string::npos);
                        ++refusals;
                    }
                }
    EXPECT_GE(answers, 18);
    EXPECT_EQ(answers + refusals, 36);
}

/// Steep roughness under a strong attraction: errors that stay large, and more adhesion than the
/// flat surfaces have, are no answers.
TEST(Renormalised, NoNumberWithoutAUsefulBound) {
    const double q_L = 8 * paper::q_L; // a box of 64 sites
    const Spectrum steep = Spectrum::self_affine({q_L, 3 * q_L, 32 * q_L, 0.8, 8});
    const auto reason = [&](double epsilon, bool friction, const RenormalisedOptions& options) {
        try {
            const RenormalisedState s =
                solve({steep, FlatInterface::hollow_sites(lennard_jones(epsilon, 3.28, 13.12), 2.6),
                       StiffnessTable::half_space(paper::contact_modulus, 0.42), friction, 0},
                      options);
            EXPECT_LE(s.gamma_ratio, 1.01);
            EXPECT_LE(std::max(s.gamma_ratio_error, s.contact_error), options.useful);
            return std::string();
        } catch (const NoSolution& error) {
            return std::string(error.what());
        }
    };
    for (const bool friction : {true, false})
        EXPECT_NE(reason(10, friction, {.max_refinement = 1}).find("on the finest grid tried"),
                  std::string::npos);
    // With so wide a bound the number itself is still refused.
    EXPECT_NE(reason(10, false, {.useful = 500, .max_refinement = 1}).find("than they have"),
              std::string::npos);
    EXPECT_EQ(reason(0.1, true, {}), "");
}

TEST(Renormalised, ErrorsSayWhatIsWrong) {
    const auto lj = [](double r0, double cutoff, double a = 2.6) {
        return [=] { (void)FlatInterface::hollow_sites(lennard_jones(0.1, r0, cutoff), a); };
    };
    RoughInterface stiff = rough(3);
    stiff.stiffness = StiffnessTable::half_space(1e4 * paper::contact_modulus, 0.42);
    const struct {
        std::function<void()> call;
        const char* word;
    } cases[] = {
        {lj(-3.28, 13), "zero"},
        {lj(3.28, 3), "cutoff"},
        {lj(1.0, 4, 5), "no minimum"},
        {[] { (void)FlatInterface::wall(morse, 3, 2, 3); }, "reaches"},
        {[] { (void)FlatInterface::wall([](double) { return 1.0; }, 1, 9, 3); }, "no minimum"},
        {[] { (void)StiffnessTable({}); }, "empty"},
        {[] {
             (void)StiffnessTable({{2, 1, 1, 0, 1}, {1, 1, 1, 0, 1}});
         },
         "ascend"},
        {[] { (void)solve(rough(3, std::nan(""))); }, "not a number"},
        {[] { (void)solve(rough(3), {.tolerance = 0}); }, "tolerance"},
        {[] { (void)solve(rough(3), {.useful = 0}); }, "largest error"},
        {[&] { (void)solve(stiff); }, "softer block"},
    };
    for (const auto& [call, word] : cases) {
        const std::string text = test::message_of<InvalidInput>(call);
        EXPECT_TRUE(test::has(text, word)) << word << " not in: " << text;
    }
}

} // namespace
} // namespace asperity::theory
