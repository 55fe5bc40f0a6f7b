// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Distribution of the rows of a tile, in all planes, over threads. A thread touches its rows first,
// so that their pages are in its local memory.
#pragma once

#include <algorithm>
#include <utility>

#include <omp.h>

namespace asperity {

/// Number of rows in a band, the unit of distribution over threads.
inline constexpr int band_rows = 8;

/// Returns the rows [first, last), of ny rows, of the calling thread in its team, as whole adjacent
/// bands.
inline std::pair<int, int> rows_of_thread(int ny) {
    const int bands = (ny + band_rows - 1) / band_rows;
    const auto cut = [&](int thread) {
        return std::min(ny, band_rows * (bands * thread / omp_get_num_threads()));
    };
    return {cut(omp_get_thread_num()), cut(omp_get_thread_num() + 1)};
}

/// Calls work(z, y) once for every row y in [-halo, ny + halo) of every plane, on the thread that
/// owns the row; rows of the halo belong to the owner of the nearest row of the tile. ny must be
/// positive.
template <class Work>
void each_row_by_its_thread(int ny, int halo, int planes, const Work& work) {
#pragma omp parallel
    {
        const auto [first, last] = rows_of_thread(ny);
        const int begin = first == 0 && last > 0 ? -halo : first;
        const int end = last == ny && first < last ? ny + halo : last;
        for (int z = 0; z < planes; ++z)
            for (int y = begin; y < end; ++y)
                work(z, y);
    }
}

} // namespace asperity
