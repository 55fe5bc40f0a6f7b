// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The two works of a path and the energy that it loses (docs/explanation/model.md), as a run writes
// them:
//
//     work of the drive in + lost in = binding energy = work of the drive out - lost out
//
// in every mode, while the work of the interface, int F dz of the mean height, is the binding
// energy itself where the surface moves as one, however much is lost.
#include "support/run_scene.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include <gtest/gtest.h>

namespace asperity {
namespace {

class Path : public test::Written {
public:
    using Written::Written;
    double last(const char* column) const { return series(column).back(); }
    double state() const { return (*this)("binding_energy"); }
    /// eV as meV/Å^2.
    double per_area(double energy) const { return 1e3 * energy / area(); }

    void expect_identities(double allowed) const {
        const Path& of = *this;
        EXPECT_NEAR(of("work_of_drive.approach") + of("lost.approach"), state(), allowed);
        EXPECT_NEAR(of("work_of_drive.pull_off") - of("lost.pull_off"), state(), allowed);
        EXPECT_NEAR(of("work_of_drive.pull_off") - of("work_of_drive.approach"), of("lost.cycle"),
                    allowed);
        EXPECT_NEAR(of("lost.cycle"), of("lost.approach") + of("lost.pull_off"), 1e-9);
    }
};

std::string scene(const char* surface, int layers, const std::string& drive) {
    return fmt::format("[surface]\nsites = 12\n{}\n[block]\nthickness = {}\n[drive]\n{}\n"
                       "[output]\nseries = 20\n",
                       surface, layers, drive);
}
const char* const flat = "kind = \"flat\"";
const char* const rough = "rms = 0.5\nseed = 4";

TEST(Works, InTimeTheDrivesWorkAndTheLossesMakeTheState) {
    for (const char* surface : {flat, rough})
        for (const char* drive : {"velocity = 20\ntimestep = 20\ndamping = 0.05",
                                  "velocity = 20\ntimestep = 20\ndamping = 2",
                                  "velocity = 40\ntimestep = 20\ndamping = 0"}) {
            const Path path(scene(surface, 48, drive));
            path.expect_identities(1e-3 * path("delta_gamma"));
            EXPECT_GT(path("lost.approach"), 0.1 * path.state());
            EXPECT_GT(path("lost.cycle"), 0.1 * path.state());
            // The loss of the cycle from the series: damped, or left at the end in vibrations of a
            // block that comes to rest again where it started.
            const double left = path.last("damped") + path.last("elastic_energy") +
                                path.last("kinetic_energy") - path.series("kinetic_energy").front();
            EXPECT_NEAR(path("lost.cycle"), path.per_area(left), 1e-3 * path.state());
            EXPECT_NEAR(path.per_area(-path.last("interface_work")),
                        path("work_of_adhesion.pull_off") - path("work_of_adhesion.approach"),
                        1e-3 * path.state());
        }
}

TEST(Works, OfTheInterfaceOfFlatSurfacesIsTheStateWhateverIsLost) {
    const Path path(scene(flat, 96, "velocity = 20\ntimestep = 20"));
    EXPECT_NEAR(path("work_of_adhesion.approach"), path.state(), 0.002 * path.state());
    EXPECT_NEAR(path("work_of_adhesion.pull_off"), path.state(), 0.002 * path.state());
    EXPECT_GT(path("lost.cycle"), 2.0 * path.state());
}

TEST(Works, WithoutTimeTheDrivesWorkAndTheLossesMakeTheState) {
    const std::string drive = "mode = \"quasistatic\"\nhold = ";
    const Path top(scene(rough, 96, drive + "\"top\""));
    top.expect_identities(0.02);
    EXPECT_GT(top("lost.cycle"), 0.5 * top.state());
    EXPECT_FALSE(top.holds("work_of_adhesion.approach")) << "the mean height jumps";
    EXPECT_FALSE(top.holds("work_of_adhesion.pull_off"));

    const Path held(scene(rough, 96, drive + "\"mean-height\""));
    held.expect_identities(0.02);
    for (const char* branch : {"approach", "pull_off"})
        EXPECT_EQ(held(fmt::format("work_of_adhesion.{}", branch)),
                  held(fmt::format("work_of_drive.{}", branch)));
    EXPECT_LT(held("lost.cycle"), 0.2 * top("lost.cycle"))
        << "held so, the block does not snap as a whole";
}

TEST(Works, OfTheDriveTendToThoseWithoutTime) {
    // A slow and damped drive takes up and gives what the path without time does; the work of the
    // interface does not.
    const Path still(scene(flat, 48, "mode = \"quasistatic\""));
    double before = 1.0;
    for (const char* velocity : {"20", "5"}) {
        const Path moving(
            scene(flat, 48, std::string("timestep = 40\ndamping = 0.5\nvelocity = ") + velocity));
        const double in = std::abs(
                         moving("work_of_drive.approach") / still("work_of_drive.approach") - 1.0),
                     out = std::abs(
                         moving("work_of_drive.pull_off") / still("work_of_drive.pull_off") - 1.0);
        EXPECT_LT(std::max(in, out), 0.6 * before) << velocity;
        before = std::max(in, out);
        EXPECT_NEAR(moving("work_of_adhesion.pull_off"), moving.state(), 0.01 * moving.state());
    }
    EXPECT_LT(before, 0.25);
}

TEST(Works, WithHeatOrALoadAreNotComparedWithTheState) {
    const Path warm(scene(flat, 4, "velocity = 100\ntimestep = 20\ntemperature = 50\ndamping = 1"));
    EXPECT_TRUE(warm.holds("work_of_drive.pull_off"));
    EXPECT_FALSE(warm.holds("lost.cycle"));
    const Path loaded(scene(flat, 4, "velocity = 50\ntimestep = 20\nload = 200"));
    EXPECT_FALSE(loaded.holds("lost.approach"));
    EXPECT_NEAR(loaded("work_of_drive.pull_off") - loaded("work_of_drive.approach"),
                loaded("lost.cycle"), 1e-3 * loaded("delta_gamma"));
}

} // namespace
} // namespace asperity
