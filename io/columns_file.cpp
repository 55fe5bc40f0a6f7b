// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/columns_file.hpp"

#include "io/error.hpp"

#include <fmt/format.h>

#include <charconv>
#include <fstream>
#include <sstream>
#include <string_view>

namespace asperity::io {

std::vector<std::vector<double>> read_columns(const std::string& file, std::size_t count) {
    std::ifstream in(file);
    std::vector<std::vector<double>> columns(count);
    const std::string fix = fmt::format("write {} numbers a line, separated by blanks", count);
    std::string text;
    for (std::size_t line = 1; std::getline(in, text); ++line) {
        if (line > 1'000'000)
            throw SceneError(Problem{file, "has more than a million lines",
                                     "it is read as columns of numbers", fix});
        if (const std::size_t hash = text.find('#'); hash != std::string::npos) text.resize(hash);
        std::istringstream words(text);
        std::string word;
        for (std::size_t k = 0; words >> word; ++k) {
            if (k == count) break;
            const std::string_view digits =
                word.starts_with('+') ? std::string_view(word).substr(1) : word;
            double value = 0.0;
            const auto [end, error] =
                std::from_chars(digits.data(), digits.data() + digits.size(), value);
            if (error != std::errc() || end != digits.data() + digits.size())
                throw SceneError(Problem{fmt::format("{}:{}", file, line),
                                         fmt::format("'{}' is no number", word.substr(0, 40)),
                                         "the file is read as columns of numbers", fix});
            columns[k].push_back(value);
        }
        if (columns[0].size() != columns[count - 1].size())
            throw SceneError(Problem{fmt::format("{}:{}", file, line),
                                     fmt::format("has fewer than {} numbers", count), "", fix});
    }
    if (in.bad() || columns[0].empty())
        throw SceneError(Problem{file, in.bad() ? "cannot be read" : "holds no numbers", "", fix});
    return columns;
}

} // namespace asperity::io
