// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A quasi-static path that is stopped, between points or within a relaxation, and resumed from a
// checkpoint is the same bits as one that never stopped, and as that of one rank.
#include "engine/case/wall_shape.hpp"
#include "engine/path/checkpoint.hpp"
#include "engine/statics/quasistatic.hpp"
#include "support/cases.hpp"
#include "support/world.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <random>
#include <string>
#include <vector>

using namespace asperity;

namespace {

using test::world;

constexpr int sites = 16;
const WallShape eight_two = WallShape::eight_two();

struct Kind {
    const char* name = "top";
    bool frictionless = false;
    Constraint::Of along = Constraint::Of::top;
    std::optional<WallLaw> wall = {};
    bool field = false; ///< a work of adhesion for each site
    int thickness = 60;
    bool slides = false;                 ///< between approach and pull-off
    std::vector<Branch> branches = {};   ///< of a viscoelastic block; it is held there
    std::optional<double> hardness = {}; ///< of a surface that yields, eV/Å^3
};

InterfaceOptions interface_of(const Kind& kind) {
    InterfaceOptions o = test::paper_interface();
    o.wall = kind.wall;
    if (kind.field) {
        auto field = std::make_shared<SiteMap>();
        field->sites = sites;
        field->largest = sites * sites;
        for (int i = 1; i <= sites * sites; ++i)
            field->values.push_back(i * 7 % 256 + 1);
        o.maps[SiteMapOf::adhesion] = field;
    }
    o.slides = kind.slides;
    o.hardness = kind.hardness;
    return o;
}

/// A soft block on a rough map: under a held top plane it snaps in.
struct Contact {
    BlockOptions options;
    Surface surface;
    ProcessGrid grid;
    Interface interface;
    SpectralBlock block;
    long long looks = 0;    ///< at relaxations so far
    long long stop_at = -1; ///< of these; -1: at none
    QuasistaticPath path;
    bool slides;

    explicit Contact(const Communicator& ranks, const Kind& kind = {})
        : options(block_of(kind)), surface(test::reference_surface("c1_N16_T16_rms0.5")),
          grid(ProcessGrid::slabs(ranks.size(), ranks.rank(), sites)),
          interface(surface, grid.tile(0), options.spacing, interface_of(kind)),
          block(options, ranks, kind.frictionless),
          path(block, interface, path_options(kind.along)), slides(kind.slides) {
        remember_sites(block, interface);
    }

    static BlockOptions block_of(const Kind& kind) {
        BlockOptions o = test::paper_block(sites, kind.thickness, 0);
        o.branches = kind.branches;
        return o;
    }

    PathOptions path_options(Constraint::Of along) {
        PathOptions o;
        o.along = along;
        o.step = 0.5;
        o.tolerance = 1e-3;
        o.scales = test::paper_scales();
        if (!options.branches.empty()) o.velocity = 1e-4;
        o.report = [this](long long, double) { return ++looks == stop_at; };
        return o;
    }
    using Outcome = QuasistaticPath::Outcome;
    Outcome advance() {
        const Outcome outcome = path.advance();
        if (outcome == Outcome::at_load && slides) {
            Segment slide{Segment::slide, 1.7, 1};
            if (interface.wall()) slide.under = 0.0;
            slide.until_steady = interface.wall() != nullptr;
            path.begin(slide, 1);
        } else if (outcome == Outcome::at_load && !options.branches.empty())
            path.begin({Segment::hold, 1e5}, 1);
        else if (outcome != Outcome::point && outcome != Outcome::interrupted)
            path.begin({Segment::pull_off}, 2);
        return outcome;
    }
    std::uint64_t trace() {
        std::uint64_t hash = test::mix(1, path.now());
        for (double value : {path.work(), static_cast<double>(path.iterations())})
            hash = test::mix(hash, value);
        for (const Instability& jump : path.dissipation().jumps)
            for (double value :
                 {jump.energy, jump.top, static_cast<double>(jump.site_x),
                  static_cast<double>(jump.site_y), static_cast<double>(jump.sites_moved)})
                hash = test::mix(hash, value);
        return hash;
    }
    void write(const std::string& file, const Communicator& ranks) {
        CollectNumbers collect;
        collect("path", path);
        write_checkpoint(file, ranks, grid, path.arrays(), collect.numbers, "it");
    }
    void read(const std::string& file, const Communicator& ranks) {
        const StateNumbers numbers = read_checkpoint(
            file, ranks, grid, [&](const auto&) { return path.arrays_to_restore(); }, "it");
        RestoreNumbers restore(numbers);
        restore("path", path);
        path.restored();
    }
};

/// The points of an undisturbed cycle: all, or so many.
std::vector<std::uint64_t> cycle(const Communicator& ranks, const Kind& kind, std::size_t most) {
    Contact contact(ranks, kind);
    contact.path.start();
    std::vector<std::uint64_t> points = {contact.trace()};
    for (auto last = QuasistaticPath::Outcome::point;
         last != QuasistaticPath::Outcome::apart && points.size() < most;) {
        last = contact.advance();
        points.push_back(contact.trace());
    }
    EXPECT_EQ(contact.path.now().largest_set > 0.0, kind.hardness.has_value()) << kind.name;
    const bool snaps = kind.along == Constraint::Of::top && kind.branches.empty();
    EXPECT_GT(contact.path.dissipation().events, snaps ? 0 : -1)
        << kind.name << " is meant to snap";
    return points;
}

} // namespace

TEST(QuasistaticRanks, ResumedItIsTheSameBits) {
    const test::SharedScratch scratch("quasistatic");
    const std::string& file = scratch.file;
    std::mt19937 random(7);
    for (const Kind& kind :
         {Kind{}, Kind{.name = "mean height", .along = Constraint::Of::mean_height},
          Kind{.name = "frictionless", .frictionless = true},
          Kind{.name = "slide", .thickness = 4, .slides = true},
          Kind{.name = "relaxing", .thickness = 20, .branches = {{1.5, 1e3}, {0.5, 2e4}}},
          Kind{.name = "slide over a wall",
          .frictionless = true,
          .along = Constraint::Of::mean_height,
          .wall = ExponentialWall(0.7, 0.4, 1000.0),
          .thickness = 20,
          .slides = true,
          .branches = {{1.5, 1e3}, {0.5, 2e4}}},
          Kind{.name = "wall", .frictionless = true, .wall = ExponentialWall(0.7, 0.4, 1000.0)},
          Kind{.name = "field",
          .frictionless = true,
          .wall = ExponentialWall(0.7, 0.4, 1000.0),
          .field = true},
          Kind{.name = "hardness",
          .frictionless = true,
          .wall = ExponentialWall(0.7, 0.4, 1000.0),
          .field = true,
          .hardness = 0.05},
          Kind{.name = "shape",
          .frictionless = true,
          .wall = ShapedWall(eight_two.shape(), 0.7, 0.6, 0.0),
          .field = true}}) {
        const std::size_t most = kind.slides || !kind.branches.empty() ? 90 : 45;
        const std::vector<std::uint64_t> whole = cycle(world(), kind, most);
        EXPECT_EQ(whole, cycle(Communicator(), kind, most)) << kind.name << " on one rank";
        // Each stretch by objects of its own.
        std::size_t point = 0;
        int stops = 0, within = 0;
        for (bool gone = false; !gone && point + 1 < whole.size(); ++stops) {
            const int stretch = std::uniform_int_distribution(1, 12)(random);
            const int looks = std::uniform_int_distribution(1, 10)(random);
            {
                Contact contact(world(), kind);
                if (point == 0)
                    contact.path.start();
                else
                    contact.read(file, world());
                contact.stop_at = stops % 2 == 0 ? looks : -1;
                for (int i = 0; i < stretch && !gone && point + 1 < whole.size(); ++i) {
                    const auto outcome = contact.advance();
                    if (outcome == QuasistaticPath::Outcome::interrupted) {
                        ++within;
                        break;
                    }
                    gone = outcome == QuasistaticPath::Outcome::apart;
                    ++point;
                    ASSERT_EQ(contact.trace(), whole[point])
                        << kind.name << ", point " << point << " after " << stops << " stops";
                }
                contact.write(file, world());
            }
            world().barrier();
        }
        EXPECT_EQ(point + 1, whole.size()) << kind.name;
        EXPECT_GT(stops, 6) << kind.name;
        EXPECT_GT(within, 0) << kind.name;
    }
}
