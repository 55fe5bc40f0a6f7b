// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Energy that a quasi-static path dissipates. When a state becomes unstable, the block moves to the
// next state at the same value of the held quantity (top plane or mean height). The energy released
// goes into vibrations that the path does not follow.
#pragma once

#include "engine/options/segment.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace asperity {

/// One instability of a quasi-static path.
struct Instability {
    double energy = 0.0;                                ///< energy dissipated, eV
    std::size_t segment = 0;                            ///< segment of the path
    double top = 0.0;                                   ///< displacement of the held quantity, Å
    double height_before = 0.0, height_after = 0.0;     ///< mean height of the lowest layer, Å
    std::array<double, 2> slide{};                      ///< place over the substrate, Å
    double force_before = 0.0, force_after = 0.0;       ///< force that holds the coordinate, eV/Å
    std::int64_t contact_before = 0, contact_after = 0; ///< number of sites in contact
    int site_x = 0, site_y = 0;   ///< the site of the lowest layer that moved most
    double largest_move = 0.0;    ///< distance moved by that site, Å
    std::int64_t sites_moved = 0; ///< sites that moved more than half as far

    template <class Visitor>
    void visit(Visitor& v) {
        v("energy", energy);
        v("segment", segment);
        v("top", top);
        v("height_before", height_before);
        v("height_after", height_after);
        v("slide", slide);
        v("force_before", force_before);
        v("force_after", force_after);
        v("contact_before", contact_before);
        v("contact_after", contact_after);
        v("site_x", site_x);
        v("site_y", site_y);
        v("largest_move", largest_move);
        v("sites_moved", sites_moved);
    }
};

/// Energy dissipated so far, and the instabilities.
struct Dissipation {
    double total = 0.0; ///< energy dissipated so far, eV
    /// Part of the total in steps too long to be separated from the dissipation of a viscoelastic
    /// block, eV.
    double not_followed = 0.0;
    long long events = 0;           ///< number of points of the path with dissipation
    std::vector<Instability> jumps; ///< the strongest instabilities, in the order of the path

    /// Adds an instability; the list keeps the 20 strongest. The caller sets the total.
    void add(const Instability& jump) {
        ++events;
        jumps.push_back(jump);
        constexpr std::size_t kept = 20;
        if (jumps.size() <= kept) return;
        const auto weaker = [](const Instability& a, const Instability& b) {
            return a.energy < b.energy;
        };
        jumps.erase(std::min_element(jumps.begin(), jumps.end(), weaker));
    }

    template <class Visitor>
    void visit(Visitor& v) {
        v("total", total);
        v("not_followed", not_followed);
        v("events", events);
        v("jumps", jumps);
    }
};

} // namespace asperity
