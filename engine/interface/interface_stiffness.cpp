// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/interface/interface_stiffness.hpp"

#include "decomposition/global_sum.hpp"

#include <algorithm>
#include <utility>

namespace asperity {

using namespace matrix_entry;

InterfaceStiffness::InterfaceStiffness(const Tile& tile, int components, double difference,
                                       Workspace* home)
    : sites_(tile.sites), difference_(difference), force_(tile, 1, 0, home) {
    for (int e = 0; e < (components == 1 ? 1 : matrix_entry::count); ++e)
        map_.emplace_back(tile, 1, 0, home);
    if (components > 1) displaced_ = VectorField<double>(tile, 1, 0, home);
}

double InterfaceStiffness::mean(const Interface& interface, const VectorPlane<const double>& u,
                                const VectorPlane<const double>& force, const Communicator& ranks) {
    const double step = difference_;
    interface.sweep(u, force_.plane(0),
                    {.mixed_precision = true, .height = interface.reference_height() + step});
    const PlaneView<const double> here = force.z, there = std::as_const(force_).plane(0).z;
    ExactSum sum;
    for (int y = 0; y < here.ny; ++y) {
        for (int x = 0; x < here.nx; ++x)
            sum.add(std::max(0.0, (here(x, y) - there(x, y)) / step));
        sum.carry();
    }
    return global_sum(ranks, sum) / (sites_ * sites_);
}

void InterfaceStiffness::measure(const Interface& interface, const VectorPlane<const double>& u,
                                 const VectorPlane<const double>& force) {
    const VectorPlane<const double> moved = std::as_const(force_).plane(0);
    difference_ = -difference_;
    const double step = difference_;
    const auto stiffness = [step](const PlaneView<const double>& there,
                                  const PlaneView<const double>& here, int x, int y) {
        return static_cast<float>((here(x, y) - there(x, y)) / step);
    };
    // Along z all sites go with the block.
    interface.sweep(u, force_.plane(0),
                    {.mixed_precision = true, .height = interface.reference_height() + step});
#pragma omp parallel for schedule(static)
    for (int y = 0; y < u.x.ny; ++y)
        for (int x = 0; x < u.x.nx; ++x) {
            entry(zz)(x, y) = stiffness(moved.z, force.z, x, y);
            if (displaced_.empty()) continue;
            entry(xz)(x, y) = stiffness(moved.x, force.x, x, y);
            entry(yz)(x, y) = stiffness(moved.y, force.y, x, y);
        }
    if (displaced_.empty()) return;

    const VectorPlane<double> d = displaced_.plane(0);
    // Mixed derivatives come twice: the mean of both.
    const auto second = [](float& first, float other) { first = 0.5f * (first + other); };
    for (const bool along_x : {true, false}) {
#pragma omp parallel for schedule(static)
        for (int y = 0; y < u.x.ny; ++y)
            for (int x = 0; x < u.x.nx; ++x) {
                d.x(x, y) = u.x(x, y) + (along_x ? step : 0.0);
                d.y(x, y) = u.y(x, y) + (along_x ? 0.0 : step);
                d.z(x, y) = u.z(x, y);
            }
        interface.sweep(std::as_const(displaced_).plane(0), force_.plane(0),
                        {.mixed_precision = true});
#pragma omp parallel for schedule(static)
        for (int y = 0; y < u.x.ny; ++y)
            for (int x = 0; x < u.x.nx; ++x) {
                const float kx = stiffness(moved.x, force.x, x, y);
                const float ky = stiffness(moved.y, force.y, x, y);
                const float kz = stiffness(moved.z, force.z, x, y);
                if (along_x) {
                    entry(xx)(x, y) = kx;
                    entry(xy)(x, y) = ky;
                    second(entry(xz)(x, y), kz);
                } else {
                    entry(yy)(x, y) = ky;
                    second(entry(xy)(x, y), kx);
                    second(entry(yz)(x, y), kz);
                }
            }
    }
}

void InterfaceStiffness::apply_row(int y, float* const* v) const {
    const auto line = [&](int e) { return entry(e).line(y); };
    if (displaced_.empty())
        return multiply_sites({.entry = {{}, {}, line(zz), {}, {}, {}}}, v, 1, entry(zz).nx);
    multiply_sites({.entry = {line(xx), line(yy), line(zz), line(xy), line(xz), line(yz)}}, v, 3,
                   entry(zz).nx);
}

} // namespace asperity
