// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/run/series.hpp"

namespace asperity {

namespace {

// Runs that have a column: all, those with an effect, quasi-static ones, those in which time
// passes.
constexpr auto all = [](const Effects&) { return true; };
template <Effect Effects::*effect>
constexpr auto with = [](const Effects& effects) { return bool(effects.*effect); };
constexpr auto at_rest = [](const Effects& effects) { return !effects.dynamic; };
constexpr auto in_time = [](const Effects& effects) { return effects.dynamic || effects.branches; };

constexpr SeriesColumn columns[] = {
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
    {all,
     {"series/interface_energy", "eV", io::per::block, "energy of the interface"},
     [](const Path&, const StepRecord& now) { return now.interface_energy; },
     "energy.interface"},
    {with<&Effects::branches>,
     {"series/branch_energy", "eV", io::per::block,
      "part of elastic_energy in the branches of a viscoelastic block"},
     [](const Path&, const StepRecord& now) { return now.branch_energy; },
     "energy.branches"},
    {with<&Effects::spring>,
     {"series/spring_energy", "eV", io::per::block,
      "part of elastic_energy in the spring that holds the top plane"},
     [](const Path&, const StepRecord& now) { return now.machine_energy; },
     "energy.spring"},
    {all,
     {"series/elastic_energy", "eV", io::per::block, "elastic energy"},
     [](const Path&, const StepRecord& now) { return now.elastic_energy; },
     "energy.elastic"},
    {with<&Effects::dynamic>,
     {"series/kinetic_energy", "eV", io::per::block, "kinetic energy"},
     [](const Path&, const StepRecord& now) { return now.kinetic_energy; }},
    {with<&Effects::temperature>,
     {"series/time_step_energy", "eV", io::per::block,
      "at a temperature: -(dt²/8) Σ F²/m, part of the energy balance"},
     [](const Path&, const StepRecord& now) { return now.time_step_energy; },
     "energy.time_step"},
    {all,
     {"series/work", "eV", io::per::block,
      "work of the drive on the solids, counted from rest apart, as energy.work"},
     [](const Path&, const StepRecord& now) { return now.work; },
     "energy.work"},
    {with<&Effects::dynamic>,
     {"series/work_of_interface", "eV", io::per::block,
      "work of the interface's force on the mean height since the start, ∫ F dz"},
     [](const Path&, const StepRecord& now) { return now.interface_work; }},
    {with<&Effects::dynamic>,
     {"series/damped", "eV", io::per::block,
      "energy damped since the start, minus the heat of the thermostat's noise"},
     [](const Path&, const StepRecord& now) { return now.damped; },
     "energy.damped"},
    {at_rest,
     {"series/dissipated", "eV", io::per::block,
      "energy dissipated at instabilities since the start"},
     [](const Path&, const StepRecord& now) { return now.damped; },
     "energy.damped"},
    {with<&Effects::branches>,
     {"series/dissipated_in_block", "eV", io::per::block,
      "energy dissipated by the branches of a viscoelastic block since the start"},
     [](const Path&, const StepRecord& now) { return now.dissipated_in_block; },
     "energy.dissipated_in_block"},
    {all,
     {"series/balance_error", "1", "largest term",
      "energy balance: work - energies - loss, divided by the largest energy or work so far"},
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
    {all,
     {"series/closest", "Å", "",
      "smallest distance from a site to an atom; infinite beyond the interaction range"},
     [](const Path&, const StepRecord& now) { return now.closest; }},
};

} // namespace

std::span<const SeriesColumn> series_columns() { return columns; }

std::vector<io::Quantity> series_quantities() {
    std::vector<io::Quantity> list;
    for (const SeriesColumn& c : columns)
        list.push_back(c.quantity);
    return list;
}

} // namespace asperity
