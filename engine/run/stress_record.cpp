// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/run/stress_record.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

namespace asperity {

namespace {

constexpr double Stress::*components[] = {&Stress::xx, &Stress::yy, &Stress::zz,
                                          &Stress::xy, &Stress::xz, &Stress::yz};

/// Stresses in points, [component][point].
class Points {
public:
    explicit Points(std::size_t size) : size_(size), values_(std::size(components) * size) {}
    /// Sets the points from `first` on.
    void put(std::size_t first, std::span<const Stress> stresses) {
        for (std::size_t c = 0; c < std::size(components); ++c)
            for (std::size_t i = 0; i < stresses.size(); ++i)
                values_[c * size_ + first + i] = static_cast<float>(stresses[i].*components[c]);
    }
    StressArray array(std::string name, io::Hdf5File::Shape shape) && {
        shape.insert(shape.begin(), std::size(components));
        return {std::move(name), std::move(shape), std::move(values_)};
    }

private:
    std::size_t size_;
    std::vector<float> values_;
};

/// Returns the largest depth of the sections, Å: three times that of the largest stress, eight
/// spacings and all layers at least, half the edge of the box at most.
double deepest(const BlockOptions& block, const StressSearch& search, double of_largest,
               const StressOptions& options) {
    const double end = search.layers.back().to;
    if (options.depth) return std::min(*options.depth, 0.999 * block.thickness * block.spacing);
    const double layers = 1.25 * search.layers.back().from;
    return std::min(end, std::max({3.0 * of_largest, 8.0 * block.spacing, layers}));
}

void add_largest(const StressSearch& search, std::vector<StressArray>& arrays) {
    const std::uint64_t layers = search.layers.size(), count = stress_measures.size();
    StressArray value{"largest", {layers, count}, {}}, error{"largest_error", {layers, count}, {}};
    StressArray place{"largest_place", {layers, count, 3}, {}}, depths{"layers", {layers, 2}, {}};
    for (const LayerStresses& layer : search.layers) {
        for (const LargestStress& largest : layer.largest) {
            value.values.push_back(static_cast<float>(largest.value));
            error.values.push_back(largest.reason.empty()
                                       ? static_cast<float>(largest.error())
                                       : std::numeric_limits<float>::quiet_NaN());
            for (const double x : {largest.x, largest.y, largest.depth})
                place.values.push_back(static_cast<float>(x));
        }
        depths.values.push_back(static_cast<float>(layer.from));
        depths.values.push_back(static_cast<float>(layer.to));
    }
    StressArray at{"profile_depth", {search.depth.size()}, {}};
    StressArray profile{"profile", {search.depth.size(), count}, {}};
    for (std::size_t i = 0; i < search.depth.size(); ++i) {
        at.values.push_back(static_cast<float>(search.depth[i]));
        for (const double largest : search.largest[i])
            profile.values.push_back(static_cast<float>(largest));
    }
    for (StressArray* array : {&value, &error, &place, &depths, &at, &profile})
        arrays.push_back(std::move(*array));
}

} // namespace

double stress_bytes(int sites, const StressOptions& options) {
    if (options.points == StressPoints::none) return 0.0;
    const double map = 1.0 * sites * sites, sections = 2.0 * options.depths * sites;
    const double volume = options.points == StressPoints::volume ? options.depths * map : 0.0;
    return sizeof(float) * std::size(components) * (map + sections + volume);
}

StressRecord record_stresses(const BlockOptions& block, const SurfaceTractions& tractions,
                             const StressOptions& options) {
    StressRecord record{search_stresses(block, tractions), {}, {}};
    add_largest(record.search, record.arrays);
    const auto largest_of = [&](std::size_t m) {
        return std::ranges::max_element(
                   record.search.layers, {},
                   [m](const LayerStresses& layer) { return layer.largest[m].value; })
            ->largest[m];
    };
    const LargestStress yielding = largest_of(0), pulled = largest_of(2);
    const Subsurface field(block, tractions);
    const auto n = static_cast<std::size_t>(field.points());
    std::array<std::size_t, 2> row{};
    std::ranges::transform(std::array{yielding, pulled}, row.begin(), [&](const LargestStress& at) {
        return std::min(n - 1, static_cast<std::size_t>(at.y / block.spacing));
    });
    const auto depths = static_cast<std::size_t>(options.depths);
    const double end = deepest(block, record.search, yielding.depth, options);
    const bool whole = options.points == StressPoints::volume;
    std::array planes = {Points(depths * n), Points(depths * n)};
    Points map(n * n), volume(whole ? depths * n * n : 0);
    StressArray depth{"depth", {depths}, {}};
    for (std::size_t i = 0; i < depths; ++i) {
        const double z = end * static_cast<double>(i) / static_cast<double>(depths - 1);
        const std::vector<Stress> stresses = field.at(z);
        for (std::size_t k = 0; k < planes.size(); ++k)
            planes[k].put(i * n, std::span(stresses).subspan(row[k] * n, n));
        if (whole) volume.put(i * n * n, stresses);
        depth.values.push_back(static_cast<float>(z));
    }
    map.put(0, field.at(yielding.depth));
    record.arrays.push_back(std::move(depth));
    StressArray section{"section", {2, std::size(components), depths, n}, {}};
    StressArray section_y{"section_y", {2}, {}};
    for (std::size_t k = 0; k < planes.size(); ++k) {
        const StressArray plane = std::move(planes[k]).array("", {depths, n});
        section.values.insert(section.values.end(), plane.values.begin(), plane.values.end());
        section_y.values.push_back(static_cast<float>(field.place(static_cast<int>(row[k]))));
    }
    record.arrays.push_back(std::move(section));
    record.arrays.push_back(std::move(section_y));
    record.arrays.push_back(std::move(map).array("map", {n, n}));
    if (whole) record.arrays.push_back(std::move(volume).array("volume", {depths, n, n}));
    record.attributes = {{"map_depth", yielding.depth}, {"friction", options.friction}};
    return record;
}

} // namespace asperity
