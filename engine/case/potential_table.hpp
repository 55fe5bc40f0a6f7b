// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A pair potential given by a table; the data of a Tabulated (kernels/tabulated.hpp).
//
// A cubic spline through the points (cubic_spline.hpp) is resampled to equal intervals with its
// values and slopes. Energy and force are continuous, and the force is the exact derivative of the
// energy.
#pragma once

#include "kernels/tabulated.hpp"

#include <optional>
#include <span>
#include <vector>

namespace asperity {

/// A tabulated pair potential.
class PotentialTable {
public:
    /// Makes the potential from distances, Å, ascending, and energies, eV. Throws
    /// std::invalid_argument for fewer than 8 points, distances that do not ascend, no well, or a
    /// repulsion that does not rise to ten times the depth of the well.
    PotentialTable(std::span<const double> distance, std::span<const double> energy);
    // Potentials point into the table, so the table is not copied.
    PotentialTable(const PotentialTable&) = delete;
    PotentialTable& operator=(const PotentialTable&) = delete;

    /// Returns the potential cut at `cutoff`, Å; it refers to this table. Throws
    /// std::invalid_argument for a cutoff that is not between the minimum and the last distance.
    Tabulated potential(double cutoff) const;

    double last() const { return last_; }               ///< Returns the last distance, Å.
    double depth() const { return uncut_.shape.depth; } ///< Returns the depth of the well, eV.
    /// Returns the number of coefficients that a potential reads.
    std::size_t numbers() const { return cubics_.size(); }
    /// Returns the number of rows of the original table.
    std::size_t rows() const { return rows_; }
    /// Returns true if the potential refers to this table.
    bool is_of(const Tabulated& potential) const { return potential.cubics == cubics_.data(); }

    // Errors of a pair's energy, eV, in the form of potentials with a cutoff, so that their sum
    // over pairs bounds the error of the total energy.

    /// Returns the error of the spline for exact rows.
    Tabulated spline_error(double cutoff) const { return of_errors(spline_error_, cutoff); }
    /// Returns four times the noise of the rows.
    Tabulated noise(double cutoff) const { return of_errors(noise_, cutoff); }

    /// Interval beyond the well in which the potential repels again by more than 2.5e-4 of its
    /// largest attraction.
    struct Repulsion {
        std::optional<double> nearest, farthest; ///< bounds, Å; empty if there is none
        double barrier = 0.0; ///< height of the energy barrier for an approaching atom, eV
        double noise = 0.0;   ///< largest noise() in the interval, eV
    };
    /// Returns the interval, searched up to the cutoff, Å.
    Repulsion repulsion(double cutoff) const;

private:
    void find_errors(std::span<const double> distance, std::span<const double> energy);
    Tabulated of_errors(const std::vector<double>& cubics, double cutoff) const;

    std::vector<double> cubics_, spline_error_, noise_;
    std::size_t rows_ = 0;
    double last_ = 0.0;
    Tabulated uncut_; ///< potential without a cutoff
};

} // namespace asperity
