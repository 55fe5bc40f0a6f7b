// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// asperity._engine: the paths of the engine that a script steps and leads, for Python.
// running/engine.py makes the classes of them that users see.
#include "decomposition/communicator.hpp"
#include "engine/script/led_path.hpp"
#include "engine/script/stepped_path.hpp"
#include "engine/units.hpp"
#include "io/machine.hpp"
#include "io/scene_reader.hpp"
#include "io/units.hpp"

#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

namespace py = pybind11;
using namespace asperity;
using namespace pybind11::literals;

namespace {

/// Other threads of Python run meanwhile. FFTW's plans and HDF5 are of the process, and threads are
/// shared: one call works at a time.
template <class Work>
auto working(const Work& work) {
    static std::recursive_mutex one_at_a_time;
    const py::gil_scoped_release release;
    const std::lock_guard<std::recursive_mutex> lock(one_at_a_time);
    return work();
}

/// Ctrl-C, seen between steps.
void look_for_signals() {
    const py::gil_scoped_acquire acquire;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

/// The ranks of a communicator, by its number in Fortran, or this process alone.
Communicator ranks_of(const std::optional<int>& number) {
    if (!number) return {};
    Communicator ranks = Communicator::of_fortran(*number);
    ranks.share_processors();
    return ranks;
}

struct Given {
    Case resolved;
    SceneText text;
};
/// What a scene's author should know is said as warnings of Python at the caller of the class.
Given read(const std::string& file, const std::vector<std::string>& overrides, int ranks = 1) {
    Given given = working([&] {
        SceneText text{io::read_scene_file(file), file, overrides};
        Case resolved = text.read(ranks);
        return Given{std::move(resolved), std::move(text)};
    });
    const py::object kind = py::module_::import("asperity.errors").attr("SceneWarning");
    for (const std::string& note : given.resolved.notes)
        if (PyErr_WarnEx(kind.ptr(), note.c_str(), 2) != 0) throw py::error_already_set();
    return given;
}

/// An array over memory of the engine, which the owner keeps alive.
py::array array_of(const PlaneView<double>& plane, std::shared_ptr<const void> of, bool writable) {
    using Owner = std::shared_ptr<const void>;
    const py::capsule owner(new Owner(std::move(of)),
                            [](void* p) { delete static_cast<Owner*>(p); });
    const auto size = static_cast<py::ssize_t>(sizeof(double));
    py::array_t<double> array({plane.ny, plane.nx}, {plane.row * size, size}, plane.origin, owner);
    if (!writable) array.attr("flags").attr("writeable") = false;
    return array;
}

/// Heights of a substrate, to be read.
py::array heights_of(const Surface& of, std::shared_ptr<const void> owner) {
    const PlaneView<double> heights{const_cast<double*>(of.height.data()), of.sites, of.sites,
                                    of.sites};
    return array_of(heights, std::move(owner), false);
}

py::object arrays_of(SteppedPath& path, const std::optional<SteppedPath::View>& view,
                     bool writable = true) {
    if (!view) return py::none();
    const auto one = [&](const PlaneView<double>& plane) {
        return array_of(plane, path.lease(), writable);
    };
    return py::module_::import("asperity.running.engine")
        .attr("Components")(one(view->x), one(view->y), one(view->z));
}

/// What was given, for a message.
std::string given_text(const py::handle& given) {
    const auto text = py::repr(given).cast<std::string>();
    return text.size() > 60 ? "a " + py::type::of(given).attr("__name__").cast<std::string>()
                            : text;
}

/// A number in a unit, given so or as words with another: 12.5, "1.25 nm".
double quantity(const char* where, const py::handle& given, const char* unit) {
    if (py::isinstance<py::str>(given)) {
        const auto text = given.cast<std::string>();
        const io::ParsedQuantity parsed = io::parse_quantity(text, unit);
        if (!parsed.why.empty())
            throw io::SceneError(
                {where, "\"" + text + "\" cannot be read as a quantity", parsed.why, parsed.fix});
        return parsed.value;
    }
    const double value = PyFloat_AsDouble(given.ptr());
    if (PyErr_Occurred()) {
        PyErr_Clear();
        throw io::SceneError(
            {where, "is given " + given_text(given), std::string("it is one number, in ") + unit,
             std::string("give one, or a text with a unit, for example ") + io::example_of(unit)});
    }
    return value;
}

/// One of the maps of a state, copied.
template <class T>
py::array array_of(const InterfaceMaps& maps, const std::vector<T>& values) {
    return py::array_t<T>({maps.ny, maps.nx}, values.data());
}

/// [y, x, 3], or three of [y, x].
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

void translate(std::exception_ptr thrown) {
    try {
        if (thrown) std::rethrow_exception(thrown);
    } catch (const io::Error& error) {
        const py::module_ errors = py::module_::import("asperity.errors");
        const py::object type =
            errors.attr("BY_CODE").attr("get")(error.code(), errors.attr("InternalError"));
        PyErr_SetObject(type.ptr(), type(error.what()).ptr());
    }
}

/// Of the two ways of a path, meV/Å^2.
struct BothWays {
    std::optional<double> approach, pull_off;
};
template <class Number>
BothWays both_ways(const PathResults& results, const Number& number) {
    const auto of = [&](Segment::Kind kind) {
        const SegmentResults* segment = results.last(kind);
        return segment ? number(*segment) : std::nullopt;
    };
    return {of(Segment::approach), of(Segment::pull_off)};
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
    m.attr("version") = io::build_info().version;
    py::register_exception_translator(translate);
    m.def(
        "quantity",
        [](const std::string& where, const py::object& given, const std::string& unit) {
            return quantity(where.c_str(), given, unit.c_str());
        },
        py::arg("where"), py::arg("given"), py::arg("unit"),
        "A number in this unit, given so or as a text with a unit. Raises SceneError.");

    py::class_<StepRecord>(m, "Energies", "Energies in eV, since the start of the path.")
        .def_readonly("elastic", &StepRecord::elastic_energy, "elastic energy of the block, eV")
        .def_readonly("interface", &StepRecord::interface_energy,
                      "energy of the interface, eV; negative if it binds")
        .def_readonly("kinetic", &StepRecord::kinetic_energy, "kinetic energy of the block, eV")
        .def_readonly(
            "work", &StepRecord::work,
            "work done on the solids since they were at rest apart, eV: by the top plane, "
            "the damping medium, an external field, and values written to u and v")
        .def_readonly("damped", &StepRecord::damped,
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
            "gap", [](const InterfaceMaps& of) { return array_of(of, of.gap); },
            "height above the substrate below, Å")
        .def_property_readonly(
            "contact",
            [](const InterfaceMaps& of) { return array_of(of, of.contact).attr("astype")("bool"); },
            "True if the nearest atom is in contact")
        .def_property_readonly(
            "pressure", [](const InterfaceMaps& of) { return array_of(of, of.pressure); },
            "normal force on a site over its area, GPa; positive pushes apart")
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

    using Sim = SteppedPath;
    py::class_<Sim, std::shared_ptr<Sim>>(m, "Simulation")
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
            "Returns\n-------\nSiteMaps\n    Gap (Å), contact and pressure (GPa), [y, x].")
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
            "total normal force of the substrate on the lowest layer, eV/Å; positive pushes apart")
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
                return both_ways(sim.results(),
                                 [](const SegmentResults& s) { return s.interface_work; });
            },
            "work of the interface's force on the mean height, ∫ F dz, meV/Å²: .approach, "
            ".pull_off")
        .def_property_readonly(
            "work_of_drive",
            [](const Sim& sim) {
                return both_ways(sim.results(),
                                 [](const SegmentResults& s) { return std::optional(s.work); });
            },
            "work of the drive on the solids, meV/Å²: .approach, .pull_off")
        .def_property_readonly(
            "lost_in_cycle", [](const Sim& sim) { return sim.results().lost_in_cycle; },
            "energy lost over approach and pull-off, with the kinetic energy left at the end, "
            "meV/Å²; None until then")
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
            "distance of the sites, Å")
        .def_property_readonly(
            "_substrate_height",
            [](Sim& sim) { return heights_of(sim.surface(), sim.shared_from_this()); })
        .def_property_readonly(
            "_scene", [](const Sim& sim) { return scene_toml(sim.scene_case().scene, false); })
        .def_property_readonly("_name", [](const Sim& sim) { return sim.scene_case().scene.name; })
        .def_property_readonly("_substrate_edge",
                               [](const Sim& sim) { return sim.surface().length; })
        .def_property_readonly("_segment_number", &Sim::segment_number)
        .def_property_readonly("_top_then", [](const Sim& sim) { return sim.now().top; })
        .def_property("_top_position", &Sim::top_position,
                      [](Sim& sim, const py::object& z) {
                          sim.set_top_position(quantity("top.position", z, "Å"));
                      })
        .def_property("_top_velocity", &Sim::top_velocity, [](Sim& sim, const py::object& v) {
            sim.set_top_velocity(v.is_none() ? std::nullopt
                                             : std::optional(quantity("top.velocity", v, "m/s")));
        });

    using Point = LedPath::Point;
    py::class_<Point>(m, "Point",
                      "Point of a quasi-static path: force balance at the held quantity.")
        .def_readonly(
            "top", &Point::top,
            "displacement of the top plane since the start, Å; 0 if the mean height is held")
        .def_readonly("mean_height", &Point::mean_height,
                      "mean height of the lowest layer above the substrate's zero, Å")
        .def_readonly(
            "force", &Point::force,
            "total normal force of the substrate on the lowest layer, eV/Å; positive pushes apart")
        .def_property_readonly("energy", &Point::energy,
                               "elastic energy and that of the interface, eV")
        .def_readonly("elastic_energy", &Point::elastic_energy, "elastic energy, eV")
        .def_readonly("interface_energy", &Point::interface_energy, "energy of the interface, eV")
        .def_readonly("work", &Point::work,
                      "work of the holder of the block since the path began, eV")
        .def_readonly("dissipated", &Point::damped,
                      "energy dissipated at instabilities, since the path began, eV")
        .def_readonly("dissipated_in_block", &Point::relaxed,
                      "energy dissipated by relaxing in the block, beside dissipated, eV")
        .def_readonly("branch_energy", &Point::branch_energy,
                      "part of elastic_energy in the branches of a block that relaxes, eV")
        .def_property_readonly(
            "time", [](const Point& p) { return p.time / units::picosecond; },
            "time of the path, for a block that relaxes, ps")
        .def_readonly("instabilities", &Point::instabilities,
                      "number of points of the path with an instability")
        .def_readonly("contact", &Point::contact_fraction,
                      "fraction of the sites whose nearest atom is in contact")
        .def_readonly("repulsive_fraction", &Point::repulsive_fraction,
                      "fraction of the sites whose net normal force is repulsive")
        .def_readonly("number", &Point::step, "number of points since the path began")
        .def("__repr__", shown);

    using State = LedPath::State;
    using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;
    py::class_<State>(
        m, "State",
        "State of the sites, returned by Statics.copy(): all numbers that determine it, with "
        "the memory of a block\nthat relaxes.")
        .def(py::init([](const Array& u, double top, const std::optional<Array>& branches) {
                 if (u.ndim() != 3 || u.shape(0) != 3 || u.shape(1) != u.shape(2))
                     throw io::SceneError({"State", "is given another shape",
                                           "it is three components on a square of sites",
                                           "give an array [3, y, x]"});
                 State state{static_cast<int>(u.shape(1)), {u.data(), u.data() + u.size()}, top};
                 if (branches)
                     state.branches = {branches->data(), branches->data() + branches->size()};
                 return state;
             }),
             py::arg("u"), py::arg("top") = 0.0, py::arg("branches") = py::none())
        .def_property_readonly(
            "u",
            [](const py::object& self) {
                State& s = self.cast<State&>();
                return py::array_t<double>({3, s.sites, s.sites}, s.u.data(), self);
            },
            "displacements of the lowest layer, Å, a writable array [component, y, x]")
        .def_readwrite("top", &State::top, "displacement of the top plane, Å")
        .def_property_readonly(
            "branches",
            [](const py::object& self) -> py::object {
                State& s = self.cast<State&>();
                const std::size_t sites = static_cast<std::size_t>(s.sites) * s.sites;
                if (s.branches.empty()) return py::none();
                return py::array_t<double>(
                    {s.branches.size() / sites, std::size_t(s.sites), std::size_t(s.sites)},
                    s.branches.data(), self);
            },
            "extensions of the springs of block.prony, Å, a writable array [branch and component, "
            "y, "
            "x]; None: the block\nhas relaxed in this state")
        .def("__repr__", [](const State& s) {
            return py::str("<State: {0} x {0} sites, top {1:.4g} Å>").format(s.sites, s.top);
        });

    py::class_<LedPath, std::shared_ptr<LedPath>>(m, "Statics")
        .def(py::init([](const std::string& file, const std::vector<std::string>& overrides) {
            const Given scene = read(file, overrides);
            return working([&] { return std::make_shared<LedPath>(scene.resolved); });
        }))
        .def(
            "relax", [](LedPath& s) { return working([&] { return s.relax(look_for_signals); }); },
            "Leads the solids, point by point, to the mean_height, top or load that was set.\n\n"
            "Ctrl-C stops at a point; the next relax() continues.\n\n"
            "Returns\n-------\nPoint\n    Point at the target; without a new target the present "
            "one.\n\n"
            "Raises\n------\nPhysicsError\n    If no equilibrium is found, or the solids part "
            "before a pull is reached.")
        .def(
            "free", [](LedPath& s) { return working([&] { return s.release(look_for_signals); }); },
            "Relaxes the sites from their present places with nothing held, under drive.load.\n\n"
            "The next relax() begins a path in this state.\n\n"
            "Returns\n-------\nRestState\n    The state; from beyond the interaction range that of "
            "the segment \"relax\" of a run.\n\n"
            "Raises\n------\nPhysicsError\n    If no state is found; the sites then stay in "
            "place.")
        .def("copy", &LedPath::copy,
             "Copies the state of the sites and the top.\n\n"
             "Returns\n-------\nState\n    The state, for restore().")
        .def(
            "restore",
            [](LedPath& s, const py::object& state) {
                if (!py::isinstance<State>(state))
                    throw io::SceneError(
                        {"restore", "is given " + given_text(state),
                         "it takes a State, where the sites stand",
                         "give what copy() returned, or asperity.State(u, top)"});
                s.restore(state.cast<const State&>());
            },
            py::arg("state"),
            "Puts the sites into a state. The next relax() begins a path in it: work, dissipated "
            "and "
            "number count anew.\n\n"
            "Parameters\n----------\nstate : State\n    Result of copy(), or asperity.State(u, top).\n\n"
            "Raises\n------\nSceneError\n    If the state has another number of sites, or values "
            "that are not finite.")
        .def(
            "maps", [](const LedPath& s) { return working([&] { return s.maps(); }); },
            "Returns maps of the sites at the last point.\n\n"
            "Returns\n-------\nSiteMaps\n    Gap (Å), contact and pressure (GPa), [y, x].")
        .def_property_readonly("now", &LedPath::now, "Point of the last relax()")
        .def_property(
            "mean_height", [](const LedPath& s) { return s.now().mean_height; },
            [](LedPath& s, const py::object& z) {
                s.set_mean_height(quantity("mean_height", z, "Å"));
            },
            "mean height of the lowest layer above the substrate's zero, Å. A written value (a "
            "number "
            "or \"0.3 nm\") is the target of the next relax()")
        .def_property(
            "top", [](const LedPath& s) { return s.now().top; },
            [](LedPath& s, const py::object& z) { s.set_top(quantity("top", z, "Å")); },
            "displacement of the top plane since the start, Å. A written value (a number or \"-1 "
            "nm\") is the target of the next relax()")
        .def_property_readonly(
            "_case", // what a search needs of it, in the units of the engine
            [](const LedPath& s) {
                const Case& c = s.scene_case();
                const bool atoms = c.surface.kind == SurfaceKind::atoms;
                return py::dict("name"_a = c.scene.name, "scene"_a = scene_toml(c.scene, false),
                                "area"_a = c.area(), "load"_a = c.simulation.drive.load_force,
                                "step"_a = c.simulation.drive.displacement_step,
                                "tension"_a = c.largest_tension * units::gigapascal,
                                "modulus"_a = c.simulation.block.contact_modulus(),
                                // Atoms anywhere can bind more than a flat layer does.
                                "deepest"_a = atoms ? HUGE_VAL : c.flat.work_of_adhesion * 1e-3,
                                "spacing"_a = c.simulation.block.spacing,
                                "scale"_a = c.flat.work_of_adhesion,
                                "separation"_a = c.flat.separation,
                                "wall"_a = c.simulation.interface.wall.has_value(),
                                "lateral"_a = c.effects.lateral.on);
            })
        .def_property_readonly(
            "_substrate_height",
            [](const std::shared_ptr<LedPath>& s) { return heights_of(s->surface(), s); })
        .def("_hold",
             [](LedPath& s, const py::object& t) { s.set_hold(quantity("hold", t, "ps")); })
        .def("_load",
             [](LedPath& s, const py::object& p) { s.set_load(quantity("load", p, "MPa")); });
}
