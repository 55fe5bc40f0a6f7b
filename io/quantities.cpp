// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/quantities.hpp"

#include <algorithm>
#include <deque>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace asperity::io {

namespace {

/// Returns true if path has this name, "*" standing for one name of a group.
bool matches(std::string_view name, std::string_view path) {
    const std::size_t star = name.find('*');
    if (star == std::string_view::npos) return name == path;
    const std::string_view before = name.substr(0, star), after = name.substr(star + 1);
    if (path.size() <= before.size() + after.size() || !path.starts_with(before) ||
        !path.ends_with(after))
        return false;
    const std::string_view between =
        path.substr(before.size(), path.size() - before.size() - after.size());
    return between.find_first_of("/@") == std::string_view::npos;
}

/// A part of the page of results: the quantities whose names begin with one of these words.
struct Topic {
    std::string_view title;
    std::vector<std::string_view> words;
};

const std::vector<Topic>& result_topics() {
    static const std::vector<Topic> topics = {
        {"Works, energies and areas",
         {"delta_gamma", "binding_energy", "binding_energy_uncertainty", "pair_binding_energy",
          "work_of_interface", "work_of_drive", "{loss}", "kinetic", "spring", "box", "stored",
          "contact_fraction", "contact_area", "contact_area_uncertainty", "mesh_error",
          "repulsive_fraction", "relaxed"}},
        {"Forces, spheres and instruments",
         {"approach_force", "pull_off_force", "jkr", "contact_radius", "instrument"}},
        {"Summary", {"rows", "sentences"}},
        {"Segments, slides and friction", {"segments"}},
        {"Instabilities", {"dissipated"}},
        {"A surface that yields", {"yielding"}},
        {"Theories", {"theory"}},
        {"Energy balance", {"energy"}},
        {"Surface, block and interface", {"surface", "block", "interface"}},
        {"Name, run and failure", {"name", "run", "failure", "digest"}}};
    return topics;
}

const std::vector<Topic>& run_topics() {
    static const std::vector<Topic> topics = {{"Series along the path", {"series"}},
                                              {"Maps of states", {"fields"}},
                                              {"Stresses below the surface", {"stress"}},
                                              {"Substrate", {"substrate"}},
                                              {"Profile of a theory, in theory.h5", {"profile"}}};
    return topics;
}

/// Returns the first word of a name: {loss} for the key of a loss.
std::string_view first_word(std::string_view name) {
    const std::string_view word = name.substr(0, name.find_first_of("./@[*"));
    const auto is_of = [&](const EnergyTerm& term) { return term.is_loss() && term.key == word; };
    return std::ranges::any_of(energy_terms, is_of) ? "{loss}" : word;
}

/// Returns a table for each topic. Throws std::logic_error if a quantity belongs to none.
std::string tables(std::span<const Quantity> quantities, const std::vector<Topic>& topics) {
    std::string text;
    std::size_t written = 0;
    for (const Topic& topic : topics) {
        text += fmt::format(
            "\n### {}\n\n| name | unit | per, or of | meaning |\n|---|---|---|---|\n", topic.title);
        for (const Quantity& q : quantities) {
            if (std::ranges::find(topic.words, first_word(q.name)) == topic.words.end()) continue;
            text += fmt::format("| `{}` | {} | {} | {} |\n", q.name, q.unit, q.per, q.meaning);
            ++written;
        }
    }
    if (written != quantities.size())
        throw std::logic_error("a quantity is in no topic of the page of results, or in two");
    return text;
}

/// Returns a row whose texts have these words for the names in braces.
template <class... Words>
Quantity filled(const Quantity& row, const Words&... words) {
    static std::deque<std::string> texts; // to which quantities refer
    const auto text = [&](std::string_view of) -> std::string_view {
        return texts.emplace_back(fmt::format(fmt::runtime(of), words...));
    };
    return {text(row.name), text(row.unit), row.per, text(row.meaning)};
}

bool is_of_map(const Quantity& row) { return row.name.find("{map}") != std::string_view::npos; }

/// Returns the quantities that rows stand for. Neighbouring rows of a map are written out map by
/// map.
std::vector<Quantity> written_out(std::span<const Quantity> rows) {
    std::vector<Quantity> list;
    for (auto row = rows.begin(); row != rows.end(); ++row) {
        if (stands_for(*row, row->name)) { // the one of its name
            list.push_back(*row);
        } else if (is_of_map(*row)) {
            const auto end = std::find_if_not(row, rows.end(), is_of_map);
            for (const SiteQuantity& of : site_quantities)
                for (auto each = row; each != end; ++each)
                    list.push_back(filled(*each, fmt::arg("map", of.name),
                                          fmt::arg("unit", of.unit), fmt::arg("words", of.words)));
            row = end - 1;
        } else {
            for (const EnergyTerm& term : energy_terms)
                if (!term.word(row->name).empty())
                    list.push_back(filled(*row, fmt::arg("loss", term.key),
                                          fmt::arg("last", term.last),
                                          fmt::arg("meaning", term.meaning)));
        }
    }
    return list;
}

} // namespace

const std::vector<Quantity>& result_quantities() {
    static const std::vector<Quantity> quantities = written_out(written_quantities);
    return quantities;
}

const std::vector<Quantity>& run_quantities() {
    static const std::vector<Quantity> quantities = written_out(written_run_quantities);
    return quantities;
}

const Quantity& result_quantity(std::string_view name) {
    const auto found = std::ranges::find(result_quantities(), name, &Quantity::name);
    if (found != result_quantities().end()) return *found;
    throw std::logic_error(fmt::format("no quantity {} in written_quantities", name));
}

const Quantity* run_quantity(std::string_view path) {
    if (path.starts_with('/')) path.remove_prefix(1);
    for (const Quantity& q : run_quantities())
        if (matches(q.name, path)) return &q;
    return nullptr;
}

std::string result_markdown(std::span<const Quantity> series) {
    std::vector<Quantity> run(series.begin(), series.end());
    run.insert(run.end(), run_quantities().begin(), run_quantities().end());
    return "# Results\n\nWritten by `asperity defaults --results`; do not edit. A run writes two "
           "files to its directory:\n`result.json`, its numbers, and `run.h5` (HDF5), the series "
           "along its path and its maps.\n\n## result.json\n\nValues that were not computed are "
           "omitted. A dot leads to a member, `*` stands for any name, `[]`\nfor each element of a "
           "list. `scene` holds the scene with its defaults ([scene.md](scene.md)).\n`units` holds "
           "the unit of every value at the place of the value, for a list once for all\nelements; "
           "`1` marks a pure number, an empty text a value that is no number.\n" +
           tables(result_quantities(), result_topics()) +
           "\n## run.h5\n\nEach data set has its `unit` and a `description` as attributes. The "
           "attributes of `/` are the scene as\nTOML (`scene`), and `version` and `git` of the "
           "program. A trajectory is in `/particles`, in the form\nof H5MD. `@` leads to an "
           "attribute.\n" +
           tables(run, run_topics());
}

} // namespace asperity::io
