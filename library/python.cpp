// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// asperity._engine: the classes of asperity.hpp that step, for Python. python/asperity/engine.py
// makes the classes of them that users see.
#include "library/asperity.hpp"

#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <utility>

namespace py = pybind11;
using namespace libasperity;

namespace {

/// Ctrl-C, seen between steps.
void look_for_signals() {
    const py::gil_scoped_acquire acquire;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

/// What a scene's author should know, as warnings of Python at the caller of the class.
void warn(const std::vector<std::string>& notes) {
    if (notes.empty()) return;
    const py::object kind = py::module_::import("asperity.errors").attr("SceneWarning");
    for (const std::string& note : notes)
        if (PyErr_WarnEx(kind.ptr(), note.c_str(), 2) != 0) throw py::error_already_set();
}

Scene read(const std::string& file, const std::vector<std::string>& overrides) {
    Scene scene = [&] {
        const py::gil_scoped_release release;
        return Scene::read(file, overrides);
    }();
    warn(scene.notes());
    return scene;
}

std::unique_ptr<Parallel> ranks_of(const std::optional<int>& communicator) {
    return communicator ? std::make_unique<Parallel>(*communicator) : nullptr;
}

/// An array over memory of the engine; it keeps that alive.
py::object array_of(const View& view, bool writable) {
    if (!view.data) return py::none();
    using Owner = std::shared_ptr<const void>;
    const py::capsule owner(new Owner(view.owner), [](void* p) { delete static_cast<Owner*>(p); });
    const auto size = static_cast<py::ssize_t>(sizeof(double));
    py::array_t<double> array(
        {static_cast<py::ssize_t>(view.ny), static_cast<py::ssize_t>(view.nx)},
        {static_cast<py::ssize_t>(view.row) * size, size}, view.data, owner);
    if (!writable) array.attr("flags").attr("writeable") = false;
    return array;
}

py::object arrays_of(const VectorView& view, bool writable) {
    if (!view.x.data) return py::none();
    return py::module_::import("asperity.engine")
        .attr("Components")(array_of(view.x, writable), array_of(view.y, writable),
                            array_of(view.z, writable));
}

py::array array_of(const Map& map) {
    return py::array_t<double>({map.ny, map.nx}, map.values.data());
}

/// One component of a field, copied.
Map map_of(const py::object& values) {
    const py::array_t<double, py::array::c_style | py::array::forcecast> array(values);
    Map map;
    map.ny = static_cast<std::size_t>(array.shape(0));
    map.nx = static_cast<std::size_t>(array.shape(1));
    map.values.assign(array.data(), array.data() + array.size());
    return map;
}

/// [y, x, 3], or three of [y, x].
void set_external(Simulation& sim, const py::object& field) {
    if (field.is_none()) return sim.clear_external();
    const py::module_ numpy = py::module_::import("numpy");
    py::object planes = numpy.attr("asarray")(field, "float64");
    const auto shape = planes.attr("shape").cast<std::vector<long long>>();
    if (shape.size() == 3 && shape[2] == 3) // also of three sites across
        planes = numpy.attr("moveaxis")(planes, -1, 0);
    else if (shape.size() != 3 || shape[0] != 3)
        throw Error(2, "external: has the shape " +
                           py::str(planes.attr("shape")).cast<std::string>() +
                           "\n    why: it is a force of three components on each site"
                           "\n    fix: give an array [y, x, 3], or three arrays [y, x]");
    sim.set_external(map_of(planes[py::int_(0)]), map_of(planes[py::int_(1)]),
                     map_of(planes[py::int_(2)]));
}

void translate(std::exception_ptr thrown) {
    try {
        if (thrown) std::rethrow_exception(thrown);
    } catch (const Error& error) {
        const py::module_ errors = py::module_::import("asperity.errors");
        const py::object type =
            errors.attr("BY_CODE").attr("get")(error.code(), errors.attr("InternalError"));
        PyErr_SetObject(type.ptr(), type(error.what()).ptr());
    }
}

/// "Point(contact=0.98, energy=-492.5, ...)", every number of it by its name.
std::string shown(const py::object& of) {
    const py::object type = py::type::of(of);
    std::string text;
    for (const py::handle& name : py::module_::import("builtins").attr("dir")(type)) {
        const auto word = name.cast<std::string>();
        if (word.starts_with("_")) continue;
        const py::object value = of.attr(name);
        const bool number = py::isinstance<py::float_>(value);
        text += (text.empty() ? "" : ", ") + word + "=" +
                (number ? py::str("{:.6g}").attr("format")(value) : py::repr(value))
                    .cast<std::string>();
    }
    return type.attr("__name__").cast<std::string>() + "(" + text + ")";
}

} // namespace

PYBIND11_MODULE(_engine, m) {
    m.doc() = "The engine of asperity.Simulation and asperity.Statics";
    m.attr("version") = version();
    py::register_exception_translator(translate);

    py::class_<Energies>(m, "Energies", "Energies in eV, since the start of the path.")
        .def_readonly("elastic", &Energies::elastic, "elastic energy of the block, eV")
        .def_readonly("interface", &Energies::interface,
                      "energy of the interface, eV; negative where it binds")
        .def_readonly("kinetic", &Energies::kinetic, "kinetic energy of the block, eV")
        .def_readonly("work", &Energies::work,
                      "work done on the block, eV: by the top plane, the medium that damps, noise, "
                      "and an external field")
        .def_readonly("damped", &Energies::damped, "energy lost to the medium that damps, eV")
        .def_readonly("balance_error", &Energies::balance_error,
                      "what the energy balance is off by, over the largest of its terms")
        .def("__repr__", shown);

    py::class_<BothWays>(
        m, "BothWays",
        "A number of the approach and one of the pull-off, meV/Å²; None until that way has ended.")
        .def_readonly("approach", &BothWays::approach, "of the approach, meV/Å²")
        .def_readonly("pull_off", &BothWays::pull_off, "of the pull-off, meV/Å²")
        .def("__repr__", shown);

    py::class_<SiteMaps>(m, "SiteMaps", "Maps of the sites, [y, x].")
        .def_property_readonly(
            "gap", [](const SiteMaps& s) { return array_of(s.gap); },
            "height above the substrate below, Å")
        .def_property_readonly(
            "contact", [](const SiteMaps& s) { return array_of(s.contact).attr("astype")("bool"); },
            "whether the nearest atom is in contact")
        .def_property_readonly(
            "pressure", [](const SiteMaps& s) { return array_of(s.pressure); },
            "normal force on a site over its area, GPa; positive pushes apart");

    py::class_<RestState>(m, "RestState", "A state of force balance under no load.")
        .def_readonly("binding_energy", &RestState::binding_energy,
                      "the least work that separates the solids from here, meV/Å²")
        .def_readonly("elastic_energy", &RestState::elastic_energy, "elastic energy, meV/Å²")
        .def_readonly("contact_fraction", &RestState::contact_fraction,
                      "fraction of the sites in contact")
        .def_readonly("repulsive_fraction", &RestState::repulsive_fraction,
                      "fraction of the sites that are pushed away")
        .def_readonly("mean_height", &RestState::mean_height,
                      "of the lowest layer above the substrate's zero, Å")
        .def_readonly("residual", &RestState::residual, "largest force left on a site, eV/Å")
        .def_readonly("iterations", &RestState::iterations, "iterations of the relaxation")
        .def_readonly("maps", &RestState::maps, "its SiteMaps: gap, contact, pressure")
        .def("__repr__", shown);

    py::class_<Simulation>(m, "Simulation")
        .def(py::init([](const std::string& file, const std::vector<std::string>& overrides,
                         const std::optional<int>& communicator) {
            const auto ranks = ranks_of(communicator);
            const Scene scene = read(file, overrides);
            const py::gil_scoped_release release;
            return Simulation(scene);
        }))
        .def(py::init([](const std::string& saved, const std::optional<int>& communicator) {
            const auto ranks = ranks_of(communicator);
            const py::gil_scoped_release release;
            return Simulation::resume(saved);
        }))
        .def("_step",
             [](Simulation& sim, long long n, const py::object& look) {
                 const py::gil_scoped_release release;
                 return sim.step(n, [&] {
                     look_for_signals();
                     const py::gil_scoped_acquire acquire;
                     if (!look.is_none()) look();
                 });
             })
        .def("_every", &Simulation::every)
        .def(
            "relax",
            [](Simulation& sim) {
                const py::gil_scoped_release release;
                return sim.relax(look_for_signals);
            },
            "The state at zero load that the sites come to from where they are: a RestState.\n\n"
            "A copy is relaxed; the simulation stays as it is. Raises PhysicsError if no state is "
            "found.")
        .def(
            "save",
            [](Simulation& sim, const py::object& file) {
                const auto path =
                    py::module_::import("os").attr("fspath")(file).cast<std::string>();
                const py::gil_scoped_release release;
                sim.save(path);
            },
            py::arg("file"),
            "Writes everything but the observers into one file (HDF5), for Simulation.resume().")
        .def("maps", &Simulation::maps,
             "The SiteMaps of the sites as they are now: gap, contact, pressure.")
        .def_property_readonly(
            "done", &Simulation::done,
            "whether the scene's path has come to its end; never while the top is led by hand")
        .def_property_readonly("steps", &Simulation::steps, "steps made")
        .def_property_readonly("time", &Simulation::time, "time at the start of the last step, ps")
        .def_property_readonly(
            "force", &Simulation::force,
            "total normal force of the substrate on the lowest layer, eV/Å; positive pushes apart")
        .def_property_readonly("top_force", &Simulation::top_force,
                               "elastic force on the top plane along z, eV/Å")
        .def_property_readonly("mean_height", &Simulation::mean_height,
                               "mean height of the lowest layer above the substrate's zero, Å")
        .def_property_readonly("energy", &Simulation::energy,
                               "Energies of the last observed step, eV: elastic, interface, "
                               "kinetic, work, damped, balance_error")
        .def_property_readonly(
            "contact", &Simulation::contact_fraction,
            "fraction of the sites whose nearest atom is in contact, at the last observed step")
        .def_property_readonly(
            "repulsive_fraction", &Simulation::repulsive_fraction,
            "fraction of the sites that are pushed away, at the last observed step")
        .def_property_readonly("segment", &Simulation::segment,
                               "where the scene's path is: 'approach', 'pull-off' or 'done'")
        .def_property_readonly(
            "work_of_adhesion", &Simulation::work_of_adhesion,
            "work of the interface's force on the mean height, meV/Å²: .approach, .pull_off")
        .def_property_readonly(
            "work_of_drive", &Simulation::work_of_drive,
            "work that the drive takes up and gives, meV/Å²: .approach, .pull_off")
        .def_property_readonly("lost_in_cycle", &Simulation::lost_in_cycle,
                               "energy lost over approach and pull-off, meV/Å²; None before")
        .def_property_readonly(
            "u", [](Simulation& sim) { return arrays_of(sim.u(), true); },
            "displacements of the lowest layer, Å: views .x, .y, .z, [y, x]; what is written is "
            "felt by the next step")
        .def_property_readonly(
            "v", [](Simulation& sim) { return arrays_of(sim.v(), true); },
            "velocities of the lowest layer half a step before u, Å/fs: views .x, .y, .z, [y, x], "
            "to be written as well")
        .def_property_readonly(
            "f", [](Simulation& sim) { return arrays_of(sim.f(), false); },
            "forces on the lowest layer in the last step (substrate and external), eV/Å: views .x, "
            ".y, .z, to be read")
        .def_property(
            "external", [](Simulation& sim) { return arrays_of(sim.external(), true); },
            &set_external,
            "forces on the lowest layer from outside, eV/Å, from the next step on: an array [y, x, "
            "3], or three of\n"
            "[y, x]; they are copied. Reads as views .x, .y, .z of what acts, to be changed in "
            "place; None: no field")
        .def_property_readonly("external_work", &Simulation::external_work,
                               "work of the external field so far, eV")
        .def_property_readonly(
            "tile",
            [](const Simulation& sim) {
                const Tile tile = sim.tile();
                const auto part = [](std::size_t from, std::size_t n) {
                    return py::slice(static_cast<py::ssize_t>(from),
                                     static_cast<py::ssize_t>(from + n), 1);
                };
                return py::make_tuple(part(tile.y, tile.ny), part(tile.x, tile.nx));
            },
            "which sites are this rank's, as an index [y, x]: u.z is whole[tile]; without comm, "
            "all")
        .def_property_readonly("spacing", &Simulation::spacing, "distance of the sites, Å")
        .def_property_readonly(
            "_substrate_height",
            [](Simulation& sim) { return array_of(sim.substrate_height(), false); })
        .def_property_readonly("_scene", [](const Simulation& sim) { return sim.scene().toml(); })
        .def_property_readonly("_name", [](const Simulation& sim) { return sim.scene().name(); })
        .def_property_readonly("_substrate_edge", &Simulation::substrate_edge)
        .def_property("_top_position", &Simulation::top_position, &Simulation::set_top_position)
        .def_property("_top_velocity", &Simulation::top_velocity, &Simulation::set_top_velocity)
        .def("_release_top", &Simulation::release_top);

    py::class_<Point>(m, "Point", "A point of a path without time: force balance at what is held.")
        .def_readonly(
            "top", &Point::top,
            "displacement of the top plane since the start, Å; 0 where the mean height is held")
        .def_readonly("mean_height", &Point::mean_height,
                      "mean height of the lowest layer above the substrate's zero, Å")
        .def_readonly(
            "force", &Point::force,
            "total normal force of the substrate on the lowest layer, eV/Å; positive pushes apart")
        .def_readonly("energy", &Point::energy, "elastic energy and that of the interface, eV")
        .def_readonly("elastic_energy", &Point::elastic_energy, "elastic energy, eV")
        .def_readonly("interface_energy", &Point::interface_energy, "energy of the interface, eV")
        .def_readonly("work", &Point::work, "work of what holds the block, since the start, eV")
        .def_readonly("dissipated", &Point::dissipated,
                      "energy dissipated at instabilities, since the start, eV")
        .def_readonly("instabilities", &Point::instabilities, "how many points of the path had one")
        .def_readonly("contact", &Point::contact_fraction,
                      "fraction of the sites whose nearest atom is in contact")
        .def_readonly("repulsive_fraction", &Point::repulsive_fraction,
                      "fraction of the sites that are pushed away")
        .def_readonly("number", &Point::number, "points of the path since the start")
        .def("__repr__", shown);

    py::class_<Statics>(m, "Statics")
        .def(py::init([](const std::string& file, const std::vector<std::string>& overrides) {
            const Scene scene = read(file, overrides);
            const py::gil_scoped_release release;
            return Statics(scene);
        }))
        .def(
            "relax",
            [](Statics& statics) {
                const py::gil_scoped_release release;
                return statics.relax(look_for_signals);
            },
            "Goes where mean_height, top or load was set, point by point; the Point there.\n\n"
            "Without a new target: the point where it is. Ctrl-C ends it at a point; the next "
            "relax() goes on.\n"
            "Raises PhysicsError where no equilibrium is found, or the solids part before a pull "
            "is reached.")
        .def("maps", &Statics::maps, "The SiteMaps of the sites there: gap, contact, pressure.")
        .def_property_readonly("now", &Statics::now, "the Point of the last relax()")
        .def_property(
            "mean_height", [](const Statics& s) { return s.now().mean_height; },
            &Statics::set_mean_height,
            "mean height of the lowest layer above the substrate's zero, Å. Written: where the "
            "next relax() leads it")
        .def_property(
            "top", [](const Statics& s) { return s.now().top; }, &Statics::set_top,
            "displacement of the top plane since the start, Å. Written: where the next relax() "
            "leads it")
        .def("_load", py::overload_cast<double>(&Statics::set_load))
        .def("_load", py::overload_cast<const std::string&>(&Statics::set_load));
}
