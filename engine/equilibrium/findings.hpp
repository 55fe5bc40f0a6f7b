// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What a run has found so far: the numbers behind the summary and result.json.
#pragma once

#include "engine/equilibrium/dissipation.hpp"

#include <optional>

namespace asperity {

/// Of the relaxed state under zero load.
struct ZeroLoad {
    double binding_energy = 0.0; ///< gamma_state = -(U_LJ + U_el) / A0, meV/Å^2
    double pairwise = 0.0;       ///< -U_LJ / A0: the atom-by-atom work, meV/Å^2
    double elastic = 0.0;        ///< U_el / A0, meV/Å^2
    double contact_fraction = 0.0;
    double pushed_fraction = 0.0;
    double mean_height = 0.0; ///< of the lowest layer above the substrate's zero, Å
    double residual = 0.0;    ///< largest force left, eV/Å
    double iterations = 0.0;
};

struct Findings {
    std::optional<ZeroLoad> zero_load;
    std::optional<double> approach; ///< work of adhesion, meV/Å^2
    std::optional<double> pull_off;
    double attraction_in = 0.0;            ///< largest attraction on the way in, eV/Å
    double attraction_out = 0.0;           ///< on the way out
    std::optional<double> contact_made;    ///< when the approach ended, fs
    std::optional<Dissipation> dissipated; ///< of a quasi-static path (which lists it itself)

    /// By name, for checkpoints: visitor(name, double&).
    template <class Visitor>
    void visit(Visitor& v) {
        optional(v, "approach", approach);
        optional(v, "pull_off", pull_off);
        v("attraction_in", attraction_in);
        v("attraction_out", attraction_out);
        optional(v, "contact_made", contact_made);
        double has = zero_load ? 1.0 : 0.0;
        v("zero_load", has);
        ZeroLoad z = zero_load.value_or(ZeroLoad{});
        v("binding_energy", z.binding_energy);
        v("pairwise", z.pairwise);
        v("elastic", z.elastic);
        v("contact_fraction", z.contact_fraction);
        v("pushed_fraction", z.pushed_fraction);
        v("mean_height", z.mean_height);
        v("residual", z.residual);
        v("iterations", z.iterations);
        if (has != 0.0) zero_load = z;
    }

private:
    template <class Visitor>
    static void optional(Visitor& v, const char* name, std::optional<double>& value) {
        double has = value ? 1.0 : 0.0, number = value.value_or(0.0);
        v("has", has);
        v(name, number);
        if (has != 0.0) value = number;
    }
};

} // namespace asperity
