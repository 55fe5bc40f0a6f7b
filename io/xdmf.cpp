// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/xdmf.hpp"

#include <fmt/format.h>

namespace asperity::io {

namespace {

std::string grid_text(const std::string& hdf5, const XdmfGrid& g) {
    // A mesh of one layer: ParaView reads 3DCoRectMesh with the slowest index (z) first.
    std::string text =
        fmt::format("    <Grid Name=\"{0}\" GridType=\"Uniform\">\n"
                    "      <Topology TopologyType=\"3DCoRectMesh\" Dimensions=\"1 {1} {1}\"/>\n"
                    "      <Geometry GeometryType=\"ORIGIN_DXDYDZ\">\n"
                    "        <DataItem Dimensions=\"3\" NumberType=\"Float\" Precision=\"8\" "
                    "Format=\"XML\">0 {3:.9g} {3:.9g}</DataItem>\n"
                    "        <DataItem Dimensions=\"3\" NumberType=\"Float\" Precision=\"8\" "
                    "Format=\"XML\">{2:.9g} {2:.9g} {2:.9g}</DataItem>\n"
                    "      </Geometry>\n",
                    g.name, g.sites, g.spacing, g.origin);
    for (const XdmfMap& m : g.maps)
        text += fmt::format("      <Attribute Name=\"{0}\" AttributeType=\"Scalar\" "
                            "Center=\"Node\">\n"
                            "        <DataItem Dimensions=\"1 {1} {1}\" NumberType=\"{2}\" "
                            "Precision=\"{3}\" Format=\"HDF\">{4}:{5}</DataItem>\n"
                            "      </Attribute>\n",
                            m.name, g.sites, m.bytes ? "UChar" : "Float", m.bytes ? 1 : 8, hdf5,
                            m.dataset);
    return text + "    </Grid>\n";
}

std::string points_text(const XdmfPoints& p) {
    if (p.times.empty()) return "";
    std::string text = fmt::format(
        "    <Grid Name=\"{}\" GridType=\"Collection\" CollectionType=\"Temporal\">\n", p.name);
    for (std::size_t frame = 0; frame < p.times.size(); ++frame)
        text += fmt::format("      <Grid Name=\"{0} {1}\" GridType=\"Uniform\">\n"
                            "        <Time Value=\"{2:.9g}\"/>\n"
                            "        <Topology TopologyType=\"Polyvertex\" "
                            "NumberOfElements=\"{3}\"/>\n"
                            "        <Geometry GeometryType=\"XYZ\">\n"
                            "          <DataItem Dimensions=\"{3} 3\" NumberType=\"Float\" "
                            "Precision=\"4\" Format=\"HDF\">{4}:{5}</DataItem>\n"
                            "        </Geometry>\n"
                            "      </Grid>\n",
                            p.name, frame, p.times[frame], p.points, p.hdf5, p.datasets[frame]);
    return text + "    </Grid>\n";
}

} // namespace

std::string xdmf(const std::string& hdf5, const std::vector<XdmfGrid>& grids,
                 const XdmfPoints& points) {
    std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                       "<!DOCTYPE Xdmf SYSTEM \"Xdmf.dtd\" []>\n"
                       "<Xdmf Version=\"2.0\">\n  <Domain>\n";
    for (const XdmfGrid& grid : grids)
        text += grid_text(hdf5, grid);
    return text + points_text(points) + "  </Domain>\n</Xdmf>\n";
}

} // namespace asperity::io
