// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "decomposition/halo_exchange.hpp"

#include <algorithm>

namespace asperity {

namespace {

constexpr int h = halo_width;

/// Number of nodes below which a halo is filled faster without threads.
constexpr std::size_t worth_threads = 1024;

/// Fills the periodic columns of all owned rows of a level held whole. Called by all threads; each
/// fills the rows on which it works elsewhere.
void wrap_x(const HaloField& f) {
    const int nx = f.view.nx;
    for (int z = 0; z < f.planes; ++z)
#pragma omp for schedule(static) nowait
        for (int y = 0; y < f.view.ny; ++y) {
            double* line = f.view[z].line(y);
            for (int i = 1; i <= h; ++i)
                line[-i] = line[periodic(-i, nx)];
            for (int i = 0; i < h; ++i)
                line[nx + i] = line[periodic(nx + i, nx)];
        }
}

void wrap_y(const HaloField& f) {
    const int nx = f.view.nx, ny = f.view.ny;
    for (int z = 0; z < f.planes; ++z) {
        const PlaneView<double> p = f.view[z];
        const auto copy = [&](int to, int from) {
            std::copy(p.line(from) - h, p.line(from) + nx + h, p.line(to) - h);
        };
        for (int i = 1; i <= h; ++i)
            copy(-i, periodic(-i, ny));
        for (int i = 0; i < h; ++i)
            copy(ny + i, periodic(ny + i, ny));
    }
}

/// Moves a rectangle of every plane of the cut fields to or from a message buffer.
template <bool pack>
void transfer(std::span<const HaloField> fields, bool columns, bool high, bool halo,
              double* buffer) {
    for (const HaloField& f : fields) {
        if (!f.tiled) continue;
        const int n = columns ? f.view.nx : f.view.ny;
        const int begin = high ? (halo ? n : n - h) : (halo ? -h : 0);
        const int x0 = columns ? begin : -h, x1 = columns ? begin + h : f.view.nx + h;
        const int y0 = columns ? 0 : begin, y1 = columns ? f.view.ny : begin + h;
        for (int z = 0; z < f.planes; ++z)
            for (int y = y0; y < y1; ++y) {
                double* line = f.view[z].line(y);
                if constexpr (pack)
                    buffer = std::copy(line + x0, line + x1, buffer);
                else {
                    std::copy(buffer, buffer + (x1 - x0), line + x0);
                    buffer += x1 - x0;
                }
            }
    }
}

} // namespace

void HaloExchange::trade(int before, int after, std::size_t size) {
    from_before_.resize(size);
    from_after_.resize(size);
    const Message messages[] = {{before, after, 0, to_before_, from_after_},
                                {after, before, 1, to_after_, from_before_}};
    communicator_.exchange(messages);
    bytes_ += 2 * size * sizeof(double);
}

void HaloExchange::along_x(std::span<const HaloField> fields) {
    std::size_t size = 0;
    std::size_t wrapped = 0;
    const auto wraps = [&](const HaloField& f) { return !f.tiled || grid_.px() == 1; };
    for (const HaloField& f : fields)
        (wraps(f) ? wrapped : size) += static_cast<std::size_t>(h) * f.view.ny * f.planes;
#pragma omp parallel if (wrapped > worth_threads)
    for (const HaloField& f : fields)
        if (wraps(f)) wrap_x(f);
    if (size == 0) return;
    to_before_.resize(size);
    to_after_.resize(size);
    transfer<true>(fields, true, false, false, to_before_.data());
    transfer<true>(fields, true, true, false, to_after_.data());
    trade(grid_.neighbour(-1, 0), grid_.neighbour(1, 0), size);
    transfer<false>(fields, true, true, true, from_after_.data());
    transfer<false>(fields, true, false, true, from_before_.data());
}

void HaloExchange::along_y(std::span<const HaloField> fields) {
    std::size_t size = 0;
    for (const HaloField& f : fields) {
        if (!f.tiled || grid_.py() == 1)
            wrap_y(f);
        else
            size += static_cast<std::size_t>(h) * (f.view.nx + 2 * h) * f.planes;
    }
    if (size == 0) return;
    to_before_.resize(size);
    to_after_.resize(size);
    transfer<true>(fields, false, false, false, to_before_.data());
    transfer<true>(fields, false, true, false, to_after_.data());
    trade(grid_.neighbour(0, -1), grid_.neighbour(0, 1), size);
    transfer<false>(fields, false, true, true, from_after_.data());
    transfer<false>(fields, false, false, true, from_before_.data());
}

void HaloExchange::exchange(std::span<const HaloField> fields) {
    bytes_ = 0;
    along_x(fields);
    along_y(fields);
}

namespace {

std::vector<int> footprint_sizes(const ProcessGrid& grid, int level, int components) {
    std::vector<int> counts(static_cast<std::size_t>(grid.ranks()));
    for (int r = 0; r < grid.ranks(); ++r) {
        const Tile t = grid.footprint(level, r);
        counts[static_cast<std::size_t>(r)] = components * t.nx * t.ny;
    }
    return counts;
}

} // namespace

void gather_footprints(const Communicator& communicator, const ProcessGrid& grid, int level,
                       std::span<const PlaneView<double>> planes) {
    if (grid.ranks() == 1) return;
    const Tile own = grid.footprint(level, grid.rank());
    std::vector<double> mine;
    mine.reserve(planes.size() * static_cast<std::size_t>(own.nx * own.ny));
    for (const auto& p : planes)
        for (int y = own.y0; y < own.y0 + own.ny; ++y)
            mine.insert(mine.end(), p.line(y) + own.x0, p.line(y) + own.x0 + own.nx);
    const auto counts = footprint_sizes(grid, level, static_cast<int>(planes.size()));
    std::vector<double> all(planes.size() * static_cast<std::size_t>(own.sites) * own.sites);
    communicator.all_gather(mine, counts, all);
    const double* from = all.data();
    for (int r = 0; r < grid.ranks(); ++r) {
        const Tile t = grid.footprint(level, r);
        for (const auto& p : planes)
            for (int y = t.y0; y < t.y0 + t.ny; ++y, from += t.nx)
                std::copy(from, from + t.nx, p.line(y) + t.x0);
    }
}

} // namespace asperity
