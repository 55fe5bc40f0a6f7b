// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The numbers of one time step, or of one point of a quasi-static path. engine/run/series.hpp
// selects and names those that a run records.
#pragma once

#include "engine/energy/energies.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace asperity {

/// Counts of sites in contact and under repulsion (count_contacts(), interface.hpp).
struct ContactCount {
    long long in_contact = 0, repulsive = 0; ///< numbers of sites
    double closest = 0.0; ///< smallest pair distance, Å; infinite beyond the interaction range

    template <class Visitor>
    void visit(Visitor& v) {
        v("in_contact", in_contact);
        v("repulsive", repulsive);
        v("closest", closest);
    }
};

/// State of a surface that yields; zero for others.
struct YieldState {
    long long at_hardness = 0; ///< number of sites whose net pressure is the hardness within 0.1 %
    double mean_set = 0.0;     ///< mean permanent set of the box, Å
    double largest_set = 0.0;  ///< largest permanent set of a site, Å

    template <class Visitor>
    void visit(Visitor& v) {
        v("at_hardness", at_hardness);
        v("mean_set", mean_set);
        v("largest_set", largest_set);
    }
};

/// Share of a site that each of Interface::contact_edges() counts too much (Yastrebov, Anciaux and
/// Molinari, Int. J. Solids Struct. 110 (2017), arXiv:1701.02727).
inline constexpr double excess_of_edge = (std::numbers::pi - 1.0 + std::numbers::ln2) / 24.0;

/// Returns the contact area over a wall in sites: the number of sites in contact less what the
/// sites at the edges of contacts count too much.
inline double contact_sites(double in_contact, double edges) {
    return in_contact - excess_of_edge * edges;
}

/// Returns the error of contact_sites() in sites, as measured (docs/reports/mesh.md): the sites at
/// the edges are in or out by chance, and their excess is known to 15 %.
inline double contact_sites_error(double edges) {
    return std::hypot(0.85 * std::sqrt(edges), 0.15 * excess_of_edge * edges);
}

/// Place of the block at a step or point, and the forces on it.
struct PlaceAndForces {
    double top = 0.0; ///< displacement of the top plane, Å
    double drive =
        0.0; ///< displacement of what the drive moves, Å: the top plane or its spring's end
    double mean_height = 0.0; ///< mean height of the lowest layer above the substrate's zero, Å
    double force = 0.0;       ///< total normal force of the substrate on the lowest layer, eV/Å
    double top_force = 0.0;   ///< elastic force on the top plane along z, eV/Å
    // Numbers along x and y of a path that slides; otherwise 0.
    std::array<double, 2> slide{};         ///< place of the block over the substrate, Å
    std::array<double, 2> lateral_force{}; ///< force of the substrate on the lowest layer, eV/Å

    template <class Visitor>
    void visit(Visitor& v) {
        v("top", top);
        v("drive", drive);
        v("mean_height", mean_height);
        v("force", force);
        v("top_force", top_force);
        v("slide", slide);
        v("lateral_force", lateral_force);
    }
};

/// Global numbers of a step or point, bitwise identical on every rank. Works and losses count from
/// the start of the path; the work of the drive and of external forces from rest apart: it includes
/// the energy of the block at the start, and that of values that a script writes to its fields.
struct StepRecord : ContactCount, YieldState, PlaceAndForces, Energies {
    long long step = 0; ///< number of the step, or of the point of a quasi-static path
    double time = 0.0;  ///< fs
    // Numbers of observed steps only, like the contacts and the energies:
    bool observed = false;
    /// Residual of the energy balance over the largest of the energies and of the work so far.
    double residual = 0.0;

    /// Passes the members to a visitor, for checkpoints.
    template <class Visitor>
    void visit(Visitor& v) {
        v("step", step);
        v("time", time);
        PlaceAndForces::visit(v);
        v("observed", observed);
        Energies::visit(v);
        ContactCount::visit(v);
        YieldState::visit(v);
        v("residual", residual);
    }
};

} // namespace asperity
