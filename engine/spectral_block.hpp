// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The elastic block without its inside (model.md section 5, "spectral").
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
// The rigid top plane is clamped sideways. Along z it is held at `top` (its displacement), or free:
// then it follows the mean height of the layer, the uniform normal wave costs nothing, and no force
// is on it.
//
// The displacement of the layer is kept both at the sites (for the interface) and as waves (for
// everything else); displace() changes both.
#pragma once

#include "decomposition/communicator.hpp"
#include "decomposition/field.hpp"
#include "engine/block.hpp"
#include "engine/waves.hpp"
#include "kernels/surface_stiffness.hpp"

#include <vector>

namespace asperity {

class SpectralBlock {
public:
    /// Throws std::invalid_argument where there is more than one rank: its transforms are of one.
    SpectralBlock(const BlockOptions& options, const Communicator& communicator);

    const BlockOptions& options() const { return options_; }
    const Tile& tile() const { return tile_; }
    const Communicator& communicator() const { return communicator_; }

    VectorPlane<const double> lowest_layer() const { return layer_.plane(0); }
    /// The displacement at the sites, to be written from outside; settle() makes the waves follow.
    VectorField<double>& layer() { return layer_; }
    VectorPlane<double> interface_force() { return force_.plane(0); }
    VectorPlane<const double> interface_force() const { return force_.plane(0); }

    /// The whole block displaced by (0, 0, z).
    void set_uniform(double z);
    /// The top plane's displacement along z, Å; it is held there.
    void hold_top(double z);
    /// From now on the top plane follows the layer.
    void free_top();
    bool top_is_free() const { return top_free_; }
    double top() const { return top_free_ ? mean_height() : top_; }
    /// Mean of u_z over the layer, Å.
    double mean_height() const { return waves_.row(2, 0)[0]; }
    /// Elastic force on the held top plane along z, eV/Å (zero on a free one).
    double top_force() const;

    /// Gradient of the energy with respect to each site, as waves: S u - F - load, with F what
    /// interface_force() holds and the load (eV/Å, pressing down) spread over the top plane.
    void gradient(double load, Waves<double>& g) const;
    /// x <- (S + k)^-1 x: k > 0, eV/Å^2, stands for the interface's stiffness of a site.
    template <class T>
    void precondition(double k, Waves<T>& x) const;
    /// y <- S x + norm y: the elastic part of a product with the Hessian.
    template <class T>
    void add_stiffness(const Waves<T>& x, double norm, Waves<T>& y) const;
    /// U_el, eV
    double elastic_energy() const;

    /// The field of some waves at the sites; the waves are kept (through a scratch copy).
    void at_sites(const Waves<double>& waves, VectorField<double>& field);
    void to_waves(const VectorField<double>& field, Waves<double>& waves) const;
    VectorField<double> new_field() const { return VectorField<double>(tile_, 1, 0); }
    /// u <- u + t d, given both as waves and at the sites.
    void displace(double t, const Waves<double>& d, const VectorField<double>& d_at_sites);
    /// The waves of what is at the sites: after many displacements, or a state from outside.
    void settle();

    /// S at q = 2 pi (nx, ny) / (N a), 0 <= nx, ny <= N/2.
    SurfaceMatrix stiffness(int nx, int ny) const;
    std::size_t bytes() const;

private:
    double* table(int entry, int ny) {
        return table_.data() +
               (static_cast<std::size_t>(entry) * columns_ + static_cast<std::size_t>(ny)) *
                   columns_;
    }
    const double* table(int entry, int ny) const {
        return table_.data() +
               (static_cast<std::size_t>(entry) * columns_ + static_cast<std::size_t>(ny)) *
                   columns_;
    }
    template <class Work>
    void each_row(const Work& work) const;

    BlockOptions options_;
    Communicator communicator_;
    Tile tile_;
    std::size_t columns_ = 0;
    std::vector<double> table_; ///< S of the quadrant: [xx yy zz xy xz yz][ny][nx], eV/Å^2
    double uniform_ = 0.0;      ///< S_zz of the uniform wave with the top held, eV/Å^2
    double top_ = 0.0;
    bool top_free_ = true;
    VectorField<double> layer_, force_;
    Waves<double> waves_, scratch_;
    SurfaceTransform<double> transform_;
};

} // namespace asperity
