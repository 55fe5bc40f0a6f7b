// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A map seen from above, as SVG text: colours, a bar of colours with its unit, a bar of length.
//
// Colours rise evenly in lightness (perceived, in Oklab), so that order is seen by everybody and
// survives a copy in grey; maps with a sign run from blue over near-white to orange. What is beyond
// the limits of the colour bar takes the colour of its end.
#pragma once

#include "io/png.hpp"

#include <optional>
#include <string>
#include <vector>

namespace asperity::io {

struct MapPlot {
    enum class Colours {
        rising,    ///< dark blue to light yellow
        diverging, ///< around zero
        two        ///< of a map of zeros and ones
    };

    std::string title;
    std::string unit;           ///< of the values
    int sites = 0;              ///< values along an edge
    std::vector<double> values; ///< values[y * sites + x]; what is no number is left grey
    double edge = 0.0;          ///< Å
    Colours colours = Colours::rising;
    std::optional<double> low, high; ///< of the colour bar; else the 0.5 and 99.5 % quantiles
    std::string low_word, high_word; ///< Colours::two: what zeros and ones are
    std::string id;                  ///< as in Plot
};

/// The 256 colours of a map.
std::vector<Rgb> palette(MapPlot::Colours colours);

/// As a document of its own, or as an element of a page. The picture within is a PNG.
std::string map_svg(const MapPlot& map);

/// A map of a page as a document of its own.
std::string map_document(MapPlot map);

/// The map alone as a PNG, a pixel a value.
std::string map_png(const MapPlot& map);

/// The values as text, one row of the map a line, lowest y first.
std::string map_csv(const MapPlot& map);

} // namespace asperity::io
