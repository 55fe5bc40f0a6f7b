// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/described.hpp"

#include "io/build_info.hpp"
#include "io/quantities.hpp"

#include <stdexcept>

namespace asperity::io {

namespace {

const Quantity& described(const std::string& path) {
    if (const Quantity* quantity = run_quantity(path)) return *quantity;
    throw std::logic_error(path + " is not in run_quantities (io/quantities.hpp)");
}

} // namespace

void describe(Hdf5File& file, const std::string& dataset) {
    const Quantity& quantity = described(dataset);
    file.write_attribute(dataset, "unit", std::string(quantity.unit));
    std::string text(quantity.meaning);
    if (!quantity.per.empty()) text += " (" + std::string(quantity.per) + ")";
    file.write_attribute(dataset, "description", text);
}

void write_described_attribute(Hdf5File& file, const std::string& object, const std::string& name,
                               double value) {
    file.write_attribute(object, name, value);
    file.write_attribute(object, name + "_unit", std::string(described(object + "@" + name).unit));
}

void describe_origin(Hdf5File& file, const std::string& scene) {
    const BuildInfo build = build_info();
    file.write_attribute("/", "scene", scene);
    file.write_attribute("/", "version", build.version);
    file.write_attribute("/", "git", build.git);
}

} // namespace asperity::io
