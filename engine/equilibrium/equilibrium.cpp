// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/equilibrium/equilibrium.hpp"

#include "decomposition/global_sum.hpp"
#include "engine/equilibrium/spectral_relaxation.hpp"
#include "engine/setup/memory.hpp"
#include "engine/units.hpp"
#include "io/error.hpp"

#include <fmt/format.h>

#include <numbers>
#include <utility>

namespace asperity {

namespace {

class LevelsAtRest final : public Equilibrium {
public:
    explicit LevelsAtRest(Block block) : block_(std::move(block)) {}
    VectorPlane<const double> lowest_layer() const override { return block_.lowest_layer(); }
    VectorPlane<double> interface_force() override { return block_.interface_force(); }
    const Communicator& communicator() const override { return block_.communicator(); }
    void set_uniform(double z) override { block_.set_uniform(z, 0.0); }
    double top() const override { return block_.top(); }
    double mean_height() const override {
        ExactSum sum;
        block_.add_lowest_z(sum);
        const double sites = block_.options().sites;
        return global_sum(block_.communicator(), sum) / (sites * sites);
    }
    std::vector<StateArray> state() override {
        std::vector<StateArray> list;
        for (const Block::Level& level : block_.levels())
            add_arrays(level.shape.level, "u", block_.fields(level).u, level.shape.cells, list);
        return list;
    }
    void settle(const Constraint& constraint) override {
        if (constraint.of != Constraint::Of::load) block_.set_top(constraint.value);
        if (constraint.is_mean_height()) shift(constraint.value - mean_height());
        block_.exchange();
    }
    RelaxedState relax(Interface& interface, double reference_height, const Constraint& constraint,
                       RelaxOptions options, Phases& phases) override {
        settle(constraint);
        return asperity::relax(block_, interface, reference_height, constraint, options, phases);
    }
    std::size_t bytes() const override { return block_.bytes(); }

private:
    /// All that moves, the free top plane apart, by this much along z.
    void shift(double by) {
        for (const Block::Level& level : block_.levels())
            for (int cell = 0; cell < level.shape.cells; ++cell) {
                const PlaneView<double> z = block_.fields(level).u.z.plane(cell);
                for (int y = 0; y < z.ny; ++y)
                    for (int x = 0; x < z.nx; ++x)
                        z(x, y) += by;
            }
    }

    Block block_;
};

class WavesAtRest final : public Equilibrium {
public:
    WavesAtRest(const BlockOptions& options, const Communicator& ranks, bool frictionless,
                bool wall)
        : block_(options, ranks, frictionless), wall_(wall) {}
    VectorPlane<const double> lowest_layer() const override { return block_.lowest_layer(); }
    VectorPlane<double> interface_force() override { return block_.interface_force(); }
    const Communicator& communicator() const override { return block_.communicator(); }
    void set_uniform(double z) override { block_.set_uniform(z); }
    double top() const override { return block_.top(); }
    double mean_height() const override { return block_.mean_height(); }
    std::vector<StateArray> state() override {
        std::vector<StateArray> list;
        add_arrays(0, "u", block_.layer(), 1, list);
        return list;
    }
    void settle(const Constraint& constraint) override {
        block_.constrain(constraint);
        block_.settle();
    }
    RelaxedState relax(Interface& interface, double reference_height, const Constraint& constraint,
                       RelaxOptions options, Phases& phases) override {
        options.max_move = 0.3;
        settle(constraint);
        return asperity::relax(block_, interface, reference_height, options, phases);
    }
    std::size_t bytes() const override {
        return block_.bytes() +
               spectral_relaxation_bytes(block_.tile(), block_.components(), wall_);
    }

private:
    SpectralBlock block_;
    bool wall_; ///< below it
};

} // namespace

std::unique_ptr<Equilibrium> at_rest(Block block) {
    return std::make_unique<LevelsAtRest>(std::move(block));
}

std::unique_ptr<Equilibrium> spectral_at_rest(const BlockOptions& options,
                                              const Communicator& ranks, bool frictionless,
                                              bool wall) {
    return std::make_unique<WavesAtRest>(options, ranks, frictionless, wall);
}

std::unique_ptr<Equilibrium> make_equilibrium(const Scene& scene, const Setup& setup,
                                              const Communicator& ranks, const ProcessGrid& grid) {
    if (scene.block.model == BlockModel::spectral)
        return spectral_at_rest(setup.simulation.block, ranks, scene.interface.frictionless,
                                scene.interface.kind == InterfaceKind::wall);
    return at_rest(Block(setup.simulation.block, ranks, grid, Motion::at_rest));
}

double height_of_strongest_attraction(Equilibrium& block, const Interface& interface,
                                      double lowest_atom, const Communicator& ranks) {
    block.set_uniform(0.0);
    double best_height = interface.attraction_grows_down_to(), strongest = 0.0;
    constexpr double stride = 0.1;
    for (double height = best_height;; height -= stride) {
        const InterfaceSums sums =
            interface.sweep(block.lowest_layer(), block.interface_force(), height, false, true);
        const double force = global_sum(ranks, sums.force_z);
        if (force < strongest) strongest = force, best_height = height;
        if (force > 0.0 || height < lowest_atom) return best_height;
    }
}

std::optional<ZeroLoad> find_zero_load(Equilibrium& block, Interface& interface,
                                       double reference_height, double load, const Scene& scene,
                                       const Setup& setup,
                                       const std::function<bool(long long, double)>& stop) {
    RelaxOptions options;
    options.tolerance = scene.drive.tolerance;
    options.site_stiffness = setup.site_stiffness;
    options.report = stop;
    Phases own; // its lines are not lines of the step
    const RelaxedState s =
        block.relax(interface, reference_height, Constraint::load(load), options, own);
    if (s.interrupted) return std::nullopt;
    if (!s.converged)
        throw io::PhysicsError(
            fmt::format("the zero-load state was not found in {} iterations", s.iterations),
            fmt::format("the largest force left is {:.2e} eV/Å, and drive.tolerance is {:.2e} eV/Å",
                        s.residual, scene.drive.tolerance),
            load < 0.0 ? "take a smaller pull (drive.load): under a large one there is no state"
                       : "look at run.h5 whether the surfaces touch at all; a looser "
                         "drive.tolerance ends earlier");
    const double area = scene.edge() * scene.edge();
    const double sites = static_cast<double>(scene.surface.sites) * scene.surface.sites;
    ZeroLoad z;
    z.binding_energy = -units::milli_per_unit * (s.interface_energy + s.elastic_energy) / area;
    z.pairwise = -units::milli_per_unit * s.interface_energy / area;
    z.elastic = units::milli_per_unit * s.elastic_energy / area;
    z.contact_fraction = static_cast<double>(s.in_contact) / sites;
    z.repulsive_fraction = static_cast<double>(s.repulsive) / sites;
    z.mean_height = reference_height + s.mean_height;
    z.residual = s.residual;
    z.iterations = static_cast<double>(s.iterations);
    // Half of force^2 / stiffness at each site, of the softest wave of the box, by the forces that
    // the tolerance allows: those left say how this relaxation ended, not where others may end.
    const double site_area = scene.surface.spacing * scene.surface.spacing;
    z.uncertainty = units::milli_per_unit * 0.5 * options.tolerance * options.tolerance /
                    (setup.simulation.block.softest_wave() * site_area * site_area);
    return z;
}

void show_relaxation(io::Progress& progress, long long iteration, double residual) {
    if (!progress.due()) return;
    progress.update(
        {fmt::format("relaxing, largest force {:.1e} eV/Å", residual), iteration, 0.0, -1.0});
}

} // namespace asperity
