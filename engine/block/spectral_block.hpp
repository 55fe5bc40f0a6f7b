// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The elastic block without its inside (docs/explanation/model.md).
//
// All that is left of a lattice of `thickness` layers whose inside is at rest is its lowest layer
// and the stiffness S(q) that the rest gives to it, one 3 x 3 matrix a wave
// (kernels/surface_stiffness.hpp):
//
//     U_el = 1/2 sum_r u.(S u),      force on the layer = -S u,      S u by Fourier transform.
//
// No depth is discretised, so this is the lattice's static answer to the last digit, at the cost of
// a surface. There is no inertia in it: it serves relaxation and quasi-static paths only.
//
// Frictionless (scene: interface.frictionless), the substrate takes no lateral traction: what is
// left of each matrix is its answer to normal forces, 1 / (S^-1)_zz, one number a wave and one
// component of displacement. Lateral displacements of the layer are then not followed, and the
// interface acts on its sites where they stood.
//
// The rigid top plane is clamped sideways. Along z (constraint.hpp) its displacement is prescribed,
// or it is free under a load: then it follows the mean height of the layer, and the uniform normal
// wave costs nothing. Or that mean height is prescribed: then there is no force along the uniform
// wave, which stays as it is, and the other waves are all that moves.
//
// With branches (block_memory.hpp) the block relaxes in time. During a step it is as stiff as these
// make it, and their known force is a part of the block's; without them nothing of this is called.
//
// The displacement of the layer is kept both at the sites (for the interface) and as waves (for
// everything else), in slabs of rows and ranges of columns over the ranks (waves.hpp); displace()
// changes both. What says so is collective.
#pragma once

#include "decomposition/communicator.hpp"
#include "decomposition/field.hpp"
#include "decomposition/surface_transform.hpp"
#include "engine/block/block_memory.hpp"
#include "engine/block/constraint.hpp"
#include "kernels/surface_stiffness.hpp"

#include <limits>
#include <optional>
#include <type_traits>
#include <vector>

namespace asperity {

class Preconditioner;

class SpectralBlock {
public:
    /// Collective. Throws std::invalid_argument where there are more ranks than slabs.
    SpectralBlock(const BlockOptions& options, const Communicator& communicator,
                  bool frictionless = false);

    const BlockOptions& options() const { return options_; }
    const Slab& slab() const { return slab_; }
    Tile tile() const { return slab_.tile(); }
    const Communicator& communicator() const { return slab_.ranks; }
    /// Of the displacement: three, or the normal one alone where there is no friction.
    int components() const { return components_; }
    template <class T>
    Waves<T> new_waves() const {
        return Waves<T>(slab_, components_);
    }
    template <class T>
    SiteField<T> new_field() const {
        return site_field<T>(slab_, components_);
    }

    VectorPlane<const double> lowest_layer() const { return layer_.plane(0); }
    /// The displacement at the sites, to be written from outside; apply_constraint() makes the
    /// waves follow.
    VectorField<double>& layer() { return layer_; }
    VectorPlane<double> interface_force() { return force_.plane(0); }
    VectorPlane<const double> interface_force() const { return force_.plane(0); }

    /// The whole block displaced by (0, 0, z).
    void set_uniform(double z);
    /// What is prescribed from now on (at first, no load); apply_constraint() brings the block
    /// there.
    void constrain(const Constraint& constraint);
    const Constraint& constraint() const { return constraint_; }
    /// Displacement of the top plane along z, Å. Collective, as are the next two.
    double top() const;
    /// Mean of u_z over the layer, Å.
    double mean_height() const;
    /// Elastic force on the top plane along z, eV/Å.
    double top_force() const;

    /// Gradient of the energy with respect to each site, as waves: S u - F - load, with F what
    /// interface_force() holds and the load spread over the top plane. None along a prescribed mean
    /// height. Collective.
    void gradient(Waves<double>& g) const;
    /// f <- S u + norm g for block b of waves; f may be u or g.
    template <class T>
    void stiffen(int b, const T* u, double norm, const T* g, T* f) const;
    /// f <- S f
    template <class T>
    void stiffen(Waves<T>& f) const {
#pragma omp parallel for schedule(static)
        for (int b = 0; b < f.blocks(); ++b)
            stiffen<T>(b, f.block(b), 0.0, nullptr, f.block(b));
    }
    /// U_el, eV; that of branches apart. Collective.
    double elastic_energy() const;

    /// Begins a time step of dt (fs) of the branches from the current displacements and constraint;
    /// infinite: the block is the relaxed one, and remembers nothing. last: length of the step that
    /// this one continues, fs; infinite: it continues none. Does nothing without branches.
    /// Collective.
    void begin_step(double dt, double last = std::numeric_limits<double>::infinity());
    /// It ends with the state as it is.
    void end_step();
    /// Of branches, in the state as it is. Collective.
    BranchEnergies branch_energies() const;
    /// S times what they remember, as waves, eV/Å: their known force is minus that, in the step
    /// under way; null without branches.
    const Waves<double>* known() const { return known_ ? &*known_ : nullptr; }
    /// Of its uniform wave, for each site. Collective.
    double uniform_known() const;
    /// What branches remember, to be kept and restored; null without.
    std::vector<SiteField<double>>* memory() { return memory_ ? &memory_->extensions() : nullptr; }
    const std::vector<SiteField<double>>* memory() const {
        return memory_ ? &memory_->extensions() : nullptr;
    }
    /// What the next step needs of the last one, to be kept and restored; null without branches.
    std::vector<SiteField<double>>* history() { return memory_ ? &memory_->history() : nullptr; }

    /// Where the sites would come to rest under the forces of gradient(), did a spring k tie each
    /// to where it is: (S + k)^-1 (k u + F + load), whose rows transform<float>().get_rows() then
    /// has. The waves of the displacement are not looked at. Collective.
    void respond(const Preconditioner& preconditioner) const;
    /// Between the sites and their waves.
    template <class T>
    const SurfaceTransform<T>& transform() const {
        if constexpr (std::is_same_v<T, double>)
            return transform_;
        else
            return single_;
    }

    /// The field of some waves. Collective.
    template <class From, class T>
    void at_sites(const Waves<From>& waves, SiteField<T>& field) const;
    /// The waves of a field, times a factor N^2. Collective.
    template <class T>
    void to_waves(const SiteField<T>& field, Waves<T>& waves) const;
    /// u <- u + t d, given both as waves and at the sites.
    void displace(double t, const Waves<float>& d, const SiteField<float>& at_sites);
    /// Component c of those that move, at the sites, to be moved from outside (apply_constraint()
    /// as above).
    PlaneView<double> moving_layer(int c) { return moving(layer_.plane(0), c); }
    /// Puts the sites, moved from outside, back to a prescribed mean height. Collective.
    void restore_mean_height();
    /// Makes the waves those of the sites: after these were moved from outside, or after many
    /// displacements, which in single precision leave 1e-7 of what has been moved between them. A
    /// prescribed mean height is then what it should be. Collective.
    void apply_constraint();
    /// The same under another constraint.
    void apply_constraint(const Constraint& constraint) {
        constrain(constraint);
        apply_constraint();
    }

    /// S at q = 2 pi (nx, ny) / (N a), 0 <= nx, ny <= N/2. Frictionless: its one number, as zz.
    SurfaceMatrix stiffness(int nx, int ny) const;
    /// Of the table of stiffness, which each rank has whole.
    std::size_t table_bytes() const { return table_.size() * (sizeof(double) + sizeof(float)); }
    std::size_t bytes() const;

private:
    /// Of the whole block under uniform stretch, eV/Å.
    double spring() const { return uniform_ * options_.sites * options_.sites; }
    /// The displacement from the top plane at the sites.
    SiteField<double> from_top() const;
    /// u.(S u) with the stiffness of the step.
    double square(const SiteField<double>& u) const;
    /// Of the whole table.
    std::size_t entry(int e, int nx, int ny) const;
    /// The components that move of a field of three.
    template <class T>
    PlaneView<T> moving(const VectorPlane<T>& field, int component) const {
        const PlaneView<T> all[3] = {field.x, field.y, field.z};
        return all[component + 3 - components_];
    }
    std::vector<PlaneView<const double>> moving_planes(const VectorField<double>& field) const {
        std::vector<PlaneView<const double>> planes;
        for (int c = 0; c < components_; ++c)
            planes.push_back(moving(field.plane(0), c));
        return planes;
    }

    BlockOptions options_;
    Slab slab_;
    int components_ = 3;
    /// S of the quadrant, eV/Å^2: of each block of all waves as in kernels/surface_rows.hpp.
    std::vector<double> table_;
    std::vector<float> single_table_; ///< the same
    double uniform_ = 0.0;            ///< S_zz of the uniform wave under a prescribed top, eV/Å^2
    Constraint constraint_;
    VectorField<double> layer_, force_;
    Waves<double> waves_;
    std::optional<BlockMemory> memory_;  ///< with branches
    std::vector<double> relaxed_;        ///< with branches: the table at rest
    std::optional<Waves<double>> known_; ///< with branches: S times what they remember, eV/Å
    SurfaceTransform<double> transform_;
    SurfaceTransform<float> single_;
};

/// (S + k)^-1, in single precision, of a block under its constraint: k > 0, eV/Å^2, stands for the
/// interface's stiffness of a site. Zero for the uniform wave of a prescribed mean height.
class Preconditioner {
public:
    Preconditioner(const SpectralBlock& block, double k);
    /// With another k.
    void tune(const SpectralBlock& block, double k);
    double k() const { return k_; }
    /// to <- (S + k)^-1 from + keep to, of block b; the two may be the same.
    void apply(int b, const float* from, double keep, float* to) const;

private:
    int sites_, first_, components_;
    std::vector<float> table_; ///< like the block's
    double k_ = 0.0;
};

} // namespace asperity
