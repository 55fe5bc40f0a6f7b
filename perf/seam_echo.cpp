// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What a multiscale block returns of a wave that is sent into it from below, by steps of the
// engine's own Block (tests/support/echo.hpp). scenes/validation/seams.py calls it.
//
//     build/release/perf/seam_echo SITES LAYERS THICKNESS SPAN DT
//
// SPAN: time between two absorptions, fs; 0: seams reflect. Then a line of the input for each
// packet, "P|SV|SH ACROSS RISE WAVES DEPTH": periods over the box along x, vertical wavelength (a),
// its number in a standard deviation of the envelope, and how deep (a) the block is listened to.
// A line of the output each: angle to the vertical, wavelength (a), fraction of the energy
// returned.
#include "support/cases.hpp"
#include "support/echo.hpp"

#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string>

using namespace asperity;

int main(int argc, char** argv) {
    if (argc != 6) {
        std::fprintf(stderr, "usage: seam_echo SITES LAYERS THICKNESS SPAN DT\n");
        return 2;
    }
    const int sites = std::atoi(argv[1]);
    BlockOptions block = test::paper_block(sites, std::atoi(argv[3]), std::atoi(argv[2]));
    block.absorption_span = std::atof(argv[4]);
    std::string kind;
    test::Packet packet;
    for (double depth = 0.0;
         std::cin >> kind >> packet.across >> packet.rise >> packet.waves >> depth;) {
        packet.polarisation = kind == "P"    ? test::Polarisation::longitudinal
                              : kind == "SV" ? test::Polarisation::vertical_shear
                                             : test::Polarisation::horizontal_shear;
        const double returned = test::echo(block, packet, depth, std::atof(argv[5]));
        std::printf("%s %.1f %.3f %.5f\n", kind.c_str(), packet.angle(sites), packet.length(sites),
                    returned);
        std::fflush(stdout);
    }
}
