// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The pair potentials of a scene: the one that its keys give, and interface.pairs, one for each
// type of the substrate's atoms, written as LAMMPS' pair_coeff has it: type, the potential's name
// where it is not interface.potential, its parameters and, where it is not interface.cutoff, the
// cutoff.
#include "engine/case/potential_table.hpp"
#include "engine/case/resolving.hpp"
#include "engine/case/wall_shape.hpp"

#include "io/files.hpp"
#include "io/table_file.hpp"
#include "io/units.hpp"
#include "kernels/substrates.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <type_traits>

namespace asperity {

namespace {

/// Calls use(potential) with the one of that name; false where there is none.
template <class Use>
bool with_potential(const EachPotential& all, const std::string& name, Use use) {
    return std::apply([&](const auto&... p) { return ((p.name == name && (use(p), true)) || ...); },
                      all);
}

std::vector<std::string> names_of(const EachPotential& all) {
    return std::apply([](const auto&... p) { return std::vector<std::string>{p.name...}; }, all);
}

constexpr const char* table_format = "a table has distances in Å, which ascend, and energies in eV";

/// Error of a table, in the words of its reader; `what` ends the sentence of a key.
struct BadTable {
    std::string what, why, fix;
};

/// Returns the path of a table. Throws BadTable.
std::string table_file(const Case& c, const std::string& file) {
    std::string found = find_beside_scene(c.scene, file, "interface.table");
    if (found.empty())
        throw BadTable{"there is no such file", table_format,
                       "give the path of such a file, relative to the scene or to the working "
                       "directory"};
    return found;
}

/// Reads a table and hands its columns to make(). Throws BadTable.
template <class Make>
void read_table(Case& c, const std::string& found, Make make) {
    try {
        const io::TableColumns read = io::read_table_columns(found);
        make(read.distance, read.energy);
        c.notes.insert(c.notes.end(), read.notes.begin(), read.notes.end());
        std::uint32_t digest = 0;
        for (const auto* column : {&read.distance, &read.energy})
            digest = io::digest_of(std::as_bytes(std::span(*column)), digest);
        c.table_digest = c.table_digest.value_or(0) * 31 + digest;
    } catch (const io::SceneError& error) {
        const io::Problem& p = error.problems().front();
        throw BadTable{p.where + " " + p.what, p.why, p.fix};
    } catch (const std::invalid_argument& error) {
        throw BadTable{error.what(), table_format, "correct the table"};
    }
    c.table_files.push_back(found);
}

/// Reads the table of a potential, once for each file. Throws BadTable.
const PotentialTable& table_of(Case& c, const std::string& file) {
    const std::string found = table_file(c, file);
    auto& tables = c.simulation.interface.tables;
    const auto known = std::find(c.table_files.begin(), c.table_files.end(), found);
    if (known != c.table_files.end())
        return *tables[static_cast<std::size_t>(known - c.table_files.begin())];
    read_table(c, found, [&](const auto& distance, const auto& energy) {
        tables.push_back(std::make_shared<PotentialTable>(distance, energy));
    });
    return *tables.back();
}

/// Returns the cutoff "4 r0", Å.
double usual_cutoff(const auto& potential) { return 4.0 * potential.zero(); }

double cutoff_over(const PotentialTable& table, const Scene::Interface& keys) {
    return keys.cutoff.value_or(usual_cutoff(table.potential(table.last())));
}

/// Fills in the potential of interface.potential with its keys.
void find_potential(Case& c, io::Problems& problems) {
    const Scene::Interface& keys = c.scene.interface;
    const bool wall = keys.kind == InterfaceKind::wall;
    const auto use = [&]<class P>(P potential) {
        const auto refuse = [&](const std::string& with, const char* why, const char* fix) {
            problems.add("interface.potential", fmt::format("= \"{}\" {}", potential.name, with),
                         why, fix);
        };
        if (!P::has_tail && wall)
            refuse("with a wall", "a wall of smeared atoms needs the integral of the potential",
                   "take interface.kind = \"atoms\", or another potential");
        if (!P::has_tail && keys.tail)
            refuse("with interface.tail = true", "it ends where its numbers do",
                   "take tail = false");
        if constexpr (std::is_same_v<P, Tabulated>) {
            try {
                const PotentialTable& table = table_of(c, keys.table);
                potential = table.potential(std::min(cutoff_over(table, keys), table.last()));
                if (keys.cutoff && *keys.cutoff > table.last())
                    problems.add("interface.cutoff",
                                 fmt::format("= {:.6g} Å is beyond the table", *keys.cutoff),
                                 fmt::format("its last distance is {:.6g} Å", table.last()),
                                 fmt::format("take {:.6g} Å or less", table.last()));
            } catch (const BadTable& bad) {
                problems.add("interface.table", fmt::format("= \"{}\": {}", keys.table, bad.what),
                             bad.why, bad.fix);
                return;
            } catch (const std::invalid_argument& error) { // thrown for the cutoff
                problems.add(
                    "interface.cutoff",
                    fmt::format("= {:.6g} Å leaves no attraction", keys.cutoff.value_or(0.0)),
                    error.what(), "take a cutoff beyond the well; 4 r0 is usual");
                return;
            }
        } else {
            potential.cutoff = keys.cutoff.value_or(usual_cutoff(potential));
            if (!(potential.zero() > 0.0))
                refuse("is attractive down to r = 0", "nothing would keep atoms apart",
                       "take a steeper one: for Morse, a r_min above ln 2");
        }
        c.simulation.interface.potential = potential;
    };
    with_potential(keys.potentials, keys.potential_name(), use);
}

/// An entry of interface.pairs: words before the first number, and numbers with their units.
struct Entry {
    std::vector<std::string> words, quantities;
    explicit Entry(const std::string& text) {
        std::istringstream in(text);
        for (std::string word; in >> word;) {
            const bool is_file = words.size() == 2 && words[1] == Tabulated::name;
            const bool is_number =
                std::string_view("+-.0123456789").find(word.front()) != std::string_view::npos;
            if (is_number && !is_file && !words.empty())
                quantities.push_back(word);
            else if (is_file || quantities.empty())
                words.push_back(word);
            else
                quantities.back() += " " + word;
        }
    }
    /// Returns true if the entry names its potential.
    bool is_named() const { return words.size() > 1; }
};

/// Returns the form of an entry, "Au D a r0", from a potential's parameters.
template <class P>
std::string form_of(P p) {
    std::string form = p.name == LennardJones::name ? "type" : fmt::format("type {}", p.name);
    if constexpr (std::is_same_v<P, Tabulated>) form += " FILE";
    P::parameters(p, [&](const char* name, const char*, double, const char*) {
        form += fmt::format(" {}", name);
    });
    return form;
}

/// Reads the numbers of an entry whose potential is p. refuse(what, why) adds a problem with the
/// remedy `fix` and returns std::nullopt.
template <class P>
std::optional<PairPotential> read_pair(Case& c, const Entry& entry, P p, std::string& fix,
                                       const auto& refuse) {
    constexpr bool table = std::is_same_v<P, Tabulated>;
    const Scene& scene = c.scene;
    if (p.name != LennardJones::name)
        fix = fmt::format("write \"{0}\" or \"{0} cutoff\" (eV, Å)", form_of(p));
    struct Member {
        const char *name, *unit;
        double* value;
    };
    std::vector<Member> members;
    P::parameters(p, [&](const char* of, const char* unit, double& value, const char*) {
        members.push_back({of, unit, &value});
    });
    const std::size_t needed = members.size();
    members.push_back({"cutoff", "Å", &p.cutoff});
    if (entry.words.size() != (entry.is_named() ? 2 : 1) + (table ? 1 : 0) ||
        entry.quantities.size() < needed || entry.quantities.size() > members.size())
        return refuse("which is no pair of a type",
                      fmt::format("{} and {} to {} numbers are needed, and {} stand there",
                                  table ? "a type, a file" : "a type", needed, members.size(),
                                  entry.quantities.size()));
    for (std::size_t k = 0; k < entry.quantities.size(); ++k) {
        const io::ParsedQuantity read = io::parse_quantity(entry.quantities[k], members[k].unit);
        *members[k].value = read.value;
        if (read.why.empty() && std::isfinite(read.value) && read.value > 0.0) continue;
        if (!read.fix.empty()) fix = read.fix;
        return refuse(fmt::format("whose {} is '{}'", members[k].name, entry.quantities[k]),
                      read.why.empty() ? "it must be above zero" : read.why);
    }
    const bool has_cutoff = entry.quantities.size() == members.size();
    if (!has_cutoff && !table) p.cutoff = scene.interface.cutoff.value_or(usual_cutoff(p));
    const double most = std::min(0.5 * scene.edge(), largest_cell_cutoff);
    if (p.cutoff > most && (!table || has_cutoff))
        refuse(fmt::format("whose cutoff is above {:.6g} Å", most),
               "it may be half the box, and 100 Å, at most");
    if constexpr (table) {
        try {
            const PotentialTable& numbers = table_of(c, entry.words.back());
            if (entry.quantities.empty())
                p.cutoff = std::min(cutoff_over(numbers, scene.interface), numbers.last());
            p = numbers.potential(p.cutoff);
        } catch (const BadTable& bad) {
            fix = bad.fix;
            return refuse(bad.what, bad.why);
        } catch (const std::invalid_argument& error) {
            fix = "take a cutoff beyond the well; 4 r0 is usual";
            return refuse(error.what(), table_format);
        }
    }
    return p;
}

void find_pairs(Case& c, io::Problems& problems) {
    constexpr const char* key = "interface.pairs";
    const Scene& scene = c.scene;
    std::vector<PairPotential>& pairs = c.simulation.interface.by_type;
    for (const std::string& text : scene.interface.pairs) {
        const std::string shown = text.size() <= 60 ? text : text.substr(0, 60) + "...";
        const Entry entry(text);
        std::string fix = "write \"type epsilon r0\" or \"type epsilon r0 cutoff\", as in \"Au 0.1 "
                          "3.28 13.12\" (eV, Å) or \"Au 100 meV 0.328 nm\"";
        const auto refuse = [&](const std::string& what, const std::string& why) {
            problems.add(key, fmt::format("has \"{}\", {}", shown, what), why, fix);
            return std::nullopt;
        };
        const std::string type = entry.words.empty() ? "" : entry.words[0];
        const std::string name =
            entry.is_named() ? entry.words[1] : scene.interface.potential_name();
        std::optional<PairPotential> pair;
        const bool known = with_potential(scene.interface.potentials, name, [&](const auto& p) {
            pair = read_pair(c, entry, p, fix, refuse);
        });
        if (!known)
            refuse(
                fmt::format("with a potential '{}'", name),
                fmt::format("there are {}", fmt::join(names_of(scene.interface.potentials), ", ")));
        if (!pair) continue;
        if (std::find(c.types.begin(), c.types.end(), type) != c.types.end()) {
            fix = "leave one of them out";
            refuse("a type that stands there already", "its atoms have one potential");
            continue;
        }
        c.types.push_back(type);
        pairs.push_back(*pair);
    }
    // A type may repel alone, cut at the minimum of its potential; not all of them.
    const auto attracts = [](const PairPotential& p) { return cutoff_of(p) > minimum_of(p); };
    if (!pairs.empty() && std::none_of(pairs.begin(), pairs.end(), attracts))
        problems.add(key, "leaves no attraction",
                     "no type's cutoff is beyond the minimum of its potential",
                     "give one of them a larger cutoff; 4 r0 is usual");
}

/// Fills in the shape of the law of a wall.
void find_shape(Case& c, io::Problems& problems) {
    const Scene::Interface& keys = c.scene.interface;
    const auto shape = [&](WallShape made) {
        c.simulation.interface.shape = std::make_shared<const WallShape>(std::move(made));
    };
    switch (keys.law) {
    case WallLawKind::smeared:
    case WallLawKind::exponential:
        break;
    case WallLawKind::dugdale:
        return shape(WallShape::dugdale());
    case WallLawKind::power:
        return shape(WallShape::power(keys.exponent));
    case WallLawKind::nine_three:
        return shape(WallShape::nine_three());
    case WallLawKind::eight_two:
        return shape(WallShape::eight_two());
    case WallLawKind::table:
        try {
            read_table(c, table_file(c, keys.table),
                       [&](const auto& gap, const auto& energy) { shape(WallShape(gap, energy)); });
        } catch (const BadTable& bad) {
            problems.add("interface.table", fmt::format("= \"{}\": {}", keys.table, bad.what),
                         bad.why, bad.fix);
        }
    }
}

} // namespace

void find_potentials(Case& c, io::Problems& problems) {
    const Scene::Interface& keys = c.scene.interface;
    if (keys.kind == InterfaceKind::atoms || keys.law == WallLawKind::smeared)
        find_potential(c, problems);
    if (keys.has_adhesion()) find_shape(c, problems);
    if (c.scene.surface.kind == SurfaceKind::atoms) find_pairs(c, problems);
}

} // namespace asperity
