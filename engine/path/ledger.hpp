// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Works and losses of the segments of a path, dynamic or quasi-static. For an approach from rest
// beyond the interaction range, and a pull-off that ends at rest beyond the range:
//
//     -(work of the drive, approach) = binding energy - lost - left
//      (work of the drive, pull-off) = binding energy + lost + left there
//                                      - left after the approach
//
// A segment of a quasi-static path, wherever it starts and ends, satisfies
//
//     work of the drive = stored + all losses,
//
// stored: the change of the energy of interface and block. Works are done on the solids; "left" is
// what the end finds in motion (EnergyLeft).
#pragma once

#include "engine/case/case.hpp"
#include "engine/path/path_results.hpp"
#include "engine/units.hpp"

#include <cstddef>
#include <optional>

namespace asperity {

/// Works and losses between two ends of segments, eV.
struct Works {
    /// Works and losses; the work is that of the drive or holder on the block.
    Energies flows;
    double lateral = 0.0;              ///< part of the work that moves the block sideways
    std::optional<double> stored = {}; ///< change of the energy; quasi-static paths only
    /// Uncertainty of work and losses; quasi-static paths only.
    std::optional<double> uncertainty = {};
    /// Part of the work that brought a viscoelastic block into its steady shape; slides until
    /// steady only.
    std::optional<double> settling = {};
    std::optional<double> distance = {};    ///< distance of a slide over a wall, Å
    std::optional<SteadySlide> steady = {}; ///< means of a slide over a wall

    /// Subtracts the works up to an earlier place on the path: returns the works from there to
    /// here.
    Works operator-(const Works& earlier) const;

    template <class Visitor>
    void visit(Visitor& v) {
        v("flows", flows);
        v("lateral", lateral);
    }
};

/// Returns true for a loss that a thermostat gives back as well: it is no loss of a way or cycle.
bool is_heat(const io::EnergyTerm& row, const Effects& effects);
/// Energies above the state in which a segment of a dynamic path ends, eV.
struct EnergyLeft {
    double kinetic = 0.0; ///< kinetic energy, and energy of vibrations of the block
    double spring = 0.0;  ///< energy of the spring that holds the top plane
    /// Returns the energy that is damped if the drive stops.
    double total() const { return kinetic + spring; }
};

/// Works and losses of the segments of a path.
class Ledger {
public:
    /// Keeps references to both arguments; conclude() writes to results.
    Ledger(const Case& c, PathResults& results) : case_(c), results_(results) {}

    /// Adds the results of a segment that has ended at this step or point. works: from the
    /// beginning to the end of the segment; left: empty on quasi-static paths or if not known.
    void conclude(std::size_t number, const StepRecord& now, const Works& works,
                  const std::optional<EnergyLeft>& left);

    /// Passes the sums to a visitor, for checkpoints.
    template <class Visitor>
    void visit(Visitor& v) {
        v("since_apart", since_apart_);
        v("moved_apart", left_in_motion_);
    }

private:
    double per_area(double energy) const { return units::milli_per_unit * energy / case_.area(); }
    std::optional<double> per_area(const std::optional<double>& energy) const;
    bool is_given(const io::EnergyTerm& row) const;

    const Case& case_;
    PathResults& results_;
    Energies since_apart_; ///< works and losses since the last end of a pull-off, or the start, eV
    double left_in_motion_ = 0.0; ///< energy left in motion at that time, eV
};

} // namespace asperity
