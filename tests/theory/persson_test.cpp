// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The adhesive theory against the numbers of theory.md. A number given to n digits must come out to
// those n digits: the tolerance is half a unit of the last one.
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <boost/math/tools/toms748_solve.hpp>
#include <gtest/gtest.h>

#include "support/diffusion.hpp"
#include "support/paper_contact.hpp"
#include "theory/error.hpp"
#include "theory/shooting.hpp"

namespace asperity::theory {
namespace {

using paper::gpa;

constexpr double five_digits = 0.5e-5;

struct Row {
    double h, gamma, area, full;
};

void PrintTo(const Row& row, std::ostream* out) { *out << "h_rms " << row.h << " Å"; }

class PaperTable : public testing::TestWithParam<Row> {};

TEST_P(PaperTable, FirstPassage) {
    const Row row = GetParam();
    const ContactState s = solve(paper::contact(row.h));
    EXPECT_EQ(s.status, Status::adhesive);
    EXPECT_TRUE(s.converged);
    EXPECT_NEAR(s.gamma_ratio, row.gamma, five_digits);
    EXPECT_NEAR(s.area, row.area, five_digits);
    EXPECT_NEAR(full_contact(paper::contact(row.h)).gamma_ratio, row.full, five_digits);
}

INSTANTIATE_TEST_SUITE_P(
    Roughness, PaperTable,
    testing::Values(Row{1, 0.96460, 1.00000, 0.96460}, Row{2, 0.85835, 0.99999, 0.85836},
                    Row{3, 0.67469, 0.98985, 0.68120}, Row{4, 0.40000, 0.88896, 0.43298},
                    Row{5, 0.15159, 0.66628, 0.11353}, Row{6, 0.02877, 0.39290, -0.27733},
                    Row{6.5, 0.00604, 0.24305, -0.49960}, Row{6.9, 0.00012, 0.08329, -0.69032}));

TEST(Persson, AreaFactorOffToEightDigits) {
    const SolverOptions fine{.tolerance = 1e-7, .max_refinement = 6};
    for (const auto& [h, gamma, area] :
         {std::array{3.0, 0.65999582, 0.98908746}, std::array{5.0, 0.12869208, 0.64160117},
          std::array{6.5, 0.00165569, 0.17100173}}) {
        const ContactState s = solve(paper::contact(h, AreaFactor::none), fine);
        EXPECT_NEAR(s.gamma_ratio, gamma, 3e-8) << h;
        EXPECT_NEAR(s.area, area, 1e-7) << h;
    }
}

TEST(Persson, CriticalRoughness) {
    const CriticalRoughness gaussian = critical_roughness(paper::contact(5));
    EXPECT_NEAR(gaussian.h_rms, 6.9723, 0.5e-4);
    EXPECT_NEAR(gaussian.full_contact_h_rms, 5.3100, 0.5e-4);
    EXPECT_LT(gaussian.error, 1e-4);
    const double off = critical_roughness(paper::contact(5, AreaFactor::none)).h_rms;
    EXPECT_NEAR(off, 6.7393, 0.5e-4);
    EXPECT_NEAR(critical_roughness(paper::contact(5, AreaFactor::small_slope)).h_rms, 6.9899,
                0.5e-4);
    EXPECT_NEAR(adhesion_parameter(paper::contact_modulus, off, 3 * paper::q_L, 0.1), 3.7625,
                0.5e-4);
    // The roughness of the spectrum handed in must not matter, not even zero.
    EXPECT_NEAR(critical_roughness(paper::contact(0)).h_rms, gaussian.h_rms, 1e-6);
    // And the answer really separates contact from none.
    EXPECT_EQ(solve(paper::contact(0.9995 * gaussian.h_rms)).status, Status::adhesive);
    EXPECT_EQ(solve(paper::contact(1.0005 * gaussian.h_rms)).status, Status::no_contact);
    // The other integration, on its own.
    EXPECT_NEAR(critical_roughness(paper::contact(5), {.integration = by_diffusion}).h_rms, 6.9723,
                0.5e-4);
}

TEST(Persson, CriticalRoughnessUnderLoad) {
    for (double p : {-0.5, 0.5}) {
        AdhesiveContact c = paper::contact(5);
        c.pressure = p * gpa;
        const double h_c = critical_roughness(c).h_rms;
        c.spectrum = c.spectrum.with_rms_height(0.999 * h_c);
        EXPECT_EQ(solve(c).status, Status::adhesive) << p;
        c.spectrum = c.spectrum.with_rms_height(1.001 * h_c);
        EXPECT_EQ(solve(c).status, p < 0 ? Status::no_contact : Status::pressed) << p;
    }
}

TEST(Persson, WithoutRollOff) {
    AdhesiveContact c = paper::contact(9);
    c.spectrum = Spectrum::self_affine({paper::q_L, paper::q_L, 512 * paper::q_L, 0.8, 9});
    EXPECT_NEAR(critical_roughness(c).h_rms, 9.98, 0.5e-2);
    EXPECT_NEAR(solve(c).area, 0.31, 0.5e-2);
    // As printed there is none, and 8.12 Å bounds any law for σ_a: even W/a = β costs Δγ S by then.
    EXPECT_EQ(solve(paper::contact(9)).status, Status::no_contact);
    const auto cheapest = [](double h) {
        const FullContactState f = full_contact(paper::contact(h));
        return paper::work_of_adhesion * f.real_area - 0.45 * f.elastic_energy;
    };
    EXPECT_GT(cheapest(8.115), 0);
    EXPECT_LT(cheapest(8.125), 0);
}

TEST(Persson, CurvesCross) {
    const auto gap = [](double h) {
        const AdhesiveContact c = paper::contact(h);
        return solve(c, {.tolerance = 1e-5}).gamma_ratio - full_contact(c).gamma_ratio;
    };
    std::uintmax_t iterations = 30;
    const auto close = [](double a, double b) { return std::abs(a - b) < 1e-6; };
    const double h = boost::math::tools::toms748_solve(gap, 4.5, 5.0, close, iterations).first;
    EXPECT_NEAR(h, 4.726, 0.5e-3);
    EXPECT_NEAR(full_contact(paper::contact(h)).gamma_ratio, 0.208, 0.5e-3);
}

TEST(Persson, EndOfTheBranch) {
    // γ_eff ∝ A^(1/α) with α = 0.24781: compare two states close to the end, area factor off.
    const double h_c = critical_roughness(paper::contact(5, AreaFactor::none)).h_rms;
    const ContactState a = solve(paper::contact(h_c * (1 - 1e-3), AreaFactor::none));
    const ContactState b = solve(paper::contact(h_c * (1 - 2.5e-4), AreaFactor::none));
    const double slope = std::log(a.gamma_ratio / b.gamma_ratio) / std::log(a.area / b.area);
    EXPECT_NEAR(1 / slope, 0.24781, 2e-3);
    // A ∝ (θ_c - θ)^(1/2): four times closer is half the area.
    EXPECT_NEAR(a.area / b.area, 2, 0.02);
}

TEST(Persson, TensionBranchEnds) {
    for (const auto& [h, p, area] :
         {std::array{3.0, -1.974, 0.741}, std::array{5.0, -1.020, 0.323}}) {
        AdhesiveContact c = paper::contact(h);
        c.pressure = (p + 0.5e-3) * gpa;
        const ContactState before = solve(c);
        EXPECT_EQ(before.status, Status::adhesive) << h;
        EXPECT_GT(before.area, area);
        EXPECT_LT(before.area, area + 0.02);
        // -p stays inside σ_a(1), which it reaches at the end.
        EXPECT_GT(before.profile.front().detachment_stress, -c.pressure);
        EXPECT_LT(before.profile.front().detachment_stress, -1.02 * c.pressure);
        c.pressure = (p - 0.5e-3) * gpa;
        const ContactState after = solve(c);
        EXPECT_EQ(after.status, Status::no_contact);
        EXPECT_EQ(after.area, 0);
        EXPECT_EQ(after.gamma_eff, 0);
        EXPECT_NE(after.reason.find("no adhesive solution"), std::string::npos) << after.reason;
    }
}

TEST(Persson, StressIsNotConserved) {
    EXPECT_NEAR(solve(paper::contact(5)).contact_stress / gpa, 1.23, 0.5e-2);
}

TEST(Persson, StressScale) {
    const AdhesiveContact c = paper::contact(1);
    EXPECT_NEAR(std::sqrt(stress_variance(c, 512 * paper::q_L)) / gpa, 2.66791, five_digits);
}

TEST(Persson, NonAdhesiveAgainstPublishedSimulation) {
    AdhesiveContact c;
    c.spectrum = Spectrum::self_affine({1e4, 1e4, 1e6, 0.8, 6e-6});
    c.contact_modulus = 1;
    struct {
        double p, simulation, theory;
    } const rows[] = {{0.01, 0.0779, 0.0576}, {0.113, 0.657, 0.586}, {0.3, 0.979, 0.970}};
    for (const auto& row : rows) {
        c.pressure = row.p;
        const ContactState s = solve(c);
        EXPECT_NEAR(s.area, row.theory, row.p < 0.1 ? 0.5e-4 : 0.5e-3);
        EXPECT_NEAR(s.area, std::erf(row.p / std::sqrt(2 * stress_variance(c, 1e6))), 1e-15);
        EXPECT_NEAR(s.area, row.simulation, 0.08);
        EXPECT_EQ(s.status, Status::pressed);
    }
    c.pressure = 0;
    EXPECT_EQ(solve(c).status, Status::no_contact);
    c.pressure = -0.1;
    EXPECT_EQ(solve(c).status, Status::no_contact);
}

TEST(Persson, VanishingAdhesionApproachesErf) {
    AdhesiveContact c = paper::contact(6);
    c.pressure = 3 * gpa;
    const double T = stress_variance(c, c.spectrum.q1());
    c.work_of_adhesion = 0;
    const ContactState none = solve(c);
    EXPECT_DOUBLE_EQ(none.area, std::erf(c.pressure / std::sqrt(2 * T)));
    EXPECT_EQ(none.contact_stress, c.pressure);
    for (Integration integration : {Integration::first_passage, by_diffusion}) {
        c.work_of_adhesion = 1e-9;
        const ContactState little = solve(c, {.integration = integration, .max_refinement = 3});
        EXPECT_NEAR(little.area, none.area, 1e-5);
        EXPECT_NEAR(little.elastic_energy, none.elastic_energy, 1e-5 * none.elastic_energy);
    }
}

TEST(Persson, DependsOnThetaAloneWithoutAreaFactor) {
    const ContactState here = solve(paper::contact(6, AreaFactor::none));
    const double theta = adhesion_parameter(paper::contact_modulus, 6, 3 * paper::q_L, 0.1);
    // SI units, another modulus, another size; h so that θ is the same.
    AdhesiveContact other;
    const double q_L = 2e5, E = 3e6, dg = 0.05;
    const double h = std::sqrt(theta * dg / (E * 3 * q_L));
    other.spectrum = Spectrum::self_affine({q_L, 3 * q_L, 512 * q_L, 0.8, h});
    other.contact_modulus = E;
    other.work_of_adhesion = dg;
    other.area_factor = AreaFactor::none;
    const ContactState there = solve(other);
    EXPECT_NEAR(there.gamma_ratio, here.gamma_ratio, 1e-9);
    EXPECT_NEAR(there.area, here.area, 1e-9);
    // With the factor on it is not so.
    other.area_factor = AreaFactor::gaussian;
    EXPECT_GT(std::abs(solve(other).gamma_ratio - here.gamma_ratio), 1e-3);
}

TEST(Persson, IntegrationsAgreeAtAnyLoad) {
    for (double h : {4.0, 6.5, 9.0})
        for (double p : {-0.3, 0.02, 3.0}) {
            AdhesiveContact c = paper::contact(h);
            c.pressure = p * gpa;
            const ContactState a = solve(c),
                               b = solve(c, {.integration = by_diffusion, .max_refinement = 3});
            EXPECT_EQ(a.status, b.status) << h << " Å " << p << " GPa";
            EXPECT_NEAR(a.gamma_ratio, b.gamma_ratio, 1e-4) << h << " Å " << p << " GPa";
            EXPECT_NEAR(a.area, b.area, 1e-4) << h << " Å " << p << " GPa";
        }
}

TEST(Persson, EquationThreeHoldsAtEveryMagnification) {
    const auto expect_it = [](const AdhesiveContact& c, const std::string& what) {
        SCOPED_TRACE(what);
        const ContactState s = solve(c);
        const auto& end = s.profile.back();
        EXPECT_NEAR(end.gamma_eff, c.work_of_adhesion, 1e-7);
        EXPECT_EQ(end.elastic_energy, 0);
        EXPECT_NEAR(end.area, s.area, 1e-3);
        for (const ProfilePoint& at : s.profile) {
            EXPECT_NEAR(at.gamma_eff * at.real_area,
                        c.work_of_adhesion * end.real_area - at.elastic_energy, 1e-7);
            EXPECT_NEAR(at.detachment_stress,
                        std::sqrt(std::max(0.0, at.gamma_eff) * c.contact_modulus * at.q), 1e-12);
        }
        for (std::size_t i = 1; i < s.profile.size(); ++i)
            EXPECT_LE(s.profile[i].area, s.profile[i - 1].area);
    };
    for (double p : {-0.3, 0.0, 1.0}) {
        AdhesiveContact c = paper::contact(5);
        c.pressure = p * gpa;
        expect_it(c, "5 Å");
    }
    expect_it(paper::contact(0.3), "full contact");
    // A gap of the spectrum, where stresses spread no further.
    AdhesiveContact c = paper::contact(3);
    const double q[] = {paper::q_L, 8 * paper::q_L, 64 * paper::q_L, 512 * paper::q_L};
    const double C[] = {c.spectrum(2 * paper::q_L), 0, c.spectrum(100 * paper::q_L)};
    c.spectrum = Spectrum::rings(q, C);
    expect_it(c, "gap");
}

// The third opinion: random walks. The boundary of the solved state is given to walkers that know
// nothing of Volterra equations; between nodes their chance of having crossed is the Brownian
// bridge's.
TEST(Persson, RandomWalkersSurviveAsOftenUnderAsMuchStress) {
    const ContactState s = solve(paper::contact(5), {.tolerance = 1e-5});
    const auto& at = s.profile;
    std::mt19937_64 generator(20260101);
    std::normal_distribution<double> normal;
    constexpr double walkers = 20000;
    struct Mean {
        double sum = 0, squares = 0;
        void add(double value) { sum += value, squares += value * value; }
        void expect(double value, double most) const {
            const double mean = sum / walkers;
            const double error = std::sqrt((squares / walkers - mean * mean) / walkers);
            EXPECT_LT(error, most);
            EXPECT_NEAR(mean, value, 4 * error);
        }
    };
    std::vector<Mean> area(at.size());
    Mean load; // of what is still in contact at the end
    for (int k = 0; k < walkers; ++k) {
        double stress = 0, alive = 1;
        for (std::size_t i = 1; i < at.size() && alive > 0; ++i) {
            const double dT = at[i].stress_variance - at[i - 1].stress_variance;
            if (dT > 0) {
                const double above = stress + at[i - 1].detachment_stress;
                stress += std::sqrt(dT) * normal(generator);
                const double now = stress + at[i].detachment_stress;
                alive *= now > 0 ? -std::expm1(-2 * above * now / dT) : 0;
            }
            area[i].add(alive);
        }
        load.add(alive * stress);
    }
    for (std::size_t i = 8; i < at.size(); i += (at.size() - 9) / 4)
        area[i].expect(at[i].area, 0.004);
    area.back().expect(s.area, 0.004);
    load.expect(s.contact_stress, 0.08 * gpa);
}

TEST(Persson, OrderOfConvergence) {
    for (const auto& [integration, order] :
         {std::pair{Integration::first_passage, 1.5}, std::pair{by_diffusion, 2.0}}) {
        const AdhesiveContact c = paper::contact(5);
        const Shooting shooting(c, {.integration = integration});
        const Shooting::Outcome at = shooting.search(0);
        ASSERT_TRUE(at.found);
        std::array<double, 4> gamma{};
        for (int refinement = 0; refinement < 4; ++refinement)
            gamma[static_cast<std::size_t>(refinement)] =
                shooting.g0(shooting.follow(at, refinement).x) / c.work_of_adhesion;
        const double measured = std::log2((gamma[1] - gamma[2]) / (gamma[2] - gamma[3]));
        EXPECT_NEAR(measured, order, 0.15);
    }
}

TEST(Persson, ErrorEstimateIsHonest) {
    // Against the same state solved far finer, the error claimed covers the error made.
    for (double h : {3.0, 5.0, 6.5}) {
        const ContactState quick = solve(paper::contact(h), {.tolerance = 1e-2});
        const ContactState slow = solve(paper::contact(h), {.tolerance = 1e-6});
        EXPECT_GT(slow.nodes, quick.nodes);
        EXPECT_LT(std::abs(quick.gamma_ratio - slow.gamma_ratio), quick.gamma_ratio_error + 1e-6);
        EXPECT_LT(std::abs(quick.area - slow.area), quick.area_error + 1e-6);
    }
}

TEST(Persson, RoughnessOnlyWeakens) {
    std::vector<ContactState> curve;
    for (int i = 1; i <= 100; ++i)
        curve.push_back(solve(paper::contact(0.1 * i)));
    for (std::size_t i = 1; i < curve.size(); ++i) {
        EXPECT_LE(curve[i].gamma_ratio, curve[i - 1].gamma_ratio) << i;
        EXPECT_LE(curve[i].area, curve[i - 1].area + 1e-9) << i;
    }
    EXPECT_EQ(curve.back().area, 0);
}

} // namespace
} // namespace asperity::theory
