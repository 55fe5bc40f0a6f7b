// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The elastic block at rest: the response of its surface to forces (docs/explanation/model.md).
//
// If the inside of a lattice of `thickness` layers is in equilibrium, its energy depends on the
// lowest layer alone, through a stiffness S(q), one 3 x 3 matrix for each wave
// (kernels/surface_stiffness.hpp):
//
//     U_el = 1/2 sum_r u.(S u),      force on the layer = -S u,      S u by Fourier transform.
//
// No depth is discretised: this is the exact static response of the lattice, at the cost of a
// surface. It has no inertia and serves relaxations and quasi-static paths.
//
// The stiffness is composed of separate terms:
//
//     the table S(q)     of the lattice, constant (stiffness_table.hpp)
//     the holder         the uniform normal wave against the machine, if that is held: the block
//                        and what holds its rigid top plane, in series
//     the branches       a factor on all of S in a step of a viscoelastic block, and a force that
//                        is known at its start (block_memory.hpp); or a factor for each wave, as
//                        long as a shape is sought that slides on unchanged (moving_pattern.hpp)
//
// Without friction (scene: interface.frictionless) the substrate takes no lateral traction: S is
// one number for each wave, 1 / (S^-1)_zz, the sites have one component of displacement, and the
// interface acts on them at their lateral rest positions.
//
// The rigid top plane is clamped sideways. Along z (constraint.hpp) its displacement is held, or
// the plane is free under a load: then it follows the mean height of the layer, and the uniform
// normal wave costs nothing. If the mean height is held, the uniform wave is fixed, and only the
// other waves relax.
//
// The displacement of the layer is kept both at the sites, for the interface, and as waves, for the
// elasticity, in slabs of rows and ranges of columns over the ranks (waves.hpp). Minimisers use
// this class; paths, which set the constraint and advance time, use spectral_block.hpp.
#pragma once

#include "decomposition/communicator.hpp"
#include "decomposition/field.hpp"
#include "decomposition/surface_transform.hpp"
#include "engine/waves/block_memory.hpp"
#include "engine/waves/constraint.hpp"
#include "engine/waves/moving_pattern.hpp"
#include "engine/waves/stiffness_table.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <type_traits>
#include <vector>

namespace asperity {

/// Force that holds the uniform normal wave, linear in the mean height of the layer.
struct Holder {
    double stiffness = 0.0; ///< eV/Å^2 per site; zero under a load
    double at = 0.0;        ///< mean height at which the stiffness gives no force, Å
    double force = 0.0;     ///< part of a load or of branches, eV/Å per site
    /// Returns the elastic force per site against this mean height, eV/Å.
    double operator()(double mean_height) const { return stiffness * (mean_height - at) + force; }
};

/// The block at rest, as minimisers use it.
class Response {
public:
    const BlockOptions& options() const { return options_; }
    const Slab& slab() const { return slab_; }
    Tile tile() const { return slab_.tile(); }
    const Communicator& communicator() const { return slab_.ranks; }
    /// Returns the number of components of the displacement: three, or one without friction, the
    /// normal one.
    int components() const { return components_; }
    /// Returns the prescribed quantity and its value.
    const Constraint& constraint() const { return constraint_; }
    /// Returns zero waves with the components of the displacement.
    template <class T>
    Waves<T> new_waves() const {
        return Waves<T>(slab_, components_, workspace());
    }
    /// Returns a zero field of the sites with the components of the displacement.
    template <class T>
    SiteField<T> new_field() const {
        return site_field<T>(slab_, components_, workspace());
    }
    /// Returns a zero field of one number for each site.
    template <class T>
    Field<T> new_map() const {
        return Field<T>(tile(), 1, 0, workspace());
    }
    /// Returns the workspace of the arrays of the functions above and of relaxations. Its arrays
    /// must not outlive the block.
    Workspace* workspace() const { return workspace_.get(); }
    /// Returns the Fourier transform between sites and waves, in double or single precision.
    template <class T>
    const SurfaceTransform<T>& transform() const {
        if constexpr (std::is_same_v<T, double>)
            return transform_;
        else
            return single_;
    }

    /// Returns the displacement at the sites, Å.
    VectorPlane<const double> lowest_layer() const { return layer_.plane(0); }
    /// Returns the forces of the interface on the sites, eV/Å, to which the interface writes.
    VectorPlane<double> interface_force() { return force_.plane(0); }
    VectorPlane<const double> interface_force() const { return force_.plane(0); }
    /// Returns the moving component c (0 <= c < components()) of the displacement, Å, for writing;
    /// apply_constraint() then updates the waves.
    PlaneView<double> moving_layer(int c) { return moving(layer_.plane(0), c); }

    /// Sets g to the gradient of the energy with respect to each site, as waves, eV/Å: S u - F -
    /// load, with F the forces in interface_force() and the load spread over the sites. The
    /// component of the uniform normal wave is zero if the mean height is held. Collective.
    void gradient(Waves<double>& g) const;
    /// Replaces this rank's block b of waves by (S + k)^-1 of them (preconditioner.hpp).
    using Inverse = std::function<void(int b, float* waves)>;
    /// Returns the displacements (S + k)^-1 (k u + F + load), Å: the equilibrium under the present
    /// forces if a spring of stiffness k, eV/Å^2, tied each site to its current place. The result
    /// still has to be transformed along x. Uses the displacements at the sites, not the waves.
    /// Collective.
    SiteRows<float> respond(double k, const Inverse& inverse) const;
    /// Sets f to S u + norm g for this rank's block b of waves; f may be u or g.
    template <class T>
    void stiffen(int b, const T* u, double norm, const T* g, T* f) const;
    /// Replaces a displacement, Å, by N^2 S u, eV/Å. Collective.
    template <class T>
    void stiffen(SiteField<T>& displacement) const;
    /// Replaces forces on the sites, eV/Å, by N^2 (S + k)^-1 of them, Å. Collective.
    void respond(const Inverse& inverse, SiteField<float>& forces) const;
    /// Replaces a displacement, Å, by N^2 times the elastic forces that resist it, eV/Å, including
    /// the known forces of branches, without the uniform normal wave. Collective.
    template <class T>
    void shape_forces(SiteField<T>& displacement) const;
    /// Returns the force that holds the uniform normal wave, as a function of the mean height.
    /// Collective.
    Holder holder() const;
    /// Returns the stiffness that acts on a wave of a column nx of this rank, 0 <= nx, ny <= N/2,
    /// eV/Å^2: the table's entry times the factor of branches; for the uniform normal wave the
    /// holder's stiffness.
    SurfaceMatrix acting_stiffness(int nx, int ny) const;
    /// Returns the largest stiffness that acts on the normal component of a wave other than the
    /// uniform one, eV/Å^2. Collective.
    double stiffest_wave() const;
    /// Returns the displacement of the top plane along z, Å. Collective.
    double top() const;
    /// Returns the displacement of the drive along z, Å (PlaceAndForces::drive). Collective.
    double drive() const;
    /// Returns the mean of u_z over the layer, Å. Collective.
    double mean_height() const;
    /// Returns the mean of u_z over the box, Å: the first N x N sites of the grid. Collective.
    double mean_height_of_box() const;
    /// Returns the elastic force on the top plane along z, eV/Å; a load presses down. Collective.
    double top_force() const;
    /// Returns the energies of the block at its present displacements, with those of its memories
    /// and of the stretch under a load, eV. Collective.
    StepEnergies energies() const;
    /// Returns what the block remembers beside its displacements.
    const std::vector<std::unique_ptr<Memory>>& memories() const { return memories_; }
    /// Adds a memory that is no part of the block, as that of its surface.
    void add_memory(std::unique_ptr<Memory> memory) { memories_.push_back(std::move(memory)); }

    /// Adds t d to the displacement. d: the same field as waves and at the sites, Å.
    void displace(double t, const Waves<float>& d, const SiteField<float>& at_sites);
    /// Shifts the displacements by (x, y), Å, with a Fourier shift: each site takes the
    /// displacement at (x, y) from it, so that the pattern keeps its place over a substrate under
    /// which the block has moved by (x, y). apply_constraint() then updates the waves. Collective.
    void shift_displacements(double x, double y);
    /// Shifts all sites along z to a held mean height, after moving_layer() was written.
    /// Collective.
    void restore_mean_height();
    /// Recomputes the waves from the sites and restores a held mean height. Called after the sites
    /// were written, or after many calls of displace(), whose rounding in single precision leaves a
    /// relative difference of 1e-7 between sites and waves. Collective.
    void apply_constraint();
    /// Recomputes the waves from the sites. Collective.
    void transform_sites();

protected:
    Response(const BlockOptions& options, const Communicator& communicator, bool frictionless);
    ~Response() = default;

    /// Returns the stiffness of the whole block under uniform stretch, eV/Å.
    double stretch_stiffness() const {
        return factor_ * table_.uniform() * slab_.sites * slab_.sites;
    }
    /// Returns the stiffness of the uniform normal wave against the drive, eV/Å^2 per site: block
    /// and machine in series.
    double held_stiffness() const;
    /// Returns the displacements of the sites relative to the top plane, Å.
    SiteField<double> from_top() const;
    /// Multiplies block b of waves by the factors of the waves 0 .. N-1 along an axis.
    template <class T, class Factor>
    void scale_waves(int b, int axis, const std::vector<Factor>& factors, T* waves) const;
    /// Replaces f by S f with the stiffness of the relaxed springs, including the holder.
    void stiffen_relaxed(Waves<double>& f) const;
    /// Returns sum_r u.(S u) with the stiffness of the relaxed springs, eV. Collective.
    double twice_energy(const SiteField<double>& u) const;
    /// Returns sum_r |a.(S b)| with the stiffness of the relaxed springs, eV: an upper bound of the
    /// energy a.(S b). Collective.
    double local_products(const SiteField<double>& a, const SiteField<double>& b) const;
    template <class T>
    PlaneView<T> moving(const VectorPlane<T>& field, int component) const {
        const PlaneView<T> all[3] = {field.x, field.y, field.z};
        return all[component + 3 - components_];
    }
    std::vector<PlaneView<const double>> moving_planes(const VectorField<double>& field) const {
        std::vector<PlaneView<const double>> planes;
        planes.reserve(static_cast<std::size_t>(components_));
        for (int c = 0; c < components_; ++c)
            planes.push_back(moving(field.plane(0), c));
        return planes;
    }

    std::unique_ptr<Workspace> workspace_ = std::make_unique<Workspace>();
    BlockOptions options_;
    Slab slab_;
    int components_;
    StiffnessTable table_;
    Constraint constraint_;
    VectorField<double> layer_, force_;
    Waves<double> waves_;
    std::vector<std::unique_ptr<Memory>> memories_;
    BlockMemory* branches_ = nullptr; ///< memory of the branches; nullptr: an elastic block
    /// Force of the branches at the start of the step, with reversed sign, eV/Å; empty if none
    /// acts.
    std::optional<Waves<double>> memory_force_;
    double factor_ = 1.0; ///< factor of branches on all of S
    /// Factors of branches on S for each wave, of a moving pattern; factor_ is then 1.
    std::optional<MovingPattern> pattern_;

private:
    /// Transforms a field to waves (N^2 u_q), calls change(b, waves) for each block b of waves, and
    /// transforms back.
    template <class T, class Change>
    void change_waves(SiteField<T>& field, const Change& change) const;
    /// Sets f to factor S u + norm g for block b. uniform: stiffness of the uniform normal wave,
    /// eV/Å^2.
    template <class T>
    void stiffen(int b, double factor, double uniform, const T* u, double norm, const T* g,
                 T* f) const;

    SurfaceTransform<double> transform_;
    SurfaceTransform<float> single_;
};

} // namespace asperity
