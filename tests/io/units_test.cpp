// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/units.hpp"

#include <gtest/gtest.h>

namespace asperity::io {
namespace {

struct Case {
    const char* text;
    const char* base;
    double value;
};

// Powers of ten are shifted in the text, so these are equal to the last bit.
TEST(Units, ShiftsOfTheDecimalPointAreExact) {
    const Case cases[] = {
        {"0.3 nm", "Å", 3.0},
        {"3", "Å", 3.0},
        {"3.28 Å", "Å", 3.28},
        {"3.28 \u212B", "Å", 3.28},
        {"3.28 A", "Å", 3.28},
        {"3.28angstrom", "Å", 3.28},
        {"0.26nm", "Å", 2.6},
        {"441 nm", "Å", 4410.0},
        {"260 pm", "Å", 2.6},
        {"1 um", "Å", 1e4},
        {"1 µm", "Å", 1e4},
        {"1 \u03BCm", "Å", 1e4},
        {"1e-10 m", "Å", 1.0},
        {"1.5e-1 nm", "Å", 1.5},
        {"100 meV", "eV", 0.1},
        {"0.1 eV", "eV", 0.1},
        {"77.2 GPa", "GPa", 77.2},
        {"77200 MPa", "GPa", 77.2},
        {"1 kPa", "MPa", 0.001},
        {"0.1 GPa", "MPa", 100.0},
        {"10 bar", "MPa", 1.0},
        {"5 m/s", "m/s", 5.0},
        {"0.05 Å/ps", "m/s", 5.0},
        {"5 pm/ps", "m/s", 5.0},
        {"10 fs", "fs", 10.0},
        {"0.01 ps", "fs", 10.0},
        {"20 ps", "ps", 20.0},
        {"2 ns", "ps", 2000.0},
        {"0.05 1/ps", "1/ps", 0.05},
        {"0.05 /ps", "1/ps", 0.0},
        {"0.05 ps^-1", "1/ps", 0.05},
        {"0.05 ps⁻¹", "1/ps", 0.05},
        {"0.05 THz", "1/ps", 0.05},
        {"300 K", "K", 300.0},
        {"5 mK", "K", 0.005},
        {"197 u", "u", 197.0},
        {"197 Da", "u", 197.0},
        {"10 min", "s", 600.0},
        {"1 h", "s", 3600.0},
        {"1 d", "s", 86400.0},
        {"100 meV/Å^2", "meV/Å^2", 100.0},
        {"0.1 eV/Å²", "meV/Å^2", 100.0},
        {"10 eV/nm^2", "meV/Å^2", 100.0},
        {"0.1 meV/Å", "eV/Å", 1e-4},
        {"100 meV/Å2", "meV/Å^2", 100.0},
        {"10 kg m-1 s-2", "MPa", 1e-5},
        {"0.05 ps-1", "1/ps", 0.05},
        {"1%", "", 0.01},
        {"0.5", "", 0.5},
        {"-2 MPa", "MPa", -2.0},
        {"+2 MPa", "MPa", 2.0},
    };
    for (const Case& c : cases) {
        const ParsedQuantity parsed = parse_quantity(c.text, c.base);
        if (c.value == 0.0) {
            EXPECT_FALSE(parsed.why.empty()) << c.text;
            continue;
        }
        EXPECT_EQ(parsed.why, "") << c.text;
        EXPECT_EQ(parsed.value, c.value) << c.text;
    }
}

TEST(Units, OtherFactorsFollowCodata) {
    EXPECT_NEAR(parse_quantity("1.602176634 J/m^2", "meV/Å^2").value, 100.0, 1e-12);
    EXPECT_NEAR(parse_quantity("1 eV/Å^3", "GPa").value, 160.2176634, 1e-10);
    EXPECT_NEAR(parse_quantity("1 nN", "eV/Å").value, 0.6241509, 1e-7);
    EXPECT_NEAR(parse_quantity("3.27123e-25 kg", "u").value, 196.998, 1e-3);
    EXPECT_NEAR(parse_quantity("1 N/m", "meV/Å^2").value, 62.41509, 1e-5);
    EXPECT_DOUBLE_EQ(*conversion("nm", "Å"), 10.0);
    EXPECT_FALSE(conversion("nm", "eV").has_value());
    // A division is of the next symbol alone.
    EXPECT_DOUBLE_EQ(*conversion("eV/Å Å", "eV"), 1.0);
    EXPECT_DOUBLE_EQ(*conversion("eV/Å/Å", "eV/Å^2"), 1.0);
}

TEST(Units, MistakesAreExplained) {
    EXPECT_EQ(parse_quantity("3 parsec", "Å").why, "'parsec' is no unit known here");
    EXPECT_EQ(parse_quantity("3 GPa", "Å").why, "a length is needed, and GPa is a pressure");
    EXPECT_EQ(parse_quantity("3 nm", "").why, "a bare number is needed, and nm is a length");
    EXPECT_EQ(parse_quantity("nm", "Å").why, "it does not begin with a number");
    EXPECT_EQ(parse_quantity("", "Å").why, "it does not begin with a number");
    EXPECT_EQ(parse_quantity("1,5 nm", "Å").fix,
              "write \"1.5 nm\" if that is meant; several values are for `asperity sweep`");
    EXPECT_EQ(parse_quantity("nan nm", "Å").why, "it is not a finite number");
    EXPECT_EQ(parse_quantity("inf", "Å").why, "it is not a finite number");
    EXPECT_EQ(parse_quantity("1e999 nm", "Å").why, "the number is too large or too small");
    EXPECT_NE(parse_quantity("3 GPa", "Å").fix.find("0.3 nm"), std::string::npos);
}

TEST(Units, NoUnits) {
    for (const char* text : {"m^", "m^x", "m/", "/s", "m//s", "m⁻", "kÅ", "mm m x", "m^0", "m0",
                             "m12", "m--1", "-2", "2"})
        EXPECT_FALSE(parse_unit(text).has_value()) << text;
    EXPECT_EQ(parse_unit("kg m^-1 s^-2")->dimension, parse_unit("Pa")->dimension);
    EXPECT_EQ(parse_unit("kg·m²/s²")->dimension, parse_unit("eV")->dimension);
    EXPECT_EQ(parse_quantity("3 min", "Å").why, "a length is needed, and min is a time");
}

} // namespace
} // namespace asperity::io
