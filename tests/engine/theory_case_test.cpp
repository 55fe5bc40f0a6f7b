// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The theory of a scene: the scene's keys reach the solver, its numbers reach the result. The
// expected numbers are those of theory.md (tests/theory tests the solver itself).
#include "engine/theory/rough_interface.hpp"
#include "engine/theory/theory_case.hpp"

#include "engine/case/case.hpp"
#include "io/error.hpp"
#include "io/json.hpp"

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
    s.surface.q_max = 512.0;
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
        EXPECT_NEAR(n.gamma_eff, 100.0 * row.gamma, 2e-2) << row.rms;
        EXPECT_NEAR(n.state.area, row.area, 3e-4) << row.rms;
        EXPECT_NEAR(n.gamma_full_contact, 100.0 * row.full, 2e-3) << row.rms;
        EXPECT_NEAR(what.flat, 98.86, 5e-3); // docs/explanation/model.md
    }
}

TEST(TheoryOfAScene, TakesFactorAndBetaFromTheScene) {
    Scene s = paper(3);
    s.theory.area_factor = AreaFactor::none;
    EXPECT_NEAR(solve_theory(theory_case(resolve(s))).gamma_eff, 65.999582, 2e-2);
    s.theory.beta = 1.0; // more elastic energy at partial contact
    EXPECT_LT(solve_theory(theory_case(resolve(s))).gamma_eff, 65.999);
}

/// Over atoms by default the area that follows the slopes adheres, under each wall the projected
/// area: full contact binds with Δγ S and Δγ, less the elastic energy. A named factor stays.
TEST(TheoryOfAScene, AWallActsOnTheProjectedArea) {
    const auto area_of = [](const Scene& s) {
        const TheoryCase what = theory_case(resolve(s));
        const theory::FullContactState full = theory::full_contact(what.contact);
        return (full.gamma + full.elastic_energy) / what.contact.work_of_adhesion;
    };
    Scene atoms = small(3);
    Scene named = atoms;
    named.theory.area_factor = AreaFactor::gaussian;
    EXPECT_GT(area_of(atoms), 1.01);
    EXPECT_EQ(area_of(atoms), area_of(named));
    for (const WallLawKind law :
         {WallLawKind::smeared, WallLawKind::exponential, WallLawKind::dugdale, WallLawKind::power,
          WallLawKind::nine_three, WallLawKind::eight_two}) {
        Scene wall = small(3);
        wall.interface.kind = InterfaceKind::wall;
        wall.interface.law = law;
        wall.interface.frictionless = true;
        wall.drive.path = {"relax"};
        EXPECT_NEAR(area_of(wall), 1.0, 1e-12);
        wall.theory.area_factor = AreaFactor::gaussian;
        EXPECT_NEAR(area_of(wall), area_of(named), 1e-12);
    }
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
}

TEST(TheoryOfAScene, OfAFlatSurfaceIsTheFlatReference) {
    Scene s = small(3);
    s.surface.kind = SurfaceKind::flat;
    const TheoryCase what = theory_case(resolve(s));
    const TheoryNumbers n = solve_theory(what);
    EXPECT_NEAR(n.gamma_eff, what.flat, 1e-9);
    EXPECT_EQ(n.state.area, 1.0);
    EXPECT_NEAR(n.gamma_full_contact, what.flat, 1e-9);
}

TEST(TheoryOfAScene, TheRenormalisedTheoryIsGivenTheLatticesStiffness) {
    const Case c = resolve(paper(3));
    const io::Json table =
        renormalised_inputs(c, theory_case(c).contact.spectrum, false).at("stiffness");
    const double modulus = 77.2 / 160.21766 / (1 - 0.42 * 0.42);
    const double ratio = (1 - 2 * 0.42) / (2 * (1 - 0.42));
    const auto at = [&](double q, std::size_t column) {
        std::size_t i = 1;
        while (table[i][0].get<double>() < q)
            ++i;
        const auto over = [&](std::size_t k) {
            return table[k][column].get<double>() / table[k][0].get<double>();
        };
        const double q0 = table[i - 1][0].get<double>(), q1 = table[i][0].get<double>();
        return q * (over(i - 1) + (q - q0) / (q1 - q0) * (over(i) - over(i - 1)));
    };
    // Long waves: the half-space, with its coupling (1-2ν)/(2(1-ν)); short ones: model.md.
    const double free = modulus * 0.02 / 2, stuck = free / (1 - ratio * ratio);
    for (const auto& [column, value] : {std::pair{1, stuck}, std::pair{2, stuck},
                                        std::pair{3, ratio * stuck}, std::pair{4, free}})
        EXPECT_NEAR(at(0.02, static_cast<std::size_t>(column)), value, 1e-2 * value) << column;
    const double q = 2.0 * std::numbers::pi / (8.0 * 2.6);
    EXPECT_NEAR(at(q, 4) / (modulus * q / 2.0), 0.982, 3e-3);
}

TEST(TheoryOfAScene, TheRenormalisedTheoryIsGivenTheSpectrumAndThePairs) {
    Scene s = small(1);
    s.drive.load = 100;
    const Case c = resolve(s);
    const io::Json rough = renormalised_inputs(c, theory_case(c).contact.spectrum, false);
    double variance = 0.0; // 2π ∫ q C dq
    for (const io::Json& piece : rough.at("spectrum")) {
        const double qa = piece[0], qb = piece[1], C = piece[2], n = piece[3];
        variance +=
            2.0 * std::numbers::pi * C * qa * qa * (std::pow(qb / qa, n + 2.0) - 1.0) / (n + 2.0);
    }
    EXPECT_NEAR(variance, 1.0, 1e-9);
    EXPECT_NEAR(rough.at("pressure").get<double>(), 0.1 / 160.21766, 1e-8);
    const io::Json& flat = rough.at("flat");
    EXPECT_GT(flat.at("rings").size(), 5u);
    EXPECT_NEAR(flat.at("at").back().get<double>(), 13.12, 1e-9);
    // first = V'/r: the slope of the energies between two of the points.
    const auto value = [&](const char* name, std::size_t i) {
        return flat.at(name)[i].get<double>();
    };
    for (const std::size_t i : {50u, 100u, 200u})
        EXPECT_NEAR((value("energy", i + 1) - value("energy", i - 1)) /
                        (value("at", i + 1) - value("at", i - 1)) / value("at", i),
                    value("first", i), 5e-3 * std::abs(value("first", i)) + 1e-6);
    s.interface.kind = InterfaceKind::wall; // exponential
    s.interface.frictionless = true;
    s.drive.path = {"relax"};
    const Case wall = resolve(s);
    EXPECT_TRUE(
        renormalised_inputs(wall, theory_case(wall).contact.spectrum, false).contains("note"));
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
                0.4);
    s.surface.rms = 9;
    EXPECT_EQ(solve_theory(theory_case(resolve(s))).jkr_pull_off_force.value(), 0.0);
    s.surface.rms = 1.0;
    const TheoryCase what = theory_case(resolve(s));
    io::Result result;
    record_theory(what, solve_theory(what), result);
    EXPECT_EQ(result.number("theory.persson.jkr_pull_off_force"),
              solve_theory(what).jkr_pull_off_force);
}

TEST(TheoryOfAScene, NeverMakesARunFail) {
    Scene s = small(1);
    const Surface surface = surface_of(resolve(s));
    io::Result good;
    add_theory(resolve(s), surface, good);
    EXPECT_TRUE(good.number("theory.persson.gamma_eff").has_value());
    s.surface.q_max = 1.0; // a band of no width
    s.surface.rolloff = 1.0;
    io::Result bad;
    add_theory(resolve(s), surface, bad);
    EXPECT_FALSE(bad.number("theory.persson.gamma_eff").has_value());
    const io::Json json = bad.json();
    ASSERT_NE(io::find(json, "theory.persson.note"), nullptr);
    EXPECT_NE(io::find(json, "theory.persson.note")->get<std::string>().find("surface.q_max"),
              std::string::npos);
}

} // namespace
} // namespace asperity
