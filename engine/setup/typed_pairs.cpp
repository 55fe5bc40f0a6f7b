// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// interface.pairs: a Lennard-Jones potential for each type of the substrate's atoms, written as
// LAMMPS' pair_coeff has it: type, epsilon, r0 and, where it is not interface.cutoff, the cutoff.
#include "engine/setup/resolving.hpp"

#include "io/units.hpp"
#include "kernels/interface_sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace asperity {

namespace {

constexpr const char* example =
    "write \"type epsilon r0\" or \"type epsilon r0 cutoff\", as in \"Au 0.1 3.28 13.12\" (eV, Å) "
    "or \"Au 100 meV 0.328 nm\"";

bool starts_number(const std::string& word) {
    return std::string_view("+-.0123456789").find(word.front()) != std::string_view::npos;
}

/// Type and quantities of an entry, each number with the unit behind it.
std::pair<std::string, std::vector<std::string>> parts_of(const std::string& entry) {
    std::istringstream words(entry);
    std::string type, word;
    std::vector<std::string> quantities;
    words >> type;
    while (words >> word)
        if (starts_number(word) || quantities.empty())
            quantities.push_back(word);
        else
            quantities.back() += " " + word;
    return {type, quantities};
}

} // namespace

void parse_pairs(Case& c, io::Problems& problems) {
    constexpr const char* key = "interface.pairs";
    const Scene& scene = c.scene;
    std::vector<LennardJones>& pairs = c.simulation.interface.by_type;
    for (const std::string& entry : scene.interface.pairs) {
        const std::string shown = entry.size() <= 60 ? entry : entry.substr(0, 60) + "...";
        const auto refuse = [&](const std::string& what, const std::string& why,
                                const std::string& fix = example) {
            problems.add(key, fmt::format("has \"{}\", {}", shown, what), why, fix);
        };
        const auto [type, quantities] = parts_of(entry);
        if (quantities.size() < 2 || quantities.size() > 3) {
            refuse("which is no pair of a type",
                   fmt::format("a type and two or three numbers are needed, and {} stand there",
                               quantities.size()));
            continue;
        }
        if (std::find(c.types.begin(), c.types.end(), type) != c.types.end()) {
            refuse("a type that stands there already", "its atoms have one potential",
                   "leave one of them out");
            continue;
        }
        LennardJones pair{0.0, 0.0, scene.interface.cutoff};
        const struct {
            const char *name, *unit;
            double& value;
        } members[] = {
            {"epsilon", "eV", pair.epsilon}, {"r0", "Å", pair.r0}, {"cutoff", "Å", pair.cutoff}};
        bool right = true;
        for (std::size_t k = 0; k < quantities.size(); ++k) {
            const auto& member = members[k];
            const io::ParsedQuantity read = io::parse_quantity(quantities[k], member.unit);
            member.value = read.value;
            if (read.why.empty() && std::isfinite(read.value) && read.value > 0.0) continue;
            refuse(fmt::format("whose {} is '{}'", member.name, quantities[k]),
                   read.why.empty() ? "it must be above zero" : read.why,
                   read.fix.empty() ? example : read.fix);
            right = false;
        }
        if (!right) continue;
        const double most = std::min(0.5 * scene.edge(), largest_cell_cutoff);
        if (pair.cutoff > most && (quantities.size() == 3))
            refuse(fmt::format("whose cutoff is above {:.6g} Å", most),
                   "it may be half the box, and 100 Å, at most", "take a smaller cutoff");
        c.types.push_back(type);
        pairs.push_back(pair);
    }
    // A type may repel alone, cut at the minimum of its potential; not all of them.
    const auto attracts = [](const LennardJones& p) {
        return p.cutoff > std::pow(2.0, 1.0 / 6.0) * p.r0;
    };
    if (!pairs.empty() && std::none_of(pairs.begin(), pairs.end(), attracts))
        problems.add(key, "leaves no attraction",
                     "no type's cutoff is beyond the minimum of its potential, 2^(1/6) r0",
                     "give one of them a larger cutoff; 4 r0 is usual");
}

} // namespace asperity
