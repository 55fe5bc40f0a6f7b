// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "binding.hpp"

#include "io/error.hpp"

namespace asperity::binding {

void bind_state(py::module_& m) {
    using State = LedPath::State;
    using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;
    py::class_<State>(
        m, "State",
        "State of the sites, returned by Statics.copy(): all numbers that determine it, with "
        "the memory of a\nviscoelastic block.")
        .def(py::init([](const Array& u, double top, const std::optional<Array>& branches) {
                 if (u.ndim() != 3 || u.shape(0) != 3 || u.shape(1) != u.shape(2))
                     throw io::SceneError({"State", "is given another shape",
                                           "it is three components on a square of sites",
                                           "give an array [3, y, x]"});
                 State state{static_cast<int>(u.shape(1)), top, {u.data(), u.data() + u.size()}};
                 if (branches)
                     state.values.insert(state.values.end(), branches->data(),
                                         branches->data() + branches->size());
                 return state;
             }),
             py::arg("u"), py::arg("top") = 0.0, py::arg("branches") = py::none())
        .def_property_readonly(
            "u",
            [](const py::object& self) {
                State& s = self.cast<State&>();
                return py::array_t<double>({3, s.sites, s.sites}, s.values.data(), self);
            },
            "displacements of the lowest layer, Å, a writable array [component, y, x]")
        .def_readwrite("top", &State::top, "displacement of the top plane, Å")
        .def_property_readonly(
            "branches",
            [](const py::object& self) -> py::object {
                State& s = self.cast<State&>();
                const auto sites = static_cast<std::size_t>(s.sites), first = s.displacements();
                if (!s.remembers()) return py::none();
                return py::array_t<double>(
                    {(s.values.size() - first) / (sites * sites), sites, sites},
                    s.values.data() + first, self);
            },
            "extensions of the springs of block.prony, Å, a writable array [branch and component, "
            "y, "
            "x]; None: the block\nhas relaxed in this state")
        .def("__repr__", [](const State& s) {
            return py::str("<State: {0} x {0} sites, top {1:.4g} Å>").format(s.sites, s.top);
        });
}

} // namespace asperity::binding
