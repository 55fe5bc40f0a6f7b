// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Pictures as PNG: maps of numbered colours, and drawings made as SVG.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace asperity::io {

using Rgb = std::array<std::uint8_t, 3>;

/// The bytes of a PNG file of width x height pixels, row by row from the top, each the number of a
/// colour in the palette (256 at most). Throws FileError where the library fails.
std::string png_of(std::span<const std::uint8_t> pixels, int width, int height,
                   std::span<const Rgb> palette);

/// An SVG document drawn as the bytes of a PNG file, `scale` pixels to its unit of length. Throws
/// FileError.
std::string png_of_svg(const std::string& svg, double scale);

/// As text for a data URI.
std::string base64(const std::string& bytes);

} // namespace asperity::io
