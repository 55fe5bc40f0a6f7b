// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/waves/response.hpp"

#include "decomposition/global_sum.hpp"
#include "kernels/elastic_level.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <span>
#include <utility>

namespace asperity {

Response::Response(const BlockOptions& options, const Communicator& communicator, bool frictionless)
    : options_(options), slab_(options.grid(), communicator), components_(frictionless ? 1 : 3),
      table_(options, slab_, frictionless), layer_(tile(), 1, 0), force_(tile(), 1, 0),
      waves_(slab_, components_), transform_(slab_, components_), single_(slab_, components_) {
    if (options.branches.empty()) return;
    auto branches = std::make_unique<BlockMemory>(
        options.branches, slab_, components_, *workspace_,
        BranchedBlock{[this] { return from_top(); },
                      [this](const SiteField<double>& u) { return twice_energy(u); },
                      [this](const SiteField<double>& a, const SiteField<double>& b) {
                          return local_products(a, b);
                      }});
    branches_ = branches.get();
    memories_.push_back(std::move(branches));
    memory_force_.emplace(slab_, components_);
}

void Response::gradient(Waves<double>& g) const {
    const double sites = slab_.sites, norm = 1.0 / (sites * sites);
    const WaveBlocks<double> forces = to_blocks(moving_planes(force_), transform_);
#pragma omp parallel for schedule(static) num_threads(forces.threads())
    for (int b = 0; b < g.blocks(); ++b) {
        stiffen<double>(b, waves_.block(b), -norm, forces.get(b), g.block(b));
        if (memory_force_)
            combine_row(1.0, memory_force_->block(b), 1.0, g.block(b),
                        static_cast<int>(g.length()));
    }
    if (!slab_.holds_uniform()) return;
    double& mean = g.uniform(components_ - 1);
    mean += norm * constraint_.load();
    if (constraint_.is_top()) mean -= held_stiffness() * constraint_.value;
    if (constraint_.is_mean_height()) mean = 0.0;
}

SiteRows<float> Response::respond(double k, const Inverse& inverse) const {
    const double sites = slab_.sites, norm = 1.0 / (sites * sites);
    double mean = -norm * constraint_.load();
    if (constraint_.is_top()) mean += held_stiffness() * constraint_.value;
    const std::size_t normal = slab_.block_length(components_ - 1);
    SiteRows<float> rows = single_.from_sites();
#pragma omp parallel for schedule(static) num_threads(rows.threads())
    for (int y = 0; y < slab_.rows; ++y) {
        for (int c = 0; c < components_; ++c)
            spring_force_row(k, norm, moving(layer_.plane(0), c).line(y),
                             moving(force_.plane(0), c).line(y), rows.own()[c], slab_.sites);
        rows.put(y);
    }
    WaveBlocks<float> blocks = std::move(rows).to_blocks();
#pragma omp parallel for schedule(static) num_threads(blocks.threads())
    for (int b = 0; b < slab_.blocks(); ++b) {
        float* const waves = blocks.get(b);
        const bool uniform = b == 0 && slab_.holds_uniform();
        if (uniform) waves[normal] += static_cast<float>(mean);
        if (memory_force_)
            combine_row(-1.0, memory_force_->block(b), 1.0, waves,
                        static_cast<int>(memory_force_->length()));
        inverse(b, waves);
        if (uniform && constraint_.is_mean_height())
            waves[normal] = static_cast<float>(constraint_.value);
        blocks.put(b, waves);
    }
    return std::move(blocks).to_rows();
}

template <class T>
void Response::stiffen(int b, double factor, double uniform, const T* u, double norm, const T* g,
                       T* f) const {
    const bool held = constraint_.is_top() && b == 0 && slab_.holds_uniform();
    const std::size_t normal = slab_.block_length(components_ - 1);
    const T mean = held ? u[normal] : T(0); // f may be u
    table_.multiply(b, u, norm / factor, g, f);
    if (factor != 1.0)
        combine_row(factor, f, 0.0, f, static_cast<int>(slab_.block_length(components_)));
    if (held) f[normal] += static_cast<T>(uniform) * mean;
}

template <class T>
void Response::stiffen(int b, const T* u, double norm, const T* g, T* f) const {
    if (!pattern_) {
        stiffen(b, factor_, held_stiffness(), u, norm, g, f);
        return;
    }
    const std::size_t length = slab_.block_length(components_);
    std::vector<T> load; // f may be g
    if (norm != 0.0) load.assign(g, g + length);
    stiffen<T>(b, factor_, held_stiffness(), u, 0.0, nullptr, f);
    scale_waves(b, pattern_->axis(), pattern_->stiffening(), f);
    if (norm != 0.0) combine_row(norm, load.data(), 1.0, f, static_cast<int>(length));
}
template void Response::stiffen(int, const float*, double, const float*, float*) const;
template void Response::stiffen(int, const double*, double, const double*, double*) const;

template <class T, class Factor>
void Response::scale_waves(int b, int axis, const std::vector<Factor>& factors, T* waves) const {
    const int first = (slab_.first_block() + b) * block_columns;
    for (int column = 0; column < block_columns && first + column < slab_.columns(); ++column)
        for (int row = 0; row < components_ * slab_.sites; ++row) {
            const int wave = axis == 0 ? first + column : row % slab_.sites;
            const Factor& factor = factors[static_cast<std::size_t>(wave)];
            T* const at = waves + 2 * (block_columns * static_cast<std::ptrdiff_t>(row) + column);
            const std::complex<double> scaled =
                factor *
                std::complex<double>(static_cast<double>(at[0]), static_cast<double>(at[1]));
            at[0] = static_cast<T>(scaled.real());
            at[1] = static_cast<T>(scaled.imag());
        }
}
template void Response::scale_waves(int, int, const std::vector<std::complex<double>>&,
                                    double*) const;

void Response::stiffen_relaxed(Waves<double>& f) const {
#pragma omp parallel for schedule(static)
    for (int b = 0; b < f.blocks(); ++b)
        stiffen<double>(b, 1.0, table_.uniform(), f.block(b), 0.0, nullptr, f.block(b));
}

template <class T, class Change>
void Response::change_waves(SiteField<T>& field, const Change& change) const {
    WaveBlocks<T> blocks = to_blocks(field, transform<T>());
#pragma omp parallel for schedule(static) num_threads(blocks.threads())
    for (int b = 0; b < slab_.blocks(); ++b) {
        T* const waves = blocks.get(b);
        change(b, waves);
        blocks.put(b, waves);
    }
    to_sites(std::move(blocks).to_rows(), field);
}

template <class T>
void Response::stiffen(SiteField<T>& displacement) const {
    change_waves(displacement, [&](int b, T* waves) { stiffen<T>(b, waves, 0.0, nullptr, waves); });
}
template void Response::stiffen(SiteField<float>&) const;

void Response::respond(const Inverse& inverse, SiteField<float>& forces) const {
    change_waves(forces, inverse);
}

template <class T>
void Response::shape_forces(SiteField<T>& displacement) const {
    const double sites = slab_.sites;
    const std::size_t normal = slab_.block_length(components_ - 1);
    change_waves(displacement, [&](int b, T* waves) {
        stiffen<T>(b, waves, 0.0, nullptr, waves);
        if (memory_force_)
            combine_row(sites * sites, memory_force_->block(b), 1.0, waves,
                        static_cast<int>(memory_force_->length()));
        if (b == 0 && slab_.holds_uniform()) waves[normal] = T(0);
    });
}
template void Response::shape_forces(SiteField<float>&) const;
template void Response::shape_forces(SiteField<double>&) const;

Holder Response::holder() const {
    const double sites = slab_.sites;
    if (!constraint_.is_top()) return {.force = constraint_.load() / (sites * sites)};
    Holder held{.stiffness = held_stiffness(), .at = constraint_.value};
    if (!memory_force_) return held;
    if (slab_.holds_uniform()) held.force = memory_force_->uniform(components_ - 1);
    slab_.ranks.broadcast(std::span(&held.force, 1)); // the root holds it
    return held;
}

SurfaceMatrix Response::acting_stiffness(int nx, int ny) const {
    SurfaceMatrix s = table_.at(nx, ny);
    for (double* entry : {&s.xx, &s.yy, &s.zz, &s.xy, &s.xz, &s.yz})
        *entry *= pattern_ ? pattern_->stiffening(nx, ny) : factor_;
    if (nx == 0 && ny == 0 && constraint_.is_top()) s.zz = held_stiffness();
    return s;
}

double Response::stiffest_wave() const {
    double stiffest = 0.0;
    for (int n = slab_.first_column(); n < slab_.end_column(); ++n)
        for (int m = n == 0 ? 1 : 0; m < slab_.columns(); ++m)
            stiffest = std::max(stiffest, acting_stiffness(n, m).zz);
    return slab_.ranks.max(stiffest);
}

double Response::held_stiffness() const {
    const double block = factor_ * table_.uniform();
    if (!options_.top_spring) return block;
    const double sites = slab_.sites, machine = options_.top_spring.stiffness / (sites * sites);
    return block * machine / (block + machine);
}

double Response::top() const {
    if (!constraint_.is_top())
        return mean_height() -
               (constraint_.stretches ? constraint_.load() / stretch_stiffness() : 0.0);
    return constraint_.value +
           (options_.top_spring ? top_force() / options_.top_spring.stiffness : 0.0);
}

double Response::drive() const {
    if (constraint_.is_top()) return constraint_.value;
    return top() - (options_.top_spring ? constraint_.load() / options_.top_spring.stiffness : 0.0);
}

double Response::mean_height() const {
    double mean = slab_.holds_uniform() ? waves_.uniform(components_ - 1) : 0.0;
    slab_.ranks.broadcast(std::span(&mean, 1)); // the root holds it
    return mean;
}

double Response::mean_height_of_box() const {
    if (options_.grid() == options_.sites) return mean_height();
    const PlaneView<const double> z = layer_.z.plane(0);
    const int n = options_.sites;
    const double mean = mean_height(); // keeps the terms of the sum small in any box
    ExactSum sum;
    for (int y = 0; y < z.ny && slab_.first + y < n; ++y) {
        for (int x = 0; x < n; ++x)
            sum.add(z(x, y) - mean);
        sum.carry();
    }
    return mean + global_sum(slab_.ranks, sum) / (static_cast<double>(n) * n);
}

double Response::top_force() const {
    if (!constraint_.is_top()) return constraint_.load();
    const double sites = slab_.sites;
    return sites * sites * holder()(mean_height());
}

StepEnergies Response::energies() const {
    // Half u.(S u), u measured from a held top plane, and what a load stretches the block by.
    const double from = constraint_.is_top() ? top() : 0.0;
    Waves<double> su = new_waves<double>();
    combine(1.0, waves_, 0.0, su);
    if (slab_.holds_uniform()) su.uniform(components_ - 1) -= from;
    stiffen_relaxed(su);
    double twice = dot(waves_, su);
    if (from != 0.0) twice -= from * stretch_stiffness() / factor_ * (mean_height() - from);
    const double load = constraint_.stretches ? constraint_.load() : 0.0;
    StepEnergies energies;
    energies[Term::elastic] = 0.5 * (twice + load * load / stretch_stiffness());
    if (options_.top_spring) {
        const double force = constraint_.is_mean_height() ? 0.0 : top_force();
        energies[Term::spring] = 0.5 * force * force / options_.top_spring.stiffness;
    }
    for (const std::unique_ptr<Memory>& memory : memories_)
        energies += memory->energies();
    for (const io::EnergyTerm& row : io::energy_terms)
        if (row.kind == io::EnergyTerm::part) energies[Term::elastic] += energies[row.term];
    return energies;
}

double Response::twice_energy(const SiteField<double>& u) const {
    const double sites = slab_.sites;
    Waves<double> waves = new_waves<double>(), su = new_waves<double>();
    to_waves(u, transform_, waves);
    combine(1.0 / (sites * sites), waves, 0.0, su);
    stiffen_relaxed(su);
    return dot(waves, su) / (sites * sites);
}

void Response::shift_displacements(double x, double y) {
    SiteField<double> field = new_field<double>();
    for (int c = 0; c < components_; ++c) {
        const PlaneView<const double> from = moving(layer_.plane(0), c);
        const PlaneView<double> to = field[static_cast<std::size_t>(c)].plane(0);
        for (int row = 0; row < from.ny; ++row)
            std::copy_n(from.line(row), from.nx, to.line(row));
    }
    const int sites = options_.sites;
    const double unit = 2.0 * std::numbers::pi / (sites * options_.spacing);
    const double norm = 1.0 / (static_cast<double>(sites) * sites);
    // The shortest wave along an axis has no sign: it is multiplied by the mean of both.
    const auto phases = [&](double by, double factor) {
        std::vector<std::complex<double>> of;
        for (int k = 0; k < sites; ++k) {
            const double angle = unit * (2 * k > sites ? k - sites : k) * by;
            of.push_back(factor * (2 * k == sites ? std::complex(std::cos(angle), 0.0)
                                                  : std::polar(1.0, angle)));
        }
        return of;
    };
    const auto along_x = phases(x, norm), along_y = phases(y, 1.0);
    change_waves(field, [&](int b, double* waves) {
        scale_waves(b, 0, along_x, waves);
        scale_waves(b, 1, along_y, waves);
    });
    for (int c = 0; c < components_; ++c) {
        const PlaneView<double> to = moving(layer_.plane(0), c);
        const PlaneView<const double> from =
            std::as_const(field[static_cast<std::size_t>(c)]).plane(0);
        for (int row = 0; row < to.ny; ++row)
            std::copy_n(from.line(row), to.nx, to.line(row));
    }
}

double Response::local_products(const SiteField<double>& a, const SiteField<double>& b) const {
    const double sites = options_.sites;
    Waves<double> waves = new_waves<double>();
    to_waves(b, transform_, waves);
    combine(0.0, waves, 1.0 / (sites * sites), waves);
    stiffen_relaxed(waves);
    SiteField<double> sb = new_field<double>();
    to_sites(waves, transform_, sb);
    OrderedSums sums(slab_, OrderedSums::Over::rows, 1);
#pragma omp parallel for schedule(static)
    for (int y = 0; y < slab_.rows; ++y) {
        double sum = 0.0;
        for (std::size_t c = 0; c < a.size(); ++c) {
            const double* const one = a[c].plane(0).line(y);
            const double* const other = sb[c].plane(0).line(y);
            for (int x = 0; x < slab_.sites; ++x)
                sum += std::abs(one[x] * other[x]);
        }
        *sums.part(y) = sum;
    }
    return sums.total()[0] / (sites * sites);
}

SiteField<double> Response::from_top() const {
    SiteField<double> w = new_field<double>();
    const double top = constraint_.is_top() ? this->top() : 0.0;
    for (int c = 0; c < components_; ++c) {
        const PlaneView<const double> u = moving(layer_.plane(0), c);
        const PlaneView<double> to = w[static_cast<std::size_t>(c)].plane(0);
        const double from = c == components_ - 1 ? top : 0.0;
        for (int y = 0; y < u.ny; ++y)
            for (int x = 0; x < u.nx; ++x)
                to(x, y) = u(x, y) - from;
    }
    return w;
}

void Response::displace(double t, const Waves<float>& d, const SiteField<float>& at_sites) {
    combine(t, d, 1.0, waves_);
#pragma omp parallel for schedule(static)
    for (int y = 0; y < slab_.rows; ++y)
        for (int c = 0; c < components_; ++c)
            combine_row(t, at_sites[static_cast<std::size_t>(c)].plane(0).line(y), 1.0,
                        moving(layer_.plane(0), c).line(y), slab_.sites);
}

void Response::restore_mean_height() {
    if (!constraint_.is_mean_height()) return;
    const double sites = slab_.sites;
    const PlaneView<double> z = layer_.z.plane(0);
    ExactSum sum;
    elastic_kernels().sum(z, 0, z.ny, sum);
    const double by = constraint_.value - global_sum(slab_.ranks, sum) / (sites * sites);
    for (int y = 0; y < z.ny; ++y)
        for (int x = 0; x < z.nx; ++x)
            z(x, y) += by;
}

void Response::apply_constraint() {
    restore_mean_height();
    transform_sites();
    if (constraint_.is_mean_height() && slab_.holds_uniform())
        waves_.uniform(components_ - 1) = constraint_.value;
}

void Response::transform_sites() {
    const double sites = slab_.sites;
    const WaveBlocks<double> blocks = to_blocks(moving_planes(layer_), transform_);
#pragma omp parallel for schedule(static) num_threads(blocks.threads())
    for (int b = 0; b < waves_.blocks(); ++b)
        combine_row(1.0 / (sites * sites), blocks.get(b), 0.0, waves_.block(b),
                    static_cast<int>(waves_.length()));
}

} // namespace asperity
