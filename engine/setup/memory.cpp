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

/// Of a spectral block: S(q) of a quadrant in double and its inverse in single precision, on every
/// rank; waves; displacements and forces.
double spectral_bytes(const Tile& tile, int components) {
    const double columns = tile.sites / 2 + 1, entries = components == 1 ? 1.0 : 6.0;
    return entries * columns * columns * 12.0 + 16.0 * components * columns * tile.ny +
           2.0 * static_cast<double>(VectorField<double>::bytes_for(tile, 1, 0));
}

double interface_bytes(const Scene& scene, const InterfaceOptions& options, const Tile& tile) {
    const double a = scene.surface.spacing;
    return static_cast<double>(
        scene.surface.kind == SurfaceKind::atoms
            ? Interface::bytes_over_atoms(options, tile, a, atoms_of(scene))
            : Interface::bytes_for(
                  options, tile, a,
                  substrate_sites(scene.surface.sites, scene.surface.lattice_ratio)));
}

/// On the root, which brings the lowest layer of a block in motion to rest (bring_to_rest()).
double bytes_of_bringing_to_rest(const Scene& scene, const Setup& setup) {
    const Tile whole = ProcessGrid::slabs(1, 0, scene.surface.sites).tile(0);
    InterfaceOptions interface = setup.simulation.interface;
    interface.single_too = !interface.mixed;
    const double layer = 24.0 * whole.nx * whole.ny;
    return layer + spectral_bytes(whole, 3) +
           static_cast<double>(relaxation_bytes(whole, 3, false)) +
           interface_bytes(scene, interface, whole);
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
                                std::max(relaxation, maps) + finite + absorption);
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
    absorption += other.absorption;
    return *this;
}

std::size_t relaxation_bytes(const Tile& tile, int components, bool wall) {
    const std::size_t sites = static_cast<std::size_t>(tile.nx) * static_cast<std::size_t>(tile.ny);
    // Waves, elastic forces in both precisions; next in double, the step in single; S u for the
    // energy at the end.
    if (wall) return sites * (4 * sizeof(double) + 3 * sizeof(float));
    // Vectors of the sites: in double, the gradient, S u, a displaced layer with its force; in
    // single, the ball's goals, momenta, waves and gain, Newton's four and its map, its direction
    // twice, and three fields of sites.
    const auto c = static_cast<std::size_t>(components);
    const std::size_t map = c == 1 ? 1 : 6;
    return sites * (sizeof(double) * (2 * c + (c == 1 ? 3 : 6)) +
                    sizeof(float) * (3 * c + 1 + 4 * c + map + 4 * c));
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
    need.interface = interface_bytes(scene, setup.simulation.interface, tile);
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
    if (!on(Effect::inertia)) {
        const int parts = scene.interface.frictionless ? 1 : 3;
        need.snapshot = copies * static_cast<double>(VectorField<double>::bytes_for(tile, 1, 0));
        need.block = spectral_bytes(tile, parts);
        need.relaxation = static_cast<double>(
            relaxation_bytes(tile, parts, scene.interface.kind == InterfaceKind::wall));
        return need;
    }
    const Block::Memory memory = Block::memory_for(setup.simulation.block, grid);
    need.motion = static_cast<double>(memory.motion);
    need.block = static_cast<double>(memory.bytes) - need.motion;
    // The energy guard's has velocities too.
    if (on(Effect::observation))
        need.snapshot = static_cast<double>(memory.displacements) + need.motion;
    if (on(Effect::relaxation) && rank == 0)
        need.relaxation = bytes_of_bringing_to_rest(scene, setup);
    need.absorption =
        static_cast<double>(Block::absorption_bytes_for(setup.simulation.block, grid, threads));
    if (on(Effect::finite_strain))
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
    const bool coarser = !scene.without_time() && scene.block.model == BlockModel::lattice;
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
