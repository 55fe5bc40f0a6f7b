// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Operations on a map of values on a periodic grid: moments, planes, jumps, other grids. The map is
// in bands (decomposition/bands.hpp): each function takes the band of this rank, and is collective.
#pragma once

#include "decomposition/bands.hpp"

#include <vector>

namespace asperity::heights {

/// Returns the rms height about the mean; NaN heights are left out.
double rms_of(const std::vector<double>& h, const Bands& bands);
/// Subtracts the mean; NaN heights are left out.
void remove_mean(std::vector<double>& h, const Bands& bands);
/// Rms height differences between neighbours inside a map of n x n points, and across the edges of
/// the periodic box. Both are similar if the map is periodic.
struct Steps {
    double inside, seam;
};
/// Computes the differences of neighbours of a square map.
Steps steps(const std::vector<double>& h, const Bands& bands);
/// Subtracts the least-squares plane.
void remove_plane(std::vector<double>& h, const Bands& bands);
/// Makes a map periodic: removes the smooth part (harmonic inside) that carries the jumps between
/// opposite edges (L. Moisan, J. Math. Imaging Vis. 39, 161, 2011).
void remove_jumps(std::vector<double>& h, const Bands& bands);
/// Returns the middle n x n points of a square map, in bands of the smaller one.
std::vector<double> middle(const std::vector<double>& h, const Bands& bands, int n);
/// Resamples a map to n x n points with the Fourier coefficients that both grids represent.
std::vector<double> resample(const std::vector<double>& h, const Bands& bands, int n);
/// Multiplies the heights so that their rms is `rms`.
void scale_to_rms(std::vector<double>& h, const Bands& bands, double rms);

} // namespace asperity::heights
