// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What would each rank hold and send? For a multiscale block as thick as wide on any number of
// ranks, from the decomposition itself, without making the block:
//
//     build/release/perf/volumes SITES:THICKNESS:RANKS ...
//
// Prints a JSON list; the rank with the most nodes speaks for all.
//
//   nodes        moving nodes worked on in a step
//   held         those of them on levels that every rank holds whole
//   sites        of the interface
//   constrained  nodes that follow a coarser level
//   x, y         bytes of a message to each of the two neighbours (0: no neighbour)
//   wrapped      bytes of halo copied within the rank
//   gathered     bytes of the plane that is put together where the levels held whole begin
//   held_side    bytes of the halo along one whole side of the levels held whole
#include "decomposition/process_grid.hpp"
#include "engine/block/block.hpp"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <exception>

using namespace asperity;

namespace {

constexpr double vector_bytes = 3.0 * sizeof(double), h = halo_width;

nlohmann::json volumes(int sites, int thickness, int ranks) {
    BlockOptions options;
    options.sites = sites;
    options.thickness = thickness;
    const auto levels = level_shapes(options);
    const ProcessGrid grid(ranks, 0, sites, static_cast<int>(levels.size()));
    int fullest = 0; // tiles are larger towards the end of an uneven cut
    for (int r = 1; r < ranks; ++r) {
        const Tile a = grid.tile(0, r), b = grid.tile(0, fullest);
        if (static_cast<double>(a.nx) * a.ny > static_cast<double>(b.nx) * b.ny) fullest = r;
    }
    double nodes = 0.0, held = 0.0, constrained = 0.0, x = 0.0, y = 0.0, wrapped = 0.0,
           gathered = 0.0, held_side = 0.0;
    for (const LevelShape& plan : levels) {
        const Tile tile = grid.tile(plan.level, fullest);
        const bool tiled = grid.tiled(plan.level), last = plan.level + 1 == std::ssize(levels);
        const double plane = static_cast<double>(tile.nx) * tile.ny;
        const double columns = h * tile.ny * plan.cells * vector_bytes,
                     rows = h * (tile.nx + 2.0 * h) * plan.cells * vector_bytes;
        nodes += plane * plan.cells;
        if (!tiled) {
            held += plane * plan.cells;
            held_side += columns;
        }
        if (!last) constrained += plane;
        (tiled && grid.px() > 1 ? x : wrapped) += columns * (tiled && grid.px() > 1 ? 1.0 : 2.0);
        (tiled && grid.py() > 1 ? y : wrapped) += rows * (tiled && grid.py() > 1 ? 1.0 : 2.0);
        if (!last && tiled && !grid.tiled(plan.level + 1))
            gathered = 0.25 * plan.sites * plan.sites * vector_bytes;
    }
    const Tile lowest = grid.tile(0, fullest);
    return {{"sites_across", sites},
            {"ranks", ranks},
            {"grid", {grid.px(), grid.py()}},
            {"nodes", nodes},
            {"held", held},
            {"held_side", held_side},
            {"sites", static_cast<double>(lowest.nx) * lowest.ny},
            {"constrained", constrained},
            {"x", x},
            {"y", y},
            {"wrapped", wrapped},
            {"gathered", gathered}};
}

} // namespace

int main(int argc, char** argv) {
    auto list = nlohmann::json::array();
    try {
        for (int i = 1; i < argc; ++i) {
            int sites = 0, thickness = 0, ranks = 0;
            if (std::sscanf(argv[i], "%d:%d:%d", &sites, &thickness, &ranks) != 3 || sites < 4 ||
                thickness < 1 || ranks < 1) {
                std::fprintf(stderr, "volumes: '%s' is not SITES:THICKNESS:RANKS\n", argv[i]);
                return 2;
            }
            list.push_back(volumes(sites, thickness, ranks));
        }
    } catch (const std::exception& error) {
        std::fprintf(stderr, "volumes: %s\n", error.what());
        return 2;
    }
    std::printf("%s\n", list.dump(1).c_str());
    return 0;
}
