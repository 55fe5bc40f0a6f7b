// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "binding.hpp"

#include "engine/units.hpp"
#include "io/error.hpp"

#include <algorithm>
#include <cmath>

namespace asperity::binding {

using namespace pybind11::literals;

namespace {

using StaticsClass = py::class_<LedPath, std::shared_ptr<LedPath>>;
using State = LedPath::State;

/// Binds the point where the path is, and the targets of the next relax().
void bind_point(StaticsClass& statics) {
    statics.def_property_readonly("now", &LedPath::now, "Point of the last relax()")
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
            "nm\") is the target of the next relax()");
}

/// Binds the spring that holds the top plane.
void bind_spring(StaticsClass& statics) {
    statics.def_property_readonly(
        "stiffness",
        [](const LedPath& s) {
            return s.scene_case().simulation.block.top_spring.stiffness / units::newton_per_metre;
        },
        "stiffness of the spring that holds the top plane (drive.stiffness), N/m; 0: the top is "
        "held itself");
}

/// Binds what the Python class and a search of states need, in the units of the engine.
void bind_inner(StaticsClass& statics) {
    statics
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

} // namespace

void bind_statics(py::module_& m) {
    StaticsClass statics(m, "Statics");
    statics
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
                    throw io::SceneError({"restore", "is given " + given_text(state),
                                          "it takes a State, where the sites stand",
                                          "give what copy() returned, or asperity.State(u, top)"});
                s.restore(state.cast<const State&>());
            },
            py::arg("state"),
            "Puts the sites into a state. The next relax() begins a path in it: work, dissipated "
            "and "
            "number count anew.\n\n"
            "Parameters\n----------\nstate : State\n    Result of copy(), or asperity.State(u, "
            "top).\n\n"
            "Raises\n------\nSceneError\n    If the state has another number of sites, or values "
            "that are not finite.")
        .def(
            "maps", [](const LedPath& s) { return working([&] { return s.maps(); }); },
            "Returns maps of the sites at the last point.\n\n"
            "Returns\n-------\nSiteMaps\n    Gap (Å), contact and pressure (GPa), [y, x].");
    bind_point(statics);
    bind_spring(statics);
    bind_inner(statics);
}

} // namespace asperity::binding
