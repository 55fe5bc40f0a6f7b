// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "support/elastic_operator.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

namespace asperity::test {

double dot(const Vector& a, const Vector& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += a[i] * b[i];
    return sum;
}

Vector random_vector(std::size_t size, unsigned seed) {
    std::mt19937_64 random(seed);
    Vector v(size);
    for (double& x : v)
        x = static_cast<double>(random() >> 11) * 0x1p-52 - 1.0;
    return v;
}

template <class Visit>
void ElasticOperator::each(const Visit& visit) const {
    std::size_t i = 0;
    for (std::size_t l = 0; l < block_.levels().size(); ++l) {
        const auto& level = block_.levels()[l];
        for (int c = 0; c < 3; ++c)
            for (int z = 0; z < level.shape.cells; ++z)
                for (int y = 0; y < level.tile.ny; ++y)
                    for (int x = 0; x < level.tile.nx; ++x)
                        visit(i++, l, c, z, y, x);
    }
}

ElasticOperator::ElasticOperator(const BlockOptions& options)
    : block_(options, Communicator(),
             ProcessGrid(1, 0, options.sites, static_cast<int>(level_shapes(options).size()))) {
    for (const auto& level : block_.levels()) {
        force_.emplace_back(level.tile, level.shape.cells);
        size_ += 3 * static_cast<std::size_t>(level.shape.cells) *
                 static_cast<std::size_t>(level.tile.nx) * static_cast<std::size_t>(level.tile.ny);
    }
    block_.set_uniform(0.0, 0.0);
}

void ElasticOperator::set(const Vector& u, double top) {
    each([&](std::size_t i, std::size_t l, int c, int z, int y, int x) {
        auto& field = block_.fields(block_.levels()[l]).u;
        (c == 0 ? field.x : c == 1 ? field.y : field.z).view()(x, y, z) = u[i];
    });
    block_.set_top(top);
    block_.exchange();
    block_.interpolate();
}

Vector ElasticOperator::force() {
    // Nothing was ever put into the transferred forces of the lowest layer.
    block_.forces(force_);
    Vector f(size_);
    each([&](std::size_t i, std::size_t l, int c, int z, int y, int x) {
        const auto& field = force_[l];
        f[i] = (c == 0 ? field.x : c == 1 ? field.y : field.z).view()(x, y, z);
    });
    return f;
}

double ElasticOperator::energy() const {
    ExactSum sum;
    block_.add_elastic_energy(sum);
    return sum.value();
}

std::array<double, 3> ElasticOperator::top_force() {
    ExactSum normal;
    block_.add_top_force(normal);
    const auto plane = std::as_const(block_.levels().back().upper_force).plane(0);
    std::array<double, 3> sum{};
    for (int y = 0; y < plane.x.ny; ++y)
        for (int x = 0; x < plane.x.nx; ++x) {
            sum[0] += plane.x(x, y);
            sum[1] += plane.y(x, y);
        }
    sum[2] = normal.value();
    return sum;
}

Vector ElasticOperator::tabulate(
    const std::function<double(const Block::Level&, int, int, int, int)>& value) const {
    Vector v(size_);
    each([&](std::size_t i, std::size_t l, int c, int z, int y, int x) {
        v[i] = value(block_.levels()[l], c, z, y, x);
    });
    return v;
}

StaticResponse press(ElasticOperator& k, const std::function<double(int, int)>& w,
                     double tolerance) {
    const auto held = [](const Block::Level& level, int c, int z) {
        return level.shape.level == 0 && c == 2 && z == 0;
    };
    // 1/2^l on free nodes (stiffness grows like 2^l), 0 on held ones: preconditioner and projector
    // at once.
    const Vector free = k.tabulate([&](const Block::Level& level, int c, int z, int, int) {
        return held(level, c, z) ? 0.0 : 1.0 / (1 << level.shape.level);
    });
    // A first guess that fades linearly: halves the iterations.
    const double thickness = k.block().options().thickness;
    const double a = k.block().options().spacing;
    Vector u = k.tabulate([&](const Block::Level& level, int c, int z, int y, int x) {
        if (c != 2) return 0.0;
        const int scale = 1 << level.shape.level;
        const double depth = level.depth + static_cast<double>(z * scale);
        if (held(level, c, z)) return w(x, y);
        return w(x * scale, y * scale) * (1.0 - depth / thickness);
    });

    k.set(u);
    Vector r = k.force(), p(u.size()), z(u.size());
    const double reaction = std::abs(*std::max_element(
        r.begin(), r.end(), [](double s, double t) { return std::abs(s) < std::abs(t); }));
    StaticResponse response;
    double old = 0.0;
    for (;; ++response.iterations) {
        response.residual = 0.0;
        for (std::size_t i = 0; i < r.size(); ++i) {
            z[i] = free[i] * r[i];
            if (free[i] != 0.0)
                response.residual = std::max(response.residual, std::abs(r[i]) / reaction);
        }
        if (response.residual < tolerance || response.iterations > 5000) break;
        const double now = dot(r, z);
        for (std::size_t i = 0; i < p.size(); ++i)
            p[i] = z[i] + (response.iterations ? now / old : 0.0) * p[i];
        old = now;
        k.set(p);
        const Vector f = k.force();
        const double step = -now / dot(p, f);
        for (std::size_t i = 0; i < u.size(); ++i)
            u[i] += step * p[i], r[i] += step * f[i];
    }
    k.set(u);
    const Vector f = k.force();
    double squares = 0.0;
    const int sites = k.block().options().sites;
    for (int y = 0; y < sites; ++y)
        for (int x = 0; x < sites; ++x)
            squares += w(x, y) * w(x, y);
    response.stiffness = -dot(u, f) / squares / (a * a);
    return response;
}

} // namespace asperity::test
