// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The substrate's height map (docs/explanation/model.md): flat, self-affine, or measured; curved on
// request. Or its atoms, at positions of their own, with the map of the topmost ones.
//
// A self-affine surface is made by Fourier filtering: each integer wavevector draws its amplitude
// and phase from a counter-based generator keyed by seed and wavevector, so the same seed gives
// bitwise identical heights on every rank, and the same large-scale shape when the grid grows.
// Every rank makes the whole map: it is one plane, small beside the block.
//
// Conventions (Persson): h_rms^2 = 2 pi int q C(q) dq; on the grid C(q) = |h_q|^2 (L / 2 pi)^2 with
// h(x) = sum_q h_q exp(i q x). q in 1/Å, C in Å^4. q_L = 2 pi / L.
#pragma once

#include "engine/options/substrate.hpp"
#include "engine/scene/line_noise.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace asperity {

enum class SurfaceKind { flat, self_affine, file, atoms };
enum class Amplitudes { gaussian, fixed };

/// Options of a substrate.
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
    double radius = 0.0;   ///< radius of the spherical cap, Å; 0: none
    bool detrend = false;  ///< measured maps: remove the mean plane
    bool periodic = false; ///< measured maps: remove the jumps between opposite edges
    LineNoise line_noise =
        LineNoise::keep;   ///< measured maps: treatment of the noise of their lines
    bool holes = false;    ///< measured maps: heights may be NaN, where no solid is
    bool repeats = true;   ///< false: the surface ends at the edges of the box
    double map_edge = 0.0; ///< measured maps: their edge, Å; 0: that of the box

    bool reads_file() const { return kind == SurfaceKind::file || kind == SurfaceKind::atoms; }
};

/// Makes the flat or self-affine surface of the options. Throws std::invalid_argument if they
/// describe none.
Surface make_surface(const SurfaceOptions& options);

/// Returns the number of lattice sites along the edge of a measured map: `sites` if it fills the
/// box to 0.5 %.
int sites_of_map(const SurfaceOptions& options);

/// Makes a surface of a measured map heights[y * nx + x]. A map with as many values as sites is
/// taken as it is; another is resampled band-limited (exactly, for the waves of both grids). A map
/// wider than the box is cut to its middle. Throws std::invalid_argument if the map is narrower.
Surface surface_from_heights(const SurfaceOptions& options, std::vector<double> heights, int nx,
                             int ny);

/// Makes a surface of atoms in the box of the options. Heights are those of the topmost atom
/// nearest to each site of the lattice; sites without one are filled by Laplace's equation; the
/// mean becomes z = 0. Throws std::invalid_argument if atoms coincide.
Surface surface_from_atoms(const SurfaceOptions& options, AtomPositions atoms);

/// Returns Persson's C(q) of the options, Å^4 (q in 1/Å), with the spectrum clipped at the grid's
/// Nyquist wavevector.
double target_spectrum(const SurfaceOptions& options, double q);

/// Returns the number of atoms across the box for a ratio of block spacing to substrate spacing, at
/// least one.
int substrate_sites(int block_sites, double lattice_ratio);

} // namespace asperity
