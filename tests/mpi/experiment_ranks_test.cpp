// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// All terms of an experiment at once: a spring, layers, surface stress, a field of the work of
// adhesion and a shaped law over a periodic box; a spring, a field and holes in a box with free
// edges. Paths are the same bits on any number of ranks and threads, and from every checkpoint on.
#include "engine/case/case.hpp"
#include "engine/path/checkpoint.hpp"
#include "engine/path/path.hpp"
#include "support/cases.hpp"
#include "support/threads.hpp"
#include "support/world.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <memory>
#include <span>
#include <string>
#include <vector>

using namespace asperity;

namespace {

using test::world;

/// Layers, surface stress, a spring, patches of adhesion and the law 8-2, periodic.
constexpr const char* film = R"(
surface = { sites = 16, spacing = "2 nm", rms = "0.4 nm", q_max = 4.0, rolloff = 1.0, seed = 3 }
output = { checkpoint = "none" }
[block]
young = "20 MPa"
poisson = 0.4
thickness = 24
layers = [["6 nm", "200 MPa", 0.3], ["4 nm", "8 MPa", 0.45]]
surface_stress = "30 mN/m"
[interface]
kind = "wall"
law = "8-2"
range = "1 nm"
adhesion = "patches 10 mJ/m^2 40 mJ/m^2 8 nm 5"
[drive]
mode = "quasistatic"
path = ["approach", "pull-off"]
displacement_step = "1 nm"
stiffness = "3 N/m"
tolerance = 0.02
)";

/// A spring, stripes of adhesion and a rough lens that ends in holes, with free edges.
constexpr const char* lens = R"(
block = { young = "20 MPa", poisson = 0.4 }
output = { checkpoint = "none" }
[surface]
kind = "file"
sites = 17
spacing = "2 nm"
file_missing = "hole"
boundary = "free"
[interface]
kind = "wall"
law = "power"
range = "1 nm"
adhesion = "stripes 10 mJ/m^2 30 mJ/m^2 7 nm"
[drive]
mode = "quasistatic"
path = ["approach", "pull-off"]
load = "5 nN"
displacement_step = "1 nm"
stiffness = "1 N/m"
tolerance = 0.02
)";

/// Writes a rough lens whose rim is no solid, Å.
void write_lens(const std::string& file) {
    std::ofstream to(file);
    for (int y = 0; y < 17; ++y)
        for (int x = 0; x < 17; ++x) {
            const double dx = x - 8.0, dy = y - 7.5, r2 = 400.0 * (dx * dx + dy * dy);
            const double height = -r2 / 2000.0 + 2.0 * std::sin(1.1 * x + 2.3 * y * y);
            if (r2 > 130.0 * 130.0)
                to << "nan";
            else
                to << height;
            to << (x < 16 ? ' ' : '\n');
        }
}

/// Returns a number of everything that a path has made of its last step.
std::uint64_t trace(const Path& path) {
    std::uint64_t hash = test::mix(static_cast<std::uint64_t>(path.status()), path.now());
    hash = test::mix(hash, static_cast<double>(path.iterations().value_or(0)));
    if (path.results().dissipated)
        for (const Instability& jump : path.results().dissipated->jumps)
            for (const double value : {jump.energy, jump.top, jump.force_after})
                hash = test::mix(hash, value);
    return test::mix(hash, path.results().edge_distance.value_or(-1.0));
}

/// Follows a path to its end; look(path) after each advance, false: not to go on.
template <class Look>
void follow(Path& path, const Look& look) {
    while (path.status() != Path::Status::done) {
        ASSERT_TRUE(path.advance({}));
        if (!look(path)) return;
    }
}

/// Returns the trace after each advance on these ranks.
std::vector<std::uint64_t> traces(const Case& c, const Surface& surface,
                                  const Communicator& ranks) {
    std::vector<std::uint64_t> all;
    const std::unique_ptr<Path> path = path_of(c, surface, ranks);
    follow(*path, [&](const Path& at) {
        all.push_back(trace(at));
        return true;
    });
    EXPECT_GT(path->results().dissipated->events, 0) << "on the spring it jumps";
    return all;
}

/// Follows a path in so many parts, each by objects of its own that begin from a checkpoint.
void expect_parts(const Case& c, const Surface& surface, const std::string& file,
                  const std::vector<std::uint64_t>& whole, std::size_t parts) {
    std::size_t at = 0;
    for (std::size_t part = 1; part <= parts; ++part) {
        const std::unique_ptr<Path> path = path_of(c, surface, world());
        if (part > 1) {
            read_checkpoint(
                file, world(), path->grid(),
                [&](const StateNumbers& all) {
                    RestoreNumbers numbers(all);
                    path->restore(numbers);
                    return path->arrays_to_restore();
                },
                "it");
            path->restored();
        }
        const std::size_t end = whole.size() * part / parts;
        follow(*path, [&](const Path& now) {
            EXPECT_EQ(trace(now), whole[at]) << "advance " << at << " in part " << part;
            return ++at < end && !testing::Test::HasFailure();
        });
        world().barrier();
        CollectNumbers numbers;
        path->collect(numbers);
        write_checkpoint(file, world(), path->grid(), path->arrays(), numbers.numbers, "it");
    }
    EXPECT_EQ(at, whole.size());
}

void expect_same_bits(const char* scene, const std::vector<std::string>& overrides,
                      const std::string& checkpoint) {
    const Case alone = read_case_text(scene, "experiment.toml", overrides);
    const Case shared = read_case_text(scene, "experiment.toml", overrides, world().size());
    std::vector<std::uint64_t> whole;
    {
        const test::Threads one(1);
        if (world().root()) whole = traces(alone, surface_of(alone), Communicator());
        whole.resize(test::from_root([&] { return whole.size(); }));
        world().broadcast(std::as_writable_bytes(std::span(whole)));
        EXPECT_GT(whole.size(), 20u);
    }
    // Threads of several ranks would wait for processors.
    const test::Threads threads(world().size() > 1 ? 1 : 2);
    if (world().size() == 1) {
        EXPECT_EQ(traces(alone, surface_of(alone), Communicator()), whole) << "two threads";
    }
    expect_parts(shared, surface_of(shared, world()), checkpoint, whole, 4);
}

} // namespace

TEST(ExperimentRanks, OfAFilmOnASpringAreTheSameBits) {
    const test::SharedScratch scratch("film");
    expect_same_bits(film, {}, scratch.file);
}

TEST(ExperimentRanks, OfALensWithFreeEdgesAreTheSameBits) {
    const test::SharedScratch scratch("lens");
    const std::string map = scratch.directory + "/lens.txt";
    if (world().root()) write_lens(map);
    world().barrier();
    expect_same_bits(lens, {"surface.file=" + map}, scratch.file);
}
