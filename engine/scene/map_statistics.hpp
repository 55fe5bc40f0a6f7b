// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Statistics of a map of heights, named and normalized as by contact.engineering and its library
// SurfaceTopography (Jacobs, Junge, Pastewka, Surf. Topogr. 5, 013001, 2017). Heights lie row by
// row, h[y * nx + x].
//
//     C1D(q) = |h_q|^2 L              h_rms^2 = 1/pi int_0^inf C1D dq,     Å^3, lines along x
//     C2D(q) = |h_q|^2 L^2            h_rms^2 = 1/(2 pi) int q C2D dq,     Å^4
//     A(r)   = <(h(x + r) - h(x))^2> / 2                                   Å^2, lines along x
//     slope(r) = sqrt(2 A(r)) / r        scale-dependent slope (Sanner, Noehring, Thimons, Jacobs,
//                                        Pastewka, Appl. Surf. Sci. Adv. 7, 100190, 2022)
//
// with h(x) = sum_q h_q exp(i q x). Persson's C(q) (surface.hpp) is C2D / (2 pi)^2.
#pragma once

#include "decomposition/bands.hpp"

#include <vector>

namespace asperity {

/// Statistics of a map on its own grid, by finite differences. NaN heights are left out.
struct MapStatistics {
    double rms_height = 0.0;            ///< Å
    double rms_slope = 0.0;             ///< sqrt(<hx^2 + hy^2>), differences of neighbours
    double rms_curvature = 0.0;         ///< sqrt(<(hxx + hyy)^2>) / 2, second differences, 1/Å
    double lowest = 0.0, highest = 0.0; ///< Å
};
/// Computes the statistics of a map from its bands. Collective. dx, dy: size of a pixel, Å;
/// periodic: include differences across the edges.
MapStatistics map_statistics(const std::vector<double>& h, const Bands& bands, double dx, double dy,
                             bool periodic);

/// Statistics of lines along x of a periodic map of n x n points, averaged over the lines.
struct LineStatistics {
    std::vector<double> q, c1d; ///< 1/Å, Å^3; q from 2 pi / L to Nyquist
    std::vector<double> r, acf; ///< Å, Å^2; r from a pixel to L / 2
    std::vector<double> slope;  ///< scale-dependent slope at r
};
/// Computes the statistics of lines. length: edge of the map, Å.
LineStatistics line_statistics(const std::vector<double>& h, int n, double length);

} // namespace asperity
