// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/setup/memory.hpp"

#include "io/atoms_file.hpp"
#include "io/available_memory.hpp"
#include "io/error.hpp"
#include "kernels/interface_sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

namespace asperity {

namespace {

/// Heights of the substrate.
double heights_of(const Scene& scene) {
    const double n = substrate_sites(scene.surface.sites, scene.surface.lattice_ratio);
    return n * n;
}

/// Of a substrate of atoms anywhere: how many the head of its file announces.
std::size_t atoms_of(const Scene& scene) {
    return scene.surface.kind == SurfaceKind::atoms ? io::atoms_announced(scene.surface.map) : 0;
}

double surface_bytes(const Scene& scene) {
    const double atom = scene.interface.pairs.empty() ? 24.0 : 28.0;
    return 8.0 * heights_of(scene) + atom * static_cast<double>(atoms_of(scene));
}

/// The surface, the waves that heights are made from and measured by (make_surface, measure), and
/// the places that atoms are compared at (surface_from_atoms).
double making_bytes(const Scene& scene) {
    const double waves = 16.0, places = 45.0;
    const double copies = scene.surface.kind == SurfaceKind::flat ? 1.0 : 2.0;
    return surface_bytes(scene) + heights_of(scene) * copies * waves +
           static_cast<double>(atoms_of(scene)) * places;
}

void refuse(const Scene& scene, const char* what, double needed, const io::AvailableMemory& there,
            const std::string& fix) {
    io::Problems problems = scene.problems();
    problems.add(
        "surface.sites",
        fmt::format("= {}: {} does not fit into memory", scene.surface.sites, what),
        fmt::format("{:.3g} GB are needed on this machine, and {:.3g} GB are available ({})",
                    needed / 1e9, there.bytes / 1e9, there.because),
        fix);
    problems.throw_if_any();
}

} // namespace

double MemoryNeed::most() const {
    return std::max(making, surface + interface + block + motion + snapshot +
                                std::max(relaxation, maps) + finite);
}

MemoryNeed& MemoryNeed::operator+=(const MemoryNeed& other) {
    making += other.making;
    surface += other.surface;
    interface += other.interface;
    block += other.block;
    motion += other.motion;
    snapshot += other.snapshot;
    relaxation += other.relaxation;
    maps += other.maps;
    finite += other.finite;
    return *this;
}

std::size_t spectral_relaxation_bytes(const Tile& tile, int components, bool wall) {
    const std::size_t sites = static_cast<std::size_t>(tile.nx) * static_cast<std::size_t>(tile.ny);
    // Waves, elastic forces in both precisions; next in double, the step in single.
    if (wall) return sites * (3 * sizeof(double) + 3 * sizeof(float));
    // Vectors of the sites: in double, the gradient, a displaced layer with its force; in single,
    // the ball's goals, momenta, waves and gain, Newton's four and its map, its direction twice,
    // and three fields of sites.
    const auto c = static_cast<std::size_t>(components);
    const std::size_t map = c == 1 ? 1 : 6;
    return sites * (sizeof(double) * (c + (c == 1 ? 3 : 6)) +
                    sizeof(float) * (3 * c + 1 + 4 * c + map + 4 * c));
}

std::size_t level_relaxation_bytes(const BlockOptions& options, const ProcessGrid& grid) {
    const std::vector<LevelShape> levels = level_shapes(options);
    const auto vectors = [&](std::size_t level, int planes) {
        return VectorField<double>::bytes_for(grid.tile(static_cast<int>(level)), planes);
    };
    std::size_t bytes = vectors(0, 1);     // the interface's forces before
    for (const LevelShape& level : levels) // forces and moves
        bytes += 2 * vectors(static_cast<std::size_t>(level.level), level.cells);
    // Grids over the levels (equilibrium/coarse_grids.cpp): planes that are thinned to every
    // second one, the same between them with the nodes of the finer grid, stiffness, and forces.
    int kept = 0;
    for (std::size_t g = 0;; ++g) {
        const Tile tile = grid.tile(static_cast<int>(g));
        bytes += Field<double>::bytes_for(tile, 1);
        if (g > 0) {
            const int planes = kept + (g - 1 < levels.size() ? levels[g - 1].cells : 0);
            kept = planes == 1 ? 1 : planes / 2;
            const bool has_level = g < levels.size();
            bytes += vectors(g, kept) + vectors(g - 1, kept + has_level);
            if (has_level) bytes += vectors(g, 1);
        }
        const bool thinner = std::ldexp(1.0, static_cast<int>(g) + 1) <= options.thickness;
        if (tile.sites % 2 != 0 || !(thinner || g + 1 < levels.size())) return bytes;
    }
}

double device_memory_of(const Scene& scene, const Setup& setup, const ProcessGrid& grid) {
    return static_cast<double>(
        DeviceBlock::bytes_for(setup.simulation.block, grid, setup.simulation.interface,
                               substrate_sites(scene.surface.sites, scene.surface.lattice_ratio)));
}

MemoryNeed memory_of_rank(const Scene& scene, const Setup& setup, int ranks, int rank,
                          int threads) {
    const auto on = [&](Effect effect) { return setup.effects.on(effect); };
    const ProcessGrid grid = make_grid(scene, setup, ranks, rank);
    const Tile tile = grid.tile(0);
    MemoryNeed need;
    need.making = making_bytes(scene);
    need.surface = surface_bytes(scene);
    const InterfaceOptions& interface = setup.simulation.interface;
    const double a = scene.surface.spacing;
    need.interface = static_cast<double>(
        scene.surface.kind == SurfaceKind::atoms
            ? Interface::bytes_over_atoms(interface, tile, a, atoms_of(scene))
            : Interface::bytes_for(
                  interface, tile, a,
                  substrate_sites(scene.surface.sites, scene.surface.lattice_ratio)));
    // Maps of the rank's sites in double, and on the root the record of all and one more map.
    if (on(Effect::maps)) {
        const double here = static_cast<double>(tile.nx) * tile.ny;
        const double all = static_cast<double>(tile.sites) * tile.sites;
        need.maps = 41.0 * here + (rank == 0 ? 57.0 * all : 0.0);
    }
    // A search keeps two points, the first state, where it turned, and a point beside a state; its
    // first four stay while a path with its own two goes on.
    const bool path = scene.drive.mode == DriveMode::quasistatic;
    const double copies = on(Effect::states) ? (path ? 6.0 : 5.0) : path ? 2.0 : 0.0;
    if (scene.block.model == BlockModel::spectral) {
        need.snapshot = copies * static_cast<double>(VectorField<double>::bytes_for(tile, 1, 0));
        const double columns = scene.surface.sites / 2 + 1;
        const int parts = scene.interface.frictionless ? 1 : 3;
        const double entries = scene.interface.frictionless ? 1.0 : 6.0;
        // S(q) of a quadrant in double and its inverse in single precision, on every rank; waves.
        need.block = entries * columns * columns * 12.0 + 16.0 * parts * columns * tile.ny +
                     2.0 * static_cast<double>(VectorField<double>::bytes_for(tile, 1, 0));
        need.relaxation = static_cast<double>(
            spectral_relaxation_bytes(tile, parts, scene.interface.kind == InterfaceKind::wall));
        return need;
    }
    const Block::Memory memory = Block::memory_for(setup.simulation.block, grid);
    const double motion = static_cast<double>(memory.motion);
    need.block = static_cast<double>(memory.bytes) - motion;
    if (on(Effect::inertia)) need.motion = motion;
    // The energy guard's has velocities too.
    const double displacements = static_cast<double>(memory.displacements);
    need.snapshot = on(Effect::inertia) && on(Effect::observation) ? displacements + motion
                                                                   : copies * displacements;
    if (on(Effect::relaxation)) {
        need.relaxation = static_cast<double>(level_relaxation_bytes(setup.simulation.block, grid));
        if (on(Effect::inertia)) need.relaxation += need.block; // of a copy of the block
    }
    if (on(Effect::finite_strain) && on(Effect::inertia))
        need.finite =
            static_cast<double>(Block::finite_bytes_for(setup.simulation.block, grid, threads));
    return need;
}

MemoryNeed memory_of(const Scene& scene, const Setup& setup, int ranks, int threads) {
    MemoryNeed need;
    for (int rank = 0; rank < ranks; ++rank)
        need += memory_of_rank(scene, setup, ranks, rank, threads);
    return need;
}

void require_memory(const Scene& scene, const Communicator& ranks, int threads) {
    const Setup setup = make_setup(scene, ranks.size());
    const double mine = memory_of_rank(scene, setup, ranks.size(), ranks.rank(), threads).most();
    const double needed = ranks.sum_on_machine(mine);
    const io::AvailableMemory there = io::available_memory();
    // All ranks refuse alike, with the numbers of the machine that is worst off.
    const double worst = ranks.max(needed / there.bytes);
    if (worst <= 1.0) return;
    const bool coarser = scene.block.model == BlockModel::lattice;
    refuse(scene, "the run", worst * there.bytes, there,
           fmt::format("take fewer sites{}, more machines (`asperity plan --ranks N` counts), or "
                       "close what else runs here",
                       coarser ? ", block.model = \"multiscale\"" : ""));
}

void require_memory_for_surface(const Scene& scene) {
    const io::AvailableMemory there = io::available_memory();
    if (making_bytes(scene) > there.bytes)
        refuse(scene, "its surface", making_bytes(scene), there,
               "take fewer sites; every rank makes the whole surface");
}

} // namespace asperity
