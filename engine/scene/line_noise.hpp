// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Line noise of a scanned map: heights that change at random from one line of the scan to the next.
//
// A scanning probe measures lines along its fast axis, one after the other. Drift and the noise of
// the feedback move each line by itself, so neighbouring points of different lines differ by more
// than those of one line. Read as roughness, these waves take most of the energy that flattens the
// map. Noise is told from roughness that has a direction (a ground surface) by the excess of the
// slow axis over the fast one,
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

/// Treatment of line noise: the heights as they are; the median step between neighbouring lines
/// subtracted; waves across the lines scaled down to the spectrum along them.
enum class LineNoise { keep, align_rows, isotropic };

/// Differences of neighbours along the two axes of a map.
struct LineNoiseStatistics {
    bool along_y = true;      ///< the lines follow one another along y (else along x)
    double slope_ratio = 1.0; ///< rms difference of neighbours across the lines over that along
                              ///< them, at least 1
    double correlation = 0.0; ///< correlation of successive differences, of the excess (see above)
    /// Returns true if the excess of variance is more than half of the variance along the lines and
    /// its correlation is below -0.4 (H of 0.13).
    bool found() const;
};
/// Returns the statistics of a map. The mean slope does not count.
LineNoiseStatistics line_noise_statistics(const std::vector<double>& h, int n);

/// Subtracts from each line of the map the sum of the median steps between the lines before it,
/// less its straight line. along_y: the lines follow one another along y.
void align_rows(std::vector<double>& h, int n, bool along_y);

/// Energy that make_isotropic() takes off, in the waves that are counted.
struct ExcessOfLines {
    double energy = 0.0;     ///< sum q |h_q|^2 that is taken off, up to the factor of the transform
    double whole = 0.0;      ///< the same sum of all waves: flattens the map (full contact)
    double wavelength = 0.0; ///< 90 % of the energy is in waves shorter than this, in pixels
    double share() const { return whole > 0.0 ? energy / whole : 0.0; }
};
/// Takes off the excess of the waves across the lines: scales them down to the power of those along
/// the lines at the same |q|, in boxes of waves (octaves along the lines, half octaves across) that
/// hold more than twice this power and more than five standard errors of it. Waves longer than an
/// eighth of the map stay; so do the mean plane and the smooth part that carries the jumps between
/// opposite edges. Returns what that takes off among the waves that `kept` x `kept` points hold.
/// along_y: as for align_rows().
ExcessOfLines make_isotropic(std::vector<double>& h, int n, bool along_y, int kept);

/// Looks for line noise in a map, treats it as asked, and returns one note on it, or none. pixel:
/// Å; kept: points along an edge that the surface has of the map, n at most.
std::vector<std::string> treat_line_noise(std::vector<double>& h, int n, double pixel, int kept,
                                          LineNoise treatment);

} // namespace asperity
