// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Line noise of a scanned map: heights that change at random from one line of the scan to the next.
//
// A scanning probe measures lines along its fast axis, one after the other. Drift and the noise of
// the feedback shift each line separately, so that neighbouring points of different lines differ by
// more than those of one line. Taken for roughness, these differences would dominate the elastic
// energy of full contact. Noise is distinguished from anisotropic roughness (a ground surface) by
// the excess of differences along the slow axis over those along the fast axis,
//
//     V = <d^2>, C = <d d'>     d, d': successive differences of neighbours along an axis, Å
//     correlation = (C_slow - C_fast) / (V_slow - V_fast),
//
// which is -1/2 for lines that are independent of each other, and 2^(2H - 1) - 1 for self-affine
// grooves of Hurst exponent H.
//
// Maps are square, n x n heights in Å, row by row (h[y * n + x]).
#pragma once

#include <string>
#include <vector>

namespace asperity {

/// Treatment of line noise: none; subtraction of the median step between neighbouring lines;
/// reduction of waves across the lines to the spectrum along the lines.
enum class LineNoise { keep, align_rows, isotropic };

/// Differences of neighbours along the two axes of a map.
struct LineNoiseStatistics {
    bool along_y = true;      ///< the slow axis is y; false: x
    double slope_ratio = 1.0; ///< rms difference of neighbours across the lines divided by that
                              ///< along the lines, at least 1
    double correlation = 0.0; ///< correlation of the excess (see the head of this file)
    /// Returns true if the excess variance is more than half of the variance along the lines and
    /// its correlation is below -0.4 (as of grooves with H = 0.13).
    bool found() const;
};
/// Computes the statistics of a map. The mean slope is subtracted.
LineNoiseStatistics line_noise_statistics(const std::vector<double>& h, int n);

/// Subtracts from each line of the map the sum of the median steps between the lines before it; the
/// linear trend of this sum is kept. along_y: LineNoiseStatistics::along_y.
void align_rows(std::vector<double>& h, int n, bool along_y);

/// Energy that make_isotropic() removes.
struct ExcessOfLines {
    double energy = 0.0; ///< removed part of sum q |h_q|^2, in the unit of the transform
    double whole = 0.0;  ///< sum q |h_q|^2 of all waves, proportional to the energy of full contact
    double wavelength = 0.0; ///< wavelength below which 90 % of the removed energy lies, pixels
    /// Returns the removed share of the energy.
    double share() const { return whole > 0.0 ? energy / whole : 0.0; }
};
/// Removes the excess of waves across the lines: scales them down to the power of the waves along
/// the lines at the same |q|, in boxes of waves (octaves along the lines, half octaves across)
/// whose power exceeds the power along the lines by more than a factor of two and by more than five
/// standard errors. Waves longer than an eighth of the map, the mean plane and the smooth part that
/// carries the jumps between opposite edges are unchanged. Returns the energy removed from the
/// waves that a grid of kept x kept points represents. along_y: LineNoiseStatistics::along_y.
ExcessOfLines make_isotropic(std::vector<double>& h, int n, bool along_y, int kept);

/// Searches for line noise in a map and treats it as asked. Returns one note on the noise, or none.
/// pixel: size of a pixel, Å; kept: number of points of the map along an edge of the surface, at
/// most n.
std::vector<std::string> treat_line_noise(std::vector<double>& h, int n, double pixel, int kept,
                                          LineNoise treatment);

} // namespace asperity
