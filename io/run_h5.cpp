// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/run_h5.hpp"

#include "io/machine.hpp"

#include <span>
#include <stdexcept>

namespace asperity::io {

namespace {

const Quantity& described(const std::string& path) {
    if (const Quantity* quantity = run_quantity(path)) return *quantity;
    throw std::logic_error(path + " is not in run_quantities() (io/quantities.hpp)");
}

} // namespace

void describe(Hdf5File& file, const std::string& dataset) {
    describe(file, dataset, described(dataset));
}

void describe(Hdf5File& file, const std::string& dataset, const Quantity& quantity) {
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

void write_h5md_head(Hdf5File& file) {
    file.make_group("/h5md/author");
    file.make_group("/h5md/creator");
    file.write_attribute("/h5md", "version", std::vector<std::int64_t>{1, 1});
    file.write_attribute("/h5md/author", "name", "the user of Asperity"); // H5MD wants a name
    file.write_attribute("/h5md/creator", "name", "Asperity");
    file.write_attribute("/h5md/creator", "version", build_info().version);
}

void describe_trajectory(Hdf5File& file) {
    const std::string box = std::string(trajectory) + "/box";
    file.write_attribute(box, "dimension", std::int64_t{3});
    file.write_attribute(box, "boundary", std::vector<std::string>{"periodic", "periodic", "none"});
}

} // namespace asperity::io
