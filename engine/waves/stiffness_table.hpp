// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// S(q) of the waves of a surface that a rank transforms (BlockOptions::stiffness): one symmetric
// 3 x 3 matrix for each, or one number without friction. The table does not change; the stiffness
// of holder and branches is added in response.hpp.
#pragma once

#include "decomposition/waves.hpp"
#include "engine/options/block_options.hpp"
#include "kernels/surface_stiffness.hpp"

#include <cstddef>
#include <vector>

namespace asperity {

/// The layout of a table over this rank's columns of the quadrant of waves: [block][ny][entry]
/// [column], of matrices or of one number for each wave (kernels/surface_rows.hpp).
struct TableLayout {
    int sites, components; ///< N; 3, or 1 without friction
    int first_column;      ///< first column of this rank
    /// Makes the layout for the waves of a slab.
    TableLayout(const Slab& slab, int of)
        : sites(slab.sites), components(of), first_column(slab.first_column()) {}
    /// Returns the numbers of a wave.
    std::size_t entries() const { return components == 1 ? 1 : matrix_entry::count; }
    /// Returns the number of values of a block of columns.
    std::size_t block() const {
        return static_cast<std::size_t>(sites / 2 + 1) * entries() * block_columns;
    }
    std::size_t size(int blocks) const { return static_cast<std::size_t>(blocks) * block(); }
    /// Returns the index of an entry of a wave.
    std::size_t at(std::size_t entry, int nx, int ny) const {
        const int column = nx - first_column;
        return static_cast<std::size_t>(column / block_columns) * block() +
               (static_cast<std::size_t>(ny) * entries() + entry) * block_columns +
               static_cast<std::size_t>(column % block_columns);
    }
    /// Sets the matrix of a wave in a table.
    template <class T>
    void put(const SurfaceMatrix& m, int nx, int ny, std::vector<T>& table) const {
        const double values[matrix_entry::count] = {m.xx, m.yy, m.zz, m.xy, m.xz, m.yz};
        for (std::size_t e = 0; e < entries(); ++e)
            table[at(e, nx, ny)] = static_cast<T>(components == 1 ? m.zz : values[e]);
    }
};

/// Table of S(q).
class StiffnessTable {
public:
    /// Computes S of a block. Without friction the matrix of a wave is replaced by its stiffness
    /// against normal forces, 1 / (S^-1)_zz. Collective.
    StiffnessTable(const BlockOptions& options, const Slab& slab, bool frictionless);

    /// Returns S at q = 2 pi (nx, ny) / (N a), 0 <= nx, ny <= N/2, eV/Å^2, of a column nx of this
    /// rank; without friction, its one number as zz. zz of the uniform wave is zero, as for a block
    /// that is free to move along z.
    SurfaceMatrix at(int nx, int ny) const;
    /// Returns S_zz of the uniform wave of a block whose top plane is held, eV/Å^2.
    double uniform() const { return uniform_; }
    /// Sets f to S u + norm g for this rank's block b of waves; f may be u or g.
    template <class T>
    void multiply(int b, const T* u, double norm, const T* g, T* f) const;
    /// Returns the memory of this rank's part of the table, bytes.
    std::size_t bytes() const { return table_.size() * (sizeof(double) + sizeof(float)); }

private:
    TableLayout layout_;
    std::vector<double> table_; ///< eV/Å^2
    std::vector<float> single_; ///< the same numbers
    double uniform_ = 0.0;
};

} // namespace asperity
