// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What the programs that time the spectral block share: the paper's rough surface at some size, a
// block as thick as wide, and the height where a relaxation starts.
#pragma once

#include "engine/equilibrium/spectral_relaxation.hpp"
#include "engine/scene/surface.hpp"
#include "engine/units.hpp"

#include <sys/resource.h>

#include <chrono>

namespace asperity {

inline double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

inline Surface rough_surface(int sites, double rms) {
    SurfaceOptions s;
    s.kind = SurfaceKind::self_affine;
    s.sites = sites;
    s.length = 2.6 * sites;
    s.rms = rms;
    s.cutoff = 0.5 * sites;
    return make_surface(s);
}

inline BlockOptions paper_block(int sites) {
    BlockOptions b;
    b.sites = sites;
    b.thickness = sites;
    b.young = 77.2 * units::gigapascal;
    b.atom_mass = 197.0 * units::atomic_mass;
    b.multiscale = false;
    return b;
}

struct RoughContact {
    Surface surface;
    std::chrono::steady_clock::time_point begin = std::chrono::steady_clock::now();
    SpectralBlock block;
    double making = seconds_since(begin); ///< S(q), s
    Interface interface;
    double height = 0.0; ///< of strongest attraction, Å

    RoughContact(int sites, double rms, bool frictionless = false)
        : surface(rough_surface(sites, rms)),
          block(paper_block(sites), Communicator(), frictionless),
          interface(surface, block.tile(), block.options().spacing,
                    {.potential = {}, .single_too = true}) {
        block.set_uniform(0.0);
        height = interface.start_height();
        double strongest = 0.0;
        for (double z = height; z > surface.statistics.lowest; z -= 0.1) {
            const double force =
                interface.sweep(block.lowest_layer(), block.interface_force(), z, false)
                    .force_z.value();
            if (force < strongest) strongest = force, height = z;
            if (force > 0.0) break;
        }
    }
    /// -U / A, meV/Å^2
    double binding(double energy) const {
        const double edge = block.options().sites * block.options().spacing;
        return -1e3 * energy / (edge * edge);
    }
};

inline RelaxOptions spectral_options(double tolerance) {
    RelaxOptions options;
    options.tolerance = tolerance;
    options.max_move = 0.3;
    return options;
}

inline double peak_megabytes() {
    rusage use{};
    getrusage(RUSAGE_SELF, &use);
    return static_cast<double>(use.ru_maxrss) / 1024.0;
}

} // namespace asperity
