// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Effects are switched by the scene; one that is off holds no memory, is not called and leaves
// nothing in the files of a run.
#include "engine/equilibrium/zero_load.hpp"
#include "engine/run/memory_meter.hpp"
#include "engine/setup/case.hpp"
#include "io/hdf5_file.hpp"
#include "kernels/device/device.hpp"
#include "kernels/variant.hpp"
#include "support/cases.hpp"
#include "support/message.hpp"
#include "support/run_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

using namespace asperity;

namespace {

const std::string rough = "[surface]\nsites = 32\nrms = 1.0\n";

Case case_with(const std::vector<std::string>& overrides) {
    return read_case_text(rough, "test.toml", overrides);
}

Effects effects_with(const std::vector<std::string>& overrides) {
    return case_with(overrides).effects;
}

std::string refusal(const std::vector<std::string>& overrides) {
    return test::message_of<io::SceneError>([&] { case_with(overrides).require_runnable(); });
}

/// In contact from the first step on.
Simulation started(const Case& c) {
    Simulation s(c.simulation, surface_of(c), Communicator(),
                 test::serial_grid(c.simulation.block));
    s.start(s.interface().start_height() - 10.0);
    return s;
}
Simulation follow(const Case& c, int steps) {
    Simulation s = started(c);
    for (int n = 0; n < steps; ++n)
        s.step(n % 10 == 0);
    return s;
}

/// The most that the state of a scene takes at once.
double relaxing_bytes(const std::vector<std::string>& overrides) {
    const Case c = case_with(overrides);
    const Surface surface = surface_of(c);
    MemoryMeter meter;
    SpectralBlock block(c.simulation.block, Communicator(), c.scene.interface.frictionless);
    const Interface interface(surface, block.tile(), c.scene.surface.spacing,
                              c.simulation.interface);
    const double tables = meter.held();
    find_zero_load(block, interface, 6.0, 0.0, c, {});
    return meter.take_peak() - tables + static_cast<double>(block.bytes());
}

} // namespace

TEST(Effects, ThePlainestSceneSwitchesEverythingElseOff) {
    const Effects effects =
        effects_with({"drive.damping=0", "block.model=lattice", "block.thickness=4",
                      "output.fields=[]", "output.checkpoint=0"});
    for (Effect off : {Effect::damping, Effect::temperature, Effect::finite_strain,
                       Effect::coarse_levels, Effect::tail, Effect::curvature, Effect::maps,
                       Effect::trajectory, Effect::checkpoints, Effect::device})
        EXPECT_FALSE(effects.on(off)) << name(off);
    for (Effect on :
         {Effect::inertia, Effect::lateral, Effect::skipping, Effect::observation, Effect::theory})
        EXPECT_TRUE(effects.on(on)) << name(on);
}

TEST(Effects, ADeviceThatIsNotThereIsRefusedAndAutoSaysWhatItTook) {
    if (!fuses(processor_level())) return; // refused for another reason
    if (cuda_device_count() >= 8) return;  // more have no number
    const std::string beyond = "numerics.device=" + std::to_string(cuda_device_count());
    const std::string refused = refusal({beyond});
    for (const char* part : {"numerics.device", "not there", "auto"})
        EXPECT_TRUE(test::has(refused, part)) << part << " not in: " << refused;
    for (const char* path : {"drive.path=zero-load", "drive.path=[\"approach\"]"}) {
        const Case c = case_with({"numerics.device=auto", path});
        EXPECT_EQ(c.on(Effect::device), bool(c.simulation.device))
            << path << ": " << c.effects.why(Effect::device);
        if (cuda_device_count() == 0) {
            EXPECT_FALSE(c.on(Effect::device)) << path;
        }
    }
}

TEST(Effects, EachHasAKeyThatSwitchesIt) {
    const std::vector<std::pair<Effect, std::string>> switched_on = {
        {Effect::damping, "drive.damping=0.1"},
        {Effect::temperature, "drive.temperature=100"},
        {Effect::finite_strain, "block.strain=finite"},
        {Effect::coarse_levels, "block.model=multiscale"},
        {Effect::tail, "interface.tail=true"},
        {Effect::curvature, "surface.radius=200"},
        {Effect::maps, "output.fields=[\"pull-off\"]"},
        {Effect::maps, "output.fields=[\"every:5\"]"},
        {Effect::trajectory, "output.trajectory=10"},
        {Effect::checkpoints, "output.checkpoint=1"},
        {Effect::device, "numerics.device=emulated"}};
    const std::vector<std::string> plain = {"drive.damping=1e-6", "block.model=lattice",
                                            "output.fields=[]", "output.checkpoint=0"};
    for (const auto& [effect, key] : switched_on) {
        std::vector<std::string> with = plain;
        with.push_back(key);
        if (effect == Effect::device && !fuses(processor_level())) {
            // Refused, for these kernels do not fuse multiplications with additions.
            EXPECT_THROW(case_with(with), io::SceneError);
            continue;
        }
        const Effects off = effects_with(
            effect == Effect::damping ? std::vector<std::string>{"drive.damping=0"} : plain);
        const Effects on = effects_with(with);
        EXPECT_FALSE(off.on(effect)) << key;
        EXPECT_TRUE(on.on(effect)) << key;
        EXPECT_FALSE(on.why(effect).empty()) << key;
    }
    const Effects late = effects_with({"output.fields=[\"after-zero-load:3\"]"});
    EXPECT_TRUE(late.on(Effect::maps));
    const Effects timeless = effects_with({"drive.path=zero-load", "drive.temperature=100"});
    for (Effect off : {Effect::inertia, Effect::damping, Effect::temperature, Effect::observation})
        EXPECT_FALSE(timeless.on(off)) << name(off);
    EXPECT_FALSE(
        effects_with({"drive.path=zero-load", "interface.frictionless=true"}).on(Effect::lateral));
    // Waves of finite strain do not add up: no state is relaxed.
    EXPECT_FALSE(effects_with({"block.strain=finite"}).on(Effect::relaxation));
    EXPECT_TRUE(effects_with({}).on(Effect::relaxation));
}

TEST(Effects, OffInAStepIsNoCallAndNoByte) {
    const Simulation s =
        follow(case_with({"drive.damping=0", "block.model=lattice", "block.thickness=4"}), 20);
    EXPECT_EQ(s.phases()[Phase::thermostat].calls, 0);
    EXPECT_EQ(s.phases()[Phase::interpolate].calls, 0);
    EXPECT_EQ(s.block().coarse_bytes(), 0u);
    EXPECT_EQ(s.block().finite_bytes(), 0u);
    EXPECT_EQ(s.interface().tail_bytes(), 0u);
    // Sums that only damping and noise add to.
    EXPECT_EQ(s.balance().damped, 0.0);
    EXPECT_EQ(s.balance().drag_work, 0.0);
    EXPECT_EQ(s.balance().heat, 0.0);
}

TEST(Effects, OnInAStepTakesPlace) {
    const Simulation s =
        follow(case_with({"drive.damping=0.2", "drive.temperature=100", "interface.tail=true",
                          "block.thickness=32", "block.strain=finite"}),
               20);
    EXPECT_EQ(s.phases()[Phase::thermostat].calls, 20);
    EXPECT_EQ(s.phases()[Phase::interpolate].calls, 20);
    EXPECT_GT(s.block().coarse_bytes(), 0u);
    EXPECT_GT(s.block().finite_bytes(), 0u);
    EXPECT_LT(s.block().finite_bytes(), s.block().bytes() / 10) << "bands of rows, no field";
    EXPECT_GT(s.interface().tail_bytes(), 0u);
    EXPECT_GT(s.balance().damped, 0.0);
    EXPECT_NE(s.balance().drag_work, 0.0);
    EXPECT_NE(s.balance().heat, 0.0);
}

TEST(Effects, DampingActsOnTheLayersItIsGivenAlone) {
    // One step of the same state, with and without: the layers below damping_from keep their bits.
    const std::vector<std::string> lattice = {"block.model=lattice", "block.thickness=8",
                                              "drive.damping=0"};
    std::vector<std::string> damped = lattice;
    damped.back() = "drive.damping=5";
    damped.emplace_back("drive.damping_from=0.5");
    Simulation plain = started(case_with(lattice)), other = started(case_with(damped));
    for (Simulation* s : {&plain, &other}) {
        Block& block = s->block_to_write();
        auto& v = block.fields(block.levels().front()).v; // faster than the medium
        for (int z = 0; z < 8; ++z)
            v.plane(z).z(3, 5) = 1e-3;
        s->step(false);
    }
    for (int z = 0; z < 8; ++z) {
        const double without = plain.block().levels().front().v.view()[z].z(3, 5);
        const double with = other.block().levels().front().v.view()[z].z(3, 5);
        if (z < 4)
            EXPECT_EQ(with, without) << z;
        else
            EXPECT_LT(std::abs(with), std::abs(without)) << z;
    }
}

TEST(Effects, AnotherSeedIsAnotherNoise) {
    const auto kinetic = [](const char* seed) {
        return follow(case_with({"drive.damping=0.2", "drive.temperature=100", "block.thickness=8",
                                 seed}),
                      3)
            .balance()
            .heat;
    };
    EXPECT_EQ(kinetic("drive.seed=1"), kinetic("drive.seed=1"));
    EXPECT_NE(kinetic("drive.seed=1"), kinetic("drive.seed=2"));
}

TEST(Effects, AStepAllocatesNoField) {
    // Observed or not, with all effects of a step on or off.
    for (const auto& overrides :
         {std::vector<std::string>{"drive.damping=0", "block.model=lattice", "block.thickness=4"},
          std::vector<std::string>{"drive.damping=0.2", "drive.temperature=100",
                                   "interface.tail=true", "block.thickness=32",
                                   "block.strain=finite"}}) {
        Simulation s = started(case_with(overrides));
        s.step(true); // room for the threads of finite strain
        const std::size_t bytes = s.block().bytes() + s.interface().bytes();
        const MemoryMeter meter;
        for (int n = 0; n < 10; ++n)
            s.step(n % 2 == 0);
        EXPECT_LE(meter.allocations(), 10) << "more than the exchange's list of fields";
        EXPECT_EQ(s.block().bytes() + s.interface().bytes(), bytes);
    }
}

TEST(Effects, WithoutFrictionThereAreNoLateralDisplacements) {
    const std::vector<std::string> wall = {"drive.path=zero-load"};
    std::vector<std::string> frictionless = wall;
    frictionless.emplace_back("interface.frictionless=true");
    EXPECT_LT(relaxing_bytes(frictionless), relaxing_bytes(wall) / 2);
}

TEST(Effects, OffInARunLeavesNothing) {
    const auto run_with = [](std::vector<std::string> keys) {
        keys.insert(keys.end(), {"surface.sites=16", "block.thickness=8", "drive.max_steps=20",
                                 "output.series=10"});
        return read_scene_text(rough, "test.toml", keys);
    };
    const test::Written without(run_with({"output.fields=[]", "output.checkpoint=0"})),
        with(run_with({"output.fields=[\"every:5\"]", "output.trajectory=5"}));
    for (const auto* run : {&without, &with}) {
        const bool on = run == &with;
        EXPECT_EQ(run->file->exists("/fields"), on);
        EXPECT_EQ(run->file->exists("/particles"), on);
        EXPECT_EQ(std::filesystem::exists(run->directory + "/checkpoint.h5"), on);
        EXPECT_EQ(run->holds("run.phases.checkpoint"), on);
    }
    EXPECT_TRUE(
        test::has(io::json_text(without.json, 2), "\"why\": \"output.trajectory = \\\"none\\\"\""));
}
