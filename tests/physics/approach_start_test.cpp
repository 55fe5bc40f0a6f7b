// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Where a path in time starts (engine/dynamics/approach_start.hpp): the block would hardly have
// yielded there, and the works are those of the whole path.
#include "engine/dynamics/approach_start.hpp"

#include "engine/statics/zero_load.hpp"
#include "engine/units.hpp"
#include "support/cases.hpp"
#include "support/run_scene.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace asperity {
namespace {

struct AtStart {
    const Case setup;
    Communicator ranks;
    ProcessGrid grid;
    Surface surface;
    Interface interface;
    Block block;

    explicit AtStart(const std::string& text)
        : setup(read_case_text(text, "start.toml")), grid(setup.grid(0)),
          surface(surface_of(setup)),
          interface(surface, grid.tile(0), setup.scene.surface.spacing, setup.simulation.interface),
          block(setup.simulation.block, ranks, grid) {}
};

const std::string rough_scene = "[surface]\nsites = 32\nrms = 0.7\n";

TEST(ApproachStart, TheBlockWouldHaveYieldedByNoMoreThanItsShare) {
    for (const std::string& text :
         {rough_scene, rough_scene + "seed = 3\n[interface]\ntail = true\n",
          std::string("[surface]\nsites = 48\nrms = 1\nradius = 300\n"),
          std::string("[surface]\nkind = \"flat\"\nsites = 16\n")}) {
        SCOPED_TRACE(text);
        AtStart c(text);
        const ApproachStart start = approach_start(c.block, c.interface);
        EXPECT_LT(start.height, c.interface.start_height());
        EXPECT_LT(start.energy, 0.0);
        EXPECT_LT(start.force, 0.0);
        // The deepest energy of the rigid block, in finer steps.
        double deepest = 0.0;
        for (double height = start.height;; height -= 0.01) {
            const InterfaceSums sums =
                c.interface.sweep(c.block.lowest_layer(), c.block.interface_force(),
                                  {.observe = true, .height = height});
            if (sums.force_z.value() > 0.0) break;
            deepest = std::min(deepest, sums.energy.value());
        }
        // What the real block gains where the top plane stays.
        SpectralBlock block(c.setup.simulation.block, c.ranks);
        RelaxOptions options;
        options.tolerance = 1e-10;
        options.scales = c.setup.scales;
        c.interface.set_reference_height(start.height);
        Phases phases;
        const RelaxedState state = relax(block, c.interface, Constraint::top(0.0), options, phases);
        ASSERT_TRUE(state.converged);
        const double gained = start.energy - state[Term::interface] - state[Term::elastic];
        EXPECT_GT(gained, 0.0);
        EXPECT_LE(gained, -share_at_start * deepest);
        // and the start is not much further out than it must be
        EXPECT_GE(gained, -0.05 * share_at_start * deepest);
    }
}

TEST(ApproachStart, IsOutOfReachWhereNothingAttracts) {
    AtStart c(rough_scene + "[interface]\nepsilon = 1e-9\n");
    InterfaceOptions none = c.setup.simulation.interface;
    std::get<LennardJones>(none.potential).epsilon = 0.0;
    const Interface nothing(c.surface, c.grid.tile(0), c.setup.scene.surface.spacing, none);
    const ApproachStart start = approach_start(c.block, nothing);
    EXPECT_EQ(start.height, nothing.start_height());
    EXPECT_EQ(start.energy, 0.0);
    EXPECT_EQ(start.force, 0.0);
}

TEST(ApproachStart, WorksAreThoseOfThePathFromOutOfReach) {
    const io::Scratch scratch;
    AtStart c(rough_scene + "[drive]\nvelocity = 10\ndamping = 0.2\ntimestep = 20\n");
    const io::Json result = test::run_scene(c.setup, scratch / "run");
    test::Driven s(c.setup.simulation, c.surface, c.ranks, c.grid);
    s.start(c.interface.start_height());
    double turn = 0.0; // eV
    test::lead(s, [&](const StepRecord&, std::size_t segment, bool over) {
        if (over && segment == 0) turn = s.balance().interface;
    });
    const double per_area = units::milli_per_unit / std::pow(c.setup.scene.edge(), 2);
    const double approach = test::number(result, "work_of_interface.approach"),
                 pull_off = test::number(result, "work_of_interface.pull_off");
    EXPECT_NEAR(approach, per_area * turn, 1e-5 * approach);
    EXPECT_NEAR(pull_off, per_area * (s.balance().interface - turn), -1e-4 * pull_off);
    EXPECT_LT(test::number(result, "run.steps"), 0.9 * static_cast<double>(s.steps()));
}

TEST(ApproachStart, AWarmBlockStartsOutOfReach) {
    const io::Scratch scratch;
    const std::string once = rough_scene + "[drive]\ndamping = 1\ntimestep = 10\nmax_steps = 1\n"
                                           "path = [\"approach\"]\n";
    for (const double temperature : {0.0, 300.0}) {
        AtStart c(once + "temperature = " + std::to_string(temperature) + "\n");
        const io::Json result = test::run_scene(c.setup, scratch / std::to_string(temperature));
        const double energy = test::number(result, "energy.interface");
        EXPECT_EQ(energy == 0.0, temperature > 0.0) << temperature;
    }
}

} // namespace
} // namespace asperity
