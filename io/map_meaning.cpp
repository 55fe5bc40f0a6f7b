// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/map_meaning.hpp"

#include "io/scene_file.hpp"
#include "io/units.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <vector>

#include <fmt/format.h>

namespace asperity::io {

namespace {

/// Heights beyond are no surface of atoms (10 cm), and sums of their squares lose all digits.
constexpr double largest_height = 1e9; // Å
/// Pixels beyond show no roughness that adheres (0.1 mm), or are smaller than an atom.
constexpr double largest_pixel = 1e6, smallest_pixel = 0.05; // Å
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Returns the length of a unit, Å; empty if it is no length.
std::optional<double> length_of(const std::string& unit) {
    const std::optional<double> factor = conversion(unit, "Å");
    return factor && std::isfinite(*factor) && *factor > 0.0 ? factor : std::nullopt;
}

/// Returns what a unit is in those of a quantity; empty if it is of another dimension.
std::optional<double> factor_of(const std::string& unit, const MapQuantity& quantity) {
    const std::optional<double> factor = conversion(unit, quantity.unit);
    return factor && std::isfinite(*factor) && *factor > 0.0 ? factor : std::nullopt;
}

/// Refuses a unit. fix: the key of the scene that says it in place of the file.
[[noreturn]] void refuse_unit(const std::string& unit, const std::string& where,
                              std::string_view what, std::string_view kind,
                              const std::string& fix) {
    refuse(where, fmt::format("{} in '{}' cannot be read", what, unit.substr(0, 40)),
           fmt::format("that is no unit of {}", kind), fmt::format("say which it is: {}", fix));
}

/// Returns what a unit of sizes is in Å. Throws SceneError if it is no length.
double length_unit(const std::string& unit, const std::string& where, const std::string& fix) {
    const std::optional<double> factor = length_of(unit);
    if (!factor) refuse_unit(unit, where, "its size", "length", fix);
    return *factor;
}
std::string say_unit(const MapQuantity& quantity) {
    const bool lengths = quantity.unit == MapQuantity().unit;
    return fmt::format("{}_unit = \"{}\"", quantity.key, lengths ? "nm" : "mJ/m^2");
}
std::string say_size(const MapQuantity& quantity) {
    return fmt::format("{}_size = \"100 nm\", its edge", quantity.key);
}

/// Converts the sizes of the scene, otherwise those of the file, to Å; with a note if they differ.
/// The scene's size is the shorter edge of a map that is not square.
void complete_size(HeightMap& map, const MapUnits& units, const MapOptions& said) {
    std::optional<double> factor;
    if (units.of_sizes)
        factor = length_of(*units.of_sizes);
    else if (units.unit && length_of(*units.unit))
        factor = length_of(*units.unit);
    else if (said.unit != "auto")
        factor = length_of(said.unit);
    const MapQuantity& quantity = said.quantity;
    if (map.width && !factor && !said.size) {
        if (units.of_sizes) length_unit(*units.of_sizes, map.source, say_size(quantity));
        const bool lengths = quantity.unit == MapQuantity().unit;
        refuse(
            map.source,
            fmt::format("the file does not say the unit of its sizes{}",
                        lengths ? " and heights" : ""),
            "in an unknown unit they may be anything",
            fmt::format("say which it is: {}", lengths ? say_unit(quantity) : say_size(quantity)));
    }
    for (std::optional<double>* size : {&map.width, &map.height}) {
        if (!*size) continue;
        **size *= factor.value_or(0.0);
        if (!said.size && (!(**size > 0.0) || !std::isfinite(**size)))
            refuse(map.source, "the map has no size",
                   fmt::format("its attributes say {} Å", **size),
                   fmt::format("say it: {}", say_size(quantity)));
    }
    if (!said.size) return;
    const double points = static_cast<double>(std::min(map.rows, map.columns)),
                 pixel = *said.size / points,
                 own = map.width && factor ? *map.width / static_cast<double>(map.columns) : pixel;
    if (std::abs(own - pixel) > 1e-3 * pixel)
        map.doubts.push_back(
            fmt::format("the file says that the map is {:.6g} Å wide, and {:.6g} Å are taken "
                        "({}_size)",
                        own * points, *said.size, quantity.key));
    map.width = pixel * static_cast<double>(map.columns);
    map.height = pixel * static_cast<double>(map.rows);
}

} // namespace

void complete(HeightMap& map, const MapUnits& units, const MapOptions& said) {
    const bool given = said.unit != "auto";
    map.unit_assumed = !given && !units.unit;
    const MapQuantity& quantity = said.quantity;
    const std::string unit = given ? said.unit : units.unit.value_or(std::string(quantity.unit));
    map.unit = units.scale == 1.0 ? unit : fmt::format("{:g} {}", units.scale, unit);
    const std::optional<double> one = factor_of(unit, quantity);
    if (!one) refuse_unit(unit, map.source, quantity.all, quantity.kind, say_unit(quantity));
    complete_size(map, units, said);
    const double factor = units.scale * *one;
    if (given && units.unit && factor_of(*units.unit, quantity) != one)
        map.doubts.push_back(fmt::format("the file says that its {} are in {}, and {} is taken "
                                         "({}_unit)",
                                         quantity.all, units.unit->substr(0, 40), unit,
                                         quantity.key));
    double largest = 0.0;
    for (std::size_t i = 0; i < map.heights.size(); ++i) {
        double& height = map.heights[i];
        if (!(std::abs(height) < no_height)) {
            if (map.first_missing.empty()) {
                map.first_missing =
                    fmt::format("{}[{}, {}]", map.source, i / map.columns, i % map.columns);
                map.first_missing_text = fmt::format("{}", height);
            }
            height = nan;
            ++map.missing;
            continue;
        }
        height *= factor;
        largest = std::max(largest, std::abs(height));
    }
    if (quantity.unit == MapQuantity().unit && !(largest <= largest_height))
        refuse(map.source, fmt::format("a height of the map is {:g} Å", largest),
               fmt::format("that is more than {:g} Å (10 cm)", largest_height),
               fmt::format("the heights are read in {}: set {}_unit, or mark points without a "
                           "height as nan",
                           map.unit, quantity.key));
}

void note_doubts(HeightMap& map, std::string_view key) {
    const auto rows = map.rows, columns = map.columns;
    if (map.width) {
        const double pixel = *map.width / static_cast<double>(columns);
        if (pixel > largest_pixel || pixel < smallest_pixel)
            map.doubts.push_back(
                fmt::format("the map is {:.4g} m wide, its pixels are {:.3g} Å: check the unit of "
                            "its size ({}_size)",
                            1e-10 * *map.width, pixel, key));
    }
    // The lowest and the highest height, how many points have them, and those next to them.
    std::vector<double> sorted;
    for (const double h : map.heights)
        if (!std::isnan(h)) sorted.push_back(h);
    if (sorted.size() < 16) return;
    std::sort(sorted.begin(), sorted.end());
    const auto low = std::upper_bound(sorted.begin(), sorted.end(), sorted.front()),
               high = std::lower_bound(sorted.begin(), sorted.end(), sorted.back());
    const auto doubt = [&](double value, std::ptrdiff_t points, double from, double to) {
        for (double* const height : {&value, &from, &to}) // rounding of a height at zero
            if (std::abs(*height) < 1e-5 * (to - from)) *height = 0.0;
        map.doubts.push_back(fmt::format(
            "{} points have the height {:.6g} Å, all others are between {:.6g} and {:.6g} "
            "Å: if that stands for points without a height, write them as nan",
            points, value, from, to));
    };
    if (low < high) {
        const double inner_low = *low, inner_high = *std::prev(high),
                     gap = 20.0 * (inner_high - inner_low);
        if (gap > 0.0 && inner_low - sorted.front() > gap)
            doubt(sorted.front(), low - sorted.begin(), inner_low,
                  sorted.back() - inner_high > gap ? inner_high : sorted.back());
        else if (gap > 0.0 && sorted.back() - inner_high > gap)
            doubt(sorted.back(), sorted.end() - high, inner_low, inner_high);
    }
    // Equal maps on top of one another jump where one ends.
    std::vector<double> step(rows > 0 ? rows - 1 : 0);
    for (std::size_t y = 0; y + 1 < rows; ++y) {
        double sum = 0.0;
        std::size_t count = 0;
        for (std::size_t x = 0; x < columns; ++x) {
            const double d = map.heights[(y + 1) * columns + x] - map.heights[y * columns + x];
            if (!std::isnan(d)) sum += d * d, ++count;
        }
        step[y] = count > 0 ? std::sqrt(sum / static_cast<double>(count)) : 0.0;
    }
    for (std::size_t parts = 2; parts <= 8 && rows >= 8 * parts; ++parts) {
        if (rows % parts != 0) continue;
        std::vector<double> others;
        double least = HUGE_VAL;
        for (std::size_t y = 0; y < step.size(); ++y)
            if ((y + 1) % (rows / parts) == 0)
                least = std::min(least, step[y]);
            else
                others.push_back(step[y]);
        if (!(least > 5.0 * *std::max_element(others.begin(), others.end()))) continue;
        map.doubts.push_back(fmt::format(
            "heights jump by {:.3g} Å (rms) after every {} of its {} rows, and by {:.3g} Å at "
            "most between others: the file may hold {} maps on top of one another",
            least, rows / parts, rows, *std::max_element(others.begin(), others.end()), parts));
        return;
    }
}

} // namespace asperity::io
