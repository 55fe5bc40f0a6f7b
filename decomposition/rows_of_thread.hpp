// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Which rows of a tile, in all planes, are a thread's: those it touches first, so that their pages
// lie near it, and those it works on.
#pragma once

#include <algorithm>
#include <utility>

#include <omp.h>

namespace asperity {

/// Rows are worked on in bands of so many.
inline constexpr int band_rows = 8;

/// [first, last) of ny rows, of the calling thread in its team: whole bands, next to each other.
inline std::pair<int, int> rows_of_thread(int ny) {
    const int bands = (ny + band_rows - 1) / band_rows;
    const auto cut = [&](int thread) {
        return std::min(ny, band_rows * (bands * thread / omp_get_num_threads()));
    };
    return {cut(omp_get_thread_num()), cut(omp_get_thread_num() + 1)};
}

/// work(z, y) for every row y of [-halo, ny + halo) of every plane, each once, by the thread whose
/// it is; rows of the halo are those of the tile's outermost rows. ny > 0.
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
