// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/run/series.hpp"

#include <fmt/format.h>

#include <deque>
#include <iterator>
#include <utility>

namespace asperity {

namespace {

// Runs that have a column: all, those with an effect, those in which time passes.
constexpr auto all = [](const Effects&) { return true; };
template <Effect Effects::*effect>
constexpr auto with = [](const Effects& effects) { return bool(effects.*effect); };
constexpr auto in_time = [](const Effects& effects) { return effects.dynamic || effects.branches; };

const SeriesColumn before_energies[] = {
    {all,
     {"series/step", "1", "", "time step; of a quasi-static path: point"},
     [](const Path&, const StepRecord& now) { return static_cast<double>(now.step); }},
    {in_time,
     {"series/time", "ps", "", "time, simulated or of the relaxation of a viscoelastic block"},
     [](const Path&, const StepRecord& now) { return now.time * 1e-3; }},
    {all,
     {"series/segment", "1", "", "number of the segment of drive.path, from 0"},
     [](const Path& p, const StepRecord&) { return static_cast<double>(p.segment()); }},
    {all,
     {"series/top_displacement", "Å", "", "displacement of the top plane"},
     [](const Path&, const StepRecord& now) { return now.top; }},
    {with<&Effects::spring>,
     {"series/drive_displacement", "Å", "",
      "displacement of the drive: of the far end of the spring that holds the top plane"},
     [](const Path&, const StepRecord& now) { return now.drive; }},
    {all,
     {"series/mean_height", "Å", "",
      "mean height of the lowest layer above the substrate's mean plane (its apex, if it is "
      "curved)"},
     [](const Path&, const StepRecord& now) { return now.mean_height; }},
    {all,
     {"series/force", "eV/Å", io::per::block,
      "normal force of the substrate on the lowest layer; repulsion is positive"},
     [](const Path&, const StepRecord& now) { return now.force; }},
    {all,
     {"series/top_force", "eV/Å", io::per::block, "elastic force on the top plane along z"},
     [](const Path&, const StepRecord& now) { return now.top_force; }},
    {with<&Effects::sliding>,
     {"series/slide_x", "Å", "",
      "place of the block over the substrate along x (paths that slide)"},
     [](const Path&, const StepRecord& now) { return now.slide[0]; }},
    {with<&Effects::sliding>,
     {"series/slide_y", "Å", "",
      "place of the block over the substrate along y (paths that slide)"},
     [](const Path&, const StepRecord& now) { return now.slide[1]; }},
    {with<&Effects::sliding>,
     {"series/lateral_force_x", "eV/Å", io::per::block,
      "force of the substrate on the lowest layer along x (paths that slide)"},
     [](const Path&, const StepRecord& now) { return now.lateral_force[0]; }},
    {with<&Effects::sliding>,
     {"series/lateral_force_y", "eV/Å", io::per::block,
      "force of the substrate on the lowest layer along y (paths that slide)"},
     [](const Path&, const StepRecord& now) { return now.lateral_force[1]; }},
};

const SeriesColumn after_energies[] = {
    {all,
     {"series/balance_error", "1", "largest term",
      "energy balance: work - energies - losses, divided by the largest energy or work so far"},
     [](const Path&, const StepRecord& now) { return now.residual; },
     "energy.balance_error"},
    {all,
     {"series/contact_fraction", "1", io::per::sites,
      "sites in contact: closer to an atom than the inflection of the pair potential; over a wall "
      "as contact_fraction of result.json"},
     [](const Path& p, const StepRecord& now) { return p.scene_case().fraction(now.in_contact); }},
    {all,
     {"series/repulsive_fraction", "1", io::per::sites,
      "sites whose net normal force is repulsive"},
     [](const Path& p, const StepRecord& now) { return p.scene_case().fraction(now.repulsive); }},
    {with<&Effects::yielding>,
     {"series/yielding_fraction", "1", io::per::sites,
      "sites whose net pressure is the hardness (interface.hardness) within 0.1 %"},
     [](const Path& p, const StepRecord& now) { return p.scene_case().fraction(now.at_hardness); }},
    {with<&Effects::yielding>,
     {"series/mean_set", "Å", "", "mean permanent set of a surface that yields"},
     [](const Path&, const StepRecord& now) { return now.mean_set; },
     "yielding.mean_set"},
    {with<&Effects::yielding>,
     {"series/largest_set", "Å", "", "largest permanent set of a site of a surface that yields"},
     [](const Path&, const StepRecord& now) { return now.largest_set; },
     "yielding.largest_set"},
    {all,
     {"series/closest", "Å", "",
      "smallest distance from a site to an atom; infinite beyond the interaction range"},
     [](const Path&, const StepRecord& now) { return now.closest; }},
};

/// Adds the column of a term, and that of quasi-static paths if it has another name.
void add_columns(const io::EnergyTerm& row, std::vector<SeriesColumn>& list) {
    // A quantity refers to its texts, which last as long as the program.
    static std::deque<std::string> texts;
    const auto add = [&](std::string_view name, std::function<bool(const Effects&)> is_in) {
        const bool since = row.is_loss();
        list.push_back(
            {std::move(is_in),
             {texts.emplace_back(fmt::format("series/{}", name)), "eV", io::per::block,
              texts.emplace_back(
                  fmt::format("{}{}", row.meaning, since ? ", since the start" : ""))},
             [&row](const Path&, const StepRecord& now) { return now[row.term]; },
             row.last.empty() ? row.last : texts.emplace_back(fmt::format("energy.{}", row.last))});
    };
    const auto is_on = [&row](const Effects& effects) { return effects.has(row.effect); };
    if (row.column_at_rest.empty()) return add(row.column, is_on);
    add(row.column, [=](const Effects& e) { return e.dynamic && is_on(e); });
    add(row.column_at_rest, [=](const Effects& e) { return !e.dynamic && is_on(e); });
}

} // namespace

const std::vector<SeriesColumn>& series_columns() {
    static const std::vector<SeriesColumn> columns = [] {
        std::vector<SeriesColumn> list(std::begin(before_energies), std::end(before_energies));
        for (const io::EnergyTerm& row : io::energy_terms)
            add_columns(row, list);
        list.insert(list.end(), std::begin(after_energies), std::end(after_energies));
        return list;
    }();
    return columns;
}

std::vector<io::Quantity> series_quantities() {
    std::vector<io::Quantity> list;
    for (const SeriesColumn& c : series_columns())
        list.push_back(c.quantity);
    return list;
}

} // namespace asperity
