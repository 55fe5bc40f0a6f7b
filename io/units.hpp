// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Parser of units: lengths, masses, times, temperatures, and their combinations with prefixes,
// products, quotients and powers ("nm", "GPa", "m/s", "meV/Å^2", "eV/Å³", "1/ps", "%"). A factor is
// stored as a number times a power of ten, and powers of ten are applied to the decimal text, so
// that "0.3 nm" is exactly equal to 3.0 Å.
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

/// Value of a text, or the reason why the text is no quantity.
struct ParsedQuantity {
    double value = 0.0;
    std::string why; ///< error in the text; empty if the text is valid
    std::string fix; ///< example of a valid text
};
/// Parses a number with a unit and converts it to the unit `base`; a number without unit is in
/// `base`.
ParsedQuantity parse_quantity(std::string_view text, std::string_view base);
/// Returns the factor from `unit` to `base`; nothing if their dimensions differ.
std::optional<double> conversion(std::string_view unit, std::string_view base);
/// Returns an example of a value for a key with this unit: "\"0.3 nm\"".
std::string example_of(std::string_view base);

} // namespace asperity::io
