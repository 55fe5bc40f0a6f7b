// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The cubic spline through the rows of a tabulated potential, and how far it may be from the
// potential that the rows are of.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace asperity {

/// The cubic with these values and slopes at the ends of an interval, from its beginning on.
struct Hermite {
    double c[4];
    Hermite(double length, double y0, double s0, double y1, double s1)
        : c{y0, length * s0, 3.0 * (y1 - y0) - length * (2.0 * s0 + s1),
            2.0 * (y0 - y1) + length * (s0 + s1)} {}
    double value(double t) const { return c[0] + t * (c[1] + t * (c[2] + t * c[3])); }
    double slope(double t) const { return c[1] + t * (2.0 * c[2] + 3.0 * t * c[3]); }
};

/// A cubic spline (continuous second derivative), whose end slopes are those of the cubics through
/// the four points there. Keeps references to the points.
class CubicSpline {
public:
    /// Computes the slopes; needs 4 points or more, x ascending.
    CubicSpline(std::span<const double> x, std::span<const double> y);
    double operator()(double at) const;
    /// Returns the number of the interval that holds this place.
    std::size_t interval(double at) const;
    /// Returns the slopes at the points.
    const std::vector<double>& slopes() const { return slope_; }

private:
    std::span<const double> x_, y_;
    std::vector<double> slope_;
};

/// Estimates, at these places, how far the spline through the points is from the function that they
/// are of, if they are exact: 1.5 times the difference to the splines through every second point,
/// scaled with the fourth power of the distances of the points, (h/H)^4/(1 - (h/H)^4). For at least
/// 8 points. (Measured: scenes/validation/tables.py.)
std::vector<double> spline_error(std::span<const double> x, std::span<const double> y,
                                 std::span<const double> at);

/// Estimates the noise of each y: the root mean square, over nine points, of what a polynomial
/// through neighbours misses at a point, for errors that are independent from point to point. Of
/// four sets of neighbours the one that misses least counts, so that a smooth function has little.
/// There must be at least 8 points.
std::vector<double> noise(std::span<const double> x, std::span<const double> y);

} // namespace asperity
