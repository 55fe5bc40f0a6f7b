// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/run/series.hpp"

namespace asperity {

namespace {

constexpr SeriesColumn columns[] = {
    {SeriesColumn::both,
     {"series/step", "1", "", "time step; of a quasi-static path: point"},
     [](const Path& p) { return static_cast<double>(p.now().step); }},
    {SeriesColumn::time,
     {"series/time", "ps", "", "time, simulated or of the relaxation of a viscoelastic block"},
     [](const Path& p) { return p.now().time * 1e-3; }},
    {SeriesColumn::both,
     {"series/segment", "1", "", "number of the segment of drive.path, from 0"},
     [](const Path& p) { return static_cast<double>(p.segment()); }},
    {SeriesColumn::both,
     {"series/top_displacement", "Å", "", "displacement of the top plane"},
     [](const Path& p) { return p.now().top; }},
    {SeriesColumn::sprung,
     {"series/drive_displacement", "Å", "",
      "displacement of the drive: of the far end of the spring that holds the top plane"},
     [](const Path& p) { return p.now().drive; }},
    {SeriesColumn::both,
     {"series/mean_height", "Å", "",
      "mean height of the lowest layer above the substrate's mean plane (its apex, if it is "
      "curved)"},
     [](const Path& p) { return p.now().mean_height; }},
    {SeriesColumn::both,
     {"series/force", "eV/Å", io::per::block,
      "normal force of the substrate on the lowest layer; repulsion is positive"},
     [](const Path& p) { return p.now().force; }},
    {SeriesColumn::both,
     {"series/top_force", "eV/Å", io::per::block, "elastic force on the top plane along z"},
     [](const Path& p) { return p.now().top_force; }},
    {SeriesColumn::sliding,
     {"series/slide_x", "Å", "",
      "place of the block over the substrate along x (paths that slide)"},
     [](const Path& p) { return p.now().slide[0]; }},
    {SeriesColumn::sliding,
     {"series/slide_y", "Å", "",
      "place of the block over the substrate along y (paths that slide)"},
     [](const Path& p) { return p.now().slide[1]; }},
    {SeriesColumn::sliding,
     {"series/lateral_force_x", "eV/Å", io::per::block,
      "force of the substrate on the lowest layer along x (paths that slide)"},
     [](const Path& p) { return p.now().lateral_force[0]; }},
    {SeriesColumn::sliding,
     {"series/lateral_force_y", "eV/Å", io::per::block,
      "force of the substrate on the lowest layer along y (paths that slide)"},
     [](const Path& p) { return p.now().lateral_force[1]; }},
    {SeriesColumn::both,
     {"series/interface_energy", "eV", io::per::block, "energy of the interface"},
     [](const Path& p) { return p.now().interface_energy; }},
    {SeriesColumn::relaxing,
     {"series/branch_energy", "eV", io::per::block,
      "part of elastic_energy in the branches of a viscoelastic block"},
     [](const Path& p) { return p.now().branch_energy; }},
    {SeriesColumn::sprung,
     {"series/spring_energy", "eV", io::per::block,
      "part of elastic_energy in the spring that holds the top plane"},
     [](const Path& p) { return p.now().machine_energy; }},
    {SeriesColumn::both,
     {"series/elastic_energy", "eV", io::per::block, "elastic energy"},
     [](const Path& p) { return p.now().elastic_energy; }},
    {SeriesColumn::dynamic,
     {"series/kinetic_energy", "eV", io::per::block, "kinetic energy"},
     [](const Path& p) { return p.now().kinetic_energy; }},
    {SeriesColumn::thermal,
     {"series/time_step_energy", "eV", io::per::block,
      "at a temperature: -(dt²/8) Σ F²/m, part of the energy balance"},
     [](const Path& p) { return p.now().time_step_energy; }},
    {SeriesColumn::both,
     {"series/work", "eV", io::per::block,
      "work of the drive on the solids, counted from rest apart, as energy.work"},
     [](const Path& p) { return p.now().work; }},
    {SeriesColumn::dynamic,
     {"series/work_of_interface", "eV", io::per::block,
      "work of the interface's force on the mean height since the start, ∫ F dz"},
     [](const Path& p) { return p.now().interface_work; }},
    {SeriesColumn::dynamic,
     {"series/damped", "eV", io::per::block,
      "energy damped since the start, minus the heat of the thermostat's noise"},
     [](const Path& p) { return p.now().damped; }},
    {SeriesColumn::quasistatic,
     {"series/dissipated", "eV", io::per::block,
      "energy dissipated at instabilities since the start"},
     [](const Path& p) { return p.now().damped; }},
    {SeriesColumn::relaxing,
     {"series/dissipated_in_block", "eV", io::per::block,
      "energy dissipated by the branches of a viscoelastic block since the start"},
     [](const Path& p) { return p.now().dissipated_in_block; }},
    {SeriesColumn::both,
     {"series/balance_error", "1", "largest term",
      "energy balance: work - energies - loss, divided by the largest energy or work so far"},
     [](const Path& p) { return p.now().residual; }},
    {SeriesColumn::both,
     {"series/contact_fraction", "1", io::per::sites,
      "sites in contact: closer to an atom than the inflection of the pair potential; over a wall "
      "as contact_fraction of result.json"},
     [](const Path& p) { return p.scene_case().fraction(p.now().in_contact); }},
    {SeriesColumn::both,
     {"series/repulsive_fraction", "1", io::per::sites,
      "sites whose net normal force is repulsive"},
     [](const Path& p) { return p.scene_case().fraction(p.now().repulsive); }},
    {SeriesColumn::both,
     {"series/closest", "Å", "",
      "smallest distance from a site to an atom; infinite beyond the interaction range"},
     [](const Path& p) { return p.now().closest; }},
};

} // namespace

std::span<const SeriesColumn> series_columns() { return columns; }

std::vector<io::Quantity> series_quantities() {
    std::vector<io::Quantity> list;
    for (const SeriesColumn& c : columns)
        list.push_back(c.quantity);
    return list;
}

bool SeriesColumn::is_in(bool dynamic_path, const Effects& effects) const {
    if (in == sliding) return effects.sliding;
    if (in == relaxing) return effects.branches;
    if (in == thermal) return effects.temperature;
    if (in == sprung) return effects.spring;
    if (in == time) return dynamic_path || effects.branches;
    return in == both || (in == dynamic) == dynamic_path;
}

} // namespace asperity
