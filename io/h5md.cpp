// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/h5md.hpp"

#include <vector>

#include <fmt/format.h>

namespace asperity::io {

namespace {

std::string member(const std::string& name) {
    return fmt::format("{}/{}", H5mdTrajectory::group, name);
}

} // namespace

void write_h5md_head(Hdf5File& file, const std::string& creator_version) {
    file.make_group("/h5md/author");
    file.make_group("/h5md/creator");
    file.write_attribute("/h5md", "version", std::vector<std::int64_t>{1, 1});
    file.write_attribute("/h5md/author", "name", "the user of Asperity"); // H5MD wants a name
    file.write_attribute("/h5md/creator", "name", "Asperity");
    file.write_attribute("/h5md/creator", "version", creator_version);
}

H5mdTrajectory::H5mdTrajectory(Hdf5File& file, std::uint64_t particles, std::array<double, 3> edges,
                               bool velocities)
    : file_(&file), edges_{}, velocities_(velocities) {
    for (std::size_t i = 0; i < 3; ++i)
        edges_[4 * i] = static_cast<float>(edges[i]);
    file.make_group(member("box"));
    file.write_attribute(member("box"), "dimension", std::int64_t{3});
    file.write_attribute(member("box"), "boundary",
                         std::vector<std::string>{"periodic", "periodic", "none"});
    const auto element = [&](const std::string& name, const char* unit,
                             const Hdf5File::Shape& row) {
        file.make_series<float>(member(name + "/value"), row);
        file.write_attribute(member(name + "/value"), "unit", unit);
        file.make_series<std::int64_t>(member(name + "/step"));
        file.make_series<double>(member(name + "/time"));
        file.write_attribute(member(name + "/time"), "unit", "ps");
    };
    element("box/edges", "Angstrom", {3, 3});
    element("position", "Angstrom", {particles, 3});
    if (velocities) element("velocity", "Angstrom ps-1", {particles, 3});
}

void H5mdTrajectory::append(std::int64_t step, double time, std::span<const float> position,
                            std::span<const float> velocity) {
    const auto write = [&](const std::string& name, std::span<const float> value) {
        file_->append<float>(member(name + "/value"), value);
        file_->append<std::int64_t>(member(name + "/step"), std::span(&step, 1));
        file_->append<double>(member(name + "/time"), std::span(&time, 1));
    };
    write("box/edges", edges_);
    write("position", position);
    if (velocities_) write("velocity", velocity);
}

} // namespace asperity::io
