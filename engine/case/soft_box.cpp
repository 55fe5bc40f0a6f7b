// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Boxes in which flat surfaces jump although their mean height is prescribed.
//
// At the gap g flat surfaces at a prescribed mean height are stable as long as the stiffness S(q)
// of the block exceeds -F'(g), the rate at which the attraction of an area falls, for each wave q
// of the box. Over an exponential wall -F' is at most w/rho^2, and the longest wave has S = pi
// E*/L: boxes wider than pi E* rho^2/w are unstable. A part of the surface then jumps into contact,
// and later out, and what is lost depends on the width of the box, however smooth the surfaces are.
//
// loss_of_flat() is a fit to runs over exponential walls: surfaces of an rms height of rho/300,
// spacing E* rho^2/2w, boxes of 2, 3, 4, 5.3 and 8 times the widest stable one lose 0.009, 0.038,
// 0.064, 0.097 and 0.160 of w.
#include "engine/case/resolving.hpp"

#include "engine/options/interface_options.hpp"
#include "engine/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace asperity {

void find_softness(Case& c) {
    if (!c.simulation.interface.wall) return;
    const double area = c.simulation.block.spacing * c.simulation.block.spacing;
    const double falls = std::visit([](const auto& law) { return -law.softest(); },
                                    mean_wall(c.simulation.interface));
    c.softness = std::max(0.0, falls / area / c.simulation.block.softest_wave());
}

double loss_of_flat(double softness) {
    const double log = std::log(std::max(1.0, softness));
    return -std::expm1(-0.0385 * log * log);
}

std::optional<std::string> note_on_soft_box(const Case& c) {
    if (!c.box_jumps()) return {};
    const double widest = c.edge() / c.softness;
    const std::optional<double> loss = c.flat_loss();
    std::string note = fmt::format(
        "in boxes wider than {:.4g} Å flat surfaces jump{}, and this one is {:.4g} Å wide: works "
        "in and out and the energy lost are those of the box, not of the surface",
        widest, loss ? " though the mean height is prescribed" : "", c.edge());
    if (loss)
        note += fmt::format("; flat surfaces lose about {:.2g} of Δγ in it",
                            *loss / c.flat.work_of_adhesion);
    if (c.surface.kind == SurfaceKind::flat && !c.simulation.interface.has_law_factors())
        note += fmt::format(
            "; nothing breaks the symmetry of surfaces that are exactly flat, so that the path may "
            "follow states that are not stable: take surface.kind = \"self-affine\" with a "
            "surface.rms of {:.1g} Å",
            0.01 * c.scales.length);
    return note;
}

} // namespace asperity
