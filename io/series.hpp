// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The series along the path of a run: named columns with units, one growing data set each, under
// one group of run.h5 (by default /series: it has its own sampling, so it stays out of H5MD's
// observables). Rows are gathered in memory and written when they are enough or when asked.
#pragma once

#include "io/hdf5_file.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace asperity::io {

struct Column {
    std::string name;
    std::string unit; ///< "" : a pure number
    std::string doc;
};

class Series {
public:
    Series() = default;
    /// A new series. The file must outlive it.
    Series(Hdf5File& file, std::string group, std::vector<Column> columns);

    /// One value a column, in the order of the columns.
    void append(std::span<const double> row);
    void append(std::initializer_list<double> row) {
        append(std::span<const double>(row.begin(), row.size()));
    }
    /// Rows so far, written or not.
    std::uint64_t rows() const { return written_ + waiting_; }
    /// Everything to the file.
    void flush();
    const std::vector<Column>& columns() const { return columns_; }

private:
    Hdf5File* file_ = nullptr;
    std::string group_;
    std::vector<Column> columns_;
    std::vector<std::vector<double>> buffer_; ///< one a column
    std::uint64_t written_ = 0;
    std::uint64_t waiting_ = 0;
};

} // namespace asperity::io
