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
    throw std::logic_error(path + " is not in run_quantities (io/quantities.hpp)");
}

/// A member of the group of the trajectory.
std::string member(const std::string& name) { return "/particles/trajectory/" + name; }

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

void append_h5md(Hdf5File& file, const H5mdFrame& frame) {
    const auto append = [&](const std::string& name, const char* unit, Hdf5File::Shape shape,
                            std::span<const float> value) {
        if (!file.exists(member(name))) {
            file.make_dataset<float>(member(name + "/value"), shape);
            file.write_attribute(member(name + "/value"), "unit", unit);
            file.make_dataset<std::int64_t>(member(name + "/step"), {0});
            file.make_dataset<double>(member(name + "/time"), {0});
            file.write_attribute(member(name + "/time"), "unit", "ps");
        }
        file.append<float>(member(name + "/value"), value);
        file.append<std::int64_t>(member(name + "/step"), std::span(&frame.step, 1));
        file.append<double>(member(name + "/time"), std::span(&frame.time, 1));
    };
    if (!file.exists(member("box"))) {
        file.make_group(member("box"));
        file.write_attribute(member("box"), "dimension", std::int64_t{3});
        file.write_attribute(member("box"), "boundary",
                             std::vector<std::string>{"periodic", "periodic", "none"});
    }
    std::array<float, 9> edges{}; // a matrix
    for (std::size_t i = 0; i < 3; ++i)
        edges[4 * i] = static_cast<float>(frame.edges[i]);
    const std::uint64_t particles = frame.position.size() / 3;
    append("box/edges", "Angstrom", {0, 3, 3}, edges);
    append("position", "Angstrom", {0, particles, 3}, frame.position);
    if (!frame.velocity.empty())
        append("velocity", "Angstrom ps-1", {0, particles, 3}, frame.velocity);
}

} // namespace asperity::io
