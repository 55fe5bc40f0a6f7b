// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Hard cases: each must end in a right answer or in an error that says what is wrong. Right means
// that the diffusion integration, which shares nothing with the production one but the grid, says
// the same.
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/diffusion.hpp"
#include "support/message.hpp"
#include "support/paper_contact.hpp"
#include "theory/error.hpp"

namespace asperity::theory {
namespace {

using paper::gpa;
using paper::q_L;

/// Solves at fractions of the critical roughness, both ways.
void expect_solved(AdhesiveContact c, const std::string& what,
                   std::vector<double> fractions = {0.7, 0.95}) {
    SCOPED_TRACE(what);
    const double h_c = critical_roughness(c).h_rms;
    ASSERT_TRUE(std::isfinite(h_c));
    for (double fraction : fractions) {
        c.spectrum = c.spectrum.with_rms_height(fraction * h_c);
        const ContactState a = solve(c);
        const ContactState b = solve(c, {.integration = by_diffusion, .max_refinement = 2});
        EXPECT_EQ(a.status, Status::adhesive) << fraction;
        EXPECT_TRUE(a.converged) << fraction;
        EXPECT_NEAR(a.gamma_ratio, b.gamma_ratio, 1e-4 * std::max(1.0, b.gamma_ratio)) << fraction;
        EXPECT_NEAR(a.area, b.area, 3e-4) << fraction;
        EXPECT_GT(a.area, 0) << fraction;
        EXPECT_LE(a.area, 1) << fraction;
    }
    c.spectrum = c.spectrum.with_rms_height(1.002 * h_c);
    const ContactState beyond = solve(c);
    EXPECT_EQ(beyond.status, Status::no_contact);
    EXPECT_EQ(beyond.area, 0);
    EXPECT_EQ(beyond.gamma_ratio, 0);
}

AdhesiveContact with_spectrum(Spectrum spectrum) {
    AdhesiveContact c = paper::contact(5);
    c.spectrum = std::move(spectrum);
    return c;
}

TEST(Hard, HurstExponent) {
    for (double H : {0.0, 0.5, 1.0})
        expect_solved(with_spectrum(Spectrum::self_affine({q_L, 3 * q_L, 512 * q_L, H, 5})),
                      "H = " + std::to_string(H));
    for (double H : {-1.01, 2.01, std::nan("")})
        EXPECT_THROW(Spectrum::self_affine({q_L, 3 * q_L, 512 * q_L, H, 5}), InvalidInput) << H;
}

TEST(Hard, WidthOfTheSpectrum) {
    for (double width : {1.0, 1.001, 10.0, 1e6})
        expect_solved(with_spectrum(Spectrum::self_affine({q_L, 3 * q_L, 3 * q_L * width, 0.8, 5})),
                      "q1/q0 = " + std::to_string(width));
    // The boundary runs far away from the paths here, and then nothing must happen.
    expect_solved(with_spectrum(Spectrum::self_affine({q_L, 3 * q_L, 3e6 * q_L, 1, 5})),
                  "H = 1, 10^6");
}

TEST(Hard, TwoPoints) {
    const std::vector<double> q{q_L, 30 * q_L}, C{1, 1e-4};
    const Spectrum table = Spectrum::tabulated(q, C);
    expect_solved(with_spectrum(table), "two points");
    // It is a power law of exponent -4/log10(30).
    EXPECT_NEAR(table(std::sqrt(30.0) * q_L), 1e-2, 1e-12);
    expect_solved(
        with_spectrum(Spectrum::tabulated(std::vector{q_L, 1.001 * q_L}, std::vector{1.0, 1.0})),
        "a narrow band", {0.7});
}

TEST(Hard, Gaps) {
    const std::vector<double> q{q_L, 3 * q_L, 3 * q_L, 100 * q_L, 100 * q_L, 512 * q_L};
    const Spectrum gap = Spectrum::tabulated(q, std::vector{1.0, 1.0, 0.0, 0.0, 1e-5, 3e-8});
    EXPECT_EQ(gap(50 * q_L), 0);
    expect_solved(with_spectrum(gap), "gap");
    // Nearly a gap is nearly the same.
    const Spectrum nearly = Spectrum::tabulated(q, std::vector{1.0, 1.0, 1e-12, 1e-12, 1e-5, 3e-8});
    const ContactState a = solve(with_spectrum(gap.with_rms_height(6)));
    const ContactState b = solve(with_spectrum(nearly.with_rms_height(6)));
    EXPECT_GT(a.area, 0.2);
    EXPECT_NEAR(a.gamma_ratio, b.gamma_ratio, 1e-6);
    EXPECT_NEAR(a.area, b.area, 1e-6);
    // A table that starts in a gap.
    expect_solved(
        with_spectrum(Spectrum::tabulated(std::vector{q_L, 100 * q_L, 100 * q_L, 512 * q_L},
                                          std::vector{0.0, 0.0, 1e-5, 3e-8})),
        "leading gap", {0.8});
}

TEST(Hard, RealisedSpectrum) {
    // Ring averages with the scatter of a real surface, one ring empty.
    std::vector<double> edges, C;
    for (int k = 1; k <= 257; ++k) {
        edges.push_back((k - 0.5) * q_L);
        if (k == 257) break;
        const double smooth = k < 3 ? 1 : std::pow(k / 3.0, -3.6);
        C.push_back(k == 40 ? 0 : smooth * (1 + 0.5 * std::sin(7.0 * k)));
    }
    expect_solved(with_spectrum(Spectrum::rings(edges, C)), "rings");
}

TEST(Hard, TableOfThePowerLaw) {
    std::vector<double> q, C;
    const Spectrum law = Spectrum::self_affine({q_L, 3 * q_L, 512 * q_L, 0.8, 5});
    for (double zeta : {1.0, 3.0, 10.0, 60.0, 200.0, 512.0}) {
        q.push_back(zeta * q_L);
        C.push_back(law(zeta * q_L));
    }
    const Spectrum table = Spectrum::tabulated(q, C);
    EXPECT_NEAR(table.rms_height(), 5, 1e-9);
    EXPECT_NEAR(table.rms_slope(), law.rms_slope(), 1e-12);
    EXPECT_NEAR(solve(with_spectrum(table)).gamma_ratio, solve(with_spectrum(law)).gamma_ratio,
                2e-6);
}

TEST(Hard, Beta) {
    for (double beta : {0.05, 1.0}) {
        AdhesiveContact c = paper::contact(5);
        c.beta = beta;
        expect_solved(c, "beta = " + std::to_string(beta));
    }
    // β = 0: a sparse contact costs a³, less than it gains, so adhesion fades but does not end.
    AdhesiveContact c = paper::contact(20);
    c.beta = 0;
    const ContactState s = solve(c);
    EXPECT_EQ(s.status, Status::adhesive);
    EXPECT_NEAR(s.gamma_ratio, solve(c, {.integration = by_diffusion}).gamma_ratio, 1e-5);
    EXPECT_THROW((void)critical_roughness(c), NoSolution);
}

TEST(Hard, StiffAndSoft) {
    for (double E : {1e-3, 1.0, 1000.0}) {
        AdhesiveContact c = paper::contact(5);
        c.contact_modulus = E * gpa;
        expect_solved(c, "E* = " + std::to_string(E) + " GPa");
    }
}

TEST(Hard, WeakAdhesion) {
    AdhesiveContact c = paper::contact(5);
    const double h_c = critical_roughness(paper::contact(5, AreaFactor::none)).h_rms;
    c.area_factor = AreaFactor::none;
    for (double ratio : {1e-2, 1e-6, 1e-12}) { // h_c ∝ √Δγ
        c.work_of_adhesion = paper::work_of_adhesion * ratio;
        EXPECT_NEAR(critical_roughness(c).h_rms / std::sqrt(ratio), h_c, 1e-6 * h_c);
    }
    c.work_of_adhesion = 0;
    EXPECT_EQ(solve(c).status, Status::no_contact);
    EXPECT_THROW((void)critical_roughness(c), NoSolution);
}

TEST(Hard, SmoothSurface) {
    const ContactState zero = solve(paper::contact(0));
    EXPECT_EQ(zero.gamma_ratio, 1);
    EXPECT_EQ(zero.area, 1);
    for (double h : {1e-12, 1e-3, 0.1}) {
        const ContactState s = solve(paper::contact(h));
        EXPECT_EQ(s.area, 1);
        EXPECT_NEAR(s.gamma_ratio, full_contact(paper::contact(h)).gamma_ratio, 1e-15);
    }
    AdhesiveContact pulled = paper::contact(0);
    const double limit = -std::sqrt(0.1 * paper::contact_modulus * q_L);
    pulled.pressure = 0.99 * limit;
    EXPECT_EQ(solve(pulled).status, Status::adhesive);
    pulled.pressure = 1.01 * limit;
    EXPECT_EQ(solve(pulled).status, Status::no_contact);
}

TEST(Hard, RoughSurface) {
    for (double h : {7.5, 20.0, 100.0, 1e6}) {
        const ContactState s = solve(paper::contact(h));
        EXPECT_EQ(s.status, Status::no_contact) << h;
        EXPECT_EQ(s.gamma_eff, 0) << h;
        EXPECT_EQ(s.area, 0) << h;
        EXPECT_EQ(s.elastic_energy, 0) << h;
        EXPECT_TRUE(s.profile.empty()) << h;
    }
}

TEST(Hard, LargeLoads) {
    for (double h : {2.0, 20.0, 100.0}) {
        AdhesiveContact c = paper::contact(h);
        c.pressure = 5000 * gpa;
        const ContactState pressed = solve(c);
        EXPECT_NEAR(pressed.area, 1, 1e-12) << h;
        EXPECT_NEAR(pressed.gamma_ratio, full_contact(c).gamma_ratio, 1e-9) << h;
        EXPECT_EQ(pressed.status, h < 5 ? Status::adhesive : Status::pressed);
        for (double p : {-5.0, -5000.0}) {
            c.pressure = p * gpa;
            EXPECT_EQ(solve(c).status, Status::no_contact) << h << ' ' << p;
        }
    }
    // Rough and pressed: hardly any adhesion, so close to erf, from above.
    AdhesiveContact c = paper::contact(100);
    c.pressure = 50 * gpa;
    const ContactState s = solve(c);
    const double bare = nonadhesive_area(c.pressure, stress_variance(c, c.spectrum.q1()));
    EXPECT_EQ(s.status, Status::pressed);
    EXPECT_GT(s.area, bare);
    EXPECT_LT(s.area, 1.1 * bare);
}

TEST(Hard, SmallLoadIsContinuous) {
    AdhesiveContact c = paper::contact(6);
    const ContactState zero = solve(c);
    for (double p : {-1e-7, 1e-7}) {
        c.pressure = p * gpa;
        const ContactState s = solve(c);
        EXPECT_NEAR(s.gamma_ratio, zero.gamma_ratio, 1e-5) << p;
        EXPECT_NEAR(s.area, zero.area, 5e-5) << p;
    }
}

TEST(Hard, ErrorsSayWhatIsWrong) {
    using Numbers = std::vector<double>;
    const auto broken = [](auto change, SolverOptions options = {}) {
        return [=] {
            AdhesiveContact c = paper::contact(5);
            change(c);
            (void)solve(c, options);
        };
    };
    const auto table = [](const Numbers& q, const Numbers& C) {
        return [=] { (void)Spectrum::tabulated(q, C); };
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
        {table({1.0, 0.5}, {1.0, 1.0}), {"row 1", "sort"}},
        {table({1.0, 2.0}, {1.0, -1.0}), {"row 1", "negative"}},
        {table({1.0}, {1.0}), {"at least two points"}},
        {[] { (void)solve({}); }, {"modulus"}},
        {broken([](auto& c) { c.beta = 1.5; }), {"beta", "1.5", "0.45"}},
        {broken([](auto& c) { c.contact_modulus = -2; }), {"-2", "modulus"}},
        {broken([](auto& c) { c.work_of_adhesion = std::nan(""); }), {"work of adhesion"}},
        {broken([](auto& c) { c.pressure = HUGE_VAL; }), {"pressure"}},
        {broken([](auto& c) { c.spectrum = {}; }), {"spectrum"}},
        {broken([](auto&) {}, {.spacing = 3}), {"spacing", "3"}},
    };
    for (const auto& [call, words] : cases) {
        const std::string text = test::message_of<InvalidInput>(call);
        for (const std::string& word : words)
            EXPECT_TRUE(test::has(text, word)) << word << " not in: " << text;
    }
}

TEST(Hard, AreaFactorBothBranches) {
    // The series meets the closed form, and both meet the definition.
    const double below = area_factor(AreaFactor::gaussian, 0.0025 * (1 - 1e-9));
    const double above = area_factor(AreaFactor::gaussian, 0.0025 * (1 + 1e-9));
    EXPECT_NEAR(below, above, 1e-11);
    for (double s : {1e-6, 1e-3, 0.3, 5.0, 1e4}) {
        double sum = 0;
        const double dt = 1e-4;
        for (double t = dt / 2; t < 40; t += dt)
            sum += std::sqrt(1 + s * t) * std::exp(-t) * dt;
        EXPECT_NEAR(area_factor(AreaFactor::gaussian, s) / sum, 1, 1e-6) << s;
    }
}

} // namespace
} // namespace asperity::theory
