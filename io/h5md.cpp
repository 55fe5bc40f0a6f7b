// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The parts of H5MD 1.1 (nongnu.org/h5md) that a run of rough solids has: who wrote the file, and
// the box.
#include "io/hdf5_file.hpp"

namespace asperity::io {

void write_h5md_head(Hdf5File& file, const std::string& creator_version) {
    file.make_group("/h5md/author");
    file.make_group("/h5md/creator");
    file.write_attribute("/h5md", "version", std::vector<std::int64_t>{1, 1});
    file.write_attribute("/h5md/author", "name", "the user of Asperity"); // H5MD wants a name
    file.write_attribute("/h5md/creator", "name", "Asperity");
    file.write_attribute("/h5md/creator", "version", creator_version);
}

void write_h5md_box(Hdf5File& file, const std::string& group, double edge_x, double edge_y,
                    double edge_z) {
    file.make_group(group);
    file.write_attribute(group, "dimension", std::int64_t{3});
    file.write_text_list_attribute(group, "boundary", {"periodic", "periodic", "none"});
    file.write<double>(group + "/edges", {3}, std::vector<double>{edge_x, edge_y, edge_z});
    file.write_attribute(group + "/edges", "unit", "Å");
}

} // namespace asperity::io
