// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The stresses below a state, as they are written (io/quantities.hpp, stress/*).
#pragma once

#include "engine/options/output_options.hpp"
#include "engine/waves/subsurface.hpp"
#include "io/hdf5_file.hpp"

#include <string>
#include <utility>
#include <vector>

namespace asperity {

/// A data set of the stresses.
struct StressArray {
    std::string name;
    io::Hdf5File::Shape shape;
    std::vector<float> values;
};

/// The stresses below a state.
struct StressRecord {
    StressSearch search;
    std::vector<StressArray> arrays;
    std::vector<std::pair<std::string, double>> attributes;
};

/// Searches the largest stresses and computes those of the section, of the map at the depth of the
/// largest stress of von Mises, and of the volume, if it is asked for. tractions: GPa.
StressRecord record_stresses(const BlockOptions& block, const SurfaceTractions& tractions,
                             const StressOptions& options);

/// Returns the size of the stresses below a state in run.h5 before compression, bytes, except those
/// of single depths and layers; 0 if none are recorded. sites: along an edge.
double stress_bytes(int sites, const StressOptions& options);

} // namespace asperity
