// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The series along the path of a run: named columns, one growing data set each, under /series of
// run.h5 (it has a sampling of its own, so it stays out of H5MD's observables). Units and
// descriptions are those of io/quantities.hpp. Rows are gathered in memory and written when they
// are enough or when asked.
#pragma once

#include "io/hdf5_file.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace asperity::io {

class Series {
public:
    Series() = default;
    /// A new series. The file must outlive it.
    Series(Hdf5File& file, std::vector<std::string> columns);

    /// One value a column, in the order of the columns.
    void append(std::span<const double> row);
    void append(std::initializer_list<double> row) {
        append(std::span<const double>(row.begin(), row.size()));
    }
    /// Rows so far, written or not.
    std::uint64_t rows() const { return written_ + waiting_; }
    /// Everything to the file.
    void flush();

private:
    Hdf5File* file_ = nullptr;
    std::vector<std::string> columns_;
    std::vector<std::vector<double>> buffer_; ///< one a column
    std::uint64_t written_ = 0;
    std::uint64_t waiting_ = 0;
};

} // namespace asperity::io
