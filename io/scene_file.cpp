// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/scene_file.hpp"

#include "io/machine.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <utility>

#include <fmt/format.h>

namespace asperity::io {

void refuse(std::string where, std::string what, std::string why, std::string fix) {
    throw SceneError(Problem{std::move(where), std::move(what), std::move(why), std::move(fix)});
}

std::string convert_first(const std::string& file) {
    const auto quoted = [](const std::string& name) {
        return name.find_first_of(" '\"\\$&;()<>*?[]|`!#~") == std::string::npos ? name
                                                                                 : "'" + name + "'";
    };
    const std::string stem = std::filesystem::path(file).stem().string();
    std::error_code error;
    const bool taken = std::filesystem::exists(stem + ".h5", error); // by the file itself, perhaps
    const std::string out = stem + (taken ? "-converted.h5" : ".h5");
    return fmt::format("convert it first: asperity convert {} {}", quoted(file), quoted(out));
}

void require_memory(const std::string& where, const char* what, double bytes) {
    const AvailableMemory there = available_memory();
    if (bytes > there.bytes)
        refuse(where, fmt::format("{} is larger than the memory", what),
               there.shortage(bytes, "for it"), "cut a piece out of it before");
}

bool is_hdf5(const std::string& file) {
    char head[8] = {};
    std::ifstream(file, std::ios::binary).read(head, sizeof head);
    return std::memcmp(head, "\x89HDF\r\n\x1a\n", sizeof head) == 0;
}

std::string_view take_word(std::string_view& line) {
    constexpr std::string_view blanks = " \t\r\v\f";
    line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
    const std::string_view word = line.substr(0, line.find_first_of(blanks));
    line.remove_prefix(word.size());
    return word;
}

std::optional<double> number_of(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error == std::errc::result_out_of_range) return std::numeric_limits<double>::quiet_NaN();
    if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
    return value;
}

} // namespace asperity::io
