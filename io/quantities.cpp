// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/quantities.hpp"

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

std::string rows(std::span<const Quantity> quantities) {
    std::string text;
    for (const Quantity& q : quantities)
        text += fmt::format("| `{}` | {} | {} | {} |\n", q.name, q.unit, q.per, q.meaning);
    return text;
}

std::string table(std::span<const Quantity> quantities) {
    return "| name | unit | per, or of | meaning |\n|---|---|---|---|\n" + rows(quantities);
}

} // namespace

const Quantity* run_quantity(std::string_view path) {
    if (path.starts_with('/')) path.remove_prefix(1);
    for (const Quantity& q : run_quantities)
        if (matches(q.name, path)) return &q;
    return nullptr;
}

std::string result_markdown(std::span<const Quantity> series) {
    return "# Results\n\n"
           "Written by `asperity defaults --results`; do not edit. A run writes two files to its "
           "directory:\n`result.json`, its numbers, and `run.h5` (HDF5), the series along its "
           "path and its maps.\n\n"
           "## result.json\n\n"
           "What was not computed is left out. Dots lead deeper, `*` stands for any name, `[]` for "
           "each\nelement of a list. `scene` holds the scene with its defaults filled in "
           "([scene.md](scene.md)).\n`units` holds the unit of every value at the same place as "
           "the value, for a list once for all its\nelements; `1` marks a pure number, an empty "
           "text what is no number.\n\n" +
           table(result_quantities) +
           "\n## run.h5\n\n"
           "Each data set has its `unit` and a `description` as attributes. `/` has the scene as "
           "TOML (`scene`),\nand `version` and `git` of the program that wrote it. A trajectory "
           "is in `/particles`, as H5MD wants it.\n`@` leads to an attribute.\n\n" +
           table(series) + rows(run_quantities);
}

} // namespace asperity::io
