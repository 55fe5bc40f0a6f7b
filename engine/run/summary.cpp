// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/run/summary.hpp"

#include "engine/device/device_block.hpp"
#include "engine/run/run_result.hpp"
#include "engine/statics/zero_load.hpp"
#include "engine/units.hpp"
#include "io/terminal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace asperity {

namespace {

using Sentences = std::vector<std::string>;

/// Fraction of the work of adhesion of flat surfaces below which solids do not stick.
constexpr double no_adhesion = 0.01;
/// Share of the box's edge within which a contact is said to come near a free edge.
constexpr double near_edge = 0.05;

/// Returns a force on the box as people read it: a pressure, or of a bounded contact a
/// force.
std::string force_text(const Case& c, double force) {
    if (c.in_newtons()) return io::cell(force / units::nanonewton, 4) + " nN";
    return io::number(force / (c.area() * units::megapascal), 1) + " MPa";
}

std::string levels_text(const Case& c) {
    if (c.simulation.block.continuum) return "static response, wave by wave";
    if (!c.effects.dynamic) return "static response of the lattice, wave by wave";
    const auto& levels = c.levels;
    const char* strain = c.simulation.block.finite_strain ? "; finite strain" : "";
    if (levels.size() == 1)
        return fmt::format("one lattice of {} layers{}", levels.front().cells, strain);
    const auto& block = c.simulation.block;
    const double all = static_cast<double>(block.sites) * block.sites * block.thickness;
    return fmt::format("{} levels, {:.3g} nodes for {:.3g} atoms{}", levels.size(),
                       nodes_of(levels), all, strain);
}

std::string surface_text(const Case& c, const Surface& surface) {
    if (c.surface.kind == SurfaceKind::flat) return "flat";
    const auto& s = surface.statistics;
    const std::string atoms = surface.atoms.size() > 0
                                  ? fmt::format("{} atoms, topmost ones: ", surface.atoms.size())
                                  : std::string();
    const std::string text = atoms + fmt::format("rms {} Å, rms slope {}, heights {} to {} Å",
                                                 io::number(s.rms, 3), io::number(s.rms_slope, 3),
                                                 io::number(s.lowest, 2), io::number(s.highest, 2));
    return surface.pair ? fmt::format("{}: the sum of two, of rms {} and {} Å and correlation {}",
                                      text, io::number(surface.pair->own.rms, 3),
                                      io::number(surface.pair->counter.rms, 3),
                                      io::number(surface.pair->correlation, 2))
                        : text;
}

using Number = std::optional<double>;

/// Numbers of a result by their names.
struct Numbers {
    const io::Result& result;
    Number operator()(io::Key key) const { return result.number(key); }
};

std::string number(Number value, int digits) { return value ? io::number(*value, digits) : "-"; }

/// Returns an energy over an area in meV/Å² and mJ/m²: "55.60 (891)".
std::string energies(Number value, int digits = 2) {
    if (!value) return "-";
    return fmt::format("{} ({})", io::number(*value, digits),
                       io::cell(*value * units::millijoule_per_square_metre, 3));
}

/// Returns an energy over an area with its units: "55.60 meV/Å² (891 mJ/m²)".
std::string with_units(double value) {
    return fmt::format("{} meV/Å² ({} mJ/m²)", io::number(value, 2),
                       io::cell(value * units::millijoule_per_square_metre, 3));
}

/// Works, energies and heights of a run as people read them: energies over the nominal area, those
/// of a bounded contact whole, in aJ; heights in Å, or beside forces in nN in nm.
class DisplayUnits {
public:
    explicit DisplayUnits(const Case& c)
        : to_attojoules_(c.in_newtons() ? 1e-3 * c.area() / units::attojoule : 0.0),
          nanometres_(c.in_newtons()) {}
    /// Returns whether energies are those of the whole contact.
    bool is_whole() const { return to_attojoules_ > 0.0; }
    /// Returns an energy over the nominal area, meV/Å^2, without its unit.
    std::string energy(Number value) const {
        if (!is_whole() || !value) return energies(value);
        return io::cell(*value * to_attojoules_, 4);
    }
    /// Returns an energy over the nominal area, meV/Å^2, with its unit.
    std::string with_unit(double value) const {
        return is_whole() ? energy(value) + " aJ" : with_units(value);
    }
    /// Returns a part of an energy that stands before it with its unit.
    std::string part(double value) const {
        return is_whole() ? energy(value) : io::number(value, 2);
    }
    /// Returns an uncertainty of such an energy, in the first of its units.
    std::string uncertainty(Number value) const {
        return value ? fmt::format("{:.1e}", *value * (is_whole() ? to_attojoules_ : 1.0)) : "-";
    }
    std::string unit_of_uncertainty() const { return is_whole() ? "aJ" : "meV/Å²"; }
    std::string height(double value) const {
        return io::number(nanometres_ ? 0.1 * value : value, nanometres_ ? 3 : 2);
    }
    std::string_view unit_of_height() const { return nanometres_ ? "nm" : "Å"; }
    /// Returns the unit of a number of the result; "" of a pure number.
    std::string unit(io::Key key) const {
        std::string unit(io::unit_of(key));
        if (unit == "1") return "";
        if (unit == "meV/Å^2") unit = is_whole() ? "aJ" : "meV/Å² (mJ/m²)";
        if (unit == "Å") unit = unit_of_height();
        if (const std::size_t at = unit.find("^2"); at != std::string::npos)
            unit.replace(at, 2, "²");
        return unit;
    }

private:
    double to_attojoules_; ///< aJ over meV/Å^2; zero: energies are over the area
    bool nanometres_;
};

/// Returns the works of the drive of all segments of the last cycle, meV/Å^2.
double works_in_cycle(const PathResults& results) {
    double sum = 0.0;
    bool ended = false;
    for (auto s = results.segments.rbegin(); s != results.segments.rend(); ++s) {
        if (s->kind == Segment::pull_off && std::exchange(ended, true)) break;
        if (ended) sum += s->energies[Term::work].value_or(0.0);
    }
    return sum;
}

/// Prints whether the losses of a quasi-static path are those of the box.
void print_limits_of_losses(Sentences& to, const Case& c) {
    if (c.effects.dynamic || !c.box_jumps()) return;
    const DisplayUnits display(c);
    const std::optional<double> loss = c.flat_loss();
    io::print_text(
        to,
        "  The longest waves of the box jump, however smooth the surfaces are: works "
        "and the energy "
        "lost are those of a box of this width, not of the surface{}.\n",
        loss ? fmt::format("; flat surfaces lose about {} in it", display.with_unit(*loss))
             : std::string());
}

/// Prints works and losses of a whole path.
void print_cycle(Sentences& to, const Case& c, const PathResults& results, const Numbers& of,
                 double flat) {
    const DisplayUnits display(c);
    if (c.effects.temperature) {
        io::print_text(to, "  The works of the drive contain heat of the thermostat.\n");
        return;
    }
    std::string remembered; // losses of memories
    for (const io::EnergyTerm& row : io::energy_terms)
        if (const Number energy = results.in_cycle[row.term];
            energy && row.kind == io::EnergyTerm::dissipated)
            remembered += fmt::format("{} are {}, ", display.with_unit(*energy), row.words());
    if (!remembered.empty()) {
        const double lost = of("lost.cycle").value_or(0.0);
        io::print_text(to,
                       "  From the approach to the end of the pull-off the works "
                       "of the drive add up to {}: {}and {} are lost at instabilities.\n",
                       display.with_unit(works_in_cycle(results)), remembered,
                       display.with_unit(lost));
        const Number unclear = of("dissipated.not_followed");
        if (unclear && *unclear > 0.0)
            io::print_text(
                to,
                "  Of what was lost {} eV went in steps that are long beside the shortest "
                "time of block.prony: the block may have dissipated a part of it.\n",
                io::number(*unclear, 2));
        return;
    }
    if (!c.is_cycle() && !results.segments.empty()) {
        if (const Number lost = of("lost.cycle"))
            io::print_text(to, "  From the approach to the end of the pull-off {} are lost.\n",
                           display.with_unit(*lost));
        return;
    }
    const double lost =
        of("lost.cycle").value_or(*of("work_of_drive.approach") + *of("work_of_drive.pull_off"));
    const double scale = flat > 0.0 ? flat
                                    : std::max(std::abs(*of("work_of_drive.pull_off")),
                                               std::abs(*of("work_of_drive.approach")));
    const bool hardly = std::abs(lost) <= 0.01 * scale;
    if (hardly)
        io::print_text(
            to,
            "  The works of the drive on the solids, in and out, add up to {}: hardly anything "
            "is lost.\n",
            display.with_unit(std::abs(lost)));
    else
        io::print_text(
            to,
            "  The works of the drive on the solids, in and out, add up to {}: energy that is "
            "{}.\n",
            display.with_unit(lost),
            !c.effects.dynamic ? "lost at instabilities"
            : c.effects.spring ? "damped, or left in motion and in the spring at the end"
                               : "damped, or left in motion at the end");
    print_limits_of_losses(to, c);
    if (of("lost.approach") && c.simulation.drive.load_force == 0.0)
        io::print_text(
            to, "  Binding energy = -(work of the drive on the approach) + {}{}.\n",
            !c.effects.dynamic ? "energy lost there"
            : c.effects.spring ? "energy lost + energy left in motion and in the spring"
                               : "energy lost + energy left in motion",
            c.effects.dynamic ? "" : " = work of the drive on the pull-off - energy lost there");
    if (of("work_of_interface.approach") && c.effects.dynamic)
        io::print_text(to,
                       "  The work of the interface is that of its force on the mean height of the "
                       "surface: a jump of the whole block does not change it, jumps of single "
                       "patches do.\n");
    if (!hardly && c.jumps_as_a_whole())
        io::print_text(to, "  A thick block is a soft spring and jumps as a whole; a thinner one "
                           "(block.thickness) less so.\n");
}

/// Prints what became of a surface that yields.
void print_yielding(Sentences& to, const Case& c, const PathResults& results, const Numbers& of) {
    const DisplayUnits display(c);
    const SegmentResults& most =
        *std::max_element(results.segments.begin(), results.segments.end(),
                          [](const SegmentResults& a, const SegmentResults& b) {
                              return a.yielding.at_hardness < b.yielding.at_hardness;
                          });
    const YieldState& last = results.segments.back().yielding;
    io::print_text(
        to,
        "  The surface yields: {} % of its sites are at the hardness at the end of \"{}\". At the "
        "end the mean set is {}, the largest {} {}, and the rms slope has become {} (before {}). "
        "The plastic work is the energy dissipated in the surface. A cap on the pressure: no "
        "pile-up and no hardening.\n",
        io::number(100.0 * c.fraction(most.yielding.at_hardness), 2), c.path()[most.number].text,
        display.height(last.mean_set), display.height(last.largest_set), display.unit_of_height(),
        io::number(*of("yielding.slope_after"), 4), io::number(*of("yielding.slope_before"), 4));
    if (const auto area = of("theory.capped.contact_fraction")) {
        const SegmentResults& pressed = most_pressed(results);
        io::print_text(to,
                       "  Persson's theory with a cap (no adhesion, the pressure absorbed at 0 and "
                       "at the hardness) has at the {} MPa of \"{}\" a contact of {}, of which {} "
                       "are at the hardness; here {} and {}.\n",
                       io::number(*of("theory.capped.pressure"), 1), c.path()[pressed.number].text,
                       io::number(*area, 4), io::number(*of("theory.capped.yielding_fraction"), 4),
                       io::number(c.fraction(pressed.in_contact), 4),
                       io::number(c.fraction(pressed.yielding.at_hardness), 4));
    }
    if (const double tension = *of("yielding.tension_over_hardness"); tension > 1.0)
        io::print_text(to,
                       "  The largest tension of flat surfaces is {} times the hardness: beside "
                       "contacts the attraction is more than such a solid bears, and tension does "
                       "not yield here.\n",
                       io::number(tension, 2));
}

/// Returns the number and the first words of a segment: "1 slide x 128 nm".
std::string short_name(const Case& c, const SegmentResults& s) {
    std::string text = c.path()[s.number].text;
    for (const char* condition : {" under load", " until steady"})
        if (const std::size_t at = text.find(condition); at != std::string::npos) text.resize(at);
    return fmt::format("{} {}", s.number, text);
}

/// Returns the segments of a path that has others than approach and pull-off, a column each.
SummaryTable table_of_segments(const Case& c, const PathResults& results) {
    const DisplayUnits display(c);
    const bool newtons = c.in_newtons();
    const double force_unit = newtons ? units::nanonewton : c.area() * units::megapascal;
    SummaryTable table{"segment"};
    for (const SegmentResults& s : results.segments)
        table.columns.push_back(short_name(c, s));
    const auto put = [&](const std::string& name, const std::string& unit, auto&& value_of) {
        SummaryRow row{name, unit};
        for (const SegmentResults& s : results.segments)
            row.values.push_back(value_of(s));
        table.rows.push_back(std::move(row));
    };
    using Of = const SegmentResults&;
    put("work of the drive", display.unit("segments[].work_of_drive"),
        [&](Of s) { return display.energy(s.energies[Term::work]); });
    for (const io::EnergyTerm& row : io::energy_terms)
        if (row.is_loss() && c.effects.has(row.effect))
            put(row.words(), display.unit(io::Key::of("segments[].", row)),
                [&](Of s) { return display.energy(s.energies[row.term]); });
    if (!c.effects.dynamic)
        put("stored", display.unit("segments[].stored"),
            [&](Of s) { return display.energy(s.stored); });
    put("ends at",
        display.unit(newtons ? io::Key("segments[].force") : io::Key("segments[].pressure")),
        [&](Of s) { return number(s.force / force_unit, newtons ? 3 : 1); });
    put("mean height", display.unit("segments[].mean_height"),
        [&](Of s) { return display.height(s.mean_height); });
    put("contact", "", [&](Of s) { return number(c.fraction(s.in_contact), 4); });
    if (c.effects.yielding) {
        put("at the hardness", "",
            [&](Of s) { return number(c.fraction(s.yielding.at_hardness), 4); });
        put("mean set", display.unit("segments[].mean_set"),
            [&](Of s) { return display.height(s.yielding.mean_set); });
    }
    if (c.effects.sliding)
        put("friction", newtons ? "nN" : display.unit("segments[].friction"), [&](Of s) {
            const Number f = s.lateral_mean;
            return number(f && newtons ? Number(*f / force_unit) : f, 2);
        });
    return table;
}

/// Tells the means of steady slides, and which segments ended at another load than their own.
void print_ends(Sentences& to, const Case& c, const PathResults& results) {
    if (c.effects.dynamic) return;
    for (const SegmentResults& s : results.segments) {
        if (!s.steady) continue;
        const SteadySlide& mean = *s.steady;
        const double megapascal = 1.0 / (c.area() * units::megapascal);
        std::string text = fmt::format(
            "  {}: friction {} MPa", short_name(c, s),
            io::with_error(mean.friction * megapascal, mean.friction_error * megapascal));
        if (mean.load > 0.0)
            text +=
                fmt::format(", coefficient {}", io::with_error(mean.friction / mean.load,
                                                               mean.friction_error / mean.load));
        io::print_text(to, "{}, contact area {}, after {:.4g} Å{}{}.\n", text,
                       io::with_error(mean.area / c.sites(), mean.area_error / c.sites()),
                       mean.running_in, mean.mesh_error > 0.0 ? "" : " (mesh not included)",
                       mean.steady
                           ? "; steady"
                           : "; not steady yet: the friction still drifts at its end, and a longer "
                             "slide tells more");
    }
    for (const SegmentResults& s : results.segments) {
        const Segment& asked = c.path()[s.number];
        if (asked.kind != Segment::load || asked.amount == 0.0 ||
            std::abs(s.force - asked.amount) <= 1.1 * load_accuracy * std::abs(asked.amount))
            continue;
        io::print_text(to,
                       "  \"{}\" ended at {}: the force jumps across the load there, and no "
                       "state that this path passes is under it.\n",
                       c.path()[s.number].text, force_text(c, s.force));
    }
}

} // namespace

std::string progress_phase(const Case& c, const std::string& segment, double force,
                           long long in_contact, double mean_height) {
    const DisplayUnits display(c);
    return fmt::format("{}, {}, contact {:.3f}, height {} {}", segment, force_text(c, force),
                       c.fraction(in_contact), display.height(mean_height),
                       display.unit_of_height());
}

namespace {

/// Returns a stress, eV/Å^3, in a unit of its size: "0.53", "GPa".
std::pair<std::string, std::string> stress_text(double stress) {
    constexpr std::pair<double, const char*> sizes[] = {
        {units::gigapascal, "GPa"}, {units::megapascal, "MPa"}, {1e-3 * units::megapascal, "kPa"}};
    for (const auto& [size, unit] : sizes)
        if (std::abs(stress) >= 0.1 * size || size == sizes[2].first)
            return {fmt::format("{:.3g}", stress / size), unit};
    return {};
}

/// Returns numbers that the sentences of the summary contain, or that an instrument measures: the
/// terminal has no table of them.
SummaryTable table_for_pages(const Case& c, const Numbers& of) {
    const DisplayUnits display(c);
    SummaryTable table{"", {""}};
    table.for_pages = true;
    const auto row = [&](const std::string& name, const std::string& unit, const std::string& value,
                         bool detail = false) {
        table.rows.push_back({name, unit, {value}, detail});
    };
    if (const Number radius = of("instrument.contact_radius")) {
        row("contact radius", "nm", io::cell(*radius));
        if (const Number error = of("instrument.contact_radius_uncertainty"))
            row("mesh", "nm", fmt::format("{:.1e}", *error), true);
    }
    if (const Number averaged = of("jkr.approach_averaged"))
        row("largest attraction of the approach as a JKR sphere, averaged over 2 ps",
            "meV/Å² (mJ/m²)", energies(averaged));
    if (const Number force = of("pull_off_force"); force && !c.in_newtons()) {
        const auto [stress, unit] = stress_text(*force / c.area());
        row("pull-off stress", unit, stress);
        row("in all", "nN", io::cell(*force / units::nanonewton), true);
    }
    for (const io::EnergyTerm& loss : io::energy_terms)
        if (const Number lost = loss.is_loss() ? of(io::Key::of("", loss, ".cycle")) : Number())
            row((loss.term == Term::lost ? "energy " : "") + loss.words() + " in a cycle",
                display.unit(io::Key::of("", loss, ".cycle")), display.energy(lost));
    return table;
}

/// Returns the description of a wall, with the field of its work of adhesion.
std::string wall_text(const Case& c) {
    const auto& field = c.simulation.interface.maps[SiteMapOf::adhesion];
    if (!field) return "a wall; ";
    return fmt::format("a wall; work of adhesion \"{}\", {} to {}; on average ", field->source,
                       with_units(field->least), with_units(field->largest));
}

} // namespace

void print_opening(std::FILE* to, const Case& c, const Surface& surface, const ProcessGrid& grid,
                   int threads, std::size_t bytes, const std::string& directory) {
    const InterfaceOptions& interface = c.simulation.interface;
    io::print_text(to, "{}: {}\n", c.scene.name, c.box_in_words());
    io::print_text(to, "  substrate   {}{}\n", surface_text(c, surface),
                   c.radius() ? fmt::format(", on a sphere of R = {:.6g} nm", 0.1 * *c.radius())
                              : "");
    io::print_text(to, "  block       {}: {}\n", c.block_in_words(), levels_text(c));
    io::print_text(to,
                   "  interface   {}flat surfaces bind with {} at {} Å; interaction range {} Å; "
                   "{} precision\n",
                   interface.wall ? wall_text(c) : "", with_units(c.flat.work_of_adhesion),
                   io::number(c.flat.separation, 2), io::number(reach_of(interface), 2),
                   interface.mixed ? "mixed" : "double");
    io::print_text(to, "  machine     {}, {} thread{} each, {:.{}f} MB a rank\n", grid.describe(),
                   threads, threads == 1 ? "" : "s", static_cast<double>(bytes) / 1e6,
                   bytes < 10'000'000 ? 1 : 0);
    if (c.simulation.device)
        io::print_text(to, "  device      {}, {:.0f} MB of its memory a rank\n",
                       describe_device(c.simulation.device),
                       static_cast<double>(
                           DeviceLayout(c.simulation.block, grid, c.simulation.interface).bytes) /
                           1e6);
    io::print_text(to, "  results     {}\n", directory);
    for (const std::string& note : c.notes)
        io::print_text(to, "  note: {}\n", note);
    for (const std::string& note : surface.notes)
        io::print_text(to, "  note: {}\n", note);
    const double height = surface.statistics.highest + reach_of(interface);
    if (const std::string note = rounding_note(c, height); !c.effects.dynamic && !note.empty())
        io::print_text(to, "  note: {}\n", note);
    std::fflush(to);
}

namespace {

/// A run whose numbers are summarised.
struct Run {
    const Case& c;
    Numbers of;
    DisplayUnits display{c};
    double flat = of("delta_gamma").value_or(0.0); ///< binding energy of flat surfaces, meV/Å²
    bool has_atoms = c.surface.kind == SurfaceKind::atoms;

    /// Returns the load of the state in words: "at zero load".
    std::string at() const {
        const double load = c.simulation.drive.load_force;
        if (!c.has(Segment::relax) || load == 0.0) return "at zero load";
        return "under " + (c.in_newtons() ? force_text(c, load)
                                          : fmt::format("{:.6g} MPa", c.load_in_megapascal()));
    }
    /// Returns the name of the row of a number over flat().
    std::string flat_text() const {
        return fmt::format("over {}, {}", has_atoms ? "one flat layer" : "flat on flat",
                           energies(flat));
    }
    std::string over_flat(Number value) const {
        return number(value && flat != 0.0 ? Number(*value / flat) : Number(), 4);
    }
    /// Returns an error by the spacing, or that there is none.
    static std::string of_mesh(const std::string& error) {
        return error == "-" ? std::string("not included") : error;
    }
};

/// Returns the numbers of the state without a load, or under drive.load.
SummaryTable table_of_state(const Run& run) {
    const auto& [c, of, display, flat, has_atoms] = run;
    SummaryTable table{"state " + run.at(), {""}};
    const auto row = [&](const std::string& name, const std::string& unit, const std::string& value,
                         bool detail = false) {
        table.rows.push_back({name, unit, {value}, detail});
    };
    row("binding energy", display.unit("binding_energy"), display.energy(of("binding_energy")));
    if (!display.is_whole()) row(run.flat_text(), "", run.over_flat(of("binding_energy")), true);
    row("convergence", display.unit_of_uncertainty(),
        display.uncertainty(of("binding_energy_uncertainty")), true);
    if (c.has_mesh())
        row("mesh", display.unit_of_uncertainty(),
            Run::of_mesh(display.uncertainty(of("mesh_error.binding_energy"))), true);
    row("energy of the pairs alone", display.unit("pair_binding_energy"),
        display.energy(of("pair_binding_energy")));
    row("elastic energy stored", display.unit("relaxed.elastic_energy"),
        display.energy(of("relaxed.elastic_energy")));
    row("contact fraction", "", number(of("contact_fraction"), 4));
    if (const Number area = of("contact_area"))
        row("area, less half sites of its edges", "",
            of("contact_area_uncertainty") ? io::with_error(*area, *of("contact_area_uncertainty"))
                                           : number(area, 4),
            true);
    row("repulsive sites, fraction", "", number(of("repulsive_fraction"), 4));
    return table;
}

/// Returns the numbers of approach and pull-off.
SummaryTable table_of_path(const Run& run) {
    const auto& [c, of, display, flat, has_atoms] = run;
    const auto error_of_force = [&](Number v) {
        return v ? fmt::format("{:.1e}", *v / (c.in_newtons() ? units::nanonewton : 1.0)) : "-";
    };
    SummaryTable table{"path", {"approach", "pull-off"}};
    const auto put = [&](const std::string& name, const std::string& unit, const std::string& in,
                         const std::string& out, bool detail = false) {
        table.rows.push_back({name, unit, {in, out}, detail});
    };
    const auto row = [&](const std::string& name, io::Key key, Number in, Number out) {
        if (in || out) put(name, display.unit(key), display.energy(in), display.energy(out));
    };
    const auto work = [&](const std::string& name, io::Key key, Number in, Number out) {
        row(name, key, in, out);
        if ((in || out) && !display.is_whole())
            put(run.flat_text(), "", run.over_flat(in), run.over_flat(out), true);
    };
    const Number drive_in = of("work_of_drive.approach"), drive_out = of("work_of_drive.pull_off");
    work("work of the interface", "work_of_interface.approach", of("work_of_interface.approach"),
         of("work_of_interface.pull_off"));
    work("work of the drive", "work_of_drive.approach", drive_in, drive_out);
    for (const io::EnergyTerm& loss : io::energy_terms)
        if (loss.is_loss())
            row((loss.term == Term::lost ? "energy " : "") + loss.words(),
                io::Key::of("", loss, ".approach"), of(io::Key::of("", loss, ".approach")),
                of(io::Key::of("", loss, ".pull_off")));
    if (c.effects.branches)
        row("energy stored", "stored.approach", of("stored.approach"), of("stored.pull_off"));
    row("energy left in motion", "kinetic.approach", of("kinetic.approach"),
        of("kinetic.pull_off"));
    row("energy left in the spring", "spring.approach", of("spring.approach"),
        of("spring.pull_off"));
    if (of("work_of_drive.uncertainty.approach") || of("work_of_drive.uncertainty.pull_off"))
        put("convergence of the above", display.unit_of_uncertainty(),
            display.uncertainty(of("work_of_drive.uncertainty.approach")),
            display.uncertainty(of("work_of_drive.uncertainty.pull_off")));
    if (c.has_mesh() && (drive_in || drive_out))
        put("mesh", display.unit_of_uncertainty(),
            Run::of_mesh(display.uncertainty(of("mesh_error.work_of_drive.approach"))),
            Run::of_mesh(display.uncertainty(of("mesh_error.work_of_drive.pull_off"))));
    if (c.in_newtons())
        put("largest attraction", display.unit("instrument.pull_off_force"),
            number(of("instrument.approach_force"), 3), number(of("instrument.pull_off_force"), 3));
    else
        put("largest attraction", display.unit("pull_off_force"), number(of("approach_force"), 1),
            number(of("pull_off_force"), 1));
    if (c.has_mesh())
        put("mesh", "", Run::of_mesh(error_of_force(of("mesh_error.approach_force"))),
            Run::of_mesh(error_of_force(of("mesh_error.pull_off_force"))), true);
    const Number jkr_in = of("jkr.approach"), jkr_out = of("jkr.pull_off");
    if (jkr_in || jkr_out) // a work of adhesion, over the area in contact
        put("as a JKR sphere", "meV/Å² (mJ/m²)", energies(jkr_in), energies(jkr_out), true);
    return table;
}

/// Tells what the numbers mean.
void tell_meaning(Sentences& to, const Run& run, const PathResults& results) {
    const auto& [c, of, display, flat, has_atoms] = run;
    const std::string at = run.at();
    const Number state = of("binding_energy"), drive_in = of("work_of_drive.approach");
    if (state)
        io::print_text(
            to,
            "  The state {} has a binding energy of {}{}: {} of the pairs across the interface, "
            "less {} of elastic energy in {}. {} % of {} are in contact.\n",
            at, display.with_unit(*state),
            flat > 0.0 && !display.is_whole()
                ? fmt::format(", {} % of that of {}", io::number(100.0 * *state / flat, 1),
                              has_atoms ? "one flat layer of the block's lattice"
                                        : "two flat surfaces")
                : std::string(),
            display.part(*of("pair_binding_energy")), display.part(*of("relaxed.elastic_energy")),
            c.simulation.block.counter ? "the two solids" : "the block",
            io::number(100.0 * *of("contact_fraction"), 1),
            c.simulation.interface.wall ? "the sites" : "the block's surface atoms");
    if (state && flat > 0.0 && !display.is_whole() && *state < no_adhesion * flat)
        io::print_text(
            to, "  No adhesion {}: the solids do not stick (below {:.0f} % of flat on flat).\n", at,
            100.0 * no_adhesion);
    if (c.simulation.block.finite_strain)
        io::print_text(
            to, "  At finite strain no state at zero load is given: states are sums of waves, "
                "which do not add up.\n");
    if (const Number pinning = of("jkr.edge_pinning"))
        io::print_text(
            to,
            "  Rows of sites hold the edge of the contact: the pull-off force, and as a JKR "
            "sphere what follows from it, are about {:.3g} times too large.\n",
            *pinning);
    if (const Number edge = of("instrument.edge_distance");
        edge && *edge < 0.1 * near_edge * c.edge())
        io::print_text(
            to,
            "  The contact comes within {} nm of a free edge of the box, where the substrate "
            "ends: it is that of this piece. A contact that is to end by itself takes "
            "a wider box (surface.sites).\n",
            io::cell(*edge));
    if (drive_in && of("work_of_drive.pull_off")) print_cycle(to, c, results, of, flat);
    if (c.effects.yielding && !results.segments.empty()) print_yielding(to, c, results, of);
    if (const Number residual = of("energy.balance_error")) {
        std::string losses = of("dissipated.energy") ? "dissipated" : "damped";
        for (const io::EnergyTerm& row : io::energy_terms)
            if (row.kind == io::EnergyTerm::dissipated && c.effects.has(row.effect))
                losses += " + energy " + row.words();
        io::print_text(
            to,
            "  Energy balance: work on the solids = kinetic + elastic + interface energy + "
            "energy {}{}, to {:.1e} of the largest so far.\n",
            losses, of("energy.time_step") ? " + energy of the time step" : "",
            std::abs(*residual));
    }
    if (state || drive_in || c.has_mesh())
        io::print_text(to,
                       "  Convergence: residual error of the solver.{} Cutoff, {}thickness, width, "
                       "velocity and "
                       "the choice of the surface are not included: asperity estimate.\n",
                       c.has_mesh() ? " Mesh: error by the spacing, by rule; "
                                      "numbers without one do not include it."
                                    : "",
                       c.has_mesh() ? "" : "spacing, ");
}

} // namespace

Summary summary_of(const Case& c, const io::Result& result, const PathResults& results) {
    Summary summary;
    const Run run{c, {result}};
    const Numbers& of = run.of;
    if (of("binding_energy")) summary.tables.push_back(table_of_state(run));
    if (of("work_of_drive.approach") || of("work_of_drive.pull_off") || of("approach_force"))
        summary.tables.push_back(table_of_path(run));
    if (SummaryTable table = table_for_pages(c, of); !table.rows.empty())
        summary.tables.push_back(std::move(table));
    if (!c.is_cycle() && !results.segments.empty()) {
        summary.tables.push_back(table_of_segments(c, results));
        print_ends(summary.tables.back().sentences, c, results);
    }
    tell_meaning(summary.sentences, run, results);
    return summary;
}

void add_summary(const Summary& summary, io::Result& result) {
    const auto plain = [](std::string_view text) {
        text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
        return std::string(text.substr(0, text.find_last_not_of('\n') + 1));
    };
    result.set_list("rows[]");
    Sentences all;
    std::size_t i = 0;
    for (const SummaryTable& table : summary.tables) {
        for (const SummaryRow& row : table.rows) {
            result.set("rows[].table", i, table.head);
            result.set("rows[].columns", i, table.columns);
            result.set("rows[].name", i, row.name);
            result.set("rows[].detail", i, row.detail);
            result.set("rows[].unit", i, row.unit);
            result.set("rows[].texts", i, row.values);
            ++i;
        }
        for (const std::string& text : table.sentences)
            all.push_back(plain(text));
    }
    for (const std::string& text : summary.sentences)
        all.push_back(plain(text));
    result.set("sentences", std::move(all));
}

void print_summary(std::FILE* to, const Summary& summary, const std::string& directory) {
    constexpr std::size_t side_by_side = 3;
    for (const SummaryTable& of : summary.tables) {
        for (std::size_t first = 0; first < of.columns.size() && !of.for_pages;
             first += side_by_side) {
            const auto some = [&](std::vector<std::string> cells, const auto& from) {
                const std::size_t end = std::min(from.size(), first + side_by_side);
                for (std::size_t i = first; i < end; ++i)
                    cells.push_back(from[i]);
                return cells;
            };
            io::Table table(some({of.head}, of.columns));
            for (const SummaryRow& row : of.rows)
                table.row(some({(row.detail ? "  " : "") + row.name +
                                (row.unit.empty() ? "" : ", " + row.unit)},
                               row.values));
            fmt::print(to, "\n");
            table.print(to);
        }
        for (const std::string& text : of.sentences)
            io::print_text(to, "{}", text);
    }
    if (directory.empty()) return;
    io::print_text(to, "\nHow to read it\n");
    for (const std::string& text : summary.sentences)
        io::print_text(to, "{}", text);
    io::print_text(
        to, "  Everything is in {}: result.json (these numbers), run.h5 (the path and the maps).\n",
        directory);
    std::fflush(to);
}

} // namespace asperity
