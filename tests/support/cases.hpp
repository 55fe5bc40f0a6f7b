// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The paper's material and small scenes, in the engine's units, without going through a scene file.
#pragma once

#include "engine/statics/zero_load.hpp"
#include "engine/waves/spectral_block.hpp"
#include "support/driven.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>

namespace asperity::test {

/// The paper's atoms.
namespace paper {
inline constexpr double a = 2.6, r0 = 3.28; ///< spacing, and distance of no force; Å
}

/// True if hard cases are followed at length.
inline const bool at_length = std::getenv("ASPERITY_LONG") != nullptr;

/// The paper's block (77.2 GPa, 0.42, 197 u, a = 2.6 Å). layers_per_level 0: the plain lattice.
BlockOptions paper_block(int sites, int thickness, int layers_per_level);
/// The paper's interface with this cutoff in units of r0.
InterfaceOptions paper_interface(double cutoff_in_r0 = 4.0);

/// The potential of these options, where it is Lennard-Jones'.
inline LennardJones& lennard_jones(InterfaceOptions& options) {
    return std::get<LennardJones>(options.potential);
}

/// Lennard-Jones, Morse and a table, the paper's length and depth, with this cutoff, Å; the table
/// belongs to the process.
std::array<PairPotential, 3> potentials(double cutoff = 13.12);

/// A contact of 8 sites with nothing driven and nothing damped.
SimulationOptions free_contact(double dt, int layers_per_level = 2);
/// On one rank.
Driven simulation(const SimulationOptions& options, const Surface& surface);
/// Steps to the end of its path; look(record, segment, whether that ended with it) after each.
template <class Look>
void lead(Driven& s, const Look& look, bool observe = true) {
    double strongest = 0.0;
    while (!s.drive().done()) {
        const std::size_t segment = s.drive().segment();
        const StepRecord& now = s.step(observe);
        strongest = std::max(strongest, -now.force);
        const bool over = s.drive().observe({now.time, now.force, now.top,
                                             are_apart(now.top >= 0.0, now.force, strongest),
                                             s.interface().reference_height()});
        look(now, segment, over);
        if (s.steps() > 300000) throw std::runtime_error("a path in time has no end");
    }
}

Surface flat_surface(int sites);
/// Its height at the atom (x, y), Å: height(x, y).
template <class Height>
Surface surface_from(int sites, const Height& height, double spacing = paper::a) {
    Surface s = flat_surface(sites);
    s.length = sites * spacing;
    for (int y = 0; y < sites; ++y)
        for (int x = 0; x < sites; ++x)
            s.height[static_cast<std::size_t>(y * sites + x)] = height(x, y);
    const auto [low, high] = std::minmax_element(s.height.begin(), s.height.end());
    s.statistics.lowest = *low, s.statistics.highest = *high;
    return s;
}
/// One period of a cosine along x.
inline Surface wave(int sites, double amplitude, double spacing = paper::a) {
    return surface_from(
        sites, [=](int x, int) { return amplitude * std::cos(2.0 * std::numbers::pi * x / sites); },
        spacing);
}
/// Heights within `amplitude` of a level, each on its own: sites atoms an edge of this length.
Surface scattered(int sites, double length, double amplitude, unsigned seed, double level = 0.0);
/// As a scene makes it, of the paper's spacing.
inline Surface self_affine(int sites, double rms, std::uint64_t seed = SurfaceOptions().seed) {
    SurfaceOptions o;
    o.sites = sites;
    o.length = 2.6 * sites;
    o.rms = rms;
    o.seed = seed;
    return make_surface(o);
}
/// A map of tests/physics/data, at its own size, its heights times a factor.
Surface reference_surface(const std::string& name, double factor = 1.0);
/// Its atoms, displaced sideways by up to 0.4 Å, over a second layer: a substrate of atoms
/// anywhere.
Surface disordered(Surface surface);

/// Of the paper's interface.
Scales paper_scales();

ProcessGrid grid_for(const BlockOptions& options, const Communicator& communicator);
inline ProcessGrid serial_grid(const BlockOptions& options) {
    return grid_for(options, Communicator());
}

struct Relaxed {
    RelaxedState state;
    double binding_energy = 0.0; ///< meV/Å^2
    double pairwise = 0.0;       ///< meV/Å^2
    double mean_height = 0.0;    ///< above the substrate's zero, Å
};
Relaxed numbers_of(const RelaxedState& state, const BlockOptions& options, double reference_height);
/// The state at zero load of this block on this surface.
Relaxed relax_spectral(const BlockOptions& block, const InterfaceOptions& interface,
                       const Surface& surface, double tolerance, bool frictionless = false);

/// The same of a lattice or levels, small or finite strain, node by node, to this largest force on
/// one, eV/Å: a second way to a state, slow, for blocks of some thousand nodes.
Relaxed relax_levels(const BlockOptions& block, const InterfaceOptions& interface,
                     const Surface& surface, double tolerance);

/// The state below a block in motion, without a scene file. Collective.
LayerAtRest bring_to_rest(const Block& moving, const Surface& surface, double reference_height,
                          const SimulationOptions& options, double tolerance);

/// A displacement of a spectral block, at the sites and as waves.
struct SpectralDisplacement {
    SiteField<float> sites;
    Waves<float> waves;
};
/// Normally distributed, independent at each site and along each component it has.
SpectralDisplacement random_displacement(const SpectralBlock& block, std::mt19937_64& random,
                                         double size);

/// 64 bits that differ if any bit of any displacement, velocity or the top differs. Collective; the
/// same on every rank, and for any number of them.
std::uint64_t fingerprint(const Block& block);
std::uint64_t mix(std::uint64_t hash, double value);
/// All numbers of a record, those of its energies where it was observed; all sums of a balance.
std::uint64_t mix(std::uint64_t hash, const StepRecord& record);
std::uint64_t mix(std::uint64_t hash, const EnergyBalance& balance);

/// What a run leaves behind, bit by bit.
struct Trace {
    std::uint64_t records = 1; ///< and the balance
    std::uint64_t state = 0;   ///< displacements and velocities
    long long in_contact = 0;  ///< at most
    double force = 0.0;        ///< of the last step
    /// So many steps, of which every tenth is observed; the drive sees their forces.
    void follow(Driven& s, int steps);
    /// The balance and the state. Collective.
    void conclude(const Driven& s);
    bool operator==(const Trace&) const = default;
};

} // namespace asperity::test
