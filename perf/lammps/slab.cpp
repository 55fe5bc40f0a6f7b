// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// One slab for two programs: this engine's lattice block at finite strain, and LAMMPS.
//
//     slab write N LAYERS STEPS DIRECTORY
//         data and settings for the inputs in.slab, in.path and in.time of LAMMPS; and, unless
//         STEPS is 0, our own path, step by step: energies, positions, forces
//     slab time N LAYERS STEPS PIECES linear|finite
//         a line for each of PIECES times STEPS steps: nanoseconds of wall time and of processor
//         time, summed over ranks and threads, for each mobile atom and step
//
// At a Poisson number of 1/4 the block is a plain bond crystal. Its atoms begin off their places
// (up to 0.05 Å, by a formula) above a rough rigid substrate in reach; the top plane comes down.
// LAMMPS gets our units (Å, eV, fs, and masses in eV fs^2/Å^2) as its "lj" units, where every
// constant of nature is 1.
#include "engine/dynamics/simulation.hpp"
#include "engine/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <numbers>
#include <string>
#include <utility>

using namespace asperity;

namespace {

constexpr double start_height = 4.0; // Å, of the lowest layer above the substrate's mean

SimulationOptions slab_options(int sites, int layers, bool finite) {
    SimulationOptions options;
    options.block.sites = sites;
    options.block.young = 77.2 * units::gigapascal;
    options.block.poisson = 0.25;
    options.block.atom_mass = 197.0 * units::atomic_mass;
    options.block.thickness = layers;
    options.block.multiscale = false;
    options.block.finite_strain = finite;
    options.drive.velocity = 50.0 * units::metre_per_second;
    options.dt = 10.0;
    return options;
}

double bumpy(double x, double y, double z) { return std::sin(1.3 * x + 7.7 * y + 0.7 * z); }

Surface rough_surface(int sites, double spacing) {
    Surface surface;
    surface.sites = sites;
    surface.length = sites * spacing;
    for (int y = 0; y < sites; ++y)
        for (int x = 0; x < sites; ++x)
            surface.height.push_back(0.4 * bumpy(x, y, 0));
    const auto [low, high] = std::minmax_element(surface.height.begin(), surface.height.end());
    surface.statistics.lowest = *low;
    surface.statistics.highest = *high;
    return surface;
}

class Slab {
public:
    Slab(int sites, int layers, bool finite, const Communicator& ranks)
        : options_(slab_options(sites, layers, finite)),
          surface_(rough_surface(sites, options_.block.spacing)),
          grid_(ranks.size(), ranks.rank(), sites, 1),
          simulation_(options_, surface_, ranks, grid_) {
        simulation_.start(start_height);
        Block& block = simulation_.block_to_write();
        const Block::Level& level = block.levels().front();
        const auto u = block.fields(level).u.view();
        for (int z = 0; z < layers; ++z)
            for (int y = 0; y < level.tile.ny; ++y)
                for (int x = 0; x < level.tile.nx; ++x) {
                    const int i = level.tile.x0 + x, j = level.tile.y0 + y;
                    u.x(x, y, z) = 0.05 * bumpy(i, j, z);
                    u.y(x, y, z) = 0.05 * bumpy(j, z, i);
                    u.z(x, y, z) = 0.05 * bumpy(z, i, j);
                }
        block.exchange();
    }
    Simulation& simulation() { return simulation_; }
    const SimulationOptions& options() const { return options_; }
    const Surface& surface() const { return surface_; }

private:
    SimulationOptions options_;
    Surface surface_;
    ProcessGrid grid_;
    Simulation simulation_;
};

/// A text file that complains.
class TextFile {
public:
    explicit TextFile(const std::string& path) : file_(std::fopen(path.c_str(), "w")) {
        if (file_) return;
        fmt::print(stderr, "slab: {} cannot be written\n", path);
        std::exit(2);
    }
    ~TextFile() { std::fclose(file_); }
    TextFile(const TextFile&) = delete;
    TextFile& operator=(const TextFile&) = delete;
    template <class... Arguments>
    void operator()(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
        fmt::print(file_, format, std::forward<Arguments>(arguments)...);
    }

private:
    std::FILE* file_;
};

/// Atoms by kind; they are numbered substrate, then the block's planes from below.
enum Kind { substrate = 1, lowest = 2, inside = 3, top = 4 };

struct Lattice {
    int sites, layers;
    long long id(int x, int y, int z) const { // z = -1: substrate
        const int i = (x + sites) % sites, j = (y + sites) % sites;
        return static_cast<long long>(z + 1) * sites * sites + j * sites + i + 1;
    }
};

/// Springs between two atoms: edges and face diagonals, each whole or (in the free surface) half.
/// Those within the top plane join prescribed atoms and are left out.
template <class Use>
void each_spring(const Lattice& l, const Use& use) {
    for (int z = 0; z < l.layers; ++z)
        for (int y = 0; y < l.sites; ++y)
            for (int x = 0; x < l.sites; ++x) {
                const int half = z == 0 ? 1 : 0;
                const auto here = l.id(x, y, z);
                use(1 + half, here, l.id(x + 1, y, z));
                use(1 + half, here, l.id(x, y + 1, z));
                use(3 + half, here, l.id(x + 1, y + 1, z));
                use(3 + half, l.id(x + 1, y, z), l.id(x, y + 1, z));
                use(1, here, l.id(x, y, z + 1));
                for (int side : {-1, 1}) {
                    use(3, here, l.id(x + side, y, z + 1));
                    use(3, here, l.id(x, y + side, z + 1));
                }
            }
}

void write_lammps(Slab& slab, const std::string& directory, const VectorField<double>& force) {
    const SimulationOptions& o = slab.options();
    const Block::Level& level = slab.simulation().block().levels().front();
    const double a = o.block.spacing, edge = o.block.sites * a, k = o.block.elasticity(0).k;
    const int n = o.block.sites, layers = o.block.thickness;
    const Lattice lattice{n, layers};
    const double velocity = -o.drive.velocity;

    TextFile data(directory + "/slab.data");
    data("Lattice block on a rough substrate; written by perf/lammps/slab\n\n");
    data("{} atoms\n{} bonds\n4 atom types\n4 bond types\n\n", lattice.id(n - 1, n - 1, layers),
         9LL * n * n * layers);
    data("0 {:.17g} xlo xhi\n0 {:.17g} ylo yhi\n-20 {:.17g} zlo zhi\n\nMasses\n\n", edge, edge,
         start_height + layers * a + 20.0);
    for (int kind = substrate; kind <= top; ++kind)
        data("{} {:.17g}\n", kind, o.block.atom_mass);
    // LAMMPS: E = K (r - r0)^2.
    data("\nBond Coeffs\n\n");
    for (int diagonal : {0, 1})
        for (int half : {0, 1})
            data("{} {:.17g} {:.17g}\n", 1 + 2 * diagonal + half, half ? 0.25 * k : 0.5 * k,
                 a * (diagonal ? std::numbers::sqrt2 : 1.0));
    data("\nAtoms # bond\n\n");
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x)
            data("{} 1 1 {:.17g} {:.17g} {:.17g}\n", lattice.id(x, y, -1), x * a, y * a,
                 slab.surface().height[static_cast<std::size_t>(y * n + x)]);
    const auto u = level.u.view();
    for (int z = 0; z <= layers; ++z)
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x)
                data("{} 1 {} {:.17g} {:.17g} {:.17g}\n", lattice.id(x, y, z),
                     static_cast<int>(z == 0        ? lowest
                                      : z == layers ? top
                                                    : inside),
                     (x + 0.5) * a + u.x(x, y, z), (y + 0.5) * a + u.y(x, y, z),
                     start_height + z * a + u.z(x, y, z));
    // Ours are velocities half a step before the start, LAMMPS wants them at it.
    data("\nVelocities\n\n");
    const double half_kick = 0.5 * o.dt / o.block.atom_mass;
    const auto f = force.view();
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            data("{} 0 0 0\n", lattice.id(x, y, -1));
            for (int z = 0; z < layers; ++z)
                data("{} {:.17g} {:.17g} {:.17g}\n", lattice.id(x, y, z), half_kick * f.x(x, y, z),
                     half_kick * f.y(x, y, z), velocity + half_kick * f.z(x, y, z));
            data("{} 0 0 {:.17g}\n", lattice.id(x, y, layers), velocity);
        }
    data("\nBonds\n\n");
    long long bond = 0;
    each_spring(lattice, [&](int type, long long from, long long to) {
        data("{} {} {} {}\n", ++bond, type, from, to);
    });

    const auto& lj = std::get<LennardJones>(o.interface.potential);
    TextFile settings(directory + "/slab.settings");
    settings("variable cutoff equal {:.17g}\nvariable epsilon equal {:.17g}\n", lj.cutoff,
             lj.epsilon);
    settings("variable r0 equal {:.17g}\nvariable velocity equal {:.17g}\n", lj.r0, velocity);
    settings("variable dt equal {:.17g}\n", o.dt);
}

/// Forces at the present positions, on all moving planes.
void evaluate(Simulation& s, std::vector<VectorField<double>>& force) {
    Block& block = s.block_to_write();
    block.interpolate();
    s.interface().sweep(block.lowest_layer(), block.interface_force(), s.reference_height(), {});
    block.forces(force);
}

int write(int sites, int layers, int steps, const std::string& directory) {
    Slab slab(sites, layers, true, Communicator());
    Simulation& s = slab.simulation();
    const Block::Level& level = s.block().levels().front();
    std::vector<VectorField<double>> force;
    force.emplace_back(level.tile, layers);
    evaluate(s, force);
    write_lammps(slab, directory, force.front());
    if (steps == 0) return 0;

    const double a = slab.options().block.spacing;
    TextFile path(directory + "/path.ours");
    for (int step = 0; step <= steps; ++step) {
        evaluate(s, force);
        const VectorVolume<double> f = force.front().view();
        std::string atoms;
        // step() moves on to the next positions; what it records belongs to these.
        const auto u = s.block().levels().front().u.view();
        for (int z = 0; z < layers; ++z)
            for (int y = 0; y < sites; ++y)
                for (int x = 0; x < sites; ++x)
                    atoms += fmt::format("{:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}\n",
                                         (x + 0.5) * a + u.x(x, y, z), (y + 0.5) * a + u.y(x, y, z),
                                         start_height + z * a + u.z(x, y, z), f.x(x, y, z),
                                         f.y(x, y, z), f.z(x, y, z));
        const StepRecord& now = s.step(true);
        path("step {} {:.17g} {:.17g} {:.17g}\n{}", step, now.interface_energy, now.elastic_energy,
             now.kinetic_energy, atoms);
    }
    return 0;
}

/// Of this process, all threads together, ns.
std::int64_t processor_time() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return now.tv_sec * std::int64_t{1000000000} + now.tv_nsec;
}

int time(int sites, int layers, int steps, int pieces, bool finite, const Communicator& ranks) {
    Slab slab(sites, layers, finite, ranks);
    const double updates = 1.0 * sites * sites * layers * steps;
    for (int piece = -1; piece < pieces; ++piece) { // the first one warms up
        const auto start = std::chrono::steady_clock::now();
        const std::int64_t used = processor_time();
        for (int step = 0; step < steps; ++step)
            slab.simulation().step(false);
        const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
        std::array<std::int64_t, 1> processors = {processor_time() - used};
        ranks.sum(processors);
        if (ranks.root() && piece >= 0)
            fmt::print("{:.6g} {:.6g}\n", 1e9 * taken.count() / updates,
                       static_cast<double>(processors[0]) / updates);
    }
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    ParallelSession session(argc, argv);
    const std::string verb = argc > 1 ? argv[1] : "";
    const auto number = [&](int i) { return std::atoi(argv[i]); };
    if (verb == "write" && argc == 6) return write(number(2), number(3), number(4), argv[5]);
    if (verb == "time" && argc == 7)
        return time(number(2), number(3), number(4), number(5), std::string(argv[6]) == "finite",
                    session.world());
    fmt::print(stderr, "usage: slab write N LAYERS STEPS DIRECTORY\n"
                       "       slab time N LAYERS STEPS PIECES linear|finite\n");
    return 2;
}
