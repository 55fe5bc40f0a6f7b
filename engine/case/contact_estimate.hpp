// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Estimates of a contact before the run, from the stiffness of the waves of the block that is
// simulated: with its layers, its surface stress and, in a periodic box, its held top plane.
//
// A contact of radius a bends waves of the wavenumber 2/a, the strip beside its edge waves of the
// inverse of its width. With E*(q) = 2 S(q)/q in place of the contact modulus of a half-space, the
// formulas of Johnson, Kendall and Roberts are exact for a half-space, and estimates otherwise
// (tests/physics/contact_estimate_test.cpp).
#pragma once

#include "engine/case/case.hpp"
#include "theory/jkr.hpp"

#include <optional>

namespace asperity {

/// Returns E*(q) = 2 S(q)/q of a block for waves of the wavenumber q, 1/Å, in eV/Å^3: S of the
/// block over that of a half-space of the block's own material, times its contact modulus.
double contact_modulus_at(const BlockOptions& block, double q);

/// Returns the mean pressure over the strain that it makes in a block, eV/Å^3: in the column of
/// layers below a held top plane or, with free edges, in a wave as long as the box.
double modulus_under_load(const BlockOptions& block);

/// Returns the width of the strip beside the edge of a contact in which an attraction acts, Å: the
/// root of 2 S(1/width) range^2 = adhesion, which is E* range^2 / adhesion for a half-space.
/// adhesion: eV/Å^2; range: Å.
double edge_strip(const BlockOptions& block, double adhesion, double range);

/// An adhesive sphere on a block, by JKR with the modulus of waves as long as the contact.
class SphereOnBlock {
public:
    /// Keeps a reference to the block. radius: Å; adhesion: work of adhesion, eV/Å^2.
    SphereOnBlock(const BlockOptions& block, double radius, double adhesion);

    /// Returns the load at a contact radius (Å), positive if it presses, eV/Å.
    double load(double contact_radius) const;
    /// Returns the contact radius under a load (eV/Å), at least that of the pull-off, Å.
    double contact_radius(double load) const;
    /// Returns the largest attraction by JKR, 1.5 pi w R, eV/Å.
    double pull_off_force() const;
    /// Returns the gap at a distance r from the axis beside a contact of this radius, Å.
    double gap(double r, double contact_radius) const;

private:
    theory::jkr::Sphere with_modulus_of(double contact_radius) const;

    const BlockOptions& block_;
    double radius_, adhesion_;
};

/// Returns the sphere of a case that has one.
SphereOnBlock sphere_of(const Case& c);
/// Estimates the attraction of the sphere of a case outside a box of this width (Å) around a
/// contact of this radius (Å), over 1.5 pi w R.
double attraction_beyond(const Case& c, double contact_radius, double width);

/// Attraction that a box with free edges leaves out, because the sphere goes on beyond its edges.
struct BeyondEdges {
    double part = 0.0;  ///< largest missing attraction on the path over 1.5 pi w R
    double width = 0.0; ///< width of the box that leaves out a thousandth, Å; at most 2 R
};
/// Estimates the attraction beyond the free edges of a case at its pull-off and under its loads;
/// empty for a box without free edges, a substrate that is no sphere, and without attraction.
std::optional<BeyondEdges> beyond_edges(const Case& c);

} // namespace asperity
