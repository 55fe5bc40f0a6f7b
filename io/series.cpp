// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/series.hpp"

#include "io/described.hpp"
#include "io/error.hpp"

#include <utility>

#include <fmt/format.h>

namespace asperity::io {

namespace {
constexpr std::uint64_t rows_in_memory = 64;
const std::string group = "/series/";
} // namespace

Series::Series(Hdf5File& file, std::vector<std::string> columns)
    : file_(&file), columns_(std::move(columns)), buffer_(columns_.size()) {
    for (const std::string& column : columns_) {
        file.make_series<double>(group + column);
        describe(file, group + column);
    }
}

void Series::append(std::span<const double> row) {
    if (row.size() != columns_.size())
        throw FileError(file_ ? file_->path() : "", "a row of the series has the wrong length",
                        fmt::format("{} values for {} columns", row.size(), columns_.size()),
                        "this is a mistake in the program");
    for (std::size_t i = 0; i < row.size(); ++i)
        buffer_[i].push_back(row[i]);
    if (++waiting_ == rows_in_memory) flush();
}

void Series::flush() {
    if (!file_) return;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
        file_->append<double>(group + columns_[i], buffer_[i]);
        buffer_[i].clear();
    }
    written_ += waiting_;
    waiting_ = 0;
}

} // namespace asperity::io
