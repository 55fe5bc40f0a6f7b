// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A pair potential given by numbers: what a Tabulated (kernels/tabulated.hpp) reads.
//
// A cubic spline through the points, whose end slopes are those of cubics through the four points
// there, is brought onto equal intervals with its values and slopes. Energy and force are
// continuous, and the force is the exact derivative of the energy.
#pragma once

#include "kernels/tabulated.hpp"

#include <span>
#include <vector>

namespace asperity {

class PotentialTable {
public:
    /// Distances, Å, ascending, and energies, eV. Throws std::invalid_argument where they are no
    /// potential: fewer than 8 points, distances that do not ascend, no well, a repulsion that does
    /// not rise to ten times its depth, or rows too far apart for a spline.
    PotentialTable(std::span<const double> distance, std::span<const double> energy);
    PotentialTable(const PotentialTable&) = delete; ///< potentials point into it
    PotentialTable& operator=(const PotentialTable&) = delete;

    /// Cut at `cutoff`, Å; it reads this object. Throws std::invalid_argument for a cutoff that is
    /// not between the minimum and the last distance.
    Tabulated potential(double cutoff) const;

    double last() const { return last_; }               ///< distance, Å
    double depth() const { return whole_.shape.depth; } ///< of the well, eV
    std::size_t numbers() const { return cubics_.size(); }

private:
    std::vector<double> cubics_;
    double last_ = 0.0;
    Tabulated whole_; ///< without a cutoff
};

} // namespace asperity
