// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/interface/over_atoms.hpp"

#include "engine/options/sweep_limits.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

namespace asperity {

namespace {

CellOptions cell_options(const InterfaceOptions& options, double spacing) {
    const PairTable pairs = options.pairs();
    if (options.tail || pairs.cutoff > largest_cell_cutoff)
        throw std::invalid_argument(fmt::format(
            "interface: a substrate of atoms anywhere has no mean plane for a tail, and a cutoff "
            "of {} Å at most; it was asked for {} Å{}",
            largest_cell_cutoff, pairs.cutoff, options.tail ? ", a tail" : ""));
    std::vector<double> cutoffs;
    cutoffs.reserve(static_cast<std::size_t>(pairs.types));
    for (int type = 0; type < pairs.types; ++type)
        cutoffs.push_back(cutoff_of(pairs.of[type]));
    return {spacing, std::move(cutoffs), sideways_margin(spacing), options.skip};
}

} // namespace

OverAtoms::OverAtoms(const AtomPositions& atoms, const Tile& tile, double spacing,
                     const InterfaceOptions& options)
    : pairs_(options.pairs().of, options.pairs().of + options.pairs().types),
      cells_(atoms, tile, cell_options(options, spacing)) {}

void OverAtoms::sweep_row(const InterfaceSites& sites, int y, SweepOptions how,
                          InterfaceSums& sums) const {
    interface_kernels().cells.of[how.observe](sites, cells_.view(), pairs(), y, y + 1, sums);
}

void OverAtoms::reference_row(const InterfaceSites& sites, int y, InterfaceSums& sums) const {
    reference_sweep(sites, cells_.atoms(), pairs(), y, y + 1, sums);
}

} // namespace asperity
