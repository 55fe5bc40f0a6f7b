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

#include <optional>
#include <span>
#include <vector>

namespace asperity {

class PotentialTable {
public:
    /// Makes the potential from distances, Å, ascending, and energies, eV. Throws
    /// std::invalid_argument if they are no potential: fewer than 8 points, distances that do not
    /// ascend, no well, or a repulsion that does not rise to ten times its depth.
    PotentialTable(std::span<const double> distance, std::span<const double> energy);
    // Potentials point into the table, so the table is not copied.
    PotentialTable(const PotentialTable&) = delete;
    PotentialTable& operator=(const PotentialTable&) = delete;

    /// Returns the potential cut at `cutoff`, Å, which reads this table. Throws
    /// std::invalid_argument for a cutoff that is not between the minimum and the last distance.
    Tabulated potential(double cutoff) const;

    double last() const { return last_; }               ///< Returns the last distance, Å.
    double depth() const { return whole_.shape.depth; } ///< Returns the depth of the well, eV.
    std::size_t numbers() const { return cubics_.size(); }
    std::size_t rows() const { return rows_; }
    /// Returns true if the potential reads this table.
    bool is_of(const Tabulated& potential) const { return potential.cubics == cubics_.data(); }

    // Errors of a pair's energy, eV, are potentials with this cutoff, so that their sum over pairs
    // bounds the error of the sum.

    /// Returns the error of the spline if the rows are exact.
    Tabulated spline_error(double cutoff) const { return of_errors(spline_error_, cutoff); }
    /// Returns four times the noise of the rows.
    Tabulated noise(double cutoff) const { return of_errors(noise_, cutoff); }

    /// Interval beyond the well in which the potential repels again, up to this cutoff, by more
    /// than 2.5e-4 of its largest attraction.
    struct Repulsion {
        std::optional<double> nearest, farthest; ///< Å; empty: nowhere
        double barrier = 0.0;                    ///< energy to climb on the way in, eV
        double noise = 0.0;                      ///< largest noise() in the interval, eV
    };
    Repulsion repulsion(double cutoff) const;

private:
    void find_errors(std::span<const double> distance, std::span<const double> energy);
    Tabulated of_errors(const std::vector<double>& cubics, double cutoff) const;

    std::vector<double> cubics_, spline_error_, noise_;
    std::size_t rows_ = 0;
    double last_ = 0.0;
    Tabulated whole_; ///< potential without a cutoff
};

} // namespace asperity
