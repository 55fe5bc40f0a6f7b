// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/options/block_options.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

namespace asperity {

namespace {

/// Returns the modulus of two springs in series; of one, if the other is rigid.
double in_series(double one, std::optional<double> other) {
    return other ? one * *other / (one + *other) : one;
}

} // namespace

double Solid::stiffest_modulus() const {
    double modulus = 0.0;
    for (const Material& material : materials())
        modulus = std::max(modulus, material.contact_modulus());
    return modulus;
}

int BlockOptions::grid() const {
    if (!free_edges) return sites;
    const auto is_fast = [](int n) {
        for (const int factor : {2, 3, 5, 7})
            while (n % factor == 0)
                n /= factor;
        return n == 1;
    };
    int grid = 2 * sites;
    while (!is_fast(grid))
        grid += 2;
    return grid;
}

double BlockOptions::contact_modulus() const {
    return in_series(Solid::contact_modulus(),
                     counter ? std::optional(counter->contact_modulus()) : std::nullopt);
}

double BlockOptions::stiffest_modulus() const {
    return in_series(Solid::stiffest_modulus(),
                     counter ? std::optional(counter->stiffest_modulus()) : std::nullopt);
}

BlockOptions BlockOptions::uncoated() const {
    BlockOptions plain = *this;
    for (Solid* solid : {static_cast<Solid*>(&plain), plain.counter ? &*plain.counter : nullptr}) {
        if (!solid) continue;
        solid->layers.clear();
        solid->surface_stress = 0.0;
    }
    return plain;
}

BlockOptions BlockOptions::counter_block() const {
    BlockOptions block = *this;
    static_cast<Solid&>(block) = *counter;
    block.counter.reset();
    block.branches.clear();
    return block;
}

double BlockOptions::shortest_wave() const {
    const auto of = [&](const Solid& solid) {
        return 0.5 * std::numbers::pi * solid.stiffest_modulus() * spacing +
               4.0 * solid.surface_stress;
    };
    double wave = in_series(of(*this), counter ? std::optional(of(*counter)) : std::nullopt);
    for (const Branch& branch : branches)
        wave *= 1.0 + branch.ratio;
    return wave;
}

double BlockOptions::sound_speed() const {
    const double density = atom_mass / (spacing * spacing * spacing);
    return std::sqrt(modulus_of_compression() / density);
}

CellElasticity BlockOptions::elasticity(int level) const { return cell(spacing * (1 << level)); }

std::vector<Material> Solid::materials() const {
    std::vector<Material> all;
    for (const MaterialLayer& layer : layers)
        all.push_back(layer.material);
    all.push_back(*this);
    return all;
}

std::vector<Material> BlockOptions::materials() const {
    std::vector<Material> all = Solid::materials();
    if (counter) std::ranges::copy(counter->materials(), std::back_inserter(all));
    return all;
}

double BlockOptions::softest_column() const {
    double softest = HUGE_VAL;
    for (const Material& m : materials())
        softest = std::min(softest, m.modulus_of_compression());
    return softest;
}

std::vector<CellLayer> BlockOptions::column() const {
    std::vector<CellLayer> column;
    const auto add = [&](const Material& material, int cells) {
        const CellElasticity elasticity = material.cell(spacing);
        if (!column.empty() && column.back().elasticity == elasticity)
            column.back().cells += cells;
        else if (cells > 0)
            column.push_back({elasticity, cells});
    };
    int left = thickness;
    for (const MaterialLayer& layer : layers) {
        const int cells = static_cast<int>(std::lround(layer.thickness / spacing));
        add(layer.material, cells);
        left -= cells;
    }
    add(*this, left);
    return column;
}

std::vector<SolidLayer> BlockOptions::solid() const {
    std::vector<SolidLayer> solid;
    double left = thickness * spacing;
    for (const MaterialLayer& layer : layers) {
        solid.push_back({layer.material.shear_modulus(), layer.material.poisson, layer.thickness});
        left -= layer.thickness;
    }
    solid.push_back({shear_modulus(), poisson, left});
    return solid;
}

SurfaceMatrix BlockOptions::stiffness(WavePhase x, WavePhase y) const {
    if (continuum) {
        const double px = std::atan2(x.sine, x.cosine), py = std::atan2(y.sine, y.cosine);
        SurfaceMatrix s = continuum_stiffness(solid(), px / spacing, py / spacing);
        for (double* entry : {&s.xx, &s.yy, &s.zz, &s.xy, &s.xz, &s.yz})
            *entry *= spacing * spacing;
        s.zz += surface_stress * (px * px + py * py);
        return s;
    }
    SurfaceMatrix s = surface_stiffness(column(), x, y);
    s.zz += surface_stress * (2.0 * (1.0 - x.cosine) + 2.0 * (1.0 - y.cosine));
    return s;
}

double BlockOptions::normal_compliance(WavePhase x, WavePhase y) const {
    const double own = inverse(stiffness(x, y)).zz;
    return counter ? own + counter_block().normal_compliance(x, y) : own;
}

double BlockOptions::softest_wave() const {
    if (layers.empty() && !(counter && !counter->layers.empty()))
        return contact_modulus() * std::numbers::pi / (grid() * spacing);
    return 1.0 / normal_compliance(wave_phase(1, grid()), wave_phase(0, grid())) /
           (spacing * spacing);
}

double BlockOptions::highest_frequency(double site_stiffness) const {
    // The largest eigenvalue of the bulk's dynamical matrix is that of a longitudinal wave, of
    // phases (pi, 0, 0) or, below a Poisson ratio of about 0.12, (t, t, t). With c = cos t it is
    // there (1 - c) (24 kappa (1 + c)^2 + k (10 + 8 c)), whose derivative vanishes at the root of
    // 72 kappa c^2 + (48 kappa + 16 k) c + 2 k - 24 kappa that is -1/8 for kappa = 0. Surfaces and
    // coarser levels have no higher one. tests/engine/block_test.cpp searches the whole zone.
    const CellElasticity e = elasticity(0);
    const double axis = 64.0 * e.kappa + 12.0 * e.k;
    const double a = 72.0 * e.kappa, b = 48.0 * e.kappa + 16.0 * e.k,
                 d = 2.0 * e.k - 24.0 * e.kappa;
    const double c = -2.0 * d / (b + std::sqrt(b * b - 4.0 * a * d));
    const double diagonal =
        (1.0 - c) * (24.0 * e.kappa * (1.0 + c) * (1.0 + c) + e.k * (10.0 + 8.0 * c));
    return std::sqrt((std::max(axis, diagonal) + site_stiffness) / atom_mass);
}

std::vector<LevelShape> level_shapes(const BlockOptions& options) {
    std::vector<LevelShape> shapes;
    int left = options.thickness, sites = options.sites;
    for (int level = 0;; ++level) {
        const int least = options.layers_per_level;
        // One cell more where the number left would not divide by two.
        const int cells = least + ((left - least) & 1);
        const bool coarsen = options.multiscale && sites % 2 == 0 && (left - cells) / 2 >= least;
        shapes.push_back({level, sites, coarsen ? cells : left});
        if (!coarsen) return shapes;
        left = (left - cells) / 2;
        sites /= 2;
    }
}

double nodes_of(const std::vector<LevelShape>& levels) {
    double nodes = 0.0;
    for (const LevelShape& l : levels)
        nodes += static_cast<double>(l.sites) * l.sites * l.cells;
    return nodes;
}

} // namespace asperity
