// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// asperity._engine: the paths of the engine that a script steps and leads, for Python.
// python/asperity/running/engine.py makes the classes of them that users see.
#include "binding.hpp"

#include "io/error.hpp"
#include "io/machine.hpp"

using namespace asperity;
using namespace asperity::binding;
using namespace pybind11::literals;

namespace {

/// Raises the exception of Python of an error of the engine, with all its problems.
void translate(std::exception_ptr thrown) {
    try {
        if (thrown) std::rethrow_exception(thrown);
    } catch (const io::Error& error) {
        const py::module_ errors = py::module_::import("asperity.errors");
        const py::object type =
            errors.attr("BY_CODE").attr("get")(error.code(), errors.attr("InternalError"));
        py::list problems;
        for (const io::Problem& one : error.problems())
            problems.append(py::dict("where"_a = one.where, "what"_a = one.what, "why"_a = one.why,
                                     "fix"_a = one.fix));
        PyErr_SetObject(type.ptr(), type.attr("of")(problems).ptr());
    }
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

    m.def(
        "check",
        [](const std::vector<std::string>& overrides) {
            working([&] { examine(SceneText{"", "overrides", overrides}.read(1)); });
        },
        py::arg("overrides"),
        "Checks the scene that these overrides make of the defaults. Raises SceneError.");

    bind_program(m);
    bind_records(m);
    bind_state(m);
    bind_simulation(m);
    bind_statics(m);
}
