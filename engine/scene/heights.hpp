// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Operations on a map of values on a periodic grid: moments, planes, jumps, other grids. Heights
// lie row by row, h[y * nx + x].
#pragma once

#include <complex>
#include <vector>

namespace asperity::heights {

/// Transforms complex values in two dimensions in place, with FFTW's sign and no scaling. The plan
/// is made by estimate for one thread, so that every rank gets a bitwise identical result. Throws
/// std::runtime_error.
void transform(std::vector<std::complex<double>>& data, int nx, int ny, int sign);

/// Returns the rms height about the mean; NaN heights are left out.
double rms_of(const std::vector<double>& h);
/// Subtracts the mean; NaN heights are left out.
void remove_mean(std::vector<double>& h);
/// Rms height differences between neighbours inside a map of n x n points, and across the edges of
/// the periodic box. Both are similar if the map is periodic.
struct Steps {
    double inside, seam;
};
/// Computes the differences of neighbours.
Steps steps(const std::vector<double>& h, int n);
/// Subtracts the least-squares plane.
void remove_plane(std::vector<double>& h, int nx, int ny);
/// Makes a map periodic: removes the smooth part (harmonic inside) that carries the jumps between
/// opposite edges (L. Moisan, J. Math. Imaging Vis. 39, 161, 2011).
void remove_jumps(std::vector<double>& h, int nx, int ny);
/// Returns the middle n x n points of a map of m x m.
std::vector<double> middle(const std::vector<double>& h, int m, int n);
/// Resamples a map of nx x ny to n x n points with the Fourier coefficients that both grids
/// represent.
std::vector<double> resample(const std::vector<double>& h, int nx, int ny, int n);
/// Multiplies the heights so that their rms is `rms`.
void scale_to_rms(std::vector<double>& h, double rms);

} // namespace asperity::heights
