// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A block on one rank as a linear operator on a flat vector.
//
// The vector holds the moving nodes, in the order level, component, plane, row, column. force() is
// what the run itself does (interpolate, hand up, force) with nothing acting from below, so K =
// -dF/du of the whole stack, constrained planes eliminated. Laws of K (symmetry, gradient, modes,
// static response) then read as algebra.
#pragma once

#include "engine/block/block.hpp"

#include <array>
#include <functional>
#include <memory>
#include <vector>

namespace asperity::test {

using Vector = std::vector<double>;

double dot(const Vector& a, const Vector& b);
/// Uniform in [-1, 1], the same on every machine.
Vector random_vector(std::size_t size, unsigned seed);

class ElasticOperator {
public:
    explicit ElasticOperator(const BlockOptions& options);

    std::size_t size() const { return size_; }
    Block& block() { return block_; }

    void set(const Vector& u, double top = 0.0);
    /// Elastic force on the moving nodes at what was set.
    Vector force();
    double energy() const;
    /// Elastic force on the top plane, three components; after force().
    std::array<double, 3> top_force();
    /// One number for each degree of freedom: value(level, component, z, y, x).
    Vector
    tabulate(const std::function<double(const Block::Level&, int, int, int, int)>& value) const;

private:
    Block block_;
    std::size_t size_ = 0;
    std::vector<VectorField<double>> force_;

    template <class Visit>
    void each(const Visit& visit) const;
};

struct StaticResponse {
    double stiffness = 0.0; ///< u.F / u.u over the lowest layer per a^2, eV/Å^4
    double residual = 0.0;  ///< largest force left on a free node over the largest reaction
    int iterations = 0;
};
/// The lowest layer's normal displacement held at w(x, y), free sideways (frictionless), top
/// clamped: all other nodes relaxed by conjugate gradients.
StaticResponse press(ElasticOperator& k, const std::function<double(int, int)>& w,
                     double tolerance = 1e-7);

} // namespace asperity::test
