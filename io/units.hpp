// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Units as people write them: lengths, masses, times, temperatures, and what is built of them with
// prefixes, products, quotients and powers ("nm", "GPa", "m/s", "meV/Å^2", "eV/Å³", "1/ps", "%").
// A factor is kept as a number times a power of ten, and powers of ten are shifted in the decimal
// text, so "0.3 nm" is exactly what 3.0 Å is.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace asperity::io {

struct Unit {
    std::array<int, 4> dimension{}; ///< powers of length, mass, time, temperature
    double factor = 1.0;            ///< in SI: factor * 10^power
    int power = 0;

    bool operator==(const Unit&) const = default;
};

/// Empty if the text is no unit.
std::optional<Unit> parse_unit(std::string_view text);

struct ParsedQuantity {
    double value = 0.0;
    std::string why; ///< empty: fine. Else what is wrong with the text
    std::string fix; ///< and what would be right
};
/// A number with a unit (or without: then it is in base) converted to base.
ParsedQuantity parse_quantity(std::string_view text, std::string_view base);
/// How many base units one of these units is; empty if they are of different dimension.
std::optional<double> conversion(std::string_view unit, std::string_view base);
/// A value that a key of this base unit could have: "\"0.3 nm\"".
std::string example_of(std::string_view base);

} // namespace asperity::io
