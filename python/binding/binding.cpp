// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "binding.hpp"

#include "io/scene_reader.hpp"
#include "io/units.hpp"

#include <utility>

namespace asperity::binding {

void look_for_signals() {
    const py::gil_scoped_acquire acquire;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

Given read(const std::string& file, const std::vector<std::string>& overrides, int ranks) {
    Given given = working([&] {
        SceneText text{io::read_scene_file(file), file, overrides};
        Case resolved = text.read(ranks);
        return Given{std::move(resolved), std::move(text)};
    });
    const py::object kind = py::module_::import("asperity.errors").attr("SceneWarning");
    for (const std::string& note : given.resolved.notes)
        if (PyErr_WarnEx(kind.ptr(), note.c_str(), 3) != 0) throw py::error_already_set();
    return given;
}

py::array array_of(const PlaneView<double>& plane, std::shared_ptr<const void> of, bool writable) {
    using Owner = std::shared_ptr<const void>;
    const py::capsule owner(new Owner(std::move(of)),
                            [](void* p) { delete static_cast<Owner*>(p); });
    const auto size = static_cast<py::ssize_t>(sizeof(double));
    py::array_t<double> array({plane.ny, plane.nx}, {plane.row * size, size}, plane.origin, owner);
    if (!writable) array.attr("flags").attr("writeable") = false;
    return array;
}

py::array heights_of(const Surface& of, std::shared_ptr<const void> owner) {
    const PlaneView<double> heights{const_cast<double*>(of.height.data()), of.sites, of.sites,
                                    of.sites};
    return array_of(heights, std::move(owner), false);
}

std::string given_text(const py::handle& given) {
    const auto text = py::repr(given).cast<std::string>();
    return text.size() > 60 ? "a " + py::type::of(given).attr("__name__").cast<std::string>()
                            : text;
}

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

} // namespace asperity::binding
