// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/atoms_file.hpp"

#include "io/error.hpp"
#include "io/map_formats.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>

#include <fmt/format.h>

namespace asperity::io {

namespace {

/// Coordinates beyond are no solid (1 mm), and lose the digits that forces need, Å.
constexpr double largest_coordinate = 1e7;
/// Types of atoms in a file.
constexpr std::size_t most_types = 64;
/// Words of a line that are looked at.
constexpr std::size_t most_words = 64;

/// For messages: no more of it than fits a line.
std::string shown(std::string_view word) {
    return word.size() <= 40 ? std::string(word) : std::string(word.substr(0, 40)) + "...";
}

template <class Number>
std::optional<Number> parsed(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    Number value{};
    const auto end = std::from_chars(word.data(), word.data() + word.size(), value);
    if (word.empty() || end.ec != std::errc() || end.ptr != word.data() + word.size())
        return std::nullopt;
    return value;
}

/// The lines of a text, one after the other.
struct Lines {
    std::string_view text;
    std::string file;
    std::size_t at = 0, number = 0;
    std::string_view line{}; ///< the one that next() found, trimmed

    bool next() {
        if (at >= text.size()) return false;
        const std::size_t end = std::min(text.find('\n', at), text.size());
        line = trimmed(text.substr(at, end - at));
        at = end + 1;
        ++number;
        if (line.find('\0') != std::string_view::npos)
            refuse(where(), "the file of atoms is no text", "it holds a zero byte",
                   "give a LAMMPS data file or extended XYZ, not compressed");
        return true;
    }
    std::string where() const { return fmt::format("{}:{}", file, number); }

    std::vector<std::string_view> words() const { return words_of(line); }
    static std::vector<std::string_view> words_of(std::string_view text) {
        std::vector<std::string_view> list;
        for (std::size_t at = 0; list.size() < most_words;) {
            at = std::min(text.find_first_not_of(blanks, at), text.size());
            if (at == text.size()) break;
            const std::size_t end = std::min(text.find_first_of(blanks, at), text.size());
            list.push_back(text.substr(at, end - at));
            at = end;
        }
        return list;
    }

    /// A finite number of moderate size, or a refusal.
    double coordinate(std::string_view word) const {
        const std::optional<double> value = parsed<double>(word);
        if (!value || !std::isfinite(*value))
            refuse(where(), fmt::format("'{}' is no coordinate", shown(word)),
                   "a finite number in Å is needed", "correct the line, or write the file again");
        if (!(std::abs(*value) <= largest_coordinate))
            refuse(
                where(), fmt::format("the coordinate {} is too large", shown(word)),
                fmt::format("{:g} Å are 1 mm: no solid of atoms is that wide", largest_coordinate),
                "write the file in Å, with the box near the origin");
        return *value;
    }
    long long integer(std::string_view word, const char* meaning) const {
        const std::optional<long long> value = parsed<long long>(word);
        if (!value)
            refuse(where(), fmt::format("'{}' is no {}", shown(word), meaning),
                   "a whole number is needed", "correct the line, or write the file again");
        return *value;
    }
    std::size_t count(std::string_view word) const {
        const long long value = integer(word, "number of atoms");
        if (value < 1 || value > 1'000'000'000)
            refuse(where(), fmt::format("a substrate of {} atoms", value),
                   "1 to 1000000000 can be read", "correct the number of atoms");
        return static_cast<std::size_t>(value);
    }
};

/// A box and atoms on their way.
struct RawAtoms {
    std::string format;
    double low[3] = {0.0, 0.0, 0.0}, width[3] = {0.0, 0.0, 0.0}; ///< width[2] = 0: not known
    std::vector<double> position[3];
    std::vector<std::string> types;
    std::vector<std::int32_t> type;

    void reserve(std::size_t count, const std::string_view& text) {
        // Ten bytes an atom at least: what a header announces is no reason to allocate.
        for (auto& axis : position)
            axis.reserve(std::min(count, text.size() / 10));
        type.reserve(std::min(count, text.size() / 10));
    }
    void add(const Lines& lines, std::string_view of_type, const std::string_view* words) {
        const auto known = std::find(types.begin(), types.end(), of_type);
        type.push_back(static_cast<std::int32_t>(known - types.begin()));
        if (known == types.end()) {
            if (types.size() == most_types)
                refuse(lines.where(), "the atoms of the substrate are of too many types",
                       fmt::format("'{}' is number {}, and {} can be read", shown(of_type),
                                   types.size() + 1, most_types),
                       "give atoms that act alike the same type");
            types.emplace_back(of_type);
        }
        for (std::size_t k = 0; k < 3; ++k)
            position[k].push_back(lines.coordinate(words[k]));
    }
};

void check_count(const Lines& lines, std::size_t there, std::size_t announced) {
    if (there != announced)
        refuse(lines.where(), "the file of atoms is not whole",
               fmt::format("it announces {} atoms, and {} are there", announced, there),
               "write the file again");
}

// LAMMPS data

struct Style {
    std::string_view name;
    std::size_t type, x, columns; ///< column of the type, of x; how many without image flags
};
constexpr Style styles[] = {{"atomic", 1, 2, 5}, {"charge", 1, 3, 6},    {"bond", 2, 3, 6},
                            {"angle", 2, 3, 6},  {"molecular", 2, 3, 6}, {"full", 2, 4, 7}};

Style style_of(const Lines& lines, const std::string& hint, std::size_t columns) {
    for (const Style& style : styles)
        if (style.name == hint) return style;
    if (!hint.empty())
        refuse(lines.where(), fmt::format("atoms of style {} cannot be read", shown(hint)),
               "atomic, charge, bond, angle, molecular and full can",
               "write the file with atom_style atomic");
    if (columns == 5 || columns == 8) return styles[0];
    if (columns == 7 || columns == 10) return styles[5];
    refuse(lines.where(), "the columns of the atoms are not known",
           fmt::format("{} columns may be of several atom styles", columns),
           "write the style behind the section's name: Atoms # molecular");
}

/// Sides of the box and the number of atoms, by their keywords; others are passed over.
struct Header {
    std::size_t atoms = 0;
    bool side[3] = {false, false, false};

    void read(const Lines& lines, std::string_view text, RawAtoms& raw) {
        const auto words = Lines::words_of(text);
        std::size_t numbers = 0;
        while (numbers < words.size() && parsed<double>(words[numbers]))
            ++numbers;
        std::string keyword;
        for (std::size_t k = numbers; k < words.size(); ++k)
            keyword += (keyword.empty() ? "" : " ") + shown(words[k]);
        const auto needs = [&](std::size_t count) {
            if (numbers != count)
                refuse(lines.where(), fmt::format("the header '{}' is not whole", shown(text)),
                       fmt::format("{} numbers are needed before '{}'", count, keyword),
                       "write the file again");
        };
        constexpr std::string_view sides[] = {"xlo xhi", "ylo yhi", "zlo zhi"};
        for (std::size_t k = 0; k < 3; ++k)
            if (keyword == sides[k]) {
                needs(2);
                raw.low[k] = lines.coordinate(words[0]);
                raw.width[k] = lines.coordinate(words[1]) - raw.low[k];
                side[k] = true;
            }
        bool tilted = keyword == "avec" || keyword == "bvec" || keyword == "cvec";
        if (keyword == "xy xz yz")
            for (std::size_t k = 0; k < numbers; ++k)
                tilted = tilted || lines.coordinate(words[k]) != 0.0;
        if (tilted)
            refuse(lines.where(), "the box of the atoms is not orthogonal",
                   fmt::format("its header says '{}', and the block's box is square", shown(text)),
                   "replicate or cut the substrate to a square box");
        if (keyword == "atoms") {
            needs(1);
            atoms = lines.count(words[0]);
        }
    }
};

void check_units(const Lines& lines, std::string_view title) {
    const std::size_t at = title.find("units = ");
    if (at == std::string_view::npos) return;
    const auto words = Lines::words_of(title.substr(at + 8));
    if (words.empty() || words[0] == "metal" || words[0] == "real") return;
    refuse(lines.where(), fmt::format("the atoms are in units of style '{}'", shown(words[0])),
           "lengths in Å are needed, as the styles metal and real have them",
           "write the file in units of style metal");
}

void check_unique(const std::string& file, std::vector<long long> ids) {
    std::sort(ids.begin(), ids.end());
    const auto twice = std::adjacent_find(ids.begin(), ids.end());
    if (twice != ids.end())
        refuse(file, fmt::format("atom {} stands twice in the file", *twice),
               "its pairs would count twice", "write the file again");
}

RawAtoms read_lammps(Lines& lines) {
    RawAtoms raw;
    lines.next(); // the title: anything
    if (lines.line.starts_with("ITEM:"))
        refuse(lines.where(), "the file of atoms is a LAMMPS dump", "a data file is needed",
               "write one with the command write_data, or extended XYZ");
    check_units(lines, lines.line);
    Header header;
    std::optional<Style> style;
    std::string hint, section;
    std::size_t columns = 0, title = 0;
    std::vector<long long> ids;
    while (lines.next()) {
        const std::size_t hash = std::min(lines.line.find('#'), lines.line.size());
        const std::string_view text = trimmed(lines.line.substr(0, hash));
        if (text.empty()) continue;
        const char first = text[0];
        if ((first >= 'a' && first <= 'z') || (first >= 'A' && first <= 'Z')) {
            section = shown(text);
            if (section != "Atoms") continue;
            if (title > 0)
                refuse(lines.where(), "the file has two sections Atoms",
                       fmt::format("the first is in line {}", title), "write the file again");
            title = lines.number;
            if (hash < lines.line.size()) hint = shown(trimmed(lines.line.substr(hash + 1)));
            raw.reserve(header.atoms, lines.text);
            continue;
        }
        if (section.empty()) header.read(lines, text, raw);
        if (section != "Atoms") continue;
        const auto words = Lines::words_of(text);
        if (!style) {
            style = style_of(lines, hint, words.size());
            columns = words.size();
            if (columns != style->columns && columns != style->columns + 3)
                refuse(lines.where(), fmt::format("the line has {} columns", columns),
                       fmt::format("atoms of style {} have {}, or {} with image flags", style->name,
                                   style->columns, style->columns + 3),
                       "correct the style behind the section's name");
        }
        if (words.size() != columns)
            refuse(lines.where(), fmt::format("the line has {} columns", words.size()),
                   fmt::format("the first atom's has {}", columns), "write the file again");
        ids.push_back(lines.integer(words[0], "number of an atom"));
        for (std::size_t k = style->columns; k < columns; ++k)
            lines.integer(words[k], "image flag");
        // A type is a whole number, or a label.
        const std::string_view type = words[style->type];
        if (std::string_view("+-.0123456789").find(type[0]) != std::string_view::npos)
            lines.integer(type, "type of an atom");
        raw.add(lines, type, &words[style->x]);
    }
    for (std::size_t k = 0; k < 2; ++k)
        if (!header.side[k])
            refuse(lines.file, "the box of the atoms is not known",
                   fmt::format("the header has no line '{}'", k == 0 ? "xlo xhi" : "ylo yhi"),
                   "write the box into the header");
    if (header.atoms == 0 || title == 0)
        refuse(lines.file, "the file holds no atoms",
               header.atoms == 0 ? "no line of the header says 'N atoms'"
                                 : "there is no section Atoms",
               "give a LAMMPS data file, or extended XYZ with a name that ends in .xyz");
    check_count(lines, raw.position[0].size(), header.atoms);
    check_unique(lines.file, std::move(ids));
    raw.format = fmt::format("LAMMPS data ({})", style->name);
    return raw;
}

// Extended XYZ

/// key=value, key="a value", of the second line; names in lower case.
std::map<std::string, std::string_view> properties_of(const Lines& lines) {
    std::map<std::string, std::string_view> list;
    const std::string_view text = lines.line;
    for (std::size_t at = 0; (at = text.find_first_not_of(blanks, at)) < text.size();) {
        std::size_t end = std::min(text.find_first_of(" \t=", at), text.size());
        const std::string key = lower(shown(text.substr(at, end - at)));
        at = end;
        if (at == text.size() || text[at] != '=') continue;
        ++at;
        const char open = at < text.size() ? text[at] : ' ';
        const char close = open == '{' ? '}' : open == '[' ? ']' : open;
        const bool quoted = open == '"' || open == '\'' || open == '{' || open == '[';
        if (quoted) ++at;
        end = quoted ? text.find(close, at) : std::min(text.find_first_of(blanks, at), text.size());
        if (end == std::string_view::npos)
            refuse(lines.where(), fmt::format("the value of '{}' has no end", key),
                   fmt::format("a {} is missing", close), "write the file again");
        if (list.size() > most_words)
            refuse(lines.where(), "the second line has too many properties",
                   fmt::format("{} can be read", most_words), "leave out what is not needed");
        if (!list.try_emplace(key, text.substr(at, end - at)).second)
            refuse(lines.where(), fmt::format("'{}' stands twice", key), "",
                   "write the file again");
        at = quoted ? end + 1 : end;
    }
    return list;
}

void read_lattice(const Lines& lines, std::string_view text, RawAtoms& raw) {
    const auto words = Lines::words_of(text);
    if (words.size() != 9)
        refuse(lines.where(), "the box of the atoms is not known",
               fmt::format("Lattice has {} numbers, and nine are needed", words.size()),
               "write Lattice=\"Lx 0 0 0 Ly 0 0 0 Lz\"");
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 3; ++column) {
            const double value = lines.coordinate(words[3 * row + column]);
            if (row == column)
                raw.width[row] = value;
            else if (std::abs(value) > 1e-9)
                refuse(lines.where(), "the box of the atoms is not orthogonal",
                       fmt::format("Lattice is \"{}\", and the block's box is square", shown(text)),
                       "replicate or cut the substrate to a square box");
        }
}

/// Columns of positions and species (npos: there are none), and how many there are.
struct Columns {
    std::size_t species = std::string_view::npos, position = std::string_view::npos, all = 0;
};

Columns columns_of(const Lines& lines, std::string_view text) {
    Columns columns;
    const auto next = [&] {
        const std::size_t end = std::min(text.find(':'), text.size());
        const std::string_view part = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        return part;
    };
    while (!text.empty()) {
        const std::string name = lower(shown(next()));
        const std::string_view kind = next();
        const long long width = lines.integer(next(), "number of columns of Properties");
        if (width < 1 || width > static_cast<long long>(most_words) || columns.all > most_words)
            refuse(lines.where(), fmt::format("Properties gives '{}' {} columns", name, width),
                   fmt::format("1 to {} can be read", most_words), "write fewer columns");
        if (name == "species" && width == 1) columns.species = columns.all;
        if (name == "pos" && kind == "R" && width == 3) {
            if (columns.position != std::string_view::npos)
                refuse(lines.where(), "Properties has pos:R:3 twice",
                       "one of them would be taken for the other", "write the file again");
            columns.position = columns.all;
        }
        columns.all += static_cast<std::size_t>(width);
    }
    if (columns.position == std::string_view::npos || columns.all >= most_words)
        refuse(lines.where(), "the positions of the atoms are not known",
               "Properties has no pos:R:3 among its first columns",
               "write Properties=species:S:1:pos:R:3");
    return columns;
}

RawAtoms read_xyz(Lines& lines) {
    RawAtoms raw;
    raw.format = "extended XYZ";
    lines.next();
    const auto head = lines.words();
    if (head.size() != 1)
        refuse(lines.where(), "the first line is no number of atoms",
               fmt::format("it is '{}'", shown(lines.line)),
               "give extended XYZ; a LAMMPS data file must not be called .xyz");
    const std::size_t count = lines.count(head[0]);
    if (!lines.next()) refuse(lines.where(), "the file of atoms is empty", "", "write it again");
    auto said = properties_of(lines);
    if (!said.contains("lattice"))
        refuse(lines.where(), "the box of the atoms is not known",
               "the second line has no Lattice=\"...\"",
               "write Lattice=\"Lx 0 0 0 Ly 0 0 0 Lz\" into it (extended XYZ)");
    read_lattice(lines, said["lattice"], raw);
    if (said.contains("origin")) {
        const auto words = Lines::words_of(said["origin"]);
        if (words.size() != 3)
            refuse(lines.where(), "Origin is no point",
                   fmt::format("it has {} numbers, and three are needed", words.size()),
                   "correct the line");
        for (std::size_t k = 0; k < 3; ++k)
            raw.low[k] = lines.coordinate(words[k]);
    }
    if (said.contains("pbc")) {
        const auto words = Lines::words_of(said["pbc"]);
        for (std::size_t k = 0; k < 2; ++k)
            if (k >= words.size() || (words[k] != "T" && words[k] != "1"))
                refuse(lines.where(),
                       fmt::format("pbc=\"{}\" is not periodic in x and y", shown(said["pbc"])),
                       "the substrate is: its atoms are repeated with the block's box",
                       "write pbc=\"T T F\" if that is meant");
    }
    const Columns columns =
        columns_of(lines, said.contains("properties") ? said["properties"] : "species:S:1:pos:R:3");
    raw.reserve(count, lines.text);
    while (raw.position[0].size() < count && lines.next()) {
        const auto words = lines.words();
        if (words.size() != columns.all)
            refuse(lines.where(), fmt::format("the line has {} columns", words.size()),
                   fmt::format("Properties gives every atom {}", columns.all),
                   "write the file again");
        raw.add(lines, columns.species < words.size() ? words[columns.species] : "",
                &words[columns.position]);
    }
    check_count(lines, raw.position[0].size(), count);
    while (lines.next())
        if (!lines.line.empty())
            refuse(lines.where(), "the file goes on behind its last atom",
                   fmt::format("it announces {} atoms; a second frame cannot be read", count),
                   "give a file of one frame");
    return raw;
}

/// Positions from the box's lower corner; those in x and y folded back into the box.
AtomsFile folded(const std::string& file, RawAtoms raw) {
    constexpr std::string_view axes = "xyz";
    std::size_t outside = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const double width = raw.width[k];
        if (k < 2 && !(width > 0.0))
            refuse(file,
                   fmt::format("the box of the atoms is {:.6g} Å wide along {}", width, axes[k]),
                   "a periodic box has a width above zero", "correct the box in the file");
        for (std::size_t i = 0; i < raw.position[k].size(); ++i) {
            double& place = raw.position[k][i];
            if (k < 2) place -= raw.low[k];
            const double from = k < 2 ? place : place - raw.low[k];
            if (width > 0.0 && (from < -width || from > 2.0 * width))
                refuse(file, fmt::format("atom {} is more than a box away from the box", i + 1),
                       fmt::format("{} = {:.6g} Å from its lower side, and the box is {:.6g} Å "
                                   "wide",
                                   axes[k], from, width),
                       "write positions in the box, or correct the box");
            if (k == 2) continue;
            if (place >= 0.0 && place < width) continue;
            outside += place < 0.0 || place > width;
            place -= width * std::floor(place / width);
            if (!(place < width)) place = 0.0; // of a negative number next to zero
        }
    }
    AtomsFile atoms;
    atoms.format = std::move(raw.format);
    atoms.types = std::move(raw.types);
    atoms.type = std::move(raw.type);
    atoms.width_x = raw.width[0];
    atoms.width_y = raw.width[1];
    atoms.x = std::move(raw.position[0]);
    atoms.y = std::move(raw.position[1]);
    atoms.z = std::move(raw.position[2]);
    if (outside > 0)
        atoms.notes.push_back(fmt::format(
            "{} coordinates of atoms lay outside of the box and were folded back", outside));
    return atoms;
}

bool is_xyz(const std::string& file) {
    const std::string ending = lower(std::filesystem::path(file).extension().string());
    return ending == ".xyz" || ending == ".extxyz";
}

} // namespace

AtomsFile read_atoms_text(std::string_view text, const std::string& file) {
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
    if (!text.empty() && text.back() != '\n')
        refuse(file, "the last line of the file of atoms has no end",
               "it may have been cut within a number", "write the file again, or end the line");
    Lines lines{text, file};
    return folded(file, is_xyz(file) ? read_xyz(lines) : read_lammps(lines));
}

AtomsFile read_atoms_file(const std::string& file) {
    return read_atoms_text(file_contents(file, "the file of atoms"), file);
}

std::size_t atoms_announced(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    std::string head(1 << 16, '\0');
    stream.read(head.data(), static_cast<std::streamsize>(head.size()));
    head.resize(static_cast<std::size_t>(stream.gcount()));
    std::size_t at = 0;
    for (bool first = true; at < head.size(); first = false) {
        const std::size_t end = std::min(head.find('\n', at), head.size());
        const auto words = Lines::words_of(std::string_view(head).substr(at, end - at));
        at = end + 1;
        const bool announces = is_xyz(file) ? first && words.size() == 1
                                            : !first && words.size() == 2 && words[1] == "atoms";
        if (!announces) continue;
        return static_cast<std::size_t>(std::max(0ll, parsed<long long>(words[0]).value_or(0)));
    }
    return 0;
}

} // namespace asperity::io
