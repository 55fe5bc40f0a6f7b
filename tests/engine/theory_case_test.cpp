// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The theory of a scene: the scene's keys reach the solver, its numbers reach the result. The
// expected numbers are those of theory.md (tests/theory tests the solver itself).
#include "engine/run/theory_case.hpp"

#include "engine/setup/case.hpp"
#include "io/error.hpp"
#include "io/json.hpp"
#include "theory/error.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace asperity {
namespace {

Scene paper(double rms) {
    Scene s;
    s.surface.rms = rms;
    s.theory.delta_gamma = 100.0;
    s.theory.clip = false;
    return s;
}

Scene small(double rms) {
    Scene s;
    s.surface.sites = 64;
    s.block.thickness = 64;
    s.surface.rms = rms;
    return s;
}

TEST(TheoryOfAScene, GivesTheNumbersOfThePaper) {
    struct Row {
        double rms, gamma, area, full;
    };
    for (const Row& row : {Row{3, 0.67469, 0.98985, 0.68120}, Row{5, 0.15159, 0.66628, 0.11353},
                           Row{6.5, 0.00604, 0.24305, -0.49960}}) {
        const TheoryCase what = theory_case(resolve(paper(row.rms)));
        const TheoryNumbers n = solve_theory(what);
        EXPECT_NEAR(n.gamma_eff, 100.0 * row.gamma, 2e-3) << row.rms;
        EXPECT_NEAR(n.state.area, row.area, 2e-5) << row.rms;
        EXPECT_NEAR(n.gamma_full_contact, 100.0 * row.full, 2e-3) << row.rms;
        EXPECT_NEAR(what.flat, 98.86, 5e-3); // docs/explanation/model.md
    }
}

TEST(TheoryOfAScene, TakesFactorAndBetaFromTheScene) {
    Scene s = paper(3);
    s.theory.area_factor = AreaFactor::none;
    EXPECT_NEAR(solve_theory(theory_case(resolve(s))).gamma_eff, 65.999582, 2e-3);
    s.theory.beta = 1.0; // more elastic energy at partial contact
    EXPECT_LT(solve_theory(theory_case(resolve(s))).gamma_eff, 65.999);
}

TEST(TheoryOfAScene, ClipsAtNyquistAndSaysSo) {
    Scene s = paper(3);
    s.theory.clip = true;
    const TheoryCase what = theory_case(resolve(s));
    EXPECT_NEAR(what.contact.spectrum.q1(), std::numbers::pi / 2.6, 1e-12);
    EXPECT_NEAR(what.contact.spectrum.rms_height(), 3.0, 1e-12);
    ASSERT_EQ(what.notes.size(), 1u);
    EXPECT_NE(what.notes[0].find("Nyquist"), std::string::npos);
}

TEST(TheoryOfAScene, ReadsTheLoadAsPressure) {
    Scene s = paper(3);
    s.drive.load = -1960.0; // theory.md: the branch ends at -1.974 GPa with A = 0.741
    EXPECT_EQ(solve_theory(theory_case(resolve(s))).state.status, theory::Status::adhesive);
    s.drive.load = -1990.0;
    const TheoryNumbers off = solve_theory(theory_case(resolve(s)));
    EXPECT_EQ(off.state.status, theory::Status::no_contact);
    EXPECT_EQ(off.gamma_eff, 0.0);
    EXPECT_EQ(off.state.area, 0.0);
    // Beyond the tension that the renormalised interface bears, 1.6 GPa: the reason, no number.
    ASSERT_TRUE(off.renormalised.has_value());
    EXPECT_FALSE(off.renormalised->numbers.has_value());
    EXPECT_NE(off.renormalised->note.find("largest tension"), std::string::npos);
}

TEST(TheoryOfAScene, OfAFlatSurfaceIsTheFlatReference) {
    Scene s = small(3);
    s.surface.kind = SurfaceKind::flat;
    const TheoryCase what = theory_case(resolve(s));
    const TheoryNumbers n = solve_theory(what);
    EXPECT_NEAR(n.gamma_eff, what.flat, 1e-9);
    EXPECT_EQ(n.state.area, 1.0);
    EXPECT_NEAR(n.gamma_full_contact, what.flat, 1e-9);
    ASSERT_TRUE(n.renormalised && n.renormalised->numbers);
    EXPECT_NEAR(n.renormalised->numbers->gamma_eff, what.flat, 1e-6 * what.flat);
    EXPECT_EQ(n.renormalised->numbers->contact_fraction, 1.0);
}

TEST(TheoryOfAScene, RenormalisedHasTheLatticesStiffness) {
    const Scene s = paper(3);
    const theory::StiffnessTable table = lattice_stiffness(resolve(s));
    const double modulus = 77.2 / 160.21766 / (1 - 0.42 * 0.42);
    // Long waves: the half-space, with its coupling (1-2ν)/(2(1-ν)); short ones: model.md.
    const theory::WaveStiffness isotropic = theory::StiffnessTable::half_space(modulus, 0.42)(0.02);
    EXPECT_NEAR(table(0.02).free_zz, isotropic.free_zz, 1e-3 * isotropic.free_zz);
    EXPECT_NEAR(table(0.02).zz, isotropic.zz, 1e-3 * isotropic.zz);
    EXPECT_NEAR(table(0.02).xx, isotropic.xx, 1e-3 * isotropic.xx);
    EXPECT_NEAR(table(0.02).xz, isotropic.xz, 1e-2 * isotropic.xz);
    const double q = 2.0 * std::numbers::pi / (8.0 * 2.6);
    EXPECT_NEAR(table(q).free_zz / (modulus * q / 2.0), 0.982, 3e-3);
    const TheoryNumbers n = solve_theory(theory_case(resolve(s)));
    ASSERT_TRUE(n.renormalised && n.renormalised->numbers);
    EXPECT_GT(n.renormalised->numbers->gamma_eff_ratio, 0.66);
    EXPECT_LT(n.renormalised->numbers->gamma_eff_ratio, 0.68);
    EXPECT_NEAR(n.renormalised->numbers->gamma_eff,
                n.renormalised->numbers->gamma_eff_ratio * 98.8633, 1e-3);
}

TEST(TheoryOfAScene, RenormalisedIsLeftOutWhereTheSceneSaysSo) {
    Scene s = small(1);
    s.theory.renormalised = false;
    io::Result result;
    add_theory(resolve(s), surface_of(resolve(s)), result);
    EXPECT_EQ(io::find(result.json(), "theory.renormalised"), nullptr);
    s.theory.renormalised = true;
    s.drive.path = {"zero-load"};
    s.interface.frictionless = true;
    const TheoryCase without = theory_case(resolve(s));
    s.interface.frictionless = false;
    EXPECT_LT(solve_theory(without).renormalised->numbers->gamma_eff,
              solve_theory(theory_case(resolve(s))).renormalised->numbers->gamma_eff);
    add_theory(resolve(s), surface_of(resolve(s)), result);
    const io::Json json = result.json();
    for (const char* key : {"gamma_eff", "gamma_eff_ratio", "contact_fraction", "separation",
                            "tension", "gamma_eff_error", "contact_fraction_error",
                            "gamma_eff_expected_error", "contact_fraction_expected_error"})
        EXPECT_NE(io::find(json, std::string("theory.renormalised.") + key), nullptr) << key;
}

/// No number without a bound: none where the errors are large, a note where they are above 1e-4 or
/// the slope above what was compared with simulations, and none where all is well.
TEST(TheoryOfAScene, RenormalisedSaysHowWellItIsKnown) {
    const auto renormalised = [](double epsilon, double rms) {
        Scene s = small(rms);
        std::get<LennardJones>(s.interface.potentials).epsilon = epsilon;
        io::Result result;
        record_theory(theory_case(resolve(s)), solve_theory(theory_case(resolve(s))), result);
        const io::Json json = result.json();
        const io::Json* note = io::find(json, "theory.renormalised.note");
        EXPECT_EQ(io::find(json, "theory.renormalised.gamma_eff") != nullptr,
                  io::find(json, "theory.renormalised.gamma_eff_error") != nullptr);
        return std::pair(io::find(json, "theory.renormalised.gamma_eff") != nullptr,
                         note ? note->get<std::string>() : std::string());
    };
    const auto [well, silence] = renormalised(0.1, 1);
    EXPECT_TRUE(well);
    EXPECT_EQ(silence, "");
    const auto [steep, slope] = renormalised(0.1, 4);
    EXPECT_TRUE(steep);
    EXPECT_NE(slope.find("second order in the slope"), std::string::npos) << slope;
    const auto [answered, reason] = renormalised(10, 8);
    EXPECT_FALSE(answered);
    EXPECT_NE(reason.find("; choose less roughness"), std::string::npos) << reason;
    EXPECT_EQ(reason.find("known to"), std::string::npos) << reason;
}

/// States at zero load of docs/data/drawn.csv, none of them in the calibration: within the expected
/// errors, and not within half of them.
TEST(TheoryOfAScene, ExpectedErrorCoversSimulatedStates) {
    struct Row {
        int sites;
        double hurst, rolloff, young, poisson, epsilon, r0, rms;
        unsigned seed;
        bool wall;
        double gamma, contact; // simulated
    };
    int beyond_half = 0, beyond_half_contact = 0;
    for (const Row& row :
         {Row{128, 0.40, 2.1, 44, 0.18, 0.198, 2.32, 1.93, 118610, false, 0.6496, 0.9941},
          Row{128, 0.65, 2.8, 131, 0, 0.226, 4.5, 0.94, 959416, false, 0.9381, 1.0000},
          Row{96, 0.55, 4.2, 127, -0.09, 0.234, 2.8, 0.92, 608408, false, 0.7561, 0.9894},
          Row{128, 0.91, 5.3, 137, 0.38, 0.173, 3.56, 2.93, 810533, true, 0.2245, 0.3400}}) {
        Scene s;
        s.surface.sites = s.block.thickness = row.sites;
        s.surface.hurst = row.hurst;
        s.surface.rolloff = row.rolloff;
        s.surface.rms = row.rms;
        s.surface.seed = row.seed;
        s.block.young = row.young;
        s.block.poisson = row.poisson;
        std::get<LennardJones>(s.interface.potentials).epsilon = row.epsilon;
        std::get<LennardJones>(s.interface.potentials).r0 = row.r0;
        s.interface.cutoff = 4 * row.r0;
        if (row.wall) {
            s.interface.kind = InterfaceKind::wall;
            s.interface.frictionless = true;
            s.drive.path = {"zero-load"};
            s.interface.law = WallLawKind::smeared;
        }
        s.theory.spectrum = TheorySpectrum::realised;
        const TheoryCase what = theory_case(resolve(s));
        const RenormalisedResult result = solve_renormalised(*what.renormalised);
        ASSERT_TRUE(result.numbers && result.numbers->gamma_eff_expected_error) << result.note;
        const RenormalisedNumbers& n = *result.numbers;
        const double off = std::abs(n.gamma_eff_ratio - row.gamma),
                     expected = *n.gamma_eff_expected_error / what.flat;
        EXPECT_LE(off, expected) << row.seed;
        const double off_contact = std::abs(n.contact_fraction - row.contact);
        EXPECT_LE(off_contact, *n.contact_fraction_expected_error) << row.seed;
        beyond_half += off > 0.5 * expected;
        beyond_half_contact += off_contact > 0.5 * *n.contact_fraction_expected_error;
        // For the surfaces of the ensemble it is larger.
        s.theory.spectrum = TheorySpectrum::target;
        if (row.wall) {
            const auto ensemble = solve_renormalised(*theory_case(resolve(s)).renormalised);
            EXPECT_GT(*ensemble.numbers->gamma_eff_expected_error, 2 * *n.gamma_eff_expected_error);
        }
    }
    EXPECT_GE(beyond_half, 2);
    EXPECT_GE(beyond_half_contact, 1);
}

TEST(TheoryOfAScene, RealisedSpectrumHasTheRmsAndTheFullContactEnergyOfTheMap) {
    for (const Amplitudes amplitudes : {Amplitudes::gaussian, Amplitudes::fixed}) {
        Scene s = small(0.8);
        s.surface.amplitudes = amplitudes;
        s.theory.spectrum = TheorySpectrum::realised;
        s.theory.area_factor = AreaFactor::none;
        const Surface surface = surface_of(resolve(s));
        const TheoryCase what = theory_case(resolve(s), &surface);
        EXPECT_NEAR(what.contact.spectrum.rms_height(), 0.8, 1e-9);
        EXPECT_NEAR(what.contact.spectrum.rms_slope(), surface.statistics.rms_slope,
                    0.02 * surface.statistics.rms_slope);
        // U_el of full contact, wave by wave: (E*/4) sum of q |h_q|^2.
        double energy = 0.0;
        for (const SpectrumBin& bin : surface.statistics.spectrum) {
            const double q_unit = 2.0 * std::numbers::pi / surface.length;
            energy += 0.25 * what.contact.contact_modulus * bin.q * bin.realised * bin.modes *
                      q_unit * q_unit;
        }
        const TheoryNumbers n = solve_theory(what);
        EXPECT_NEAR(what.delta_gamma - n.gamma_full_contact, 1e3 * energy, 0.03 * 1e3 * energy);
        // Made anew it is the same surface, and of another roughness the same shape.
        EXPECT_EQ(solve_theory(theory_case(resolve(s))).gamma_eff, n.gamma_eff);
        s.surface.rms = 0.4;
        EXPECT_NEAR(theory_case(resolve(s), &surface).contact.spectrum.rms_slope(),
                    theory_case(resolve(s)).contact.spectrum.rms_slope(), 1e-9);
    }
}

TEST(TheoryOfAScene, OfASphereIsJkrWithTheEffectiveEnergy) {
    Scene s = paper(0);
    s.surface.radius = 4410.0;
    const TheoryNumbers n = solve_theory(theory_case(resolve(s)));
    EXPECT_NEAR(n.jkr_pull_off_force.value(), 2078.16, 0.01); // theory.md
    s.surface.rms = 3;
    EXPECT_NEAR(solve_theory(theory_case(resolve(s))).jkr_pull_off_force.value(), 0.67469 * 2078.16,
                0.1);
    s.surface.rms = 9;
    EXPECT_EQ(solve_theory(theory_case(resolve(s))).jkr_pull_off_force.value(), 0.0);
    s.surface.rms = 1.0;
    const TheoryCase what = theory_case(resolve(s));
    io::Result result;
    record_theory(what, solve_theory(what), result);
    EXPECT_EQ(result.number("theory.jkr_pull_off_force"), solve_theory(what).jkr_pull_off_force);
}

TEST(TheoryOfAScene, NeverMakesARunFail) {
    Scene s = small(1);
    const Surface surface = surface_of(resolve(s));
    io::Result good;
    add_theory(resolve(s), surface, good);
    EXPECT_TRUE(good.number("theory.gamma_eff").has_value());
    s.surface.cutoff = 1.0; // a band of no width
    s.surface.rolloff = 1.0;
    io::Result bad;
    add_theory(resolve(s), surface, bad);
    EXPECT_FALSE(bad.number("theory.gamma_eff").has_value());
    const io::Json json = bad.json();
    ASSERT_NE(io::find(json, "theory.note"), nullptr);
    EXPECT_NE(io::find(json, "theory.note")->get<std::string>().find("surface.cutoff"),
              std::string::npos);
}

} // namespace
} // namespace asperity
