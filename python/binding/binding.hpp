// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What the bindings of asperity._engine share: reading scenes, arrays over memory of the engine,
// and numbers with units. bind_...() puts one group of classes into the module.
#pragma once

#include "decomposition/communicator.hpp"
#include "engine/script/led_path.hpp"
#include "engine/script/stepped_path.hpp"

#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace asperity::binding {

namespace py = pybind11;

/// Binds the records and maps that the paths return: Energies, BothWays, SiteMaps, RestState,
/// Point.
void bind_records(py::module_& m);
/// Binds State, the sites of a quasi-static path.
void bind_state(py::module_& m);
/// Binds Simulation, a dynamic path that a script steps.
void bind_simulation(py::module_& m);
/// Binds Statics, a quasi-static path that a script leads.
void bind_statics(py::module_& m);

/// Binds program(), the command line.
void bind_program(py::module_& m);

/// Calls work() without the lock of Python, so that its other threads run. FFTW's plans and HDF5
/// are of the process, and threads are shared: one call works at a time.
template <class Work>
auto working(const Work& work) {
    static std::recursive_mutex one_at_a_time;
    const py::gil_scoped_release release;
    const std::lock_guard<std::recursive_mutex> lock(one_at_a_time);
    return work();
}
/// Throws if Python has a signal, such as Ctrl-C: called between steps.
void look_for_signals();

/// A scene, resolved and as it was written.
struct Given {
    Case resolved;
    SceneText text;
};
/// Reads a scene. Its notes become warnings of Python at the caller of the class.
Given read(const std::string& file, const std::vector<std::string>& overrides, int ranks = 1);

/// Returns an array over memory of the engine, which the owner keeps alive.
py::array array_of(const PlaneView<double>& plane, std::shared_ptr<const void> of, bool writable);
/// Returns the heights of a substrate as an array that cannot be written.
py::array heights_of(const Surface& of, std::shared_ptr<const void> owner);

/// Returns what was given, for a message.
std::string given_text(const py::handle& given);
/// Returns a number in this unit, given so or as words with another: 12.5, "1.25 nm". Throws
/// io::SceneError.
double quantity(const char* where, const py::handle& given, const char* unit);

/// Numbers of the two ways of a path, meV/Å^2.
struct BothWays {
    std::optional<double> approach, pull_off;
};
/// Returns every number of an object by its name: "Point(contact=0.98, energy=-492.5, ...)".
std::string shown(const py::object& of);

} // namespace asperity::binding
