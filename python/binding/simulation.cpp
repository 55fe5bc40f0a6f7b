// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "binding.hpp"

#include "io/error.hpp"

#include <filesystem>
#include <utility>

namespace asperity::binding {

namespace {

using Sim = SteppedPath;
using SimulationClass = py::class_<Sim, std::shared_ptr<Sim>>;

/// Returns the ranks of a communicator, by its number in Fortran, or this process alone.
Communicator ranks_of(const std::optional<int>& number) {
    if (!number) return {};
    Communicator ranks = Communicator::of_fortran(*number);
    ranks.share_processors();
    return ranks;
}

/// Returns the components of a field as arrays over its memory; None if there is no field.
py::object arrays_of(SteppedPath& path, const std::optional<SteppedPath::View>& view,
                     bool writable = true) {
    if (!view) return py::none();
    const auto one = [&](const PlaneView<double>& plane) {
        return array_of(plane, path.lease(), writable);
    };
    return py::module_::import("asperity.running.engine")
        .attr("Components")(one(view->x), one(view->y), one(view->z));
}

/// Sets the external forces from an array [y, x, 3], or three of [y, x].
void set_external(SteppedPath& path, const py::object& field) {
    if (field.is_none()) return path.clear_external();
    const py::module_ numpy = py::module_::import("numpy");
    py::object planes = numpy.attr("asarray")(field, "float64");
    const auto shape = planes.attr("shape").cast<std::vector<long long>>();
    if (shape.size() == 3 && shape[2] == 3) // also of three sites across
        planes = numpy.attr("moveaxis")(planes, -1, 0);
    else if (shape.size() != 3 || shape[0] != 3)
        throw io::SceneError({"external",
                              "has the shape " + py::str(planes.attr("shape")).cast<std::string>(),
                              "it is a force of three components on each site",
                              "give an array [y, x, 3], or three arrays [y, x]"});
    const py::array_t<double, py::array::c_style | py::array::forcecast> all(planes);
    const auto plane = [&](int component) {
        const int ny = static_cast<int>(all.shape(1)), nx = static_cast<int>(all.shape(2));
        return PlaneView<const double>{all.data(component, 0, 0), nx, nx, ny};
    };
    path.set_external({plane(0), plane(1), plane(2)});
}

/// Returns a number of the approach and of the pull-off.
template <class Number>
BothWays both_ways(const PathResults& results, const Number& number) {
    const auto of = [&](Segment::Kind kind) {
        const SegmentResults* segment = results.last(kind);
        return segment ? number(*segment) : std::nullopt;
    };
    return {of(Segment::approach), of(Segment::pull_off)};
}

/// Binds the numbers of the present step.
void bind_numbers(SimulationClass& simulation) {
    simulation
        .def_property_readonly(
            "done", &Sim::done,
            "True if the scene's path has come to its end; never while the top is led by hand")
        .def_property_readonly(
            "steps", [](const Sim& sim) { return sim.simulation().steps(); }, "steps made")
        .def_property_readonly(
            "time", [](const Sim& sim) { return sim.now().time * 1e-3; }, // as the series has it
            "time at the start of the last step, ps")
        .def_property_readonly(
            "force", [](const Sim& sim) { return sim.now().force; },
            "total normal force of the substrate on the lowest layer, eV/Å; repulsion is positive")
        .def_property_readonly(
            "top_force", [](const Sim& sim) { return sim.now().top_force; },
            "elastic force on the top plane along z, eV/Å")
        .def_property_readonly(
            "mean_height", [](const Sim& sim) { return sim.now().mean_height; },
            "mean height of the lowest layer above the substrate's zero, Å")
        .def_property_readonly(
            "energy", [](const Sim& sim) { return sim.now(); },
            "Energies of the last observed step, eV: elastic, interface, kinetic, work, damped, "
            "balance_error")
        .def_property_readonly(
            "contact",
            [](const Sim& sim) { return sim.scene_case().fraction(sim.now().in_contact); },
            "fraction of the sites that are in contact, at the last observed step")
        .def_property_readonly(
            "repulsive_fraction",
            [](const Sim& sim) { return sim.scene_case().fraction(sim.now().repulsive); },
            "fraction of the sites whose net normal force is repulsive, at the last observed step")
        .def_property_readonly(
            "segment", &Sim::segment,
            "current segment of drive.path, as the scene has it; 'done' after the last")
        .def_property_readonly(
            "work_of_interface",
            [](const Sim& sim) {
                return both_ways(sim.results(), [](const SegmentResults& s) {
                    return s.energies[Term::work_of_interface];
                });
            },
            "work of the interface's force on the mean height, ∫ F dz, meV/Å²: .approach, "
            ".pull_off")
        .def_property_readonly(
            "work_of_drive",
            [](const Sim& sim) {
                return both_ways(sim.results(),
                                 [](const SegmentResults& s) { return s.energies[Term::work]; });
            },
            "work of the drive on the solids, meV/Å²: .approach, .pull_off")
        .def_property_readonly(
            "lost_in_cycle", [](const Sim& sim) { return sim.results().in_cycle[Term::lost]; },
            "energy lost over approach and pull-off, with the kinetic energy left at the end, "
            "meV/Å²; None until then");
}

/// Binds the fields of the sites.
void bind_fields(SimulationClass& simulation) {
    simulation
        .def_property_readonly(
            "u", [](Sim& sim) { return arrays_of(sim, sim.u()); },
            "displacements of the lowest layer, Å: views .x, .y, .z, [y, x]; the next step uses "
            "values written to them")
        .def_property_readonly(
            "v", [](Sim& sim) { return arrays_of(sim, sim.v()); },
            "velocities of the lowest layer half a step before u, Å/fs: writable views .x, .y, .z, "
            "[y, x]")
        .def_property_readonly(
            "f", [](Sim& sim) { return arrays_of(sim, sim.f(), false); },
            "forces on the lowest layer in the last step (substrate and external), eV/Å: read-only "
            "views .x, .y, .z")
        .def_property(
            "external", [](Sim& sim) { return arrays_of(sim, sim.external()); }, &set_external,
            "external forces on the lowest layer, eV/Å, from the next step on: an array [y, x, 3], "
            "or "
            "three of [y, x],\n"
            "which are copied. Reads as writable views .x, .y, .z of the present forces; None: no "
            "field")
        .def_property_readonly(
            "external_work", [](const Sim& sim) { return sim.simulation().balance().external; },
            "work of the external field so far, eV")
        .def_property_readonly(
            "tile",
            [](const Sim& sim) {
                const Tile tile = sim.tile();
                return py::make_tuple(py::slice(tile.y0, tile.y0 + tile.ny, 1),
                                      py::slice(tile.x0, tile.x0 + tile.nx, 1));
            },
            "sites of this rank as an index [y, x]: u.z is whole[tile]; without comm, all sites")
        .def_property_readonly(
            "spacing", [](const Sim& sim) { return sim.scene_case().simulation.block.spacing; },
            "distance of the sites, Å");
}

/// Binds what the Python class needs.
void bind_inner(SimulationClass& simulation) {
    simulation
        .def_property_readonly(
            "_substrate_height",
            [](Sim& sim) { return heights_of(sim.surface(), sim.shared_from_this()); })
        .def_property_readonly(
            "_scene", [](const Sim& sim) { return scene_toml(sim.scene_case().scene, false); })
        .def_property_readonly("_name", [](const Sim& sim) { return sim.scene_case().scene.name; })
        .def_property_readonly("_substrate_edge",
                               [](const Sim& sim) { return sim.surface().length; })
        .def_property_readonly("_segment_number", &Sim::segment_number)
        .def_property_readonly("_energies",
                               [](const Sim& sim) { // by their columns in the series
                                   py::dict energies;
                                   for (const io::EnergyTerm& row : io::energy_terms)
                                       if (sim.scene_case().effects.has(row.effect))
                                           energies[py::str(std::string(row.column))] =
                                               sim.now()[row.term];
                                   return energies;
                               })
        .def_property_readonly("_top_then", [](const Sim& sim) { return sim.now().top; })
        .def_property("_top_position", &Sim::top_position,
                      [](Sim& sim, const py::object& z) {
                          sim.set_top_position(quantity("top.position", z, "Å"));
                      })
        .def_property("_top_velocity", &Sim::top_velocity, [](Sim& sim, const py::object& v) {
            sim.set_top_velocity(v.is_none() ? std::nullopt
                                             : std::optional(quantity("top.velocity", v, "m/s")));
        });
}

} // namespace

void bind_simulation(py::module_& m) {
    SimulationClass simulation(m, "Simulation");
    simulation
        .def(py::init([](const std::string& file, const std::vector<std::string>& overrides,
                         const std::optional<int>& communicator) {
            const Communicator ranks = ranks_of(communicator);
            Given scene = read(file, overrides, ranks.size());
            return working([&] {
                return std::make_shared<Sim>(std::move(scene.resolved), std::move(scene.text),
                                             ranks);
            });
        }))
        .def(py::init([](const std::string& saved, const std::optional<int>& communicator) {
            return working([&] { return Sim::resume(saved, ranks_of(communicator)); });
        }))
        .def("_step",
             [](Sim& sim, long long n, const py::object& look) {
                 return working([&] {
                     return sim.step(n, [&] {
                         look_for_signals();
                         const py::gil_scoped_acquire acquire;
                         if (!look.is_none()) look();
                     });
                 });
             })
        .def("_every", &Sim::every)
        .def(
            "relax", [](Sim& sim) { return working([&] { return sim.relax(look_for_signals); }); },
            "Relaxes a copy of the sites from their present places at zero load.\n\n"
            "Returns\n-------\nRestState\n    State of force balance; the simulation itself does "
            "not change.\n\n"
            "Raises\n------\nPhysicsError\n    If no state is found.")
        .def(
            "save",
            [](Sim& sim, const std::filesystem::path& file) {
                working([&] { sim.save(file.string()); });
            },
            py::arg("file"),
            "Saves everything except the observers in one file (HDF5), for Simulation.resume().\n\n"
            "Parameters\n----------\nfile : str or Path\n    The file; one of an earlier save() is "
            "replaced.\n\n"
            "Raises\n------\nSceneError\n    If the file exists and is not one of save().")
        .def(
            "maps", [](Sim& sim) { return working([&] { return sim.maps(); }); },
            "Returns maps of the sites in their present state.\n\n"
            "Returns\n-------\nSiteMaps\n    Gap (Å), contact and pressure (GPa), [y, x].");
    bind_numbers(simulation);
    bind_fields(simulation);
    bind_inner(simulation);
}

} // namespace asperity::binding
