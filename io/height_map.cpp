// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/height_map.hpp"

#include "io/hdf5_file.hpp"
#include "io/scene_file.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <fmt/format.h>

namespace asperity::io {

namespace {

void treat_missing(HeightMap& map, bool fill, const MapQuantity& quantity) {
    const auto first = std::find_if(map.heights.begin(), map.heights.end(),
                                    [](double h) { return std::isnan(h); });
    const auto at = static_cast<std::size_t>(first - map.heights.begin());
    if (!fill)
        refuse(map.first_missing,
               fmt::format("the {} in row {}, column {} is {}", quantity.one, at / map.columns + 1,
                           at % map.columns + 1, map.first_missing_text),
               fmt::format("every atom needs a {}; {} of {} points have none", quantity.one,
                           map.missing, map.heights.size()),
               fmt::format("fill the holes of the map before, or let them be filled with "
                           "{}_missing = \"fill\"",
                           quantity.key));
    const double part = static_cast<double>(map.missing) / static_cast<double>(map.heights.size());
    if (part > 0.5)
        refuse(map.source, fmt::format("most of the {} map is missing", quantity.one),
               fmt::format("{} of {} points have no {}", map.missing, map.heights.size(),
                           quantity.one),
               "measure it again, or cut out a piece that is whole");
    fill_missing(map.heights, map.rows, map.columns);
    map.notes.push_back(fmt::format("{} points of the map ({:.2g} %) had no {}: filled by "
                                    "Laplace's equation",
                                    map.missing, 100.0 * part, quantity.one));
}

/// Makes the map square, with the middle of it where the scene says so.
void make_square(HeightMap& map, bool crop, const MapQuantity& quantity) {
    if (!crop && map.rows != map.columns)
        refuse(map.source, fmt::format("the {} map is not square", quantity.one),
               fmt::format("it has {} rows and {} columns, and the periodic box is square",
                           map.rows, map.columns),
               std::min(map.rows, map.columns) <= 2
                   ? std::string(
                         "it is a line scan, and a surface needs a map: measure or export an area")
                   : fmt::format("cut a square out of it before, or take the middle with "
                                 "{}_crop = \"middle\"",
                                 quantity.key));
    const std::size_t n = std::min(map.rows, map.columns);
    if (map.width && map.height) {
        const double pixel = *map.width / static_cast<double>(map.columns);
        const double other = *map.height / static_cast<double>(map.rows);
        if (std::abs(other - pixel) > 1e-3 * pixel)
            refuse(map.source, fmt::format("is {:g} x {:g} Å wide", *map.width, *map.height),
                   fmt::format("its pixels of {:g} x {:g} Å are not square, and the periodic "
                               "box is",
                               pixel, other),
                   "resample it to square pixels before");
        if (std::abs(other - pixel) > 1e-6 * pixel)
            map.notes.push_back(
                fmt::format("the pixels of {:.7g} x {:.7g} Å are taken as square", pixel, other));
        map.width = map.height = pixel * static_cast<double>(n);
    }
    if (map.rows == map.columns) return;
    map.notes.push_back(fmt::format("of {} rows and {} columns the middle {} x {} are taken",
                                    map.rows, map.columns, n, n));
    std::vector<double> cut;
    cut.reserve(n * n);
    const std::size_t y0 = (map.rows - n) / 2, x0 = (map.columns - n) / 2;
    for (std::size_t y = y0; y < y0 + n; ++y) {
        const double* const row = map.heights.data() + y * map.columns + x0;
        cut.insert(cut.end(), row, row + n);
    }
    map.heights = std::move(cut);
    map.rows = map.columns = n;
}

} // namespace

HeightMap read_height_map(const std::string& name, const MapOptions& options) {
    HeightMap map = read_map_file(name, options);
    if (map.unit_assumed)
        map.notes.push_back(fmt::format("the file does not say the unit of its {}: taken as {}",
                                        options.quantity.all, options.quantity.unit));
    if (map.missing > 0 && options.holes)
        map.notes.push_back(
            fmt::format("{} of {} points have no height: holes", map.missing, map.heights.size()));
    else if (map.missing > 0)
        treat_missing(map, options.fill, options.quantity);
    make_square(map, options.crop, options.quantity);
    return map;
}

void fill_missing(std::vector<double>& h, std::size_t rows, std::size_t columns) {
    constexpr std::size_t known = static_cast<std::size_t>(-1);
    std::vector<std::size_t> holes, number(h.size(), known);
    double largest = 0.0;
    for (std::size_t i = 0; i < h.size(); ++i)
        if (std::isnan(h[i])) {
            number[i] = holes.size();
            holes.push_back(i);
        } else {
            largest = std::max(largest, std::abs(h[i]));
        }
    const auto neighbours = [&](std::size_t i, const auto& visit) {
        const std::size_t x = i % columns, y = i / columns;
        if (x > 0) visit(i - 1);
        if (x + 1 < columns) visit(i + 1);
        if (y > 0) visit(i - columns);
        if (y + 1 < rows) visit(i + columns);
    };
    // Conjugate gradients on (number of neighbours) h - sum of neighbours = 0, from zero.
    std::vector<double> value(holes.size(), 0.0), residual(holes.size(), 0.0), image(holes.size());
    for (std::size_t k = 0; k < holes.size(); ++k)
        neighbours(holes[k], [&](std::size_t j) {
            if (number[j] == known) residual[k] += h[j];
        });
    std::vector<double> direction = residual;
    const auto dot = [](const std::vector<double>& a, const std::vector<double>& b) {
        return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
    };
    double square = dot(residual, residual);
    const double enough = 1e-20 * largest * largest;
    for (std::size_t n = 0; n < 10 * holes.size() + 10 && square > enough; ++n) {
        for (std::size_t k = 0; k < holes.size(); ++k) {
            double sum = 0.0;
            neighbours(holes[k], [&](std::size_t j) {
                sum += direction[k] - (number[j] == known ? 0.0 : direction[number[j]]);
            });
            image[k] = sum;
        }
        const double step = square / dot(direction, image);
        for (std::size_t k = 0; k < holes.size(); ++k) {
            value[k] += step * direction[k];
            residual[k] -= step * image[k];
        }
        const double before = std::exchange(square, dot(residual, residual));
        for (std::size_t k = 0; k < holes.size(); ++k)
            direction[k] = residual[k] + square / before * direction[k];
    }
    for (std::size_t k = 0; k < holes.size(); ++k)
        h[holes[k]] = value[k];
}

void write_height_map(const std::string& file, const HeightMap& map,
                      const std::vector<MapColumn>& columns) {
    Hdf5File out(file, Hdf5File::Mode::create);
    out.write<double>("/heights", {map.rows, map.columns}, map.heights);
    out.write_attribute("/heights", "unit", "Å");
    if (!map.origin.empty()) out.write_attribute("/heights", "origin", map.origin);
    if (map.width) out.write_attribute("/heights", "size_x", *map.width);
    if (map.height) out.write_attribute("/heights", "size_y", *map.height);
    for (const MapColumn& column : columns) {
        out.write<double>(column.name, {column.values.size()}, column.values);
        out.write_attribute(column.name, "unit", column.unit);
    }
    out.close();
}

} // namespace asperity::io
