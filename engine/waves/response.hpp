// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The elastic block at rest, as its surface answers (docs/explanation/model.md).
//
// All that is left of a lattice of `thickness` layers whose inside is at rest is its lowest layer
// and the stiffness S(q) that the rest gives to it, one 3 x 3 matrix for each wave
// (kernels/surface_stiffness.hpp):
//
//     U_el = 1/2 sum_r u.(S u),      force on the layer = -S u,      S u by Fourier transform.
//
// No depth is discretised, so this is the lattice's static answer to the last digit, at the cost of
// a surface. It has no inertia: it serves relaxations and quasi-static paths.
//
// The stiffness is composed, and no term is written into another:
//
//     the table S(q)     the lattice's, a constant of the block (stiffness_table.hpp)
//     the holder         the uniform normal wave against the rigid top plane, if that is held, in
//                        series with the spring of the machine
//     the branches       a factor on all of S in a step of a viscoelastic block, and a force that
//                        is known at its start (block_memory.hpp); or a factor for each wave, as
//                        long as a shape is sought that slides on unchanged (moving_pattern.hpp)
//
// Without friction (scene: interface.frictionless) the substrate takes no lateral traction: S is
// one number for each wave, 1 / (S^-1)_zz, the sites have one component of displacement, and the
// interface acts on them where they stood laterally.
//
// The rigid top plane is clamped sideways. Along z (constraint.hpp) its displacement is held, or
// the plane is free under a load: then it follows the mean height of the layer, and the uniform
// normal wave costs nothing. Or that mean height is held: then the uniform wave stays as it is
// without a force, and the other waves are all that moves.
//
// The displacement of the layer is kept both at the sites, for the interface, and as waves, for all
// else, in slabs of rows and ranges of columns over the ranks (waves.hpp). Minimisers see this
// class; what is held, and time, belong to the path (spectral_block.hpp).
#pragma once

#include "decomposition/communicator.hpp"
#include "decomposition/field.hpp"
#include "decomposition/surface_transform.hpp"
#include "engine/step_record.hpp"
#include "engine/waves/block_memory.hpp"
#include "engine/waves/constraint.hpp"
#include "engine/waves/moving_pattern.hpp"
#include "engine/waves/stiffness_table.hpp"

#include <memory>
#include <optional>
#include <type_traits>
#include <vector>

namespace asperity {

class Preconditioner;

/// Holder of the uniform normal wave: the elastic force on each site, eV/Å, is linear in the mean
/// height of the layer.
struct Holder {
    double stiffness = 0.0; ///< eV/Å^2 for each site; zero under a load
    double at = 0.0;        ///< mean height at which the stiffness gives no force, Å
    double force = 0.0;     ///< part of a load or of branches, eV/Å for each site
    double operator()(double mean_height) const { return stiffness * (mean_height - at) + force; }
};

/// Energies of the block at rest, eV: of its springs, what a load stretches it by included, of its
/// branches and of the spring that holds its top plane.
struct BlockEnergies : Energies {
    BranchEnergies branches{};
};

class Response {
public:
    const BlockOptions& options() const { return options_; }
    const Slab& slab() const { return slab_; }
    Tile tile() const { return slab_.tile(); }
    const Communicator& communicator() const { return slab_.ranks; }
    /// Returns the number of components of the displacement: three, or one without friction, the
    /// normal one.
    int components() const { return components_; }
    /// Returns what is held.
    const Constraint& constraint() const { return constraint_; }
    template <class T>
    Waves<T> new_waves() const {
        return Waves<T>(slab_, components_, workspace());
    }
    template <class T>
    SiteField<T> new_field() const {
        return site_field<T>(slab_, components_, workspace());
    }
    /// Returns one number for each site, zeros at first.
    template <class T>
    Field<T> new_map() const {
        return Field<T>(tile(), 1, 0, workspace());
    }
    /// Returns the memory from which the functions above, and relaxations, make their arrays. The
    /// arrays must not outlive the block.
    Workspace* workspace() const { return workspace_.get(); }
    template <class T>
    const SurfaceTransform<T>& transform() const {
        if constexpr (std::is_same_v<T, double>)
            return transform_;
        else
            return single_;
    }

    /// Returns the displacement at the sites, Å.
    VectorPlane<const double> lowest_layer() const { return layer_.plane(0); }
    /// Returns the forces of the interface on the sites, eV/Å, which the interface writes.
    VectorPlane<double> interface_force() { return force_.plane(0); }
    VectorPlane<const double> interface_force() const { return force_.plane(0); }
    /// Returns component c of the displacement, Å, counted among those that move, to be written;
    /// the waves follow in apply_constraint().
    PlaneView<double> moving_layer(int c) { return moving(layer_.plane(0), c); }

    /// Sets g to the gradient of the energy with respect to each site, as waves, eV/Å: S u - F -
    /// load, with F the forces in interface_force() and the load spread over the top plane. The
    /// uniform normal wave of a held mean height has none. Collective.
    void gradient(Waves<double>& g) const;
    /// Returns the displacements (S + k)^-1 (k u + F + load), Å, as rows that are still to be
    /// transformed along x: the equilibrium if a spring of stiffness k tied each site to its
    /// current place. The waves of the displacement are not read. Collective.
    SiteRows<float> respond(const Preconditioner& preconditioner) const;
    /// Sets f to S u + norm g for this rank's block b of waves; f may be u or g.
    template <class T>
    void stiffen(int b, const T* u, double norm, const T* g, T* f) const;
    /// Replaces a displacement, Å, by N^2 S u, eV/Å. Collective.
    template <class T>
    void stiffen(SiteField<T>& displacement) const;
    /// Replaces a displacement, Å, by N^2 times the elastic forces against it, eV/Å, with the known
    /// forces of branches and without the uniform normal wave. Collective.
    template <class T>
    void shape_forces(SiteField<T>& displacement) const;
    /// Returns what holds the uniform normal wave. Collective.
    Holder holder() const;
    /// Returns the stiffness that acts on a wave, 0 <= nx, ny <= N/2, eV/Å^2: that of the table,
    /// times the factor of branches, with the holder's stiffness for the uniform normal wave.
    SurfaceMatrix acting_stiffness(int nx, int ny) const;
    /// Returns the largest stiffness that acts on the normal component of a wave, eV/Å^2.
    double stiffest_wave() const;
    /// Returns the displacement of the top plane along z, Å. Collective.
    double top() const;
    /// Returns the displacement of the drive along z, Å: of the top plane, or of the far end of the
    /// spring that holds it. Collective.
    double drive() const;
    /// Returns the mean of u_z over the layer, Å. Collective.
    double mean_height() const;
    /// Returns the mean of u_z over the box, Å: with free edges over the sites above the substrate.
    /// Collective.
    double mean_height_of_box() const;
    /// Returns the elastic force on the top plane along z, eV/Å; a load presses down. Collective.
    double top_force() const;
    /// Returns the energies of the block as it is. Collective.
    BlockEnergies energies() const;

    /// Adds t d to the displacement; d is given both as waves and at the sites, Å.
    void displace(double t, const Waves<float>& d, const SiteField<float>& at_sites);
    /// Replaces the displacements by those at (x, y) from each site, Å, by a Fourier shift: they
    /// then stand as they did over a substrate under which the block was moved by this. The waves
    /// follow in apply_constraint(). Collective.
    void shift_displacements(double x, double y);
    /// Shifts the sites along z, after they were moved through moving_layer(), to a held mean
    /// height. Collective.
    void restore_mean_height();
    /// Makes the waves those of the sites, and a held mean height what it should be: after the
    /// sites were moved, or after many displacements, which in single precision leave 1e-7 of what
    /// has been moved between the two. Collective.
    void apply_constraint();

protected:
    Response(const BlockOptions& options, const Communicator& communicator, bool frictionless);
    ~Response() = default;

    /// Returns the stiffness of the whole block under uniform stretch, eV/Å.
    double spring() const { return factor_ * table_.uniform() * slab_.sites * slab_.sites; }
    /// Returns the stiffness of the uniform normal wave against the drive, eV/Å^2 for each site:
    /// the block's, in series with the machine's.
    double held_stiffness() const;
    /// Returns the displacement from the top plane at the sites, Å.
    SiteField<double> from_top() const;
    /// Multiplies block b of waves by the factors of the waves 0 .. N-1 along an axis.
    template <class T, class Factor>
    void scale_waves(int b, int axis, const std::vector<Factor>& factors, T* waves) const;
    /// Sets f to S f with the stiffness of the relaxed springs, the holder included.
    void stiffen_relaxed(Waves<double>& f) const;
    /// Returns sum_r u.(S u) with the stiffness of the relaxed springs, eV. Collective.
    double twice_energy(const SiteField<double>& u) const;
    /// Returns sum_r |a.(S b)| with the stiffness of the relaxed springs, eV: no less than the
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
    std::optional<BlockMemory> memory_; ///< memory of the branches; empty: an elastic block
    /// Force of the branches at the start of the step, with its sign reversed, eV/Å; empty: none
    std::optional<Waves<double>> memory_force_;
    double factor_ = 1.0; ///< factor of branches on S
    /// Factors of branches on S, wave by wave, instead; factor_ is then 1.
    std::optional<MovingPattern> pattern_;

private:
    /// Replaces a field by what change(b, waves) makes of the N^2 u_q of each block b.
    template <class T, class Change>
    void change_waves(SiteField<T>& field, const Change& change) const;
    /// Sets f to factor S u + norm g for block b; uniform: stiffness of the uniform normal wave
    /// against what is held, eV/Å^2.
    template <class T>
    void stiffen(int b, double factor, double uniform, const T* u, double norm, const T* g,
                 T* f) const;

    SurfaceTransform<double> transform_;
    SurfaceTransform<float> single_;
};

} // namespace asperity
