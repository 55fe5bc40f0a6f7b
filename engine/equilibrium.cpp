// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/equilibrium.hpp"

#include "decomposition/global_sum.hpp"
#include "engine/spectral_relaxation.hpp"
#include "engine/units.hpp"
#include "io/error.hpp"

#include <fmt/format.h>

#include <utility>

namespace asperity {

namespace {

class LevelsAtRest final : public Equilibrium {
public:
    explicit LevelsAtRest(Block block) : block_(std::move(block)) {}
    VectorPlane<const double> lowest_layer() const override { return block_.lowest_layer(); }
    VectorPlane<double> interface_force() override { return block_.interface_force(); }
    void undo() override { block_.set_uniform(0.0, 0.0); }
    RelaxedState relax(Interface& interface, double reference_height, RelaxOptions options,
                       Phases& phases) override {
        return asperity::relax(block_, interface, reference_height, options, phases);
    }
    std::size_t bytes() const override { return block_.bytes(); }
    std::size_t coarse_bytes() const override { return block_.coarse_bytes(); }

private:
    Block block_;
};

class WavesAtRest final : public Equilibrium {
public:
    WavesAtRest(const BlockOptions& options, const Communicator& ranks) : block_(options, ranks) {}
    VectorPlane<const double> lowest_layer() const override { return block_.lowest_layer(); }
    VectorPlane<double> interface_force() override { return block_.interface_force(); }
    void undo() override { block_.set_uniform(0.0); }
    RelaxedState relax(Interface& interface, double reference_height, RelaxOptions options,
                       Phases& phases) override {
        options.max_move = 0.2;
        return asperity::relax(block_, interface, reference_height, options, phases);
    }
    std::size_t bytes() const override {
        return block_.bytes() + spectral_relaxation_bytes(block_.options().sites);
    }
    std::size_t coarse_bytes() const override { return 0; }

private:
    SpectralBlock block_;
};

} // namespace

std::unique_ptr<Equilibrium> at_rest(Block block) {
    return std::make_unique<LevelsAtRest>(std::move(block));
}

std::unique_ptr<Equilibrium> make_equilibrium(const Scene& scene, const Setup& setup,
                                              const Communicator& ranks, const ProcessGrid& grid) {
    if (scene.block.model == BlockModel::spectral)
        return std::make_unique<WavesAtRest>(setup.simulation.block, ranks);
    return at_rest(Block(setup.simulation.block, ranks, grid, Motion::at_rest));
}

double height_of_strongest_attraction(Equilibrium& block, const Interface& interface,
                                      double lowest_atom, const Communicator& ranks) {
    block.undo();
    double best_height = interface.start_height(), strongest = 0.0;
    constexpr double stride = 0.1;
    for (double height = best_height;; height -= stride) {
        const InterfaceSums sums =
            interface.sweep(block.lowest_layer(), block.interface_force(), height, false);
        const double force = global_sum(ranks, sums.force_z);
        if (force < strongest) strongest = force, best_height = height;
        if (force > 0.0 || height < lowest_atom) return best_height;
    }
}

ZeroLoad find_zero_load(Equilibrium& block, Interface& interface, double reference_height,
                        const Scene& scene, const Setup& setup, io::Progress& progress) {
    RelaxOptions options;
    options.tolerance = scene.drive.tolerance;
    options.site_stiffness = setup.flat.stiffness * scene.surface.spacing * scene.surface.spacing;
    options.report = [&](long long iteration, double residual) {
        if (!progress.due()) return;
        progress.update(
            {fmt::format("relaxing, largest force {:.1e} eV/Å", residual), iteration, 0.0, -1.0});
    };
    Phases own; // its lines are not lines of the step
    const RelaxedState s = block.relax(interface, reference_height, options, own);
    if (!s.converged)
        throw io::PhysicsError(
            fmt::format("the zero-load state was not found in {} iterations", s.iterations),
            fmt::format("the largest force left is {:.2e} eV/Å, and drive.tolerance is {:.2e} eV/Å",
                        s.residual, scene.drive.tolerance),
            "look at run.h5 whether the surfaces touch at all; a looser drive.tolerance ends "
            "earlier");
    const double area = scene.edge() * scene.edge();
    const double sites = static_cast<double>(scene.surface.sites) * scene.surface.sites;
    ZeroLoad z;
    z.binding_energy = -units::milli_per_unit * (s.interface_energy + s.elastic_energy) / area;
    z.pairwise = -units::milli_per_unit * s.interface_energy / area;
    z.elastic = units::milli_per_unit * s.elastic_energy / area;
    z.contact_fraction = static_cast<double>(s.in_contact) / sites;
    z.pushed_fraction = static_cast<double>(s.pushed) / sites;
    z.mean_height = reference_height + s.mean_height;
    z.residual = s.residual;
    z.iterations = static_cast<double>(s.iterations);
    return z;
}

} // namespace asperity
