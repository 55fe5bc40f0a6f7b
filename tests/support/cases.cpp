// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "support/cases.hpp"

#include "decomposition/halo_exchange.hpp"
#include "decomposition/plane_bands.hpp"
#include "engine/case/potential_table.hpp"
#include "engine/units.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <fstream>
#include <stdexcept>

namespace asperity::test {

BlockOptions paper_block(int sites, int thickness, int layers_per_level) {
    BlockOptions options;
    options.sites = sites;
    options.young = 77.2 * units::gigapascal;
    options.atom_mass = 197.0 * units::atomic_mass;
    options.thickness = thickness;
    options.layers_per_level = std::max(1, layers_per_level);
    options.multiscale = layers_per_level > 0;
    return options;
}

std::array<PairPotential, 3> potentials(double cutoff) {
    // Softer than Lennard-Jones close by, and of a longer reach: no other potential of the program.
    static const PotentialTable table = [] {
        std::vector<double> r, v;
        for (double at = 1.5; at < 16.0; at += 0.05) {
            r.push_back(at);
            v.push_back(0.4 * (std::pow(3.2 / at, 9) - std::pow(3.2 / at, 5)));
        }
        return PotentialTable(r, v);
    }();
    Morse morse;
    morse.cutoff = cutoff;
    return {LennardJones{0.1, 3.28, cutoff}, morse, table.potential(cutoff)};
}

InterfaceOptions paper_interface(double cutoff_in_r0) {
    InterfaceOptions options;
    lennard_jones(options).cutoff = cutoff_in_r0 * lennard_jones(options).r0;
    return options;
}

SimulationOptions free_contact(double dt, int layers_per_level) {
    SimulationOptions options;
    options.block = paper_block(8, 7, layers_per_level);
    options.interface = paper_interface();
    options.drive.velocity = 0.0;
    options.dt = dt;
    return options;
}

Driven simulation(const SimulationOptions& options, const Surface& surface) {
    return Driven(options, surface, Communicator(), serial_grid(options.block));
}

namespace {

Surface surface_of(std::vector<double> heights) {
    Surface surface;
    surface.sites = static_cast<int>(std::lround(std::sqrt(static_cast<double>(heights.size()))));
    surface.length = 2.6 * surface.sites;
    surface.statistics.lowest = *std::min_element(heights.begin(), heights.end());
    surface.statistics.highest = *std::max_element(heights.begin(), heights.end());
    surface.height = std::move(heights);
    return surface;
}

} // namespace

Surface flat_surface(int sites) {
    return surface_of(
        std::vector<double>(static_cast<std::size_t>(sites) * static_cast<std::size_t>(sites)));
}

Surface scattered(int sites, double length, double amplitude, unsigned seed, double level) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> height(-amplitude, amplitude);
    Surface surface = flat_surface(sites);
    for (double& h : surface.height)
        h = level + height(random);
    surface.length = length;
    return surface;
}

Surface reference_surface(const std::string& name, double factor) {
    const std::string path = std::string(ASPERITY_TEST_DATA) + "/" + name + ".txt";
    std::ifstream file(path);
    if (!file) throw std::runtime_error("cannot open " + path);
    std::vector<double> heights;
    for (double h; file >> h;)
        heights.push_back(factor * h);
    return surface_of(std::move(heights));
}

Surface disordered(Surface surface) {
    const double b = surface.length / surface.sites;
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> aside(-0.4, 0.4);
    for (const double layer : {0.0, 1.0})
        for (std::size_t i = 0; i < surface.height.size(); ++i) {
            const auto n = static_cast<std::size_t>(surface.sites);
            const auto folded = [&](std::size_t site) {
                const double place = (static_cast<double>(site) + 0.5 * layer) * b + aside(random);
                return place - surface.length * std::floor(place / surface.length);
            };
            surface.atoms.x.push_back(folded(i % n));
            surface.atoms.y.push_back(folded(i / n));
            surface.atoms.z.push_back(surface.height[i] - 1.8 * layer);
        }
    return surface;
}

ProcessGrid grid_for(const BlockOptions& options, const Communicator& communicator) {
    return ProcessGrid(communicator.size(), communicator.rank(), options.sites,
                       static_cast<int>(level_shapes(options).size()));
}

Relaxed numbers_of(const RelaxedState& state, const BlockOptions& options,
                   double reference_height) {
    Relaxed relaxed;
    relaxed.state = state;
    const double area = std::pow(options.sites * options.spacing, 2);
    relaxed.binding_energy = -1e3 * (state[Term::interface] + state[Term::elastic]) / area;
    relaxed.pairwise = -1e3 * state[Term::interface] / area;
    relaxed.mean_height = reference_height + state.mean_height;
    return relaxed;
}

Scales paper_scales() {
    const FlatReference flat = flat_reference(paper_interface(), 2.6, 64, 64);
    const double tension = flat.largest_tension * units::gigapascal;
    return {flat.work_of_adhesion / units::milli_per_unit / tension, 2.6 * 2.6 * tension,
            2.6 * 2.6 * flat.stiffness};
}

Relaxed relax_spectral(const BlockOptions& options, const InterfaceOptions& interface_options,
                       const Surface& surface, double tolerance, bool frictionless) {
    SpectralBlock block(options, Communicator(), frictionless);
    Interface interface(surface, block.tile(), options.spacing, interface_options);
    const double height = height_of_strongest_attraction(
        block, interface, surface.statistics.lowest, paper_scales().length);
    interface.set_reference_height(height);
    RelaxOptions relax_options;
    relax_options.tolerance = tolerance;
    relax_options.scales = paper_scales();
    Phases phases;
    return numbers_of(relax(block, interface, {}, relax_options, phases), options, height);
}

LayerAtRest bring_to_rest(const Block& moving, const Surface& surface, double reference_height,
                          const SimulationOptions& options, double tolerance) {
    Scene scene;
    scene.surface.sites = options.block.sites;
    scene.surface.spacing = options.block.spacing;
    scene.interface.cutoff = std::min(scene.interface.cutoff.value_or(13.12), 0.5 * scene.edge());
    Case c = resolve(scene);
    c.tolerance = tolerance;
    c.simulation = options;
    return asperity::bring_to_rest(moving, surface, reference_height, c, {}, {});
}

SpectralDisplacement random_displacement(const SpectralBlock& block, std::mt19937_64& random,
                                         double size) {
    SpectralDisplacement d{block.new_field<float>(), block.new_waves<float>()};
    std::normal_distribution<double> normal(0.0, size);
    for (Field<float>& f : d.sites)
        for (int y = 0; y < block.tile().ny; ++y)
            for (int x = 0; x < block.tile().nx; ++x)
                f.plane(0)(x, y) = static_cast<float>(normal(random));
    const double n = block.options().sites;
    to_waves(d.sites, block.transform<float>(), d.waves);
    combine(0.0, d.waves, 1.0 / (n * n), d.waves);
    return d;
}

std::uint64_t mix(std::uint64_t hash, double value) {
    return (hash ^ std::bit_cast<std::uint64_t>(value)) * 0x9E3779B97F4A7C15u + (hash >> 29);
}

std::uint64_t mix(std::uint64_t hash, const StepRecord& r) {
    for (double value : {r.time, r.top, r.mean_height, r.force, r.top_force, r.slide[0], r.slide[1],
                         r.lateral_force[0], r.lateral_force[1]})
        hash = mix(hash, value);
    if (!r.observed) return hash;
    for (double value :
         {r[Term::interface], r[Term::elastic], r[Term::kinetic], r.closest,
          static_cast<double>(r.in_contact), static_cast<double>(r.repulsive), r[Term::work],
          r[Term::lost], r[Term::work_of_interface], r.residual, r[Term::time_step]})
        hash = mix(hash, value);
    return hash;
}

std::uint64_t mix(std::uint64_t hash, const EnergyBalance& b) {
    for (double value :
         {b.top_work, b.lateral, b.drag_work, b.damped, b.heat, b.external, b.interface})
        hash = mix(hash, value);
    return hash;
}

void Trace::follow(Driven& s, int steps) {
    for (int n = 0; n < steps; ++n) {
        const StepRecord& now = s.step(s.steps() % 10 == 0);
        s.drive().observe({now.time, now.force, 0.0, false}); // turns round on contact
        force = now.force;
        records = mix(records, now);
        if (now.observed) in_contact = std::max(in_contact, now.in_contact);
    }
}
void Trace::conclude(const Driven& s) {
    records = mix(records, s.balance());
    state = fingerprint(s.block());
}

std::uint64_t fingerprint(const Block& block) {
    const Communicator& ranks = block.communicator();
    std::uint64_t hash = mix(1, block.top());
    for (const Block::Level& level : block.levels())
        for (const VectorField<double>* field : {&level.u, &level.v})
            for (const Field<double>* component : {&field->x, &field->y, &field->z})
                for (int z = 0; z < level.shape.cells; ++z)
                    for (double value :
                         gather_plane(ranks, block.grid(), level.shape.level, component->plane(z)))
                        hash = mix(hash, value);
    std::array<std::int64_t, 1> roots = {ranks.root() ? std::bit_cast<std::int64_t>(hash) : 0};
    ranks.sum(roots);
    return std::bit_cast<std::uint64_t>(roots[0]);
}

} // namespace asperity::test
