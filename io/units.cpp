// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A unit is a chain of terms, "meV/Å^2" or "kg m-1 s-2"; a term is a prefix, a symbol and a
// power. python/asperity/units.py has the same table (a test compares them). A symbol is looked up
// whole before it is split into prefix and symbol, so that "min" is a minute and "Pa" no
// peta-annum.
#include "io/units.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <utility>

#include <fmt/format.h>

namespace asperity::io {

namespace {

struct Symbol {
    std::string_view name;
    Unit unit;
    bool takes_prefix;
};

constexpr std::array<int, 4> length{1, 0, 0, 0}, mass{0, 1, 0, 0}, duration{0, 0, 1, 0},
    temperature{0, 0, 0, 1}, energy{2, 1, -2, 0}, force{1, 1, -2, 0}, pressure{-1, 1, -2, 0},
    rate{0, 0, -1, 0}, number{0, 0, 0, 0};

// CODATA 2018: the electron volt is exact, the atomic mass unit is not.
constexpr Symbol symbols[] = {
    {"m", {length, 1.0, 0}, true},
    {"Å", {length, 1.0, -10}, false},      // U+00C5
    {"\u212B", {length, 1.0, -10}, false}, // the Ångström sign
    {"A", {length, 1.0, -10}, false},      // for keyboards; nothing here is electric
    {"Ang", {length, 1.0, -10}, false},
    {"angstrom", {length, 1.0, -10}, false},
    {"Angstrom", {length, 1.0, -10}, false},
    {"g", {mass, 1.0, -3}, true},
    {"u", {mass, 1.66053906660, -27}, false},
    {"amu", {mass, 1.66053906660, -27}, false},
    {"Da", {mass, 1.66053906660, -27}, false},
    {"s", {duration, 1.0, 0}, true},
    {"min", {duration, 6.0, 1}, false},
    {"h", {duration, 3.6, 3}, false},
    {"d", {duration, 8.64, 4}, false},
    {"K", {temperature, 1.0, 0}, true},
    {"J", {energy, 1.0, 0}, true},
    {"eV", {energy, 1.602176634, -19}, true},
    {"N", {force, 1.0, 0}, true},
    {"Pa", {pressure, 1.0, 0}, true},
    {"bar", {pressure, 1.0, 5}, true},
    {"atm", {pressure, 1.01325, 5}, false},
    {"psi", {pressure, 6.894757293168, 3}, true},
    {"ksi", {pressure, 6.894757293168, 6}, false},
    {"Hz", {rate, 1.0, 0}, true},
    {"%", {number, 1.0, -2}, false},
    {"1", {number, 1.0, 0}, false},
};

constexpr std::pair<std::string_view, int> prefixes[] = {
    {"a", -18}, {"f", -15}, {"p", -12}, {"n", -9}, {"u", -6}, {"\u00B5", -6}, {"\u03BC", -6},
    {"m", -3},  {"c", -2},  {"k", 3},   {"M", 6},  {"G", 9},  {"T", 12},
};

std::optional<Unit> find_symbol(std::string_view name) {
    for (const Symbol& symbol : symbols)
        if (symbol.name == name) return symbol.unit;
    for (const auto& [prefix, power] : prefixes) {
        if (!name.starts_with(prefix)) continue;
        for (const Symbol& symbol : symbols)
            if (symbol.takes_prefix && symbol.name == name.substr(prefix.size())) {
                Unit unit = symbol.unit;
                unit.power += power;
                return unit;
            }
    }
    return std::nullopt;
}

bool skip(std::string_view& text, std::string_view what) {
    if (!text.starts_with(what)) return false;
    text.remove_prefix(what.size());
    return true;
}

void skip_blanks(std::string_view& text) {
    while (skip(text, " ") || skip(text, "\t")) {
    }
}

/// Other spellings: superscripts, "**", the dot of a product, and "µ" in UTF-8 that a program took
/// for Latin-1 (in files of SUR).
constexpr std::pair<std::string_view, std::string_view> spellings[] = {
    {"⁰", "^0"},  {"¹", "^1"},
    {"²", "^2"},  {"³", "^3"},
    {"⁴", "^4"},  {"⁵", "^5"},
    {"⁶", "^6"},  {"⁷", "^7"},
    {"⁸", "^8"},  {"⁹", "^9"},
    {"⁻^", "^-"}, {"**", "^"},
    {"·", "*"},   {"\u00C2\u00B5", "\u00B5"},
    {"Â²", "^2"}, {"Ã\u0085", "Å"}, // UTF-8 that was read as Latin-1
};

std::string plain(std::string_view unit) {
    std::string text(unit);
    for (const auto& [from, to] : spellings)
        for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
            text.replace(at, from.size(), to);
    return text;
}

/// Returns the power behind a symbol: ^2, ^-1; 1 if there is none. The power that stands in the
/// symbol itself, as in "m2" or "s-1", is moved from there.
std::optional<int> take_power(std::string_view& text, std::string_view& symbol) {
    if (!text.starts_with("^")) {
        const std::size_t end = symbol.find_last_not_of("123456789-") + 1;
        if (end == 0 || end == symbol.size()) return 1;
        std::string_view power = symbol.substr(end);
        symbol = symbol.substr(0, end);
        const int sign = skip(power, "-") ? -1 : 1;
        if (power.size() != 1 || power[0] == '-') return std::nullopt;
        return sign * (power[0] - '0');
    }
    skip(text, "^");
    const int sign = skip(text, "-") ? -1 : 1;
    if (text.empty() || text[0] < '1' || text[0] > '9') return std::nullopt;
    const int digit = text[0] - '0';
    text.remove_prefix(1);
    return sign * digit;
}

std::string_view take_symbol(std::string_view& text) {
    const std::string_view symbol = text.substr(0, text.find_first_of(" \t*/^"));
    text.remove_prefix(symbol.size());
    return symbol;
}

double scaled(double value, int power) { // powers of ten are exact up to 10^22
    return power >= 0 ? value * std::pow(10.0, power) : value / std::pow(10.0, -power);
}

/// Base units, each with a value that a key of the unit could have.
constexpr std::pair<std::string_view, std::string_view> examples[] = {
    {"Å", "\"0.3 nm\""},       {"eV", "\"100 meV\""},     {"GPa", "\"77.2 GPa\""},
    {"MPa", "\"1 kPa\""},      {"m/s", "\"5 m/s\""},      {"fs", "\"0.01 ps\""},
    {"ps", "\"20 ps\""},       {"1/ps", "\"0.05 1/ps\""}, {"K", "\"300 K\""},
    {"u", "\"197 u\""},        {"s", "\"10 min\""},       {"meV/Å^2", "\"1.6 J/m^2\""},
    {"eV/Å", "\"0.1 meV/Å\""}, {"N/m", "\"30 mN/m\""},
};

/// Names of the dimensions.
constexpr std::pair<std::array<int, 4>, const char*> measures[] = {
    {number, "a bare number"},
    {length, "a length"},
    {mass, "a mass"},
    {duration, "a time"},
    {temperature, "a temperature"},
    {energy, "an energy"},
    {force, "a force"},
    {pressure, "a pressure"},
    {{1, 0, -1, 0}, "a velocity"},
    {rate, "a rate"},
    {{0, 1, -2, 0}, "an energy per area"},
};

std::string measure_of(const Unit& unit) {
    for (const auto& [dimension, measure] : measures)
        if (dimension == unit.dimension) return measure;
    return "something else";
}

} // namespace

std::optional<Unit> parse_unit(std::string_view written) {
    const std::string owned = plain(written);
    std::string_view text = owned;
    Unit unit;
    bool divide = false;
    skip_blanks(text);
    if (text.empty()) return unit;
    while (true) {
        std::string_view name = take_symbol(text);
        const std::optional<int> power = take_power(text, name);
        const std::optional<Unit> symbol = find_symbol(name);
        if (!symbol || !power) return std::nullopt;
        const int times = divide ? -*power : *power;
        for (std::size_t i = 0; i < 4; ++i)
            unit.dimension[i] += times * symbol->dimension[i];
        unit.power += times * symbol->power;
        for (int i = 0; i < std::abs(times); ++i)
            unit.factor = times > 0 ? unit.factor * symbol->factor : unit.factor / symbol->factor;
        skip_blanks(text);
        if (text.empty()) return unit;
        divide = skip(text, "/");
        if (!divide) skip(text, "*");
        skip_blanks(text);
    }
}

std::optional<double> conversion(std::string_view unit, std::string_view base) {
    const std::optional<Unit> from = parse_unit(unit), to = parse_unit(base);
    if (!from || !to || from->dimension != to->dimension) return std::nullopt;
    return scaled(from->factor / to->factor, from->power - to->power);
}

std::string example_of(std::string_view base) {
    for (const auto& [unit, text] : examples)
        if (unit == base) return std::string(text);
    return base.empty() ? "0.5" : fmt::format("\"1 {}\"", base);
}

ParsedQuantity parse_quantity(std::string_view text, std::string_view base) {
    ParsedQuantity result;
    const auto wrong = [&](std::string why, std::string fix) {
        result.why = std::move(why);
        result.fix = std::move(fix);
        return result;
    };
    const std::string usual =
        base.empty() ? "give a bare number, for example 0.5"
                     : fmt::format("give a number in {}, or one with a unit, for example {}", base,
                                   example_of(base));
    skip_blanks(text);
    skip(text, "+");
    const char* const begin = text.data();
    const char* const end = begin + text.size();
    const auto parsed = std::from_chars(begin, end, result.value);
    if (parsed.ec == std::errc::invalid_argument)
        return wrong("it does not begin with a number", usual);
    if (parsed.ec != std::errc()) return wrong("the number is too large or too small", usual);
    std::string digits(begin, parsed.ptr);
    if (!std::isfinite(result.value)) return wrong("it is not a finite number", usual);

    std::string_view name(parsed.ptr, static_cast<std::size_t>(end - parsed.ptr));
    skip_blanks(name);
    if (name.empty()) return result; // in the base unit
    if (name[0] == ',') {
        const bool one_number = digits.find_first_of(".eE") == std::string::npos &&
                                name.find(',', 1) == std::string_view::npos;
        return one_number
                   ? wrong("a comma is no decimal point, and one number is needed",
                           fmt::format("write \"{}.{}\" if that is meant; several values "
                                       "are for `asperity sweep`",
                                       digits, name.substr(1)))
                   : wrong(
                         "it is a list, and one number is needed",
                         "give one of them; all of them are for `asperity sweep SCENE --set KEY=" +
                             std::string(text) + "`");
    }
    const std::optional<Unit> unit = parse_unit(name);
    if (!unit) return wrong(fmt::format("'{}' is no unit known here", name), usual);
    const Unit target = parse_unit(base).value_or(Unit{});
    if (unit->dimension != target.dimension)
        return wrong(
            fmt::format("{} is needed, and {} is {}", measure_of(target), name, measure_of(*unit)),
            usual);
    const int shift = unit->power - target.power;
    if (unit->factor == target.factor) { // shift the decimal point, exactly
        int exponent = shift;
        if (const std::size_t e = digits.find_first_of("eE"); e != std::string::npos) {
            exponent += std::atoi(digits.c_str() + e + 1);
            digits.resize(e);
        }
        digits += fmt::format("e{}", exponent);
        const auto shifted =
            std::from_chars(digits.data(), digits.data() + digits.size(), result.value);
        if (shifted.ec != std::errc()) return wrong("the number is too large or too small", usual);
    } else {
        result.value = scaled(result.value * (unit->factor / target.factor), shift);
    }
    return result;
}

} // namespace asperity::io
