// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// XDMF 2: a small XML file beside an HDF5 file that tells ParaView what is in it. It holds no
// numbers of its own.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace asperity::io {

/// One data set of sites x sites values, as an attribute of the nodes of a flat mesh.
struct XdmfMap {
    std::string name;    ///< as the viewer shows it
    std::string dataset; ///< "/fields/zero-load/gap"
    bool bytes = false;  ///< 8-bit integers instead of doubles
};

struct XdmfGrid {
    std::string name;
    int sites = 0;
    double spacing = 0.0; ///< of the nodes, Å
    double origin = 0.0;  ///< x and y of the first node, Å
    std::vector<XdmfMap> maps;
};

/// Points that move: a data set [point][3] of single precision a frame. (Slabs of one data set of
/// all frames are read differently by the XDMF libraries 2 and 3.)
struct XdmfPoints {
    std::string name;
    std::string hdf5; ///< the file's name as seen from the XDMF file
    std::uint64_t points = 0;
    std::vector<double> times;         ///< of the frames, ps
    std::vector<std::string> datasets; ///< as many as times
};

/// hdf5: the file's name as seen from the XDMF file.
std::string xdmf(const std::string& hdf5, const std::vector<XdmfGrid>& grids,
                 const XdmfPoints& points);

} // namespace asperity::io
