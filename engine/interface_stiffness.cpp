// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/interface_stiffness.hpp"

#include <utility>

namespace asperity {

void InterfaceStiffness::measure(const Interface& interface, const VectorPlane<const double>& u,
                                 const VectorPlane<const double>& force, double reference_height) {
    constexpr double step = 1e-3; // Å
    const VectorPlane<double> d = displaced_.plane(0);
    const VectorPlane<float> own = diagonal_.plane(0), off = off_diagonal_.plane(0);
    const VectorPlane<const double> f = std::as_const(force_).plane(0);
    const auto row = [&](int y, double along_x, double along_y) {
        for (int x = 0; x < u.x.nx; ++x) {
            d.x(x, y) = u.x(x, y) + along_x;
            d.y(x, y) = u.y(x, y) + along_y;
            d.z(x, y) = u.z(x, y);
        }
    };
    const auto stiffness = [](double there, double here) {
        return static_cast<float>((here - there) / step);
    };
    // Mixed derivatives come twice: the mean of both.
    const auto second = [](float& first, float other) { first = 0.5f * (first + other); };
    for (int along = 0; along < 3; ++along) {
#pragma omp parallel for schedule(static)
        for (int y = 0; y < u.x.ny; ++y)
            row(y, along == 0 ? step : 0.0, along == 1 ? step : 0.0);
        interface.sweep(std::as_const(displaced_).plane(0), force_.plane(0),
                        reference_height + (along == 2 ? step : 0.0), false);
#pragma omp parallel for schedule(static)
        for (int y = 0; y < u.x.ny; ++y)
            for (int x = 0; x < u.x.nx; ++x) {
                const float kx = stiffness(f.x(x, y), force.x(x, y));
                const float ky = stiffness(f.y(x, y), force.y(x, y));
                const float kz = stiffness(f.z(x, y), force.z(x, y));
                if (along == 0) own.x(x, y) = kx, off.x(x, y) = ky, off.y(x, y) = kz;
                if (along == 1) {
                    own.y(x, y) = ky, off.z(x, y) = kz;
                    second(off.x(x, y), kx);
                }
                if (along == 2) {
                    own.z(x, y) = kz;
                    second(off.y(x, y), kx);
                    second(off.z(x, y), ky);
                }
            }
    }
}

void InterfaceStiffness::apply(const VectorPlane<float>& v) const {
    const VectorPlane<const float> own = diagonal_.plane(0), off = off_diagonal_.plane(0);
#pragma omp parallel for schedule(static)
    for (int y = 0; y < v.x.ny; ++y)
        for (int x = 0; x < v.x.nx; ++x) {
            const float a = v.x(x, y), b = v.y(x, y), c = v.z(x, y);
            v.x(x, y) = own.x(x, y) * a + off.x(x, y) * b + off.y(x, y) * c;
            v.y(x, y) = off.x(x, y) * a + own.y(x, y) * b + off.z(x, y) * c;
            v.z(x, y) = off.y(x, y) * a + off.z(x, y) * b + own.z(x, y) * c;
        }
}

} // namespace asperity
