// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// NumPy's .npy (numpy.lib.format, versions 1 to 3): magic, a dictionary of three keys as text, the
// values. Numbers of the usual kinds, rows or columns first.
#include "io/map_formats.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>

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

using Reader = double (*)(const char*, bool);

/// For a type like "f8"; nullptr: not one of those.
Reader reader_of(std::string_view type) {
    if (type == "f8") return value_at<double>;
    if (type == "f4") return value_at<float>;
    if (type == "i1") return value_at<std::int8_t>;
    if (type == "i2") return value_at<std::int16_t>;
    if (type == "i4") return value_at<std::int32_t>;
    if (type == "i8") return value_at<std::int64_t>;
    if (type == "u1") return value_at<std::uint8_t>;
    if (type == "u2") return value_at<std::uint16_t>;
    if (type == "u4") return value_at<std::uint32_t>;
    if (type == "u8") return value_at<std::uint64_t>;
    return nullptr;
}

} // namespace

RawMap read_map_numpy(std::string_view bytes, const std::string& file) {
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
    const Reader read = type.size() >= 5 ? reader_of(type.substr(2, 2)) : nullptr;
    if (!read || type.size() != 5)
        damaged(fmt::format("its numbers are of type {}, and integers or floats are needed",
                            type.substr(0, 40)));
    const bool swap = (type[1] == '>') == (std::endian::native == std::endian::little);
    const bool columns_first = entry(header, "'fortran_order'").starts_with("True");

    std::size_t extent[2] = {0, 0}, count = 0;
    for (std::size_t at = 0; (at = shape.find_first_of("0123456789", at)) != std::string_view::npos;
         ++count) {
        std::size_t value = 0;
        const auto parsed = std::from_chars(shape.data() + at, shape.data() + shape.size(), value);
        if (parsed.ec != std::errc()) damaged("its shape is no shape");
        if (count < 2) extent[count] = value;
        at = static_cast<std::size_t>(parsed.ptr - shape.data());
        if (at >= shape.size()) {
            ++count;
            break;
        }
    }
    if (count != 2)
        refuse(file, "is no height map", fmt::format("it has {} dimensions, a map has 2", count),
               "name another file");
    const std::size_t size = static_cast<std::size_t>(type[3] - '0');
    RawMap map;
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
            map.heights[r * map.columns + c] =
                read(data.data() + size * (columns_first ? c * map.rows + r : r * map.columns + c),
                     swap);
    return map;
}

} // namespace asperity::io
