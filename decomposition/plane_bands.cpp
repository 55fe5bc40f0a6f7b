// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "decomposition/plane_bands.hpp"

#include <algorithm>

namespace asperity {

namespace {

/// One tile of a plane for each rank; a tile may be empty.
using Cut = std::vector<Tile>;

Tile overlap(const Tile& a, const Tile& b) {
    const int x0 = std::max(a.x0, b.x0), x1 = std::min(a.x0 + a.nx, b.x0 + b.nx);
    const int y0 = std::max(a.y0, b.y0), y1 = std::min(a.y0 + a.ny, b.y0 + b.ny);
    return {x0, y0, std::max(0, x1 - x0), std::max(0, y1 - y0), a.sites};
}

std::size_t size_of(const Tile& tile) {
    return static_cast<std::size_t>(tile.nx) * static_cast<std::size_t>(tile.ny);
}

/// Copies a plane from one cut to another. of, into: views of this rank's tiles. Collective.
void move_tiles(const Communicator& ranks, const Cut& from, PlaneView<const double> of,
                const Cut& to, PlaneView<double> into) {
    const auto mine = static_cast<std::size_t>(ranks.rank());
    /// Values that go to a rank, and those that come from it.
    struct Part {
        Tile gives, takes;
        std::vector<double> out, in;
    };
    std::vector<Part> parts(from.size());
    std::vector<Message> messages;
    for (std::size_t rank = 0; rank < parts.size(); ++rank) {
        Part& part = parts[rank];
        part.gives = overlap(from[mine], to[rank]);
        part.takes = overlap(from[rank], to[mine]);
        if (size_of(part.gives) + size_of(part.takes) == 0) continue;
        if (rank == mine) {
            for (int y = part.gives.y0; y < part.gives.y0 + part.gives.ny; ++y)
                std::copy_n(of.line(y - from[mine].y0) + (part.gives.x0 - from[mine].x0),
                            part.gives.nx,
                            into.line(y - to[mine].y0) + (part.gives.x0 - to[mine].x0));
            part.takes = {};
            continue;
        }
        part.out.reserve(size_of(part.gives));
        for (int y = 0; y < part.gives.ny; ++y) {
            const double* const line =
                of.line(part.gives.y0 - from[mine].y0 + y) + (part.gives.x0 - from[mine].x0);
            part.out.insert(part.out.end(), line, line + part.gives.nx);
        }
        part.in.resize(size_of(part.takes));
        const int other = static_cast<int>(rank);
        messages.push_back({other, other, 0, part.out, part.in});
    }
    ranks.exchange(messages);
    for (const Part& part : parts) {
        const double* values = part.in.data();
        for (int y = 0; y < part.takes.ny; ++y, values += part.takes.nx)
            std::copy_n(values, part.takes.nx,
                        into.line(part.takes.y0 - to[mine].y0 + y) + (part.takes.x0 - to[mine].x0));
    }
}

Cut tiles_of(const ProcessGrid& grid, int level) {
    Cut cut;
    for (int rank = 0; rank < grid.ranks(); ++rank)
        cut.push_back(grid.tile(level, rank));
    return cut;
}

/// Returns the cut that leaves rows of a level of `sites` nodes across to the root.
Cut on_root(const ProcessGrid& grid, int sites, int first, int rows) {
    Cut cut(static_cast<std::size_t>(grid.ranks()), Tile{0, 0, 0, 0, sites});
    cut.front() = {0, first, sites, rows, sites};
    return cut;
}

PlaneView<double> view_of(double* values, int sites, int rows) {
    return {values, sites, sites, rows};
}

} // namespace

int rows_of_band(int sites) {
    return std::clamp(static_cast<int>(band_length / static_cast<std::size_t>(sites)), 1, sites);
}

void move_plane(const Communicator& ranks, const ProcessGrid& from, PlaneView<const double> of,
                const ProcessGrid& to, PlaneView<double> into) {
    move_tiles(ranks, tiles_of(from, 0), of, tiles_of(to, 0), into);
}

void gather_bands(const Communicator& ranks, const ProcessGrid& grid, int level,
                  std::span<const PlaneView<const double>> planes, const TakeBand& take) {
    const int sites = grid.tile(level).sites, most = rows_of_band(sites);
    // Every rank holds a level that is not cut; the root's is taken.
    const Cut tiles = grid.tiled(level) ? tiles_of(grid, level) : on_root(grid, sites, 0, sites);
    std::vector<double> band;
    for (int first = 0; first < sites; first += most) {
        const int rows = std::min(most, sites - first);
        const Cut here = on_root(grid, sites, first, rows);
        const std::size_t length = size_of(here[static_cast<std::size_t>(ranks.rank())]);
        band.resize(planes.size() * length);
        for (std::size_t i = 0; i < planes.size(); ++i)
            move_tiles(ranks, tiles, planes[i], here,
                       view_of(band.data() + i * length, sites, rows));
        ranks.on_root([&] { take(first, band); });
    }
}

void scatter_bands(const Communicator& ranks, const ProcessGrid& grid, int level,
                   const GiveBand& give, PlaneView<double> plane) {
    const int sites = grid.tile(level).sites, most = rows_of_band(sites);
    const Cut tiles = tiles_of(grid, level);
    std::vector<double> band;
    for (int first = 0; first < sites; first += most) {
        const int rows = std::min(most, sites - first);
        const Cut here = on_root(grid, sites, first, rows);
        band.resize(size_of(here[static_cast<std::size_t>(ranks.rank())]));
        ranks.on_root([&] { give(first, band); });
        move_tiles(ranks, here, view_of(band.data(), sites, rows), tiles, plane);
    }
}

std::vector<double> gather_plane(const Communicator& ranks, const ProcessGrid& grid, int level,
                                 PlaneView<const double> plane) {
    const auto sites = static_cast<std::size_t>(grid.tile(level).sites);
    std::vector<double> dense(ranks.root() ? sites * sites : 0);
    gather_bands(
        ranks, grid, level, std::span(&plane, 1), [&](int first, std::span<const double> rows) {
            std::ranges::copy(rows, dense.begin() + static_cast<std::ptrdiff_t>(
                                                        static_cast<std::size_t>(first) * sites));
        });
    return dense;
}

} // namespace asperity
