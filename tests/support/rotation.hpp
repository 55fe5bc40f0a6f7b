// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// 3 x 3 matrices for tests of finite deformations.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace asperity::test {

using Matrix = std::array<std::array<double, 3>, 3>;

inline std::array<double, 3> apply(const Matrix& m, const std::array<double, 3>& v) {
    std::array<double, 3> result{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            result[i] += m[i][j] * v[j];
    return result;
}

inline Matrix product(const Matrix& a, const Matrix& b) {
    Matrix result{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            for (std::size_t k = 0; k < 3; ++k)
                result[i][j] += a[i][k] * b[k][j];
    return result;
}

/// About an axis of any length (Rodrigues).
inline Matrix rotation(const std::array<double, 3>& axis, double degrees) {
    const double length = std::hypot(axis[0], axis[1], axis[2]);
    const double x = axis[0] / length, y = axis[1] / length, z = axis[2] / length;
    const double angle = degrees * std::numbers::pi / 180.0;
    const double c = std::cos(angle), s = std::sin(angle), d = 1.0 - c;
    return {{{c + d * x * x, d * x * y - s * z, d * x * z + s * y},
             {d * x * y + s * z, c + d * y * y, d * y * z - s * x},
             {d * x * z - s * y, d * y * z + s * x, c + d * z * z}}};
}

} // namespace asperity::test
