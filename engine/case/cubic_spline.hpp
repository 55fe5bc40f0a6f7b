// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The cubic spline through the rows of a tabulated potential, and estimates of its error.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace asperity {

/// The cubic with given values y and slopes s at both ends of an interval, as a polynomial in t,
/// from 0 to 1.
struct Hermite {
    double c[4];
    Hermite(double length, double y0, double s0, double y1, double s1)
        : c{y0, length * s0, 3.0 * (y1 - y0) - length * (2.0 * s0 + s1),
            2.0 * (y0 - y1) + length * (s0 + s1)} {}
    /// Returns the value at t.
    double value(double t) const { return c[0] + t * (c[1] + t * (c[2] + t * c[3])); }
    /// Returns the derivative with respect to t.
    double slope(double t) const { return c[1] + t * (2.0 * c[2] + 3.0 * t * c[3]); }
};

/// A cubic spline (continuous second derivative) whose end slopes are those of the cubics through
/// the four outermost points. Keeps references to the points.
class CubicSpline {
public:
    /// Computes the slopes; needs 4 points or more, x ascending.
    CubicSpline(std::span<const double> x, std::span<const double> y);
    double operator()(double at) const; ///< returns the value at a place
    /// Returns the index of the interval that contains a place.
    std::size_t interval(double at) const;
    /// Returns the slopes at the points.
    const std::vector<double>& slopes() const { return slope_; }

private:
    std::span<const double> x_, y_;
    std::vector<double> slope_;
};

/// Estimates the error of the spline through exact points at these places: 1.5 times the difference
/// from the splines through every second point, scaled with the fourth power of the distances of
/// the points, (h/H)^4/(1 - (h/H)^4). Needs at least 8 points. (Measured:
/// scenes/validation/tables.py.)
std::vector<double> spline_error(std::span<const double> x, std::span<const double> y,
                                 std::span<const double> at);

/// Estimates the noise of each y, for errors that are independent from point to point: the root
/// mean square, over nine points, of the deviation from a polynomial through neighbours. The
/// deviation is the smallest for four sets of neighbours, so that a smooth function has little
/// noise. Needs at least 8 points.
std::vector<double> noise(std::span<const double> x, std::span<const double> y);

} // namespace asperity
