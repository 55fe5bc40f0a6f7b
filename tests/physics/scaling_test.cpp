// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// No length and no energy is hidden in relaxations and paths without time: with all lengths times a
// and all energies times b, each dimensionless number of a result is the same, and the work for it
// too. Powers of two leave the bits of most of the arithmetic alone; others ask for the accuracy
// that is stated.
#include "support/factors.hpp"
#include "support/path_case.hpp"
#include "support/run_scene.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

using namespace asperity;

namespace {

using test::Factors;

/// A scene of 16 sites with rubber or a solid over atoms or a wall.
struct Scenes {
    enum Interface { atoms, wall, hard } interface = atoms;
    bool path = false;                 ///< in and out, in place of a state
    double load = 0.0;                 ///< MPa, of the state, or where a segment of the path ends
    bool sphere = false, held = false; ///< held: the mean height
    double young = 0.772, epsilon = 1e-3, rms = 1.0;

    std::string text(const Factors& f) const {
        const double a = f.length;
        const auto mean = held ? "control = \"mean-height\"\n" : "";
        std::string s = fmt::format(
            "[surface]\nsites = {}\nspacing = {}\n{}[block]\nyoung = {}\nthickness = 16\n"
            "[output]\nfields = []\ncheckpoint = \"none\"\n"
            "[drive]\nmode = \"quasistatic\"\ndisplacement_step = {}\n{}",
            sphere ? 32 : 16, 2.6 * a,
            sphere ? fmt::format("kind = \"flat\"\nradius = {}\n", 300.0 * a)
                   : fmt::format("rms = {}\nrolloff = 2\n", rms * a),
            young * f.pressure(), 0.25 * a, mean);
        if (path && interface == hard)
            s += fmt::format("path = [\"load {} MPa\", \"load {} MPa\"]\n", load * f.pressure(),
                             0.3 * load * f.pressure());
        else if (path && load > 0.0)
            s += fmt::format("path = [\"approach\", \"load {} MPa\", \"pull-off\"]\n",
                             load * f.pressure());
        else if (path)
            s += "path = [\"approach\", \"pull-off\"]\n";
        else
            s += fmt::format("path = [\"relax\"]\nload = {}\n", load * f.pressure());
        s += "[interface]\n";
        if (interface == atoms)
            s += fmt::format("epsilon = {}\nr0 = {}\ncutoff = {}\n", epsilon * f.energy, 3.28 * a,
                             13.12 * a);
        else
            s += fmt::format("kind = \"wall\"\nadhesion = {}\nrange = {}\n",
                             interface == hard ? 0.0 : 1e3 * epsilon * f.surface(),
                             (sphere ? 3.0 : 1.0) * a);
        return s;
    }
};

/// Numbers without a unit, and what they may be wrong by beside 1e-6 of themselves (the tolerance
/// is 2.5e-4, and energies go with its square).
struct Outcome {
    std::vector<std::pair<double, double>> numbers;
    double iterations = 0.0;
};

Outcome outcome(const Scenes& scene, const Factors& f) {
    const test::Written run(scene.text(f));
    const Case c = resolve(run.scene());
    const double surface = f.surface(); // meV/Å^2
    Outcome o;
    const auto add = [&](const char* name, double unit, double error) {
        if (run.holds(name)) o.numbers.emplace_back(run(name) / unit, error / unit);
    };
    const auto error = [&](const char* name) { return run.holds(name) ? run(name) : 0.0; };
    add("binding_energy", surface, error("binding_energy_uncertainty"));
    // A site at the edge of a contact may be on either side.
    add("contact_fraction", 1.0, 1.5 / (c.scene.surface.sites * c.scene.surface.sites));
    add("work_of_drive.approach", surface, error("work_of_drive.uncertainty.approach"));
    add("work_of_drive.pull_off", surface, error("work_of_drive.uncertainty.pull_off"));
    add("lost.approach", surface, error("lost.uncertainty.approach"));
    add("lost.pull_off", surface, error("lost.uncertainty.pull_off"));
    const auto segments = run.json.find("segments");
    if (segments != run.json.end())
        for (const io::Json& s : *segments) {
            const double pressure = s["pressure"].get<double>() / f.pressure();
            o.numbers.emplace_back(pressure, 1.1e-3 * std::abs(scene.load) +
                                                 1e-3 * c.largest_tension * 1e3 / f.pressure());
        }
    o.iterations = run("run.iterations");
    return o;
}

/// The same whatever the factors. bits: these are powers of two.
void expect_same(const Scenes& scene, const std::vector<Factors>& factors, bool bits) {
    const Outcome one = outcome(scene, {});
    ASSERT_GE(one.numbers.size(), 2u);
    for (const Factors& f : factors) {
        SCOPED_TRACE(fmt::format("lengths x {}, energies x {}", f.length, f.energy));
        const Outcome other = outcome(scene, f);
        ASSERT_EQ(one.numbers.size(), other.numbers.size());
        for (std::size_t i = 0; i < one.numbers.size(); ++i) {
            const auto [value, error] = one.numbers[i];
            const auto [there, error_there] = other.numbers[i];
            const double allowed = bits ? 0.0 : error + error_there;
            EXPECT_NEAR(there, value, allowed + 1e-6 * std::abs(value)) << "number " << i;
        }
        EXPECT_LE(other.iterations, 2.0 * one.iterations);
        EXPECT_GE(other.iterations, 0.5 * one.iterations);
    }
}

const std::vector<Factors> doublings = {
    {0x1p7, 1.0}, {1.0, 0x1p20}, {1.0, 0x1p-20}, {0x1p-6, 0x1p-10}};
const std::vector<Factors> others = {{1e3, 1.0}, {1.0, 1e6}, {1.0, 1e-6}, {0.03, 1e-3}};

} // namespace

TEST(Scaling, StatesOverAtoms) {
    for (const bool bits : {true, false})
        expect_same({}, bits ? doublings : others, bits);
    expect_same({.load = 5.0}, others, false);
}

TEST(Scaling, StatesOverWalls) {
    for (const bool bits : {true, false}) {
        expect_same({.interface = Scenes::wall}, bits ? doublings : others, bits);
        expect_same({.interface = Scenes::hard, .load = 5.0}, bits ? doublings : others, bits);
    }
    // Rubber: the attraction is a thousand times its modulus.
    expect_same({.interface = Scenes::wall, .young = 1e-4}, others, false);
}

TEST(Scaling, PathsOverAtoms) {
    const std::vector<Factors> few = {{0x1p4, 1.0}, {1.0, 0x1p-20}, {0.03, 1e-3}, {1.0, 1e5}};
    expect_same({.path = true, .load = 2.0}, few, false);
    expect_same({.path = true, .held = true}, few, false);
}

TEST(Scaling, PathsOverWalls) {
    expect_same({.interface = Scenes::wall, .path = true}, others, false);
    // And where the tolerance of a step is less energy than sums over the sites leave out.
    std::vector<Factors> more = others;
    more.push_back({1e3, 1e-6});
    expect_same({.interface = Scenes::hard, .path = true, .load = 3.0}, more, false);
    expect_same({.interface = Scenes::wall, .path = true, .sphere = true}, others, false);
}

// Right numbers of scenes that a tolerance in eV/Å got wrong.

TEST(Scaling, RubberUnderALoad) {
    // Pixels of 1 nm, 1 MPa, no adhesion. At 0.03 and 0.1 MPa a solver of the half-space of our own
    // has 0.207 and 0.541; a lattice, softer for its shortest waves, 0.219 and 0.556.
    for (const auto& [load, contact] : {std::pair{0.03, 0.207}, {0.1, 0.541}}) {
        const test::Written run(fmt::format(
            "[surface]\nsites = 128\nspacing = 10\nrms = 10\nq_max = 16\nseed = 4\n"
            "[block]\nyoung = 0.001\npoisson = 0.49\n[interface]\nkind = \"wall\"\nadhesion = 0\n"
            "[drive]\npath = [\"relax\"]\nload = {}\n[output]\nfields = []\n",
            load));
        EXPECT_NEAR(run("contact_fraction"), contact, 1e-3) << load;
    }
}

TEST(Scaling, WeakInterface) {
    for (const auto& [seed, epsilon, ratio] : {std::tuple{1, 1e-5, 0.2502},
                                               {2, 1e-5, 0.1918},
                                               {3, 1e-5, 0.2014},
                                               {4, 1e-5, 0.2311},
                                               {1, 1e-6, 0.2500}}) {
        const test::Written run(fmt::format("[surface]\nsites = 24\nrms = 1\nseed = {}\n"
                                            "[block]\nthickness = 24\n[drive]\n"
                                            "path = [\"relax\"]\n[interface]\nepsilon = {}\n"
                                            "[output]\nfields = []\n",
                                            seed, epsilon));
        EXPECT_NEAR(run("binding_energy") / run("delta_gamma"), ratio, 1e-4);
    }
}

TEST(Scaling, ABeadThatTouchesAGel) {
    // 5 µm on 2 kPa, led to a depth of 0.2 µm: at its first points there is hardly any energy.
    const test::Written run(
        "[surface]\nkind = \"flat\"\nsites = 128\nspacing = 550\nradius = 5e4\n[block]\n"
        "young = 2e-6\npoisson = 0.49\nthickness = 73\n[interface]\nkind = \"wall\"\n"
        "adhesion = 0\n[drive]\nmode = \"quasistatic\"\npath = [\"height -2000 Å\"]\n"
        "displacement_step = 500\n[output]\nfields = []\n");
    EXPECT_NEAR(run.json["segments"][0]["pressure"].get<double>(), 2.2577e-5, 1e-8);
}

TEST(Scaling, LoadsAreMetToTheirOwnSize) {
    // Also after far larger ones.
    for (const char* hold : {"top", "mean-height"}) {
        const test::Written run(fmt::format(
            "[surface]\nsites = 32\nrms = 1.5\n[drive]\nmode = \"quasistatic\"\ncontrol = \"{}\"\n"
            "path = [\"approach\", \"load 300 MPa\", \"load 1 MPa\", \"load 0.1 MPa\"]\n"
            "[output]\nfields = []\n",
            hold));
        for (const auto& [i, load] : {std::pair{1u, 300.0}, {2u, 1.0}, {3u, 0.1}})
            EXPECT_NEAR(run.json["segments"][i]["pressure"].get<double>(), load, 1e-3 * load)
                << hold;
    }
}

TEST(Scaling, LoadsOverDecadesCostNoMoreThanTheirForces) {
    // The tolerance follows the force that is there. Each load is met, with the contact that the
    // state under it has, and a large load after a small one costs no more for it.
    const std::string solids = "[surface]\nsites = 32\nrms = 2\nseed = 3\nq_max = 8\n[block]\n"
                               "young = 10\n[interface]\nkind = \"wall\"\n{}\n"
                               "[output]\nfields = []\n[drive]\n{}";
    for (const char* adhesion : {"adhesion = 0", "adhesion = 1e-5"}) {
        const test::Written run(
            fmt::format(fmt::runtime(solids), adhesion,
                        "mode = \"quasistatic\"\npath = [\"load 300 MPa\", \"load 1 MPa\", "
                        "\"load 300 MPa\", \"load 0.1 MPa\"]\n"));
        double contact = -1.0;
        for (const auto& [i, load] : {std::pair{0u, 300.0}, {1u, 1.0}, {2u, 300.0}, {3u, 0.1}}) {
            const auto& segment = run.json["segments"][i];
            EXPECT_NEAR(segment["pressure"].get<double>(), load, 1e-3 * load) << adhesion;
            if (i == 0) contact = segment["contact_fraction"].get<double>();
            if (i == 2) {
                EXPECT_NEAR(segment["contact_fraction"].get<double>(), contact, 2.0 / 1024);
            }
        }
        const test::Written state(
            fmt::format(fmt::runtime(solids), adhesion, "path = [\"relax\"]\nload = 300\n"));
        EXPECT_NEAR(state("contact_fraction"), contact, 2.0 / 1024) << adhesion;
        EXPECT_LT(run("run.iterations"), 40000);
    }
}

TEST(Scaling, ASoftPullOffIsThatOfATighterPath) {
    // A soft block comes off a soft wall site by site. Steps that take a site off before its
    // instability, or that pass two of them at once, all lose too little: 2.0041 without the
    // tangent (wall_tangent.hpp), 1.9956 with steps that hide instabilities too. At a tolerance of
    // 5e-7 the work is 2.01727.
    const test::Written run(
        "[surface]\nsites = 16\nspacing = 10\nrms = 8\nseed = 3\n[block]\nyoung = 0.02\n"
        "poisson = 0.45\nthickness = 16\nmodel = \"lattice\"\n[interface]\nkind = "
        "\"wall\"\nadhesion = 2\n"
        "range = 10\n[drive]\nmode = \"quasistatic\"\ncontrol = \"mean-height\"\n"
        "displacement_step = 2\n[output]\nfields = []\n");
    EXPECT_NEAR(run("work_of_drive.pull_off"), 2.01727, 3e-3 * 2.01727);
}

TEST(Scaling, AFlatWallGivesWayByPressureOverStiffness) {
    for (const double adhesion : {0.0, 1.0})
        for (const double load : {1.0, 100.0, 2000.0}) {
            const test::Written run(
                fmt::format("[surface]\nkind = \"flat\"\nsites = 16\n[block]\nthickness = 16\n"
                            "[interface]\nkind = \"wall\"\nadhesion = {}\nstiffness = 5\n"
                            "[drive]\nmode = \"quasistatic\"\npath = [\"load {} MPa\"]\n"
                            "[output]\nfields = []\n",
                            adhesion, load));
            const auto& segment = run.json["segments"][0];
            EXPECT_NEAR(segment["pressure"].get<double>(), load, 1e-3 * load);
            if (adhesion == 0.0) { // 1 MPa over 5 GPa/Å
                EXPECT_NEAR(segment["mean_height"].get<double>(), -2e-4 * load, 1e-6 * load);
            }
        }
}

TEST(Scaling, AMeanHeightFarInsideIsRefused) {
    for (const auto& [height, refused] : {std::pair{-5.0, true}, {1.5, true}, {2.9, false}}) {
        const Case c = read_case_text(
            fmt::format("[surface]\nsites = 16\nrms = 0.2\n[drive]\nmode = \"quasistatic\"\n"
                        "control = \"mean-height\"\npath = [\"height {} Å\"]\n"
                        "[output]\nfields = []\n",
                        height),
            "deep.toml");
        const io::Scratch scratch;
        RunOptions options;
        options.out = scratch / "run";
        options.progress = io::ProgressMode::off;
        std::string what;
        try {
            run(c, options, Communicator());
        } catch (const io::PhysicsError& e) {
            what = e.what();
        }
        EXPECT_EQ(what.find("too far inside the substrate") != std::string::npos, refused)
            << height << ": " << what;
    }
}

TEST(Scaling, ATolerancesUnitAndItsFloorAreNamed) {
    try {
        read_scene_text("[drive]\ntolerance = \"1e-4 eV/Å\"\n", "old.toml");
        ADD_FAILURE() << "a unit is taken";
    } catch (const io::SceneError& e) {
        EXPECT_NE(std::string(e.what()).find("fraction"), std::string::npos) << e.what();
    }
    const auto note = [](double tolerance) {
        return rounding_note(read_case_text(fmt::format("[surface]\nsites = 16\n[drive]\npath = "
                                                        "[\"relax\"]\ntolerance = {}\n",
                                                        tolerance),
                                            "s.toml"),
                             20.0);
    };
    EXPECT_EQ(note(1e-11), "");
    EXPECT_NE(note(1e-14).find("rounding"), std::string::npos);
    // It is where relaxations end: a hundred times above it one comes to its tolerance, a tenth
    // below it none does.
    for (const auto& [of_floor, converges] : {std::pair{100.0, true}, {0.1, false}}) {
        test::PathCase at(test::paper_block(16, 16, 0), test::self_affine(16, 1.0));
        const double floor =
            rounding_of_forces(test::paper_scales(), at.options, at.interface.start_height());
        at.block.set_uniform(3.0 - at.interface.start_height());
        RelaxOptions o;
        o.tolerance = of_floor * floor;
        o.scales = test::paper_scales();
        Phases phases;
        const RelaxedState s = relax(at.block, at.interface, Constraint::load(0.0), o, phases);
        EXPECT_EQ(s.converged, converges) << of_floor << ": " << s.residual << " of " << floor;
    }
}
