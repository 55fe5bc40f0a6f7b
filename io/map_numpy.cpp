// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// NumPy's .npy (numpy.lib.format, versions 1 to 3): magic, a dictionary of three keys as text, the
// values. Numbers of the usual kinds, rows or columns first.
#include "io/map_file.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>

#include <fmt/format.h>

namespace asperity::io {

namespace {

/// What stands behind 'key': in the header, up to the next comma outside of parentheses.
std::string_view entry(std::string_view header, std::string_view key) {
    std::size_t at = header.find(key);
    if (at == std::string_view::npos) return {};
    at = header.find(':', at + key.size());
    if (at == std::string_view::npos) return {};
    at = header.find_first_not_of(" ", at + 1);
    if (at == std::string_view::npos) return {};
    const char end = header[at] == '(' ? ')' : ',';
    return header.substr(at, header.find(end, at) - at);
}

template <class T>
double value_at(const char* from, bool swap) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, from, sizeof(T));
    if (swap) std::reverse(bytes, bytes + sizeof(T));
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return static_cast<double>(value);
}

/// How a type like "f8" is read.
constexpr std::pair<std::string_view, double (*)(const char*, bool)> readers[] = {
    {"f8", value_at<double>},        {"f4", value_at<float>},
    {"i1", value_at<std::int8_t>},   {"i2", value_at<std::int16_t>},
    {"i4", value_at<std::int32_t>},  {"i8", value_at<std::int64_t>},
    {"u1", value_at<std::uint8_t>},  {"u2", value_at<std::uint16_t>},
    {"u4", value_at<std::uint32_t>}, {"u8", value_at<std::uint64_t>},
};

} // namespace

MapFile read_map_numpy(std::string_view bytes, const std::string& file) {
    const auto damaged = [&](const std::string& why) {
        refuse(file, "the height map cannot be read", why,
               "save it again: numpy.save(\"heights.npy\", heights)");
    };
    if (bytes.size() < 12) damaged("the file is cut short");
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(bytes[i]); };
    const bool wide = byte(6) >= 2; // length of the header in 4 bytes rather than 2
    std::size_t length = byte(8) + 256u * byte(9), start = 10;
    if (wide)
        length += 65536u * byte(10) + 16777216u * static_cast<std::size_t>(byte(11)), start = 12;
    if (length > bytes.size() - start) damaged("its header is cut short");
    const std::string_view header = bytes.substr(start, length),
                           data = bytes.substr(start + length);

    const std::string_view type = entry(header, "'descr'"), shape = entry(header, "'shape'");
    const auto* const reader = std::find_if(std::begin(readers), std::end(readers), [&](auto& r) {
        return type.size() == 5 && r.first == type.substr(2, 2);
    });
    if (reader == std::end(readers))
        damaged(fmt::format("its numbers are of type {}, and integers or floats are needed",
                            type.substr(0, 40)));
    const bool swap = (type[1] == '>') == (std::endian::native == std::endian::little);
    const bool columns_first = entry(header, "'fortran_order'").starts_with("True");

    std::vector<std::size_t> extent;
    for (const char *at = shape.data(), *const end = at + shape.size(); at < end;) {
        std::size_t value = 0;
        const auto [next, error] = std::from_chars(at, end, value);
        if (error == std::errc::result_out_of_range) damaged("its shape is no shape");
        if (error == std::errc()) extent.push_back(value);
        at = std::max(next, at + 1);
    }
    if (extent.size() != 2)
        refuse(file, "is no height map",
               fmt::format("it has {} dimensions, a map has 2", extent.size()),
               "name another file");
    const std::size_t size = static_cast<std::size_t>(type[3] - '0');
    MapFile map;
    map.format = "NumPy";
    if (extent[0] == 0 || extent[1] == 0) return map; // empty, whatever the other says
    if (extent[0] > data.size() / size / extent[1])
        damaged(fmt::format("{} x {} numbers of {} bytes are declared, and {} bytes are there",
                            extent[0], extent[1], size, data.size()));
    map.rows = extent[0];
    map.columns = extent[1];
    map.heights.resize(map.rows * map.columns);
    for (std::size_t r = 0; r < map.rows; ++r)
        for (std::size_t c = 0; c < map.columns; ++c)
            map.heights[r * map.columns + c] = reader->second(
                data.data() + size * (columns_first ? c * map.rows + r : r * map.columns + c),
                swap);
    return map;
}

} // namespace asperity::io
