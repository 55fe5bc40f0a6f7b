// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// numerics.accuracy on scenes that its calibration has not seen: the error is within the target,
// and the work, counted in node-steps or iterations of nodes, a third of the default's or less.
#include "engine/scene/accuracy.hpp"
#include "engine/setup/setup.hpp"
#include "support/run_scene.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

namespace asperity {
namespace {

io::Json result_of(const std::string& text, const std::vector<std::string>& overrides) {
    const io::Scratch scratch;
    return test::run_scene(read_scene_text(text, "held-out.toml", overrides), scratch / "run");
}

/// Node-steps of the path in time, or nodes times iterations without.
double work_of(const std::string& text, const std::vector<std::string>& overrides,
               const io::Json& result) {
    const Scene scene = read_scene_text(text, "held-out.toml", overrides);
    const double sites = static_cast<double>(scene.surface.sites) * scene.surface.sites;
    double nodes = 0.0;
    for (const LevelShape& level : make_setup(scene, 1).levels)
        nodes += static_cast<double>(level.sites) * level.sites * level.cells;
    if (scene.without_time()) nodes = sites;
    const char* count = scene.without_time() ? "run.iterations" : "run.steps";
    return nodes * io::find(result, count)->get<double>();
}

/// What a setting can be asked for: the relaxed state, or all of its path too.
enum class Question { state, path };

/// The largest relative difference of the numbers that both have, energies over flat on flat.
double largest_error(const io::Json& fast, const io::Json& best, Question question) {
    std::vector<const char*> keys = {"binding_energy", "contact_fraction"};
    if (question == Question::path)
        keys.insert(keys.end(),
                    {"work_of_adhesion.approach", "work_of_adhesion.pull_off", "pull_off_force"});
    double largest = 0.0;
    for (const std::string key : keys) {
        const bool energy = key.starts_with("binding") || key.starts_with("work");
        const auto number = [&](const io::Json& result) {
            return io::find(result, key)->get<double>() /
                   (energy ? io::find(result, "delta_gamma")->get<double>() : 1);
        };
        largest = std::max(largest, std::abs(number(fast) / number(best) - 1.0));
    }
    return largest;
}

/// reference: what makes every dial that accuracy turns exact.
void expect_accuracy(const std::string& text, const std::vector<std::string>& reference,
                     const std::string& target, Question question) {
    const std::vector<std::string> chosen = {"numerics.accuracy=" + target};
    const io::Json fast = result_of(text, chosen), plain = result_of(text, {}),
                   best = result_of(text, reference);
    const double error = largest_error(fast, best, question);
    EXPECT_LE(error, io::find(fast, "accuracy.target")->get<double>()) << text;
    EXPECT_LE(io::find(fast, "accuracy.expected_error")->get<double>(),
              io::find(fast, "accuracy.target")->get<double>());
    const double saved = work_of(text, {}, plain) / work_of(text, chosen, fast);
    EXPECT_GE(saved, 3.0) << text;
    ::testing::Test::RecordProperty("error", std::to_string(error));
    ::testing::Test::RecordProperty("saved", std::to_string(saved));
}

const std::string thin = "[block]\nthickness = 32\n[drive]\nvelocity = 10\n";

TEST(HeldOut, PathInTime) {
    std::vector<std::string> scenes = {"sites = 32\nrms = 0.8\nseed = 11\nhurst = 0.7\n" + thin};
    if (std::getenv("ASPERITY_LONG")) // ctest -L long
        for (const char* surface :
             {"sites = 64\nrms = 1.2\nseed = 4\n", "sites = 64\nrms = 2\nseed = 9\n"})
            scenes.push_back(surface + std::string("[drive]\nvelocity = 10\n"));
    for (const std::string& scene : scenes)
        expect_accuracy("[surface]\n" + scene, {"block.model=lattice", "drive.timestep=20"}, "1%",
                        Question::path);
}

TEST(Choice, StepsAreNoLongerThanWhatIsStableInWideBoxes) {
    const auto step = [](const char* sites) {
        const Scene scene = read_scene_text("[numerics]\naccuracy = \"2%\"\n", "s.toml",
                                            {std::string("surface.sites=") + sites});
        return scene.drive.timestep;
    };
    EXPECT_EQ(step("128"), 60.0);
    EXPECT_EQ(step("512"), 40.0);
    const Scene wide = read_scene_text("[drive]\ntimestep = 15\n", "s.toml");
    ASSERT_TRUE(longer_timestep(wide));
    EXPECT_EQ(longer_timestep(wide)->timestep, 40.0);
}

TEST(Choice, LeavesAloneWhatTheSceneSays) {
    const std::string text = "[numerics]\naccuracy = \"1%\"\n";
    const Scene free = read_scene_text(text, "s.toml");
    ASSERT_TRUE(free.choice);
    EXPECT_EQ(free.choice->settings.size(), 3u);
    EXPECT_TRUE(free.choice->kept.empty());
    const Scene held =
        read_scene_text(text, "s.toml", {"drive.timestep=7", "block.layers_per_level=9"});
    EXPECT_EQ(held.drive.timestep, 7.0);
    EXPECT_EQ(held.block.layers_per_level, 9);
    EXPECT_EQ(held.choice->kept,
              (std::vector<std::string>{"block.layers_per_level", "drive.timestep"}));
    // The interaction and the experiment are not its to choose.
    EXPECT_EQ(free.interface.cutoff, Scene{}.interface.cutoff);
    EXPECT_EQ(free.drive.velocity, Scene{}.drive.velocity);
    EXPECT_FALSE(read_scene_text("", "s.toml").choice);
}

TEST(Choice, IsCheaperForALooserTarget) {
    const auto layers = [](const char* target) {
        return read_scene_text("", "s.toml", {std::string("numerics.accuracy=") + target});
    };
    EXPECT_LT(layers("5%").block.layers_per_level, layers("1%").block.layers_per_level);
    EXPECT_EQ(layers("0.1%").block.model, BlockModel::lattice);
}

TEST(Choice, RefusesWhatWasNotMeasured) {
    for (const char* outside : {"block.young=50", "interface.epsilon=0.2", "surface.rms=12",
                                "surface.sites=16", "surface.radius=4410", "drive.velocity=40",
                                "drive.temperature=300", "numerics.accuracy=1e-6"})
        EXPECT_THROW(read_scene_text("", "s.toml", {"numerics.accuracy=1%", outside}),
                     io::SceneError)
            << outside;
}

TEST(Choice, CoversWhatWasMeasuredUpToItsLimits) {
    // N = 32, 10 m/s, rms 2 Å at N = 32, one value of the moduli.
    const auto covered = [](const std::vector<std::string>& keys) {
        std::vector<std::string> all = {"numerics.accuracy=5%", "surface.sites=32",
                                        "surface.rms=1"};
        all.insert(all.end(), keys.begin(), keys.end());
        try {
            read_scene_text("", "s.toml", all);
            return true;
        } catch (const io::SceneError&) {
            return false;
        }
    };
    for (const auto& [inside, beyond] : {std::pair{"surface.sites=32", "surface.sites=31"},
                                         {"drive.velocity=10", "drive.velocity=10.01"},
                                         {"surface.rms=1.99", "surface.rms=2.01"},
                                         {"block.young=77.25", "block.young=77.4"},
                                         {"block.poisson=0.4202", "block.poisson=0.421"},
                                         {"block.atom_mass=196.9", "block.atom_mass=196"},
                                         {"interface.r0=3.281", "interface.r0=3.29"},
                                         {"surface.spacing=2.601", "surface.spacing=2.61"},
                                         {"surface.lattice_ratio=1", "surface.lattice_ratio=1.618"},
                                         {"block.strain=linear", "block.strain=finite"},
                                         {"interface.kind=atoms", "interface.kind=wall"}}) {
        EXPECT_TRUE(covered({inside})) << inside;
        EXPECT_FALSE(covered({beyond})) << beyond;
    }
    EXPECT_TRUE(covered({"drive.mode=quasistatic", "drive.velocity=40"})); // has no effect
}

TEST(BendingEnergy, OfOneWave) {
    // All of it in the longest wave: (E*/4) q h², E* = E / (1 - ν²).
    Scene scene;
    scene.surface.rolloff = scene.surface.cutoff = 1.0;
    scene.surface.rms = 2.0;
    const double q = 2.0 * 3.14159265358979 / scene.edge();
    const double modulus = 77.2 / 160.21766 / (1.0 - 0.42 * 0.42);
    EXPECT_NEAR(bending_energy(scene), 1000.0 * modulus * q, 1e-3);
}

} // namespace
} // namespace asperity
