// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Forces between the block's lowest layer and the rigid substrate: Lennard-Jones pairs, or a wall
// with a law of the gap below each site (wall_law.hpp), which has a sweep of its own.
//
// Pairs are with a map of heights over a square lattice, or with atoms anywhere. Four sweeps:
//   reference  every site against every substrate atom in reach by an explicit loop over pairs,
//              scalar: what the other three are tested against;
//   lattice    both sides are the same lattice, so the neighbours of a site are known offsets: SIMD
//              over sites, sums in registers over the offsets in a fixed order;
//   rows       a substrate with a spacing of its own (incommensurate): site by site, SIMD over the
//              atoms along x, row after row;
//   cells      atoms anywhere, sixteen to a cell: site by site, SIMD over the atoms of the cells
//              near it.
//
// The last three exist twice: in double, and mixed: a site's pairs, and in the lattice sweep their
// sums, in single precision. Mixed heights are 32-bit integers, multiples of 2^-22 Å: the
// difference of two is exact, wherever in the box and however high it is formed, and only then
// becomes a float.
//
// Block site (x, y) of the tile stands at ((x0+x+1/2) a + ux, (y0+y+1/2) a + uy, z_ref + uz).
// Units: Å, eV, eV/Å.
//
// Sites out of reach are skipped. For each block of sixteen sites along x the owner tabulates
// how high the substrate gets in rings of lateral distance around it. From the lowest site of the
// block follows a gap, from the gap the lateral distance beyond which no pair can interact, and
// only offsets (atoms) nearer than that are visited. What is left out would have added exact zeros.
// In the same way, from how low the substrate gets, follow the offsets that need no comparison with
// the cutoff. The sweep over cells compares each site with the bounds of the cells near its block.
//
// Reproducibility: a site's force is summed in an order that the site alone decides (offset number,
// atoms counted from the one below it, number of the cell), never the tile, block or lane it is in;
// so its bits are the same for any decomposition and number of threads. Sums over sites are exact
// sums.
//
// Sites displaced sideways by more than offset_margin (a run about to be stopped by its guard) are
// summed one by one with the reference loop, so no pair is ever missed.
#pragma once

#include "kernels/exact_sum.hpp"
#include "kernels/lennard_jones.hpp"
#include "kernels/views.hpp"
#include "kernels/wall_law.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>

namespace asperity {

/// Sites along x whose reach is bounded together: the widest register in single precision.
inline constexpr int interface_block = 16;
/// Rings of lateral distance for which each block knows the substrate's greatest height.
inline constexpr int interface_rings = 8;
/// Most offsets along one half axis, (cutoff + margin) / a + 1 at most.
inline constexpr int max_half_offsets = 64;
/// Most rows of a substrate of any spacing within reach to either side.
inline constexpr int max_rows = 2 * max_half_offsets;

/// The block's side of the interface: one tile of its lowest layer.
struct InterfaceSites {
    VectorPlane<const double> displacement; ///< u, Å
    VectorPlane<double> force;              ///< out: force on each site, eV/Å (overwritten)
    double spacing = 2.6;                   ///< a, Å
    double reference_height = 0.0;          ///< z of an undisplaced site, Å
    int x0 = 0;                             ///< the tile's first site, counted over the box
    int y0 = 0;
    PlaneView<double> nearest_r2{}; ///< out where given and observed: squared distance to the
                                    ///< nearest atom in reach (no_pair if there is none), Å^2
    /// out where given and observed: 1 where a site is closer than contact_distance to some atom,
    /// or than contact_gap to the wall.
    PlaneView<std::uint8_t> in_contact{};
};

/// Squared distance reported where no atom is in reach.
inline constexpr double no_pair = 1e300;

/// What one pass over the sites adds up. Sums are order-independent.
struct InterfaceSums {
    ExactSum force_z;            ///< total normal force of the substrate on the sites, eV/Å
    ExactSum energy;             ///< U_LJ, eV (only if asked for)
    std::int64_t in_contact = 0; ///< sites closer than contact_distance to some atom (if asked for)
    std::int64_t repulsive = 0;  ///< sites whose net normal force is repulsive (if asked for)
    std::int64_t in_reach = 0;   ///< sites of the blocks of sites that were not skipped
    double closest_r2 = no_pair; ///< smallest squared pair distance met (if asked for), Å^2

    void merge(const InterfaceSums& other) {
        force_z.merge(other.force_z);
        energy.merge(other.energy);
        in_contact += other.in_contact;
        repulsive += other.repulsive;
        in_reach += other.in_reach;
        closest_r2 = other.closest_r2 < closest_r2 ? other.closest_r2 : closest_r2;
    }
    void carry() { force_z.carry(), energy.carry(); }
};

/// The whole substrate as a periodic map of heights: what the reference loop needs.
struct SubstrateMap {
    const double* height = nullptr; ///< height[j * sites + i] of the atom at (i b, j b), Å
    int sites = 0;                  ///< atoms across the box
    double spacing = 2.6;           ///< b, Å
};

/// How high the substrate gets around each block of sites, ring by ring.
struct ReachBounds {
    const double* highest = nullptr; ///< [(y * blocks + block) * interface_rings + ring], Å
    const double* lowest = nullptr;  ///< likewise
    int blocks = 0;                  ///< blocks in a row
    /// Ring r holds lateral distances [r, r + 1) ring_width from the undisplaced site, Å.
    double ring_width = 1.0;
    double offset_margin = 0.0; ///< largest sideways displacement the tables allow for, Å
};

/// The substrate's heights as the sweeps read them; a view that no sweep reads is empty.
struct SubstrateHeights {
    PlaneView<const double> height;      ///< over the datum, Å
    PlaneView<const std::int32_t> fixed; ///< over the datum, in units of fixed_quantum
    double datum = 0.0;                  ///< height of the highest atom, Å
};

/// Å, a power of two: it rounds positions by half of it at most, as a float does at 3 Å.
inline constexpr double fixed_quantum = 0x1p-22;
/// Atoms farther below the datum than this stand this far below it, Å: differences of heights fit
/// into 32 bits. Sites as low as that are left to the reference loop.
inline constexpr double fixed_depth = 250.0;

/// A substrate of the block's own lattice: atom (x, y) of the tile at ((x0+x) a, (y0+y) a, height).
///
/// Offsets from a hollow site to atoms are (±(m - 1/2) a, ±(n - 1/2) a), m, n = 1, 2, ...
struct LatticeSubstrate {
    SubstrateHeights heights; ///< with a halo that holds every offset and a whole vector
    /// [k * half_offsets + n - 1]: how many m lie within the lateral distance k / cuts_per_length.
    const std::int32_t* columns = nullptr;
    int half_offsets = 0; ///< greatest m and n
    int cut_count = 0;
    double cuts_per_length = 1.0; ///< 1/Å
    ReachBounds reach;
    SubstrateMap map;
};

/// A substrate of any spacing b: atom (i, j), counted over the box and beyond it, at (i b, j b,
/// height(i - i0, j - j0)). Held as far as any site reaches, and a register and a row farther.
struct RowSubstrate {
    SubstrateHeights heights;
    int i0 = 0;
    int j0 = 0;
    ReachBounds reach;
    SubstrateMap map;
};

/// The potentials of the block's atoms with those of the substrate, by the type of the latter.
struct PairTable {
    const LennardJones* of = nullptr; ///< [type]
    int types = 0;
    double cutoff = 0.0; ///< the largest, Å

    PairTable(const LennardJones* table, int count) : of(table), types(count) {
        for (int t = 0; t < count; ++t)
            cutoff = table[t].cutoff > cutoff ? table[t].cutoff : cutoff;
    }
    PairTable(const LennardJones& of_all) : PairTable(&of_all, 1) {}
};

/// Substrate atoms anywhere, periodic in x and y: what the reference loop needs.
struct SubstrateAtoms {
    const double* x = nullptr; ///< Å, in the box
    const double* y = nullptr;
    const double* z = nullptr;
    const std::int32_t* type = nullptr; ///< row of the PairTable; none: all are of the first
    std::int64_t count = 0;
    double edge = 0.0; ///< of the box, Å
};

/// Atoms in a cell: the widest register in single precision.
inline constexpr int cell_atoms = 16;
/// The atoms that fill a cell stand so deep that larger cutoffs might reach them, Å.
inline constexpr double largest_cell_cutoff = 100.0;

/// A periodic image of a cell, moved by (x, y) edges of the box.
struct CellImage {
    std::int32_t cell;
    std::int16_t x, y;
};

/// Atoms anywhere in cells of cell_atoms, [(cell * 3 + axis) * cell_atoms + atom]; those of a cell
/// are of one type. Heights are over the datum. A cell that is not full is filled with atoms so low
/// that no site reaches them.
struct CellSubstrate {
    const double* places = nullptr;      ///< Å; or, mixed,
    const std::int32_t* fixed = nullptr; ///< from the cell's centre, in fixed_quantum
    /// [cell * 8 + n], Å: the middle of its atoms' bounds (x, y, z, 0), and half their edges.
    const double* bounds = nullptr;
    /// The cells of a type within its cutoff and the margin of a block of sites, sideways:
    /// images[k], k from first[i] to first[i + 1] with i = b * types + type, b = y * blocks + x /
    /// interface_block and the types of the PairTable; in ascending order of (y, x, cell).
    const CellImage* images = nullptr;
    const std::int64_t* first = nullptr;
    const double* highest = nullptr; ///< [b]: atom of all these cells, over the datum, Å
    int blocks = 0;                  ///< in a row
    double datum = 0.0;              ///< height of the highest atom, Å
    double offset_margin = 0.0;      ///< largest sideways displacement the lists allow for, Å
    SubstrateAtoms atoms;
};

/// What one site feels: the sums of the reference loop.
struct PairSum {
    double force[3] = {0.0, 0.0, 0.0}; ///< eV/Å
    double energy = 0.0;               ///< eV
    double nearest_r2 = no_pair;       ///< Å^2
    bool in_contact = false;           ///< closer than contact_distance to some atom
};

/// The reference: the sum over every substrate atom (periodic images included) within the cutoff of
/// a site at (x, y, z), by rows of atoms. Not-a-number where the position is none.
PairSum pair_sum(const SubstrateMap& map, const LennardJones& potential, double x, double y,
                 double z);
/// The same over atoms anywhere, one after the other, each by the potential of its type.
PairSum pair_sum(const SubstrateAtoms& atoms, const PairTable& pairs, double x, double y, double z);

/// The reference sweep: pair_sum for each site of rows [row_begin, row_end).
void reference_sweep(const InterfaceSites& sites, const SubstrateMap& map,
                     const LennardJones& potential, int row_begin, int row_end,
                     InterfaceSums& sums);
void reference_sweep(const InterfaceSites& sites, const SubstrateAtoms& atoms,
                     const PairTable& pairs, int row_begin, int row_end, InterfaceSums& sums);

/// Continuum correction for the pairs beyond the cutoff (scene: interface.tail).
///
/// A site at height g over the substrate's local mean plane feels, beyond the cutoff, a plane of n
/// atoms per area; and the shift of the potential inside it is undone. With V0 the unshifted
/// potential and c = max(r_c, |g|):
///
///     U(g) = 8 pi n epsilon [r0^12 / (10 c^10) - r0^6 / (4 c^4)]  +  pi n (r_c^2 - g^2)_+ V0(r_c)
///
/// -dU/dg = 2 pi n g V0(c) is the force of the plane's atoms beyond the cutoff: continuous at g =
/// r_c.
struct TailCorrection {
    LennardJones potential;
    double density = 0.0; ///< n, atoms per Å^2

    /// eV
    ASPERITY_HOST_DEVICE double energy(double gap) const {
        const double cut = potential.cutoff;
        const double from = std::fabs(gap) > cut ? std::fabs(gap) : cut;
        const double s2 = potential.r0 * potential.r0 / (from * from);
        const double s4 = s2 * s2;
        // r0^12 / c^10 = r0^2 s^10, r0^6 / c^4 = r0^2 s^4.
        const double beyond = 8.0 * std::numbers::pi * density * potential.epsilon * potential.r0 *
                              potential.r0 * s4 * (s4 * s2 / 10.0 - 0.25);
        const double inside = cut * cut - gap * gap;
        return beyond +
               (inside > 0.0 ? std::numbers::pi * density * inside * potential.shift() : 0.0);
    }
    /// eV/Å
    ASPERITY_HOST_DEVICE double force(double gap) const {
        const double cut = potential.cutoff;
        const double from = std::fabs(gap) > cut ? std::fabs(gap) : cut;
        const double s2 = potential.r0 * potential.r0 / (from * from);
        const double s6 = s2 * s2 * s2;
        const double unshifted = 4.0 * potential.epsilon * s6 * (s6 - 1.0);
        return 2.0 * std::numbers::pi * density * gap * unshifted;
    }
};

/// Adds the tail to forces and sums that a sweep has left; mean_height is the local mean plane
/// below each site. If observed, energies are added and the repulsive sites are counted anew.
void tail_sweep(const InterfaceSites& sites, const TailCorrection& tail,
                PlaneView<const double> mean_height, int row_begin, int row_end, bool observe,
                InterfaceSums& sums);

/// A wall below the sites: its height below each site of the tile, Å.
template <class Law>
struct WallSubstrate {
    PlaneView<const double> height;
    Law law;
};

/// A row of sites over a wall, each of which comes to rest under its own force while the elastic
/// ones stay as they are (engine/equilibrium/wall_descent.hpp).
template <class T>
struct WallRow {
    const double* below; ///< the wall's height, Å
    const double* u;     ///< where the sites are, Å
    const float* step;   ///< how far they went last, Å
    const T* elastic;    ///< S z, eV/Å, times 1 / norm
    double* next;        ///< out: where they come to rest, Å
};
struct WallRule {
    double reference_height; ///< Å
    double spring;           ///< eV/Å^2: of each site to z - (elastic force) / spring
    double momentum;         ///< z = u + momentum step
    double norm;
    double load; ///< on each site, pressing down, eV/Å
};
struct WallSums {
    double furthest = 0.0; ///< |next - z| and the force left on a site over the spring, Å
    double turn = 0.0;     ///< sum of (z - next) (next - u), Å^2
    double height = 0.0;   ///< sum of next, Å
};

/// The sweeps compiled for one processor level. Each handles rows [row_begin, row_end) of the tile
/// and overwrites their forces; `observed` ones also find energy, contacts and nearest distances.
struct InterfaceKernels {
    template <class Substrate, class Potential>
    using Sweep = void (*)(const InterfaceSites&, const Substrate&, const Potential&, int row_begin,
                           int row_end, InterfaceSums&);
    template <class Substrate, class Potential = LennardJones>
    struct Sweeps {
        Sweep<Substrate, Potential> plain[2];    ///< in double; [observe]
        Sweep<Substrate, Potential> in_mixed[2]; ///< pairs in single precision
    };
    Sweeps<LatticeSubstrate> lattice;
    Sweeps<RowSubstrate> rows;
    Sweeps<CellSubstrate, PairTable> cells;

    /// Over a wall, in double; [observe]. nearest_r2: the square of the gap, 0 where it is
    /// negative.
    template <class Law>
    using OverWall = void (*)(const InterfaceSites&, const WallSubstrate<Law>&, int row_begin,
                              int row_end, InterfaceSums&);
    template <class Law, class T>
    using Settle = WallSums (*)(const Law&, const WallRow<T>&, const WallRule&, int sites);
    template <class Law>
    struct WallKernels {
        OverWall<Law> sweep[2];
        Settle<Law, double> settle_double;
        Settle<Law, float> settle_single;
    };
    struct AllWalls {
        WallKernels<LennardJonesWall> lennard_jones;
        WallKernels<ExponentialWall> exponential;
        const auto& over(const LennardJonesWall&) const { return lennard_jones; }
        const auto& over(const ExponentialWall&) const { return exponential; }
    };
    AllWalls wall;
};

/// The kernels for the running processor (processor_level()).
const InterfaceKernels& interface_kernels();

} // namespace asperity
