// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "binding.hpp"

#include "engine/units.hpp"

#include <fmt/format.h>

#include <string>

namespace asperity::binding {

namespace {

/// Returns one of the maps of a state, copied.
template <class T>
py::array copied(const InterfaceMaps& maps, const std::vector<T>& values) {
    return py::array_t<T>({maps.ny, maps.nx}, values.data());
}

/// Returns a term of a record.
template <Term term, class Record>
double of(const Record& record) {
    return record[term];
}

void bind_point(py::module_& m) {
    using Point = LedPath::Point;
    py::class_<Point> path_point(
        m, "Point", "Point of a quasi-static path: force balance at the held quantity.");
    for (const io::EnergyTerm& row : io::energy_terms)
        if (row.kind == io::EnergyTerm::dissipated)
            path_point.def_property_readonly(
                std::string(row.key).c_str(), [&row](const Point& p) { return p[row.term]; },
                fmt::format("{}, since the path began, eV", row.meaning).c_str());
    path_point
        .def_readonly(
            "top", &Point::top,
            "displacement of the top plane since the start, Å; 0 if the mean height is held")
        .def_readonly("mean_height", &Point::mean_height,
                      "mean height of the lowest layer above the substrate's zero, Å")
        .def_readonly(
            "force", &Point::force,
            "total normal force of the substrate on the lowest layer, eV/Å; repulsion is positive")
        .def_property_readonly("energy", &Point::stored, "energy of block and interface, eV")
        .def_property_readonly("elastic_energy", of<Term::elastic, Point>, "elastic energy, eV")
        .def_property_readonly("interface_energy", of<Term::interface, Point>,
                               "energy of the interface, eV")
        .def_property_readonly("work", of<Term::work, Point>,
                               "work of the holder of the block since the path began, eV")
        .def_property_readonly("dissipated", of<Term::lost, Point>,
                               "energy dissipated at instabilities, since the path began, eV")
        .def_readonly("mean_set", &Point::mean_set,
                      "mean permanent set of a surface that yields, Å")
        .def_readonly("largest_set", &Point::largest_set,
                      "largest permanent set of a site of a surface that yields, Å")
        .def_property_readonly(
            "losses",
            [](const Point& p) {
                py::dict losses;
                for (const io::EnergyTerm& row : io::energy_terms)
                    if (row.is_loss()) losses[py::str(std::string(row.key))] = p[row.term];
                return losses;
            },
            "all losses since the path began, by their names in result.json, eV")
        .def_property_readonly("branch_energy", of<Term::branches, Point>,
                               "part of elastic_energy in the branches of a viscoelastic block, eV")
        .def_property_readonly(
            "time", [](const Point& p) { return p.time / units::picosecond; },
            "time of the path, for a viscoelastic block, ps")
        .def_readonly("instabilities", &Point::instabilities,
                      "number of points of the path with an instability")
        .def_readonly("contact", &Point::contact_fraction,
                      "fraction of the sites whose nearest atom is in contact")
        .def_readonly("repulsive_fraction", &Point::repulsive_fraction,
                      "fraction of the sites whose net normal force is repulsive")
        .def_readonly("number", &Point::step, "number of points since the path began")
        .def("__repr__", shown);
}

} // namespace

void bind_records(py::module_& m) {
    py::class_<StepRecord>(m, "Energies", "Energies in eV, since the start of the path.")
        .def_property_readonly("elastic", of<Term::elastic, StepRecord>,
                               "elastic energy of the block, eV")
        .def_property_readonly("interface", of<Term::interface, StepRecord>,
                               "energy of the interface, eV; negative if it binds")
        .def_property_readonly("kinetic", of<Term::kinetic, StepRecord>,
                               "kinetic energy of the block, eV")
        .def_property_readonly(
            "work", of<Term::work, StepRecord>,
            "work done on the solids since they were at rest apart, eV: by the top plane, "
            "the damping medium, an external field, and values written to u and v")
        .def_property_readonly("damped", of<Term::lost, StepRecord>,
                               "energy lost to the damping medium, less the heat of the noise, eV")
        .def_readonly("balance_error", &StepRecord::residual,
                      "work - energies - damped, over the largest energy or work so far")
        .def("__repr__", shown);

    py::class_<BothWays>(
        m, "BothWays",
        "Numbers of the approach and of the pull-off, meV/Å²; None until the segment has ended.")
        .def_readonly("approach", &BothWays::approach, "number of the approach, meV/Å²")
        .def_readonly("pull_off", &BothWays::pull_off, "number of the pull-off, meV/Å²")
        .def("__repr__", shown);

    py::class_<InterfaceMaps>(m, "SiteMaps", "Maps of the sites, [y, x].")
        .def_property_readonly(
            "gap", [](const InterfaceMaps& of) { return copied(of, of.gap); },
            "height above the substrate below, Å")
        .def_property_readonly(
            "contact",
            [](const InterfaceMaps& of) { return copied(of, of.contact).attr("astype")("bool"); },
            "True if the nearest atom is in contact")
        .def_property_readonly(
            "pressure", [](const InterfaceMaps& of) { return copied(of, of.pressure); },
            "normal force on a site over its area, GPa; repulsion is positive")
        .def("__repr__", [](const InterfaceMaps& of) {
            return py::str("<SiteMaps: gap, contact, pressure of {} x {} sites>")
                .format(of.ny, of.nx);
        });

    py::class_<RestState>(
        m, "RestState",
        "State of force balance, returned by Simulation.relax() and Statics.free().")
        .def_readonly("binding_energy", &RestState::binding_energy,
                      "minimum work needed to separate the solids from this state, meV/Å²")
        .def_readonly("elastic_energy", &RestState::elastic, "elastic energy, meV/Å²")
        .def_readonly("contact_fraction", &RestState::contact_fraction,
                      "fraction of the sites in contact")
        .def_readonly("repulsive_fraction", &RestState::repulsive_fraction,
                      "fraction of the sites whose net normal force is repulsive")
        .def_readonly("mean_height", &RestState::mean_height,
                      "mean height of the lowest layer above the substrate's zero, Å")
        .def_readonly("residual", &RestState::residual, "largest force left on a site, eV/Å")
        .def_readonly("iterations", &RestState::iterations, "iterations of the relaxation")
        .def_readonly("maps", &RestState::maps, "SiteMaps of the state: gap, contact, pressure")
        .def("__repr__", shown);
    bind_point(m);
}

} // namespace asperity::binding
