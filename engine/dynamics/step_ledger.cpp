// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/dynamics/step_ledger.hpp"

#include <cstddef>

namespace asperity {

void StepLedger::enter(const StepTotals& now, StepRecord& record) {
    if (has_previous_) {
        // The machine pushes with minus the force on it.
        balance_.top_work -=
            0.5 * (now.drive_force + pending_.drive_force) * (now.drive - record.drive);
        balance_.interface +=
            0.5 * (now.force + record.force) * (now.mean_height - record.mean_height);
        balance_.damped += 0.5 * (now.dissipated + pending_.dissipated);
        balance_.drag_work -= 0.5 * (now.drag + pending_.drag);
    }
    balance_.heat += 0.5 * (now.heat + pending_.heat); // half of that of the first step
    if (has_previous_) {
        double sideways = 0.0;
        for (std::size_t axis : {0u, 1u})
            sideways -= 0.5 * (now.lateral_force[axis] + record.lateral_force[axis]) *
                        (now.slide[axis] - record.slide[axis]);
        balance_.top_work += sideways;
        balance_.lateral += sideways;
        balance_.external += now.external;
    }
    has_previous_ = true;
    pending_ = {now.dissipated, now.drag, now.heat, now.drive_force};

    static_cast<PlaceAndForces&>(record) = now;
    if (record.observed) balance_energies(now, record);
}

void StepLedger::balance_energies(const StepTotals& now, StepRecord& record) {
    static_cast<Energies&>(record) = now;
    if (!energy_brought_)
        energy_brought_ = record.stored() + balance_.net_damped() - balance_.work();
    record[Term::work] = balance_.work() + *energy_brought_;
    record[Term::work_of_interface] = balance_.interface;
    record[Term::lost] = balance_.net_damped();
    record.residual = energies_.residual(record);
}

} // namespace asperity
