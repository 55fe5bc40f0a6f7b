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

/// A unit: powers of the base dimensions and a factor.
struct Unit {
    std::array<int, 4> dimension{}; ///< powers of length, mass, time, temperature
    double factor = 1.0;            ///< factor * 10^power is the unit in SI
    int power = 0;

    bool operator==(const Unit&) const = default;
};

/// Parses a unit. Returns nothing if the text is no unit.
std::optional<Unit> parse_unit(std::string_view text);

/// Value of a text, or the reason why it is no quantity.
struct ParsedQuantity {
    double value = 0.0;
    std::string why; ///< error of the text; empty: it is valid
    std::string fix; ///< valid text to write instead
};
/// Converts a number with a unit (without: in base) to the unit base.
ParsedQuantity parse_quantity(std::string_view text, std::string_view base);
/// Returns the number of base units in one unit; nothing if their dimensions differ.
std::optional<double> conversion(std::string_view unit, std::string_view base);
/// Returns an example value for a key of this base unit: "\"0.3 nm\"".
std::string example_of(std::string_view base);

} // namespace asperity::io
