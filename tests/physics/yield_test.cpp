// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A surface that yields at its hardness: the law of a site, spheres and rough maps against closed
// forms and numbers of other solvers, and the books of cycles.
#include "engine/case/case.hpp"
#include "engine/case/wall_shape.hpp"
#include "engine/interface/over_wall.hpp"
#include "engine/scene/heights.hpp"
#include "engine/units.hpp"
#include "io/error.hpp"
#include "support/cases.hpp"
#include "support/path_case.hpp"
#include "support/run_scene.hpp"

#include <fftw3.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <fstream>
#include <numbers>
#include <random>
#include <string>
#include <vector>

using namespace asperity;

namespace {

using std::numbers::pi;

/// Contact modulus of the scenes below, GPa.
constexpr double plane_modulus = 10.0;

/// Returns a scene of a wall on a quasi-static path, of these lines of [surface], [interface] and
/// [drive].
std::string scene_of(const std::string& surface, const std::string& interface,
                     const std::string& drive, const std::vector<std::string>& path) {
    std::string list;
    for (const std::string& segment : path)
        list += (list.empty() ? "\"" : ", \"") + segment + "\"";
    return fmt::format("[surface]\n{}\n[block]\nyoung = {}\npoisson = 0\n[interface]\nkind = "
                       "\"wall\"\n{}\n[drive]\nmode = \"quasistatic\"\n{}\npath = [{}]\n",
                       surface, plane_modulus, interface, drive, list);
}

/// Converts an energy per area, meV/Å^2, to GPa Å.
double gigapascal_length(double energy) {
    return energy / (units::milli_per_unit * units::gigapascal);
}

std::string load_of(double megapascal) { return fmt::format("load {:.12g} MPa", megapascal); }

double of_segment(const test::Written& run, std::size_t i, const char* name) {
    return run.json["segments"][i][name].get<double>();
}

/// The map of three octaves at n x n points of a unit box, with an rms slope of 0.08: waves of 4
/// to 32 periods with the amplitude |k|^-1.8 and quadratic phases. Deep valleys are where its
/// formula has summits.
std::vector<double> three_octaves(int n) {
    std::vector<std::complex<double>> wave(static_cast<std::size_t>(n * n));
    double slope2 = 0.0;
    for (int ky = -32; ky <= 32; ++ky)
        for (int kx = 0; kx <= 32; ++kx) {
            const double k = std::hypot(kx, ky);
            if ((kx == 0 && ky <= 0) || k < 4.0 || k > 32.0) continue;
            const double turns =
                0.6180339887 * kx * kx + 0.4142135624 * ky * ky + 0.7320508076 * kx * ky;
            const double amplitude = std::pow(k, -1.8);
            wave[static_cast<std::size_t>((ky + n) % n * n + kx)] =
                std::polar(amplitude, 2.0 * pi * (turns - std::floor(turns)));
            slope2 += 0.5 * std::pow(2.0 * pi * k * amplitude, 2);
        }
    Bands({}, n).transform(wave, FFTW_BACKWARD);
    std::vector<double> h;
    for (const std::complex<double>& value : wave)
        h.push_back(-value.real() * 0.08 / std::sqrt(slope2));
    return h;
}

/// Writes a map of n x n heights as text. Returns the path.
std::string written(const io::Scratch& scratch, const std::vector<double>& h, int n) {
    const std::string file = scratch / "map.txt";
    std::ofstream to(file);
    for (int y = 0; y < n; ++y) {
        for (int x = 0; x < n; ++x)
            to << fmt::format("{:.17g} ", h[static_cast<std::size_t>(y * n + x)]);
        to << "\n";
    }
    return file;
}

/// Returns the text of the problems of a scene; empty if it may run.
std::string problems_of(const std::string& scene) {
    try {
        read_case_text(scene, "yield.toml").require_runnable();
        return "";
    } catch (const io::SceneError& error) {
        std::string text;
        for (const io::Problem& p : error.problems())
            text += p.where + " " + p.what + " " + p.why + " " + p.fix + "\n";
        return text;
    }
}

} // namespace

/// The force of a site is that of its law, and no more than that of the hardness; its rest on a
/// spring is where the two forces are equal. For each law, of one work of adhesion or one for each
/// site, and a hardness for each site.
TEST(Yield, SitesBearTheirHardnessAndNoMore) {
    constexpr int n = 16;
    constexpr double a = 2.6, spring = 3.0;
    const WallShape power = WallShape::power(3.0), eight_two = WallShape::eight_two();
    std::mt19937 random(3);
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution(low, high)(random);
    };
    for (const WallLaw& law :
         {WallLaw(ExponentialWall(0.7, 1.3, 24.0)), WallLaw(ExponentialWall(0.0, 1.0, 24.0)),
          WallLaw(ShapedWall(power.shape(), 0.7, 3.9, 24.0)),
          WallLaw(ShapedWall(eight_two.shape(), 0.7, 2.3, 0.0)),
          WallLaw(SmearedWall(LennardJones{0.1, 3.28, 13.12}, 0.15, false))}) {
        InterfaceOptions options = test::over(law);
        auto hardness = std::make_shared<SiteMap>();
        hardness->sites = n;
        for (int i = 0; i < n * n; ++i)
            hardness->values.push_back(between(0.5, 30.0)); // GPa
        options.hardness = 0.0;
        options.maps[SiteMapOf::hardness] = hardness;
        const Surface surface = test::scattered(n, n * a, 0.5, 5);
        test::PathCase c(test::paper_block(n, n, 0), surface, options);
        const OverWall& wall = *c.interface.yielding_wall();
        const PlaneView<double> set = c.interface.set().plane(0), u = c.block.layer().z.plane(0);
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x)
                set(x, y) = between(0.0, 0.4), u(x, y) = between(-3.0, 3.0);
        c.interface.set_reference_height(1.0);
        const InterfaceSums sums =
            c.interface.sweep(c.block.lowest_layer(), c.block.interface_force(), {.observe = true});
        double energy = 0.0;
        int yielding = 0;
        const auto force_of = [&](double gap) {
            return std::visit([&](const auto& l) { return l.force(gap); }, law);
        };
        std::vector<float> still(n, 0.0F);
        std::vector<double> none(n, 0.0), next(n), z(n);
        for (int y = 0; y < n; ++y) {
            for (int x = 0; x < n; ++x) {
                const double most = hardness->at(x, y) * units::gigapascal * a * a;
                const double below = surface.height[static_cast<std::size_t>(y * n + x)];
                const double gap = 1.0 + u(x, y) - (below - set(x, y));
                const bool yields = force_of(gap) > most;
                yielding += yields;
                EXPECT_NEAR(c.block.interface_force().z(x, y), std::min(force_of(gap), most),
                            1e-9 * most);
                EXPECT_NEAR(wall.yield_force(x, y), most, 1e-9 * most);
                EXPECT_EQ(wall.stiffness_at(x, y, gap) == 0.0 && gap < 0.0, yields && gap < 0.0);
                const double at_yield = gap + wall.growth(x, y, 1.0 + u(x, y));
                EXPECT_NEAR(force_of(at_yield), std::min(force_of(gap), most), 1e-9 * most);
                energy += std::visit([&](const auto& l) { return l.energy(at_yield); }, law);
                z[static_cast<std::size_t>(x)] = u(x, y);
            }
            // The attraction is that of the place before: from its rest a site does not move.
            for (int i = 0; i < 200; ++i) {
                const WallRow<double> row{.u = z.data(),
                                          .step = still.data(),
                                          .elastic = none.data(),
                                          .next = next.data()};
                wall.rest_row(y, row,
                              {.reference_height = 1.0,
                               .spring = spring,
                               .momentum = 0.0,
                               .norm = 1.0,
                               .load = 0.0},
                              n);
                for (int x = 0; x < n; ++x) { // the spring stays where it was
                    const auto at = static_cast<std::size_t>(x);
                    none[at] = spring * (next[at] - u(x, y));
                }
                z = next;
            }
            for (int x = 0; x < n; ++x) {
                const double at = next[static_cast<std::size_t>(x)];
                EXPECT_NEAR(spring * (u(x, y) - at) + wall.force(x, y, 1.0 + at), 0.0, 1e-6);
            }
            none.assign(n, 0.0);
        }
        EXPECT_GT(yielding, 20);
        EXPECT_LT(yielding, n * n - 20);
        ExactSum sum = sums.energy;
        EXPECT_NEAR(sum.value(), energy, 1e-9 * std::abs(energy));
    }
}

/// A sphere from its first yield to full plasticity, unloaded and loaded again, in units of the
/// load and depth at which it begins to yield. Numbers: rings, and closed forms from 30 loads on.
TEST(Yield, SphereYieldsAsRingsDo) {
    constexpr double hardness = 0.01, a = 10.0;
    constexpr int n = 64;
    constexpr double edge = n * a;
    struct Row {
        double load, area, depth, set, work; ///< area times H/F
    };
    struct Part {
        double first_yield; ///< radius of the contact that begins to yield, sites
        std::vector<Row> rows;
        double most; ///< relative error of depth and set
    };
    for (const Part& part :
         {Part{13.4,
               {{1.0, 1.5, 1.0, 0.0, 0.0},
                {1.5, 1.32, 1.3146, 0.0553, 0.0158},
                {3.0, 1.12, 2.148, 0.3491, 0.3751}},
               0.005},
          Part{24.0 / 8.16,
               {{30.0, 1.0, 13.625, 7.931, 113.75}, {100.0, 1.0, 39.95, 29.56, 1446.0}},
               0.015}}) {
        const double ratio = hardness / plane_modulus;
        const double radius = part.first_yield * a / (0.5 * pi * ratio);
        const double load = std::pow(pi, 3) * radius * radius * std::pow(ratio, 2) * hardness / 6.0;
        const double depth = pi * pi * radius * ratio * ratio / 4.0;
        const auto in_megapascal = [&](double loads) { return 1e3 * loads * load / (edge * edge); };
        std::vector<double> loads;
        for (const Row& row : part.rows)
            loads.push_back(row.load);
        const double most = loads.back();
        for (const double share : {0.75, 0.5, 0.25, 0.995})
            loads.push_back(share * most);
        std::vector<std::string> path = {"approach"};
        for (std::size_t i = 1; i < loads.size(); ++i)
            path.push_back(load_of(in_megapascal(loads[i])));
        const test::Written run(scene_of(
            fmt::format("kind = \"flat\"\nsites = {}\nspacing = {}\nboundary = \"free\"\nradius = "
                        "{:.17g}",
                        n, a, radius),
            fmt::format("adhesion = 0\nhardness = {}", hardness),
            fmt::format("load = {:.17g}", in_megapascal(loads[0])), path));
        const double contact = edge * edge * hardness / load; // area over contact area, as in rows
        double work = 0.0;
        for (std::size_t i = 0; i < part.rows.size(); ++i) {
            const Row& row = part.rows[i];
            SCOPED_TRACE(row.load);
            work += of_segment(run, i, "dissipated_in_surface");
            const double whole = gigapascal_length(work) * edge * edge / (load * depth);
            EXPECT_NEAR(-of_segment(run, i, "top_displacement") / depth, row.depth,
                        part.most * row.depth);
            EXPECT_NEAR(of_segment(run, i, "largest_set") / depth, row.set,
                        part.most * row.set + 1e-3);
            EXPECT_NEAR(whole, row.work, 2.0 * part.most * row.work + 1e-3);
            EXPECT_NEAR(of_segment(run, i, "contact_area") * contact / row.load, row.area,
                        0.015 * row.area);
        }
        const std::size_t top = part.rows.size() - 1;
        const double area = of_segment(run, top, "contact_fraction");
        const double set = of_segment(run, top, "mean_set");
        if (most >= 30.0) { // then the pressure is the hardness everywhere
            const double shares[] = {0.961, 0.837, 0.597};
            for (std::size_t i = 0; i < 3; ++i)
                EXPECT_NEAR(of_segment(run, top + 1 + i, "contact_fraction") / area, shares[i],
                            0.01);
        }
        for (std::size_t i = top + 1; i < loads.size(); ++i) {
            EXPECT_EQ(of_segment(run, i, "mean_set"), set) << i;
            EXPECT_EQ(of_segment(run, i, "dissipated_in_surface"), 0.0) << i;
        }
    }
}

/// A sphere that was pressed until it was at the hardness everywhere comes off as a body that is
/// flat under its contact (Mesarovic and Johnson, J. Mech. Phys. Solids 48, 2009 (2000)), with a
/// range of w/H.
TEST(Yield, PullOffGrowsWithThePreload) {
    constexpr double hardness = 0.01, a = 10.0, om = 0.3;
    constexpr int n = 48;
    constexpr double edge = n * a, contact = 15.0 * a;
    const double ratio = hardness / plane_modulus, radius = contact / (12.83 * ratio);
    const double work = om * hardness * ratio * contact; // GPa Å
    const double load = pi * contact * contact * hardness;
    double pull_off = 0.0;
    for (double x = 0.0; x <= 1.0; x += 1e-3)
        pull_off = std::max(pull_off, std::sqrt(8.0 * om / pi) * std::pow(x, 1.5) -
                                          2.0 / pi * (std::asin(x) - x * std::sqrt(1.0 - x * x)));
    const test::Written run(scene_of(
        fmt::format("kind = \"flat\"\nsites = {}\nspacing = {}\nboundary = \"free\"\nradius = "
                    "{:.17g}",
                    n, a, radius),
        fmt::format("adhesion = {:.17g}\nrange = {:.17g}\nhardness = {}\nedge_pinning = \"allow\"",
                    work * units::gigapascal * units::milli_per_unit, work / hardness, hardness),
        fmt::format("displacement_step = {:.6g}", 0.5 * work / hardness),
        {"approach", load_of(1e3 * load / (edge * edge)), "pull-off"}));
    const double force = of_segment(run, 2, "largest_attraction") / units::gigapascal; // GPa Å^2
    EXPECT_NEAR(force / load, pull_off, 0.05 * pull_off);
    EXPECT_NEAR(run("yielding.tension_over_hardness"), 1.0, 1e-3);
}

/// A map of three octaves against a solver of another kind (projected conjugate gradients for the
/// pressures between 0 and H, of the same half-space and 128 x 128 sites).
TEST(Yield, RoughMapIsThatOfAnotherSolver) {
    constexpr int n = 128;
    constexpr double edge = 2.0 * n;
    struct Row {
        double part, area, plastic, work; ///< load over hardness; work over E* times the volume
    };
    struct Path {
        double hardness; ///< over E*
        std::vector<Row> rows;
        double area, plastic; ///< of the last row by Persson's theory with a cap
    };
    const io::Scratch scratch;
    std::vector<double> h = three_octaves(n);
    for (double& value : h)
        value *= edge;
    const std::string file = written(scratch, h, n);
    for (const Path& path :
         {Path{0.02, {{0.5, 0.53174, 0.46832, 8.04768e-06}}, 0.5, 0.5},
          Path{0.05,
               {{0.1, 0.15991, 0.04517, 4.69895e-07}, {0.5, 0.62500, 0.37506, 9.81128e-06}},
               0.5271,
               0.4729},
          Path{0.1,
               {{0.3, 0.62201, 0.03644, 5.36087e-07},
                {0.7, 0.96088, 0.37842, 1.76543e-05},
                {0.99, 0.99994, 0.96063, 2.16281e-04}},
               0.9982,
               0.9801}}) {
        const double hardness = path.hardness * plane_modulus;
        std::vector<std::string> segments = {"approach"};
        for (std::size_t i = 1; i < path.rows.size(); ++i)
            segments.push_back(load_of(1e3 * path.rows[i].part * hardness));
        const test::Written run(scene_of(
            fmt::format("kind = \"file\"\nfile = \"{}\"\nsites = {}\nspacing = 2", file, n),
            fmt::format("adhesion = 0\nhardness = {}", hardness),
            fmt::format("control = \"mean-height\"\nload = {:.17g}",
                        1e3 * path.rows[0].part * hardness),
            segments));
        for (std::size_t i = 0; i < path.rows.size(); ++i) {
            const Row& row = path.rows[i];
            SCOPED_TRACE(fmt::format("H = {} E*, {} H", path.hardness, row.part));
            const double work = path.hardness * of_segment(run, i, "mean_set") / edge;
            EXPECT_NEAR(of_segment(run, i, "contact_fraction"), row.area, 0.01 * row.area);
            EXPECT_NEAR(of_segment(run, i, "yielding_fraction"), row.plastic, 0.01 * row.plastic);
            EXPECT_NEAR(work, row.work, 0.01 * row.work);
        }
        EXPECT_NEAR(run("theory.capped.pressure"), 1e3 * path.rows.back().part * hardness,
                    1.0 * hardness);
        EXPECT_NEAR(run("theory.capped.contact_fraction"), path.area, 2e-4);
        EXPECT_NEAR(run("theory.capped.yielding_fraction"), path.plastic, 2e-4);
        EXPECT_EQ(run("yielding.largest_fraction"),
                  of_segment(run, path.rows.size() - 1, "yielding_fraction"));
        EXPECT_LT(run("yielding.rms_after"), run("yielding.rms_before"));
        EXPECT_LT(run("yielding.slope_after"), run("yielding.slope_before"));
        double lost = 0.0;
        for (std::size_t i = 0; i < path.rows.size(); ++i)
            lost += of_segment(run, i, "dissipated_in_surface");
        const double set = of_segment(run, path.rows.size() - 1, "mean_set");
        EXPECT_NEAR(gigapascal_length(lost), hardness * set, 1e-9 * hardness * set);
    }
}

namespace {

const std::string rough_section = "sites = 32\nspacing = 2\nrms = 1\nseed = 4";

} // namespace

/// Three cycles of a surface that attracts: work = plastic work + loss in each, the loss is of the
/// attraction alone, and after the first cycle hardly anything yields.
TEST(Yield, BooksOfCyclesBalance) {
    std::vector<std::string> path;
    for (int i = 0; i < 3; ++i)
        for (const char* segment : {"approach", "load 200 MPa", "pull-off"})
            path.push_back(segment);
    const test::Written run(scene_of(rough_section, "adhesion = 5\nrange = 2\nhardness = 0.8",
                                     "control = \"mean-height\"", path));
    ASSERT_EQ(run.json["segments"].size(), path.size());
    std::vector<double> plastic;
    for (std::size_t cycle = 0; cycle < 3; ++cycle) {
        SCOPED_TRACE(cycle);
        double work = 0.0, losses = 0.0, in_surface = 0.0, stored = 0.0, largest = 0.0;
        for (std::size_t i = 3 * cycle; i < 3 * cycle + 3; ++i) {
            work += of_segment(run, i, "work_of_drive");
            in_surface += of_segment(run, i, "dissipated_in_surface");
            losses += of_segment(run, i, "lost");
            stored += of_segment(run, i, "stored");
            largest += std::abs(of_segment(run, i, "work_of_drive"));
        }
        EXPECT_NEAR(work, losses + in_surface, 1e-3 * largest);
        EXPECT_NEAR(stored, 0.0, 1e-3 * largest);
        EXPECT_GE(losses, 0.0);
        plastic.push_back(in_surface);
    }
    EXPECT_GT(plastic[0], 0.0);
    EXPECT_LT(plastic[1], 0.02 * plastic[0]); // a load is met to a thousandth
    EXPECT_LT(plastic[2], 0.02 * plastic[0]);
    const double set = run("yielding.mean_set");
    double all = 0.0;
    for (const double of_cycle : plastic)
        all += gigapascal_length(of_cycle);
    EXPECT_NEAR(all, 0.8 * set, 1e-9 * set);
    EXPECT_GT(run("yielding.tension_over_hardness"), 0.0);
}

/// The books of a loading and a pull-off with attraction, of each block and each machine: work =
/// plastic work + loss, the plastic work is H times the set, and a hardness that no site reaches
/// changes nothing.
TEST(Yield, BooksBalanceOnEachBlockAndMachine) {
    struct Kind {
        const char *name, *surface, *block, *drive;
    };
    const char *rough_map = "sites = 24\nspacing = 2\nrms = 0.8\nseed = 4",
               *tip = "kind = \"flat\"\nsites = 22\nspacing = 4\nradius = 60\nboundary = \"free\"";
    for (const Kind& kind : {Kind{"spring", rough_map, "", "stiffness = \"2 N/m\""},
                             Kind{"layers", rough_map, "layers = [[6, 30, 0.2], [10, 3, 0.4]]",
                                  "control = \"mean-height\""},
                             Kind{"free edges", tip, "", ""},
                             Kind{"free edges, layers and a spring", tip, "layers = [[6, 30, 0.2]]",
                                  "stiffness = \"20 N/m\""}}) {
        SCOPED_TRACE(kind.name);
        const auto run_of = [&](const char* hardness) {
            std::string scene = scene_of(
                kind.surface,
                fmt::format("adhesion = 5\nrange = 2\nedge_pinning = \"allow\"\nhardness = {}",
                            hardness),
                kind.drive, {"approach", "load 150 MPa", "pull-off"});
            const std::size_t at = scene.find("[interface]");
            return test::Written(scene.insert(at, std::string(kind.block) + "\n"));
        };
        const test::Written run = run_of("\"0.8 GPa\"");
        double work = 0.0, losses = 0.0, plastic = 0.0, largest = 0.0;
        for (std::size_t i = 0; i < 3; ++i) {
            work += of_segment(run, i, "work_of_drive");
            losses += of_segment(run, i, "lost");
            plastic += of_segment(run, i, "dissipated_in_surface");
            largest = std::max(largest, std::abs(of_segment(run, i, "work_of_drive")));
        }
        EXPECT_GT(plastic, 0.01 * largest);
        EXPECT_NEAR(work, losses + plastic, 1e-3 * largest);
        const double set = run("yielding.mean_set");
        EXPECT_NEAR(gigapascal_length(plastic), 0.8 * set, 1e-9 * set);
        EXPECT_EQ(of_segment(run, 2, "mean_set"), of_segment(run, 1, "mean_set"));
        if (kind.surface == tip) continue; // takes longer, and is one law with the others
        const test::Written elastic = run_of("\"none\""), hard = run_of("\"1e7 GPa\"");
        EXPECT_EQ(elastic.series("force"), hard.series("force"));
    }
}

/// Over four decades of the load: on steep roughness each site of the contact is at the hardness,
/// and its area is P/H; the set does not depend on the loads before.
TEST(Yield, AreaIsTheLoadOverTheHardnessOverFourDecades) {
    constexpr double hardness = 0.01;
    const double parts[] = {1e-4, 1e-3, 1e-2, 0.1, 0.3, 0.99};
    const std::string surface = "sites = 64\nspacing = 2\nrms = 8\nhurst = 0.5\nseed = 5";
    const auto run_of = [&](double first, const std::vector<std::string>& more) {
        std::vector<std::string> path = {"approach"};
        path.insert(path.end(), more.begin(), more.end());
        return test::Written(scene_of(
            surface, fmt::format("adhesion = 0\nhardness = {}", hardness),
            fmt::format("control = \"mean-height\"\nload = {:.12g}", 1e3 * first * hardness),
            path));
    };
    std::vector<std::string> more;
    for (std::size_t i = 1; i < std::size(parts); ++i)
        more.push_back(load_of(1e3 * parts[i] * hardness));
    const test::Written run = run_of(parts[0], more), once = run_of(parts[4], {});
    for (std::size_t i = 0; i < std::size(parts); ++i) {
        SCOPED_TRACE(parts[i]);
        EXPECT_NEAR(of_segment(run, i, "pressure"), 1e3 * parts[i] * hardness,
                    2e-3 * 1e3 * parts[i] * hardness);
        EXPECT_NEAR(of_segment(run, i, "contact_fraction"), parts[i],
                    0.03 * parts[i] + 1.0 / (64 * 64));
        if (i == 0) continue;
        EXPECT_GT(of_segment(run, i, "mean_set"), of_segment(run, i - 1, "mean_set"));
    }
    EXPECT_NEAR(of_segment(once, 0, "mean_set"), of_segment(run, 4, "mean_set"),
                2e-3 * of_segment(run, 4, "mean_set"));
}

/// At the height that has been reached before nothing yields, and at a lower one the set grows
/// only; the set does not depend on the number of steps.
TEST(Yield, SameHeightSetsNothingAnew) {
    const auto sets = [](const std::string& drive) {
        const test::Written run(
            scene_of(rough_section, "adhesion = 0\nhardness = 0.5", drive,
                     {"approach", "height 0.5 Å", "height 2 Å", "height 0.5 Å", "height 0.2 Å"}));
        std::vector<double> list;
        for (std::size_t i = 0; i < 5; ++i)
            list.push_back(of_segment(run, i, "mean_set"));
        return list;
    };
    const std::string held = "control = \"mean-height\"\ndisplacement_step = ";
    const std::vector<double> fine = sets(held + "0.05"), coarse = sets(held + "1");
    EXPECT_GT(fine[1], 0.0);
    EXPECT_EQ(fine[2], fine[1]);
    EXPECT_NEAR(fine[3], fine[1], 1e-5 * fine[1]);
    EXPECT_GT(fine[4], 1.05 * fine[1]);
    for (std::size_t i = 1; i < 5; ++i)
        EXPECT_NEAR(fine[i], coarse[i], 1e-3 * fine[i]) << i;
}

/// The heights less the set are a map for another scene: the dented surface bears the load that has
/// dented it elastically, in the same contact at the same height.
TEST(Yield, DentedSurfaceIsElasticUnderItsLoad) {
    const std::string drive = "control = \"mean-height\"";
    const std::vector<std::string> path = {"load 200 MPa"};
    const test::Written dented(
        scene_of(rough_section, "adhesion = 0\nhardness = 0.5", drive, path) +
        "[output]\nfields = [\"segments\"]\n");
    EXPECT_GT(dented("yielding.largest_set"), 1.0);
    const test::Written again(scene_of(
        fmt::format("kind = \"file\"\nfile = \"{}/run.h5:/fields/segment-0/yielded_height\"\nsites "
                    "= 32\nspacing = 2",
                    dented.directory),
        "adhesion = 0", drive, path));
    EXPECT_NEAR(again("surface.rms"), dented("yielding.rms_after"), 1e-9);
    EXPECT_NEAR(of_segment(again, 0, "mean_height"), of_segment(dented, 0, "mean_height"), 1e-3);
    EXPECT_NEAR(of_segment(again, 0, "contact_fraction"), of_segment(dented, 0, "contact_fraction"),
                0.002);
}

/// A hardness that no site reaches changes no bit of an elastic run.
TEST(Yield, HardIsElastic) {
    const std::vector<std::string> path = {"approach", "load 200 MPa", "pull-off"};
    for (const char* adhesion : {"adhesion = 0", "adhesion = 5\nrange = 2"}) {
        const std::string soft = std::string(adhesion) + "\nhardness = ";
        const test::Written elastic(scene_of(rough_section, soft + "\"none\"", "", path)),
            hard(scene_of(rough_section, soft + "\"1e7 GPa\"", "", path));
        for (const char* column :
             {"force", "mean_height", "work", "elastic_energy", "contact_fraction", "dissipated"})
            EXPECT_EQ(elastic.series(column), hard.series(column)) << column;
        EXPECT_EQ(hard("yielding.largest_set"), 0.0);
        EXPECT_FALSE(elastic.holds("yielding"));
    }
}

/// Under a map of the hardness each site has its own; a uniform map is one number, bit for bit.
TEST(Yield, HardnessMayDifferFromSiteToSite) {
    const std::vector<std::string> path = {"approach", "load 200 MPa"};
    const auto run_of = [&](const std::string& hardness) {
        return test::Written(scene_of(rough_section, "adhesion = 0\nhardness = " + hardness,
                                      "control = \"mean-height\"", path));
    };
    const test::Written one = run_of("0.5"), uniform = run_of("\"rings 0.5 GPa 0 20\""),
                        stripes = run_of("\"stripes 0.5 GPa 1000 GPa 64 Å\"");
    EXPECT_EQ(one.series("force"), uniform.series("force"));
    EXPECT_EQ(one.series("mean_set"), uniform.series("mean_set"));
    EXPECT_EQ(uniform("interface.hardness_least"), 0.5);
    EXPECT_EQ(stripes("interface.hardness_largest"), 1000.0);
    EXPECT_GT(stripes("yielding.mean_set"), 0.0);
    EXPECT_LT(stripes("yielding.mean_set"), one("yielding.mean_set"));
}

/// From a hundredth of the hardness to 0.99 of it, with and without attraction.
TEST(Yield, ConvergesUpToTheHardness) {
    int seed = 0;
    struct Map {
        double ratio, slope; ///< hardness over the modulus, rms slope about
        bool attracts;
    };
    for (const auto& [ratio, slope, attracts] : {Map{0.01, 0.05, true}, Map{0.01, 0.4, false},
                                                 Map{0.3, 0.05, false}, Map{0.3, 0.4, true}}) {
        SCOPED_TRACE(fmt::format("{} {} {}", ratio, slope, attracts));
        const double hardness = ratio * plane_modulus;
        std::vector<std::string> path = {"approach"};
        for (const double part : {0.01, 0.3, 0.99})
            path.push_back(load_of(1e3 * part * hardness));
        const std::string attraction =
            attracts ? fmt::format("adhesion = {:.6g}\nrange = 2\nedge_pinning = \"allow\"",
                                   units::milli_per_unit * units::gigapascal * 0.6 * hardness)
                     : "adhesion = 0";
        const test::Written run(scene_of(
            fmt::format("sites = 24\nspacing = 2\nrms = {}\nseed = {}", 5.0 * slope, ++seed),
            fmt::format("{}\nhardness = {}", attraction, hardness), "control = \"mean-height\"",
            path));
        const std::size_t last = path.size() - 1;
        EXPECT_GT(of_segment(run, last, "yielding_fraction"), 0.8);
        EXPECT_NEAR(of_segment(run, last, "pressure"), 990.0 * hardness, 1.5 * hardness);
    }
}

/// Sites that begin and end to yield, to touch and to part are exchanged in a few steps of Newton's
/// method (wall_newton.hpp): the minimiser, which follows where they go to and fro, takes thirty to
/// fifty products a point.
TEST(Yield, NextPointTakesAFewProducts) {
    for (const char* control : {"mean-height", "top"})
        for (const int sites : {32, 64}) {
            const test::Written run(scene_of(
                fmt::format("sites = {}\nspacing = 2\nhurst = 0.8\nrms = 4\nq_max = 8", sites),
                "adhesion = 0\nhardness = 0.2", fmt::format("control = \"{}\"", control),
                {"approach", load_of(20), load_of(100), load_of(180), "pull-off"}));
            EXPECT_GT(of_segment(run, 3, "yielding_fraction"), 0.5);
            const double points = static_cast<double>(run.series("force").size());
            EXPECT_LT(run("run.iterations") / points, 20.0) << control << " " << sites;
        }
}

/// Without attraction the way out ends at the first point at which the dented surfaces are apart,
/// far below the summits that there were, and the next approach finds the contact from there.
TEST(Yield, WayOutEndsWhereTheDentedSurfacesPart) {
    const test::Written run(
        scene_of("sites = 32\nspacing = 2\nhurst = 0.8\nrms = 1.1338\nq_max = 8\nseed = 9",
                 "adhesion = 0\nhardness = 0.2162", "control = \"mean-height\"",
                 {load_of(214.0), "pull-off", load_of(214.0), "pull-off"}));
    const std::vector<double> segment = run.series("segment"),
                              contact = run.series("contact_fraction"), force = run.series("force");
    for (const double way_out : {1.0, 3.0}) {
        int apart = 0;
        for (std::size_t i = 0; i < segment.size(); ++i)
            if (segment[i] == way_out && contact[i] == 0.0) {
                EXPECT_EQ(force[i], 0.0);
                ++apart;
            }
        EXPECT_EQ(apart, 1);
    }
    EXPECT_NEAR(of_segment(run, 2, "pressure"), 214.0, 0.22);
    EXPECT_NEAR(of_segment(run, 3, "mean_set"), of_segment(run, 1, "mean_set"),
                0.01 * of_segment(run, 1, "mean_set"));
}

/// What a surface that yields cannot have is refused by its name.
TEST(Yield, IsRefusedWhereItIsNotComputed) {
    const std::string wall = "adhesion = 0\nhardness = 0.5";
    const auto problems = [&](const std::string& drive, const std::vector<std::string>& path,
                              const std::string& more = "") {
        return problems_of(scene_of(rough_section, wall, drive, path) + more);
    };
    EXPECT_EQ(problems("", {"approach", "load 499 MPa"}), "");
    const auto names = [](const std::string& text, const char* name) {
        EXPECT_NE(text.find(name), std::string::npos) << name << ":\n" << text;
    };
    names(problems("", {"approach", "load 500 MPa"}), "load 500 MPa");
    names(problems("load = 501", {"approach"}), "hardness of 500 MPa");
    names(problems("", {"relax"}), "\"relax\" in drive.path");
    names(problems("", {"approach", "slide x 5"}), "over a surface that yields");
    names(problems_of("[surface]\nsites = 32\n[block]\nprony = [[1.0, 10.0]]\n[interface]\nkind = "
                      "\"wall\"\nhardness = 0.5\n[drive]\nmode = \"quasistatic\"\n"),
          "with block.prony");
    names(problems_of("[surface]\nsites = 32\n[interface]\nhardness = 0.5\n"), "without a wall");
    names(problems_of("[surface]\nsites = 32\n[interface]\nkind = \"wall\"\nhardness = 0.5\n"),
          "dynamic");
    names(problems_of(scene_of(rough_section, "adhesion = 0\nhardness = \"stripes 0 1 GPa 20\"", "",
                               {"approach"})),
          "0 at some sites");
}

/// A height at which the whole surface yields is no place to go to.
TEST(Yield, WholeSurfaceYieldsNoFurther) {
    const io::Scratch scratch;
    const Case c =
        read_case_text(scene_of(rough_section, "adhesion = 0\nhardness = 0.05",
                                "control = \"mean-height\"", {"approach", "height -4 Å"}),
                       "yield.toml");
    RunOptions options;
    options.out = scratch / "run";
    options.progress = io::ProgressMode::off;
    try {
        run(c, options, Communicator());
        ADD_FAILURE() << "the height was reached";
    } catch (const io::PhysicsError& error) {
        EXPECT_NE(std::string(error.what()).find("reached the hardness"), std::string::npos)
            << error.what();
    }
}
