// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The substrate's height map (docs/explanation/model.md): flat, self-affine, or measured; curved on
// request. Or its atoms, at positions of their own, and the map of the topmost ones.
//
// A self-affine surface is made by Fourier filtering: each integer wavevector draws its amplitude
// and phase from a counter-based generator keyed by seed and wavevector, so the same seed gives
// bitwise identical heights on every rank, and the same large-scale shape when the grid grows.
// Every rank makes the whole map: it is one plane, small beside the block.
//
// Conventions (Persson): h_rms^2 = 2 pi int q C(q) dq; on the grid C(q) = |h_q|^2 (L / 2 pi)^2 with
// h(x) = sum_q h_q exp(i q x). q in 1/Å, C in Å^4. q_L = 2 pi / L.
#pragma once

#include "engine/scene/line_noise.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace asperity {

enum class SurfaceKind { flat, self_affine, file, atoms };
enum class Amplitudes { gaussian, fixed };

struct SurfaceOptions {
    SurfaceKind kind = SurfaceKind::self_affine;
    int sites = 512;        ///< atoms across the box
    double length = 1331.2; ///< edge of the periodic box, Å
    double rms = 3.0;       ///< Å; for a measured map: 0 keeps its own
    double hurst = 0.8;
    double rolloff = 3.0;  ///< q0 / q_L
    double cutoff = 512.0; ///< q1 / q_L, clipped at the grid's Nyquist wavevector
    Amplitudes amplitudes = Amplitudes::gaussian;
    std::uint64_t seed = 1;
    double radius = 0.0;   ///< of the spherical cap, Å; 0: none
    bool detrend = false;  ///< measured maps: remove the mean plane
    bool periodic = false; ///< measured maps: remove the jumps between opposite edges
    LineNoise line_noise =
        LineNoise::keep;   ///< measured maps: treatment of the noise of their lines
    double map_edge = 0.0; ///< measured maps: their edge, Å; 0: that of the box
};

/// One bin of the radially averaged spectrum.
struct SpectrumBin {
    double q = 0.0;        ///< mean wavevector of the bin's modes, 1/Å
    double realised = 0.0; ///< C(q), Å^4
    double target = 0.0;   ///< what the options ask for (0 for flat and measured surfaces), Å^4
    int modes = 0;
};

/// Of the roughness, without the cap; least and greatest height with it.
struct SurfaceStatistics {
    double rms = 0.0;                  ///< Å
    double rms_slope = 0.0;            ///< sqrt(<hx^2 + hy^2>), spectral derivative
    double rms_curvature = 0.0;        ///< sqrt(<(hxx + hyy)^2>) / 2, spectral, 1/Å
    double lowest = 0.0;               ///< Å
    double highest = 0.0;              ///< Å
    std::vector<SpectrumBin> spectrum; ///< bins of width q_L
};

/// Atoms anywhere, Å.
struct AtomPositions {
    std::vector<double> x, y, z;
    std::vector<std::int32_t>
        type{}; ///< counted from 0 in the scene's pairs; empty: all are of one
    std::size_t size() const { return x.size(); }
};

struct Surface {
    int sites = 0;
    double length = 0.0;        ///< Å
    double radius = 0.0;        ///< of the cap that the heights hold, Å; 0: none
    std::vector<double> height; ///< height[y * sites + x] of the atom at (x, y) length / sites, Å;
                                ///< where there are `atoms`, of the topmost one nearest to it
    AtomPositions atoms;        ///< in the box [0, length); empty: one for each height
    SurfaceStatistics statistics;
    std::string origin; ///< of a measured map: whose it is, where its file says so
    /// Of a map or atoms from a file: CRC-32 of what was read, before anything was made of it.
    std::optional<std::uint32_t> file_digest;
    std::vector<std::string> doubts; ///< what may be wrong with the map of a file, in words
    std::vector<std::string> notes;  ///< what was clipped or resampled, in words
};

/// The flat or self-affine surface that the options describe. Throws std::invalid_argument for
/// options that describe none.
Surface make_surface(const SurfaceOptions& options);

/// Lattice sites along the edge of a measured map: `sites` if it fills the box to 0.5 %.
int sites_of_map(const SurfaceOptions& options);

/// A measured map heights[y * nx + x]: taken as it is if it has as many values as it covers sites,
/// else resampled band-limited (exactly, for what both grids can hold). Of a map wider than the box
/// the middle is cut out; one that is narrower is refused (std::invalid_argument).
Surface surface_from_heights(const SurfaceOptions& options, std::vector<double> heights, int nx,
                             int ny);

/// Atoms in the box of the options. Heights are those of the topmost atom nearest to each site of
/// the lattice, sites without one being filled by Laplace's equation; their mean becomes z = 0.
/// Throws std::invalid_argument where atoms coincide.
Surface surface_from_atoms(const SurfaceOptions& options, AtomPositions atoms);

/// Persson's C(q) of the options, Å^4 (q in 1/Å), with the spectrum clipped at the grid's Nyquist
/// wavevector.
double target_spectrum(const SurfaceOptions& options, double q);

/// Atoms across the box for a ratio of block spacing to substrate spacing, at least one.
int substrate_sites(int block_sites, double lattice_ratio);

} // namespace asperity
