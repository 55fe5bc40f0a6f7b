// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/table_file.hpp"

#include "io/scene_file.hpp"
#include "io/units.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <fstream>
#include <optional>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace asperity::io {

namespace {

enum class Meaning { distance, energy, force, number, other };

struct Column {
    std::string name;
    Meaning meaning = Meaning::other;
    std::string unit; ///< empty: Å or eV
};

constexpr const char* names_fix =
    "write the names of the columns above the first row, as in \"# r F V\" (r in Å, V in eV; a "
    "unit may follow a name: \"r(nm)\"), or write a file with the distances and energies alone";

/// Returns the quantity that a column of this name holds. Case and "(r)" do not count.
Meaning meaning_of(std::string name) {
    for (char& c : name)
        c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    const auto one_of = [&](std::initializer_list<std::string_view> words) {
        return std::find(words.begin(), words.end(), name) != words.end();
    };
    if (one_of({"r", "d", "dist", "distance", "separation", "rij", "r_ij"}))
        return Meaning::distance;
    if (one_of({"e", "u", "v", "energy", "potential", "phi", "epot", "pe", "v0", "pot"}))
        return Meaning::energy;
    if (one_of({"f", "force", "fpair", "dv/dr", "-dv/dr", "du/dr", "-du/dr", "de/dr", "-de/dr"}))
        return Meaning::force;
    if (one_of({"i", "n", "index", "no", "no.", "number", "id", "bin", "row"}))
        return Meaning::number;
    return Meaning::other;
}

/// Returns true if the text is a unit of length, energy or force ("eV/Å"), or one of chemistry.
bool is_unit(std::string_view text) {
    if (text == "kcal/mol" || text == "kJ/mol") return true;
    return conversion(text, "Å") || conversion(text, "eV") || conversion(text, "eV/Å");
}

/// Returns the columns that a line names: words, each with a unit behind it, in brackets or
/// without.
std::vector<Column> columns_named(std::string_view line) {
    std::string text(line);
    for (char& c : text)
        if (c == ',' || c == ';' || c == '|' || c == ':' || c == '#' || c == '=') c = ' ';
    std::vector<Column> columns;
    std::string_view left = text;
    for (std::string_view word = take_word(left); !word.empty(); word = take_word(left)) {
        const std::size_t slash = word.rfind('/'); // "r/nm"
        if (slash != std::string_view::npos && is_unit(word.substr(slash + 1)) &&
            meaning_of(std::string(word.substr(0, slash))) != Meaning::other) {
            const std::string of(word.substr(0, slash));
            columns.push_back({of, meaning_of(of), std::string(word.substr(slash + 1))});
            continue;
        }
        const std::size_t bracket = word.find_first_of("([");
        const std::string_view name = word.substr(0, bracket);
        std::string_view inside;
        if (bracket != std::string_view::npos) {
            inside = word.substr(bracket + 1);
            inside = inside.substr(0, inside.find_first_of(")]"));
        }
        const bool known = meaning_of(std::string(name)) != Meaning::other;
        if (!columns.empty() && (name.empty() ? is_unit(inside) : !known && is_unit(name))) {
            columns.back().unit = name.empty() ? inside : name;
            continue;
        }
        if (name.empty()) continue;
        columns.push_back({std::string(name), meaning_of(std::string(name)),
                           is_unit(inside) ? std::string(inside) : std::string()});
    }
    return columns;
}

/// The rows of a file and what stands above them.
struct Rows {
    std::vector<std::vector<double>> columns;
    std::string above;        ///< the last line of words above the first row
    std::string lammps_units; ///< units of a table of LAMMPS: "metal"
    bool lammps = false;
};

std::vector<std::string_view> words_of(std::string_view line) {
    std::vector<std::string_view> words;
    for (std::string_view word = take_word(line); !word.empty(); word = take_word(line))
        words.push_back(word);
    return words;
}

Rows read_rows(const std::string& file) {
    const auto fail = [](const std::string& where, const std::string& what, std::string why = "",
                         std::string fix = "write numbers separated by blanks, one row a line") {
        refuse(where, what, std::move(why), std::move(fix));
    };
    std::ifstream in(file);
    Rows rows;
    std::string text, keyword;
    int first_line = 0;
    for (int line = 1; std::getline(in, text); ++line) {
        if (line > 1'000'000) fail(file, "has more than a million lines");
        if (line == 1 && text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);
        const std::string place = fmt::format("{}:{}", file, line);
        const std::size_t hash = text.find('#');
        const std::vector<std::string_view> words =
            words_of(std::string_view(text).substr(0, hash));
        if (words.empty()) {
            if (hash == std::string::npos || !rows.columns.empty()) continue;
            rows.above = text.substr(hash);
            const std::size_t units = rows.above.find("UNITS:");
            if (units == std::string::npos) continue;
            std::string_view behind = std::string_view(rows.above).substr(units + 6);
            rows.lammps_units = take_word(behind);
            continue;
        }
        const std::optional<double> first = number_of(words[0]);
        if (!first && rows.columns.empty() && !rows.lammps) {
            // "N 1000 R 2.4 13.12" behind a keyword: a table of LAMMPS
            if (words[0] == "N" && words.size() >= 2 && number_of(words[1]) && !keyword.empty()) {
                rows.lammps = true;
                continue;
            }
            const bool names = keyword.empty() &&
                               std::none_of(words.begin(), words.end(), [](std::string_view word) {
                                   return number_of(word).has_value();
                               });
            if (names) {
                keyword = words[0];
                rows.above = text;
                continue;
            }
        }
        if (!first && rows.lammps && !rows.columns.empty())
            fail(place, fmt::format("'{}' begins a second table", words[0].substr(0, 40)),
                 "one potential is read", "write the table that is meant into a file of its own");
        if (rows.columns.empty()) rows.columns.resize(words.size()), first_line = line;
        if (words.size() != rows.columns.size())
            fail(place,
                 fmt::format("has {} than {} numbers",
                             words.size() < rows.columns.size() ? "fewer" : "more",
                             rows.columns.size()),
                 fmt::format("line {} has {}", first_line, rows.columns.size()),
                 "give every row as many numbers");
        for (std::size_t k = 0; k < words.size(); ++k) {
            const std::optional<double> value = number_of(words[k]);
            if (!value || !std::isfinite(*value))
                fail(place, fmt::format("'{}' is no finite number", words[k].substr(0, 40)));
            rows.columns[k].push_back(*value);
        }
    }
    if (in.bad()) fail(file, "cannot be read");
    if (rows.columns.empty()) fail(file, "holds no numbers");
    return rows;
}

/// Returns the columns of a table of LAMMPS, which are always the same four.
std::vector<Column> columns_of_lammps(const Rows& rows, const std::string& file) {
    if (rows.columns.size() != 4)
        refuse(file, fmt::format("has {} columns", rows.columns.size()),
               "a table of LAMMPS has index, distance, energy and force",
               "write it again with pair_write");
    if (!rows.lammps_units.empty() && rows.lammps_units != "metal")
        refuse(file, fmt::format("is in LAMMPS' units of style {}", rows.lammps_units),
               "distances are read in Å and energies in eV (style metal)",
               rows.lammps_units == "real"
                   ? "multiply the energies by 0.0433641 (kcal/mol in eV) and write UNITS: metal"
                   : "convert the distances to Å and the energies to eV, and write UNITS: metal");
    return {{"index", Meaning::number, ""},
            {"r", Meaning::distance, ""},
            {"energy", Meaning::energy, ""},
            {"force", Meaning::force, ""}};
}

/// Returns the columns by name; of two without names the first is the distance.
std::vector<Column> columns_of(const Rows& rows, const std::string& file) {
    if (rows.lammps) return columns_of_lammps(rows, file);
    std::vector<Column> named = columns_named(rows.above);
    const std::size_t count = rows.columns.size();
    const auto with = [&](Meaning meaning) {
        return std::count_if(named.begin(), named.end(),
                             [&](const Column& c) { return c.meaning == meaning; });
    };
    const bool all_named = named.size() == count &&
                           (count > 2 || std::none_of(named.begin(), named.end(), [](auto& c) {
                                return c.meaning == Meaning::other;
                            }));
    if (all_named && with(Meaning::distance) == 1 && with(Meaning::energy) == 1) return named;
    if (all_named && count <= 2)
        refuse(file, fmt::format("has the columns {} and {}", named[0].name, named.back().name),
               "a potential is read from distances and energies", names_fix);
    if (count == 2) return {{"r", Meaning::distance, ""}, {"V", Meaning::energy, ""}};
    if (count == 1)
        refuse(file, "has fewer than 2 numbers a line", "distances and energies are needed",
               "write 2 numbers a line, separated by blanks");
    refuse(file, fmt::format("has {} columns", count),
           all_named
               ? fmt::format("their names do not tell one distance and one energy: {}", rows.above)
               : std::string("distances and energies are read, and nothing says which of "
                             "the columns they are"),
           names_fix);
    return {};
}

/// Returns the number of base units in one unit of the column.
double factor_of(const Column& column, const char* base, const std::string& file) {
    if (column.unit.empty()) return 1.0;
    if (const std::optional<double> factor = conversion(column.unit, base)) return *factor;
    const char* const chemistry = column.unit == "kcal/mol" ? " (1 kcal/mol is 0.0433641 eV)"
                                  : column.unit == "kJ/mol" ? " (1 kJ/mol is 0.0103643 eV)"
                                                            : "";
    refuse(file, fmt::format("has '{}' in {}", column.name, column.unit),
           fmt::format("that is no unit of {} known here",
                       std::string_view(base) == "eV" ? "energy" : "length"),
           fmt::format("convert the column to {}{} and correct its unit", base, chemistry));
    return 1.0;
}

} // namespace

TableColumns read_table_columns(const std::string& file) {
    Rows rows = read_rows(file);
    const std::vector<Column> columns = columns_of(rows, file);
    TableColumns table;
    std::vector<std::string> unread;
    std::array<std::size_t, 2> read{};
    for (std::size_t k = 0; k < columns.size(); ++k) {
        const bool distance = columns[k].meaning == Meaning::distance;
        if (!distance && columns[k].meaning != Meaning::energy) {
            unread.push_back(columns[k].name);
            continue;
        }
        read[distance ? 0 : 1] = k;
        const double factor = factor_of(columns[k], distance ? "Å" : "eV", file);
        for (double& value : rows.columns[k])
            value *= factor;
        (distance ? table.distance : table.energy) = std::move(rows.columns[k]);
    }
    if (!unread.empty())
        table.notes.push_back(fmt::format(
            "{}: distances are read from column {} ({}), energies from column {} ({}); {} {} not "
            "read",
            file, read[0] + 1, columns[read[0]].name, read[1] + 1, columns[read[1]].name,
            fmt::join(unread, ", "), unread.size() == 1 ? "is" : "are"));
    return table;
}

} // namespace asperity::io
