// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/series.hpp"

#include "io/error.hpp"

#include <utility>

#include <fmt/format.h>

namespace asperity::io {

namespace {
constexpr std::uint64_t rows_in_memory = 64;
}

Series::Series(Hdf5File& file, std::string group, std::vector<Column> columns)
    : file_(&file), group_(std::move(group)), columns_(std::move(columns)),
      buffer_(columns_.size()) {
    file.make_group(group_);
    for (const Column& column : columns_) {
        const std::string dataset = group_ + "/" + column.name;
        file.make_series<double>(dataset);
        if (!column.unit.empty()) file.write_attribute(dataset, "unit", column.unit);
        if (!column.doc.empty()) file.write_attribute(dataset, "description", column.doc);
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
        file_->append<double>(group_ + "/" + columns_[i].name, buffer_[i]);
        buffer_[i].clear();
    }
    written_ += waiting_;
    waiting_ = 0;
}

} // namespace asperity::io
