// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/run/summary.hpp"

#include "engine/run/states_record.hpp"
#include "engine/scene/accuracy.hpp"
#include "engine/units.hpp"
#include "io/table.hpp"
#include "theory/jkr.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace asperity {

namespace {

std::string levels_text(const Scene& scene, const Setup& setup) {
    if (scene.block.model == BlockModel::spectral)
        return "the lattice's static answer, wave by wave";
    const auto& levels = setup.levels;
    const char* strain = scene.block.strain == Strain::finite ? "; finite strain" : "";
    if (levels.size() == 1)
        return fmt::format("one lattice of {} layers{}", levels.front().cells, strain);
    long long nodes = 0;
    for (const LevelPlan& l : levels)
        nodes += static_cast<long long>(l.sites) * l.sites * l.cells;
    const auto& block = setup.simulation.block;
    const double all = static_cast<double>(block.sites) * block.sites * block.thickness;
    return fmt::format("{} levels, {:.3g} nodes stand for {:.3g} atoms{}", levels.size(),
                       static_cast<double>(nodes), all, strain);
}

std::string surface_text(const Scene& scene, const Surface& surface) {
    if (scene.surface.kind == SurfaceKind::flat) return "flat";
    const auto& s = surface.statistics;
    return fmt::format("rms {:.3f} Å, rms slope {:.3f}, heights {:.2f} to {:.2f} Å", s.rms,
                       s.rms_slope, s.lowest, s.highest);
}

} // namespace

void print_opening(std::FILE* to, const Scene& scene, const Setup& setup, const Surface& surface,
                   const ProcessGrid& grid, int threads, std::size_t bytes,
                   const std::string& directory) {
    const auto& block = setup.simulation.block;
    fmt::print(to, "{}: {} x {} sites, {:.1f} Å wide\n", scene.name, block.sites, block.sites,
               scene.edge());
    fmt::print(to, "  substrate   {}{}\n", surface_text(scene, surface),
               scene.surface.radius
                   ? fmt::format(", on a sphere of R = {:.6g} Å", *scene.surface.radius)
                   : "");
    fmt::print(to, "  block       {} layers ({:.1f} Å): {}\n", block.thickness,
               block.thickness * block.spacing, levels_text(scene, setup));
    fmt::print(to,
               "  interface   flat on flat {:.2f} meV/Å² at {:.2f} Å with the cutoff of {:.2f} Å, "
               "pairs in "
               "{} precision\n",
               setup.flat.work_of_adhesion, setup.flat.separation, scene.interface.cutoff,
               setup.simulation.interface.mixed ? "single" : "double");
    if (scene.choice) {
        const char* head = "accuracy";
        for (const std::string& line : accuracy_lines(*scene.choice))
            fmt::print(to, "  {:<11} {}\n", std::exchange(head, ""), line);
    }
    fmt::print(to, "  machine     {}, {} thread{} each, {:.0f} MB a rank\n", grid.describe(),
               threads, threads == 1 ? "" : "s", static_cast<double>(bytes) / 1e6);
    if (setup.simulation.device.kind != DeviceChoice::Kind::none)
        fmt::print(
            to, "  device      {}, {:.0f} MB of its memory a rank\n",
            describe_device(setup.simulation.device),
            static_cast<double>(DeviceBlock::bytes_for(block, grid, setup.simulation.interface)) /
                1e6);
    fmt::print(to, "  results     {}\n", directory);
    for (const std::string& note : setup.notes)
        fmt::print(to, "  note: {}\n", note);
    for (const std::string& note : surface.notes)
        fmt::print(to, "  note: {}\n", note);
    std::fflush(to);
}

void print_summary(std::FILE* to, const Scene& scene, const Setup& setup, const Findings& findings,
                   double residual, const std::string& directory) {
    const double flat = setup.flat.work_of_adhesion;
    const auto number = [](std::optional<double> v, int digits = 2) {
        return v ? fmt::format("{:.{}f}", *v, digits) : std::string("-");
    };
    const auto& z = findings.zero_load;
    const auto of_state = [&](auto member) -> std::optional<double> {
        if (!z) return std::nullopt;
        return (*z).*member;
    };
    const std::optional<double> state = of_state(&ZeroLoad::binding_energy);
    const auto share = [&](std::optional<double> v) -> std::optional<double> {
        if (!v || flat == 0.0) return std::nullopt;
        return *v / flat;
    };
    io::Table table({"", "approach", "pull-off", "state at zero load"});
    table.row({"work of adhesion, meV/Å²", number(findings.approach), number(findings.pull_off),
               number(state)});
    table.row({fmt::format("  over flat on flat ({:.2f})", flat),
               number(share(findings.approach), 4), number(share(findings.pull_off), 4),
               number(share(state), 4)});
    if (const auto& lost = findings.dissipated) {
        const double per_area = units::milli_per_unit / (scene.edge() * scene.edge());
        table.row({"lost where it fell, meV/Å²",
                   scene.has(PathPart::approach) ? number(per_area * lost->approach) : "-",
                   scene.has(PathPart::pull_off) ? number(per_area * lost->pull_off) : "-", ""});
    }
    const auto force = [&](double f, bool there) -> std::string {
        return there && f > 0.0 ? fmt::format("{:.1f}", f) : "-";
    };
    table.row({"largest attraction, eV/Å",
               force(findings.attraction_in, findings.approach.has_value()),
               force(findings.attraction_out, findings.pull_off.has_value()), "0"});
    if (scene.surface.radius) {
        const auto jkr = [&](double f, bool there) -> std::string {
            return there && f > 0.0
                       ? fmt::format("{:.2f}",
                                     units::milli_per_unit *
                                         theory::jkr::work_from_pull_off(f, *scene.surface.radius))
                       : "-";
        };
        table.row({"  as a JKR sphere, meV/Å²",
                   jkr(findings.attraction_in, findings.approach.has_value()),
                   jkr(findings.attraction_out, findings.pull_off.has_value()), ""});
    }
    table.row({"contact area fraction", "", "", number(of_state(&ZeroLoad::contact_fraction), 4)});
    table.row({"sites pushed, fraction", "", "", number(of_state(&ZeroLoad::pushed_fraction), 4)});
    table.row({"elastic energy stored, meV/Å²", "", "", number(of_state(&ZeroLoad::elastic))});
    table.row({"atom-by-atom work, meV/Å²", "", "", number(of_state(&ZeroLoad::pairwise))});
    fmt::print(to, "\n");
    table.print(to);
    fmt::print(to, "\n");
    fmt::print(to, "How to read it\n");
    if (z)
        fmt::print(to,
                   "  The state at zero load binds with {:.2f} meV/Å², {:.1f} % of what two flat "
                   "surfaces would:\n"
                   "  the bonds give {:.2f}, and {:.2f} of it is spent on bending the solids into "
                   "contact.\n"
                   "  {:.1f} % of the block's surface atoms are in contact.\n",
                   z->binding_energy, 100.0 * z->binding_energy / flat, z->pairwise, z->elastic,
                   100.0 * z->contact_fraction);
    if (findings.states) print_states(to, *findings.states);
    if (findings.approach && findings.pull_off && z) {
        const double lost = *findings.pull_off - *findings.approach;
        fmt::print(to, "  Approach and pull-off are the work of the interface's force on the mean "
                       "surface. Where nothing\n"
                       "  snaps, both equal the state's energy");
        if (lost < 0.01 * flat)
            fmt::print(to, ", as they do here to {:.2f} meV/Å².\n", std::abs(lost));
        else
            fmt::print(to,
                       "; pull-off minus approach, {:.2f} meV/Å², is energy that\n"
                       "  snapping in and off has turned into vibrations (hysteresis). {}\n",
                       lost,
                       scene.drive.hold == Hold::mean_height
                           ? "With the mean height held, the\n  surface did so in patches, not as "
                             "a whole."
                           : "A thick block is a soft spring and\n  snaps as a whole; a thinner "
                             "one (block.thickness) follows the interface more closely.");
    }
    if (std::isfinite(residual))
        fmt::print(to,
                   "  Energy balance: work done = energy gained + energy {}, to {:.1e} of the "
                   "largest term.\n",
                   findings.dissipated ? "lost" : "damped", std::abs(residual));
    fmt::print(
        to, "  Everything is in {}: result.json (these numbers), run.h5 (the path and the maps).\n",
        directory);
    std::fflush(to);
}

} // namespace asperity
