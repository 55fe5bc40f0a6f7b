// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The permanent set of a surface that yields (over_wall.hpp), as a memory. A step is implicit: it
// ends in the equilibrium under forces of no more than that of the hardness H, and then the set of
// each site grows by the depth below its yield gap. The set grows only while the pressure is H, so
// that the plastic work of the step is exactly the sum of H times the growth.
#pragma once

#include "decomposition/communicator.hpp"
#include "engine/energy/memory.hpp"
#include "engine/interface/interface.hpp"
#include "engine/step_record.hpp"

#include <functional>
#include <utility>
#include <vector>

namespace asperity {

/// Permanent set of a surface that yields.
class PlasticSet : public Memory {
public:
    /// Keeps a reference to the interface, whose wall yields. displacement: returns the
    /// displacements of the sites, Å.
    PlasticSet(Interface& interface, const Communicator& ranks,
               std::function<VectorPlane<const double>()> displacement)
        : interface_(interface), ranks_(ranks), displacement_(std::move(displacement)) {}

    std::vector<RestoredArray> arrays() override;
    void begin(const TimeStep&) override {}
    void accept() override;
    StepEnergies energies() const override;
    bool stays_at_rest() const override { return true; }
    std::size_t bytes() const override { return 0; } // counted by the interface

private:
    Interface& interface_;
    Communicator ranks_;
    std::function<VectorPlane<const double>()> displacement_;
};

/// Returns the state of a wall that yields. displacement: Å. Collective.
YieldState yield_state(const Interface& interface, const VectorPlane<const double>& displacement,
                       const Communicator& ranks);

} // namespace asperity
