// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The substrate's height map (docs/explanation/model.md): flat, self-affine, or measured; curved on
// request. A substrate of atoms has positions and the map of the topmost atoms instead.
//
// A self-affine surface is made by Fourier filtering: amplitude and phase of each integer
// wavevector are drawn from a counter-based generator keyed by seed and wavevector, so that a seed
// gives bitwise identical heights on any number of ranks, and the same large-scale shape on a finer
// grid. Each rank makes and keeps its band of the rows (decomposition/bands.hpp).
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

/// Kind of a substrate.
enum class SurfaceKind { flat, self_affine, file, atoms };
/// Amplitudes of the waves of a self-affine surface: of random or of fixed modulus.
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
    bool holes = false;    ///< measured maps: heights may be NaN, which means no solid
    bool repeats = true;   ///< false: the surface ends at the edges of the box
    bool counter = false;  ///< the map of a second solid lies on the surface (engine/surface)
    double map_edge = 0.0; ///< measured maps: edge of the map, Å; 0: edge of the box

    bool reads_file() const {
        return kind == SurfaceKind::file || kind == SurfaceKind::atoms || counter;
    }
};

/// Makes the flat or self-affine surface of the options. Collective. Throws std::invalid_argument
/// for impossible options.
Surface make_surface(const SurfaceOptions& options, const Communicator& ranks = Communicator());

/// Returns the number of lattice sites along the edge of a measured map: options.sites if the map's
/// edge is that of the box within 0.5 %.
int sites_of_map(const SurfaceOptions& options);

/// Makes a surface from a measured map heights[y * nx + x], Å, which the root alone holds: line
/// noise is a matter of whole lines, and the root treats it. A map with as many values as sites is
/// not resampled; other maps are resampled band-limited (exactly, for waves on both grids). A map
/// wider than the box is cut to its middle. Collective. Throws std::invalid_argument if the map is
/// narrower than the box, or if its heights are no numbers (RootFailure on the other ranks).
Surface surface_from_heights(const SurfaceOptions& options, std::vector<double> heights, int nx,
                             int ny, const Communicator& ranks = Communicator());

/// Computes the statistics of the roughness of the heights, adds the cap of the options, and finds
/// the extremes. Collective.
Surface finished(const SurfaceOptions& options, Surface surface);

/// Makes a surface from atoms in the box of the options. The height of a site is that of the
/// topmost atom nearest to the site; sites without an atom are filled by Laplace's equation; the
/// mean height is shifted to z = 0. Every rank has all atoms. Collective. Throws
/// std::invalid_argument if atoms coincide.
Surface surface_from_atoms(const SurfaceOptions& options, AtomPositions atoms,
                           const Communicator& ranks = Communicator());

/// Returns the surface with all its heights on every rank of it, as on a single one. Collective.
Surface whole(Surface surface);

/// Returns Persson's C(q) of the options, Å^4 (q in 1/Å), with the spectrum clipped at the grid's
/// Nyquist wavevector.
double target_spectrum(const SurfaceOptions& options, double q);

/// Returns the number of substrate atoms across the box, at least one, for a ratio of block spacing
/// to substrate spacing.
int substrate_sites(int block_sites, double lattice_ratio);

} // namespace asperity
