// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Operations on a map of heights on a periodic grid, whatever it stands for: moments, planes,
// jumps, other grids. Heights lie row by row, h[y * nx + x].
#pragma once

#include <complex>
#include <vector>

namespace asperity::heights {

/// Transforms complex values in two dimensions in place, with FFTW's sign and no scaling. Planned
/// by estimate and on one thread, so that every rank gets a bitwise identical result. Throws
/// std::runtime_error.
void transform(std::vector<std::complex<double>>& data, int nx, int ny, int sign);

/// Returns the rms height; remove_mean() subtracts the mean. Heights that are NaN do not count.
double rms_of(const std::vector<double>& h);
void remove_mean(std::vector<double>& h);
/// Steps from point to point of a map of n x n, rms: between neighbours inside, and over the edges
/// of the periodic box. They are alike if the map repeats.
struct Steps {
    double inside, seam;
};
Steps steps(const std::vector<double>& h, int n);
/// Removes the plane of least squares.
void remove_plane(std::vector<double>& h, int nx, int ny);
/// Makes a map periodic: removes the smooth part (harmonic inside) that carries the jumps between
/// opposite edges (L. Moisan, J. Math. Imaging Vis. 39, 161, 2011).
void remove_jumps(std::vector<double>& h, int nx, int ny);
/// Returns the middle n x n points of a map of m x m.
std::vector<double> middle(const std::vector<double>& h, int m, int n);
/// Returns heights on n x n points with the Fourier coefficients of a map of nx x ny that both
/// grids can hold.
std::vector<double> resample(const std::vector<double>& h, int nx, int ny, int n);
void scale_to_rms(std::vector<double>& h, double rms);

} // namespace asperity::heights
