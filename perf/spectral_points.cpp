// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What does a point of a quasi-static path cost? From the relaxed state the top plane, held, is
// moved by a little, and the spectral block relaxed again from where it was.
//
//     spectral_points SITES RMS [frictionless]
#include "rough_contact.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <string>

using namespace asperity;

int main(int argc, char** argv) {
    const int sites = argc > 1 ? std::atoi(argv[1]) : 128;
    const double rms = argc > 2 ? std::atof(argv[2]) : 3.0;
    const bool frictionless = argc > 3 && std::string(argv[3]) == "frictionless";
    RoughContact contact(sites, rms, frictionless);
    SpectralBlock& block = contact.block;
    Phases phases;
    const auto relaxed = [&](const std::string& what) {
        const auto start = std::chrono::steady_clock::now();
        const RelaxedState s =
            relax(block, contact.interface, contact.height, spectral_options(1e-4), phases);
        fmt::print("{:24} {:4} iterations {:7.3f} s, {:.8f} meV/Å², contact {}{}\n", what,
                   s.iterations, seconds_since(start),
                   contact.binding(s.interface_energy + s.elastic_energy), s.in_contact,
                   s.converged ? "" : "  NOT CONVERGED");
    };
    relaxed("zero load");
    double top = block.top();
    for (double move : {0.02, 0.05, 0.1, 0.25, -0.02, -0.1, -0.25, 0.1, 0.25, 0.25, 0.25}) {
        block.constrain(Constraint::top(top += move));
        relaxed(fmt::format("top moved by {:+.2f} Å", move));
    }
    fmt::print("peak memory {:.0f} MB\n", peak_megabytes());
    return 0;
}
