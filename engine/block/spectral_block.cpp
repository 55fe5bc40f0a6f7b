// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/block/spectral_block.hpp"

#include "decomposition/global_sum.hpp"
#include "kernels/elastic_level.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace asperity {

namespace {

using namespace matrix_entry;

/// Of a table over the quadrant: [block][ny][entry][column], or one number of a wave.
struct TableShape {
    int sites, components;
    std::size_t entries() const { return components == 1 ? 1 : count; }
    std::size_t block() const {
        return static_cast<std::size_t>(sites / 2 + 1) * entries() * block_columns;
    }
    std::size_t size(int blocks) const { return static_cast<std::size_t>(blocks) * block(); }
    std::size_t at(std::size_t e, int nx, int ny) const {
        return static_cast<std::size_t>(nx / block_columns) * block() +
               (static_cast<std::size_t>(ny) * entries() + e) * block_columns +
               static_cast<std::size_t>(nx % block_columns);
    }
    template <class T>
    void put(const SurfaceMatrix& m, int nx, int ny, std::vector<T>& table) const {
        const double values[count] = {m.xx, m.yy, m.zz, m.xy, m.xz, m.yz};
        for (std::size_t e = 0; e < entries(); ++e)
            table[at(e, nx, ny)] = static_cast<T>(components == 1 ? m.zz : values[e]);
    }
};

/// S of every wave, or what is left of it without friction.
std::vector<double> stiffness_table(const BlockOptions& options, const Slab& slab,
                                    bool frictionless) {
    const TableShape shape{options.sites, frictionless ? 1 : 3};
    std::vector<double> table(shape.size(slab.all_blocks()));
    const CellElasticity elasticity = options.elasticity(0);
    std::vector<WavePhase> phase;
    for (int n = 0; n <= options.sites / 2; ++n)
        phase.push_back(wave_phase(n, options.sites));
#pragma omp parallel for schedule(dynamic, 4)
    for (int i = 0; i < slab.columns(); ++i)
        for (int j = 0; j <= i; ++j) {
            const SurfaceMatrix s =
                surface_stiffness(elasticity, phase[static_cast<std::size_t>(i)],
                                  phase[static_cast<std::size_t>(j)], options.thickness);
            const double normal = frictionless ? 1.0 / inverse(s).zz : s.zz;
            shape.put({s.xx, s.yy, normal, s.xy, s.xz, s.yz}, i, j, table);
            shape.put({s.yy, s.xx, normal, s.xy, s.yz, s.xz}, j, i, table);
        }
    return table;
}

/// Transforms a field, a plane for each component, as far as blocks.
template <class T>
void put_planes(const std::vector<PlaneView<const T>>& planes, const SurfaceTransform<T>& to) {
#pragma omp parallel for schedule(static) num_threads(to.threads())
    for (int y = 0; y < planes.front().ny; ++y) {
        for (std::size_t c = 0; c < planes.size(); ++c)
            std::copy_n(planes[c].line(y), planes[c].nx, to.rows()[c]);
        to.put_rows(y);
    }
    to.to_blocks();
}

} // namespace

SpectralBlock::SpectralBlock(const BlockOptions& options, const Communicator& communicator,
                             bool frictionless)
    : options_(options), slab_(options.sites, communicator), components_(frictionless ? 1 : 3),
      table_(stiffness_table(options, slab_, frictionless)),
      single_table_(table_.begin(), table_.end()), layer_(tile(), 1, 0), force_(tile(), 1, 0),
      waves_(slab_, components_), transform_(slab_, components_), single_(slab_, components_) {
    uniform_ = stiffness(0, 0).zz;
    if (!options.branches.empty()) {
        memory_.emplace(options.branches, slab_, components_);
        relaxed_ = table_;
        known_.emplace(slab_, components_);
    }
    constrain({});
}

std::size_t SpectralBlock::entry(int e, int nx, int ny) const {
    return TableShape{options_.sites, components_}.at(
        static_cast<std::size_t>(components_ == 1 ? 0 : e), nx, ny);
}

void SpectralBlock::set_uniform(double z) {
    layer_ = VectorField<double>(tile(), 1, 0);
    const PlaneView<double> uz = layer_.z.plane(0);
    for (int y = 0; y < uz.ny; ++y)
        std::fill(uz.line(y), uz.line(y) + uz.nx, z);
    waves_.clear();
    if (slab_.holds_uniform()) waves_.uniform(components_ - 1) = z;
}

void SpectralBlock::constrain(const Constraint& constraint) {
    constraint_ = constraint;
    double& zero = table_[entry(zz, 0, 0)];
    zero = constraint.is_top() ? uniform_ : 0.0;
    single_table_[entry(zz, 0, 0)] = static_cast<float>(zero);
}

double SpectralBlock::top() const {
    return constraint_.is_top() ? constraint_.value : mean_height() - constraint_.load() / spring();
}

double SpectralBlock::mean_height() const {
    double mean = slab_.holds_uniform() ? waves_.uniform(components_ - 1) : 0.0;
    slab_.ranks.broadcast(std::span(&mean, 1)); // the root holds it
    return mean;
}

double SpectralBlock::top_force() const {
    if (!constraint_.is_top()) return constraint_.load();
    const double known = options_.sites * options_.sites * uniform_known();
    return spring() * (mean_height() - constraint_.value) + known;
}

void SpectralBlock::gradient(Waves<double>& g) const {
    const double sites = options_.sites, norm = 1.0 / (sites * sites);
    put_planes(moving_planes(force_), transform_);
#pragma omp parallel for schedule(static) num_threads(transform_.threads())
    for (int b = 0; b < g.blocks(); ++b) {
        stiffen<double>(b, waves_.block(b), -norm, transform_.get_block(b), g.block(b));
        if (known_)
            combine_row(1.0, known_->block(b), 1.0, g.block(b), static_cast<int>(g.length()));
    }
    if (!slab_.holds_uniform()) return;
    double& mean = g.uniform(components_ - 1);
    mean += norm * constraint_.load();
    if (constraint_.is_top()) mean -= uniform_ * constraint_.value;
    if (constraint_.is_mean_height()) mean = 0.0;
}

template <class T>
void SpectralBlock::stiffen(int b, const T* u, double norm, const T* g, T* f) const {
    const TableShape shape{options_.sites, components_};
    const T* table = nullptr;
    if constexpr (std::is_same_v<T, double>)
        table = table_.data();
    else
        table = single_table_.data();
    multiply_block(table + shape.size(slab_.first_block() + b), options_.sites, components_, u,
                   norm, g, f);
}
template void SpectralBlock::stiffen(int, const float*, double, const float*, float*) const;
template void SpectralBlock::stiffen(int, const double*, double, const double*, double*) const;

double SpectralBlock::elastic_energy() const {
    // Half u.(S u), u measured from a prescribed top plane, and what a load stretches the block by.
    const double from = constraint_.is_top() ? constraint_.value : 0.0;
    Waves<double> su = new_waves<double>();
    combine(1.0, waves_, 0.0, su);
    if (slab_.holds_uniform()) su.uniform(components_ - 1) -= from;
    stiffen(su);
    double twice = dot(waves_, su);
    if (from != 0.0) twice -= from * spring() * (mean_height() - from);
    if (memory_) twice /= 1.0 + memory_->stiffening();
    const double load = constraint_.load();
    return 0.5 * (twice + load * load / spring());
}

SiteField<double> SpectralBlock::from_top() const {
    SiteField<double> w = new_field<double>();
    const double top = constraint_.is_top() ? constraint_.value : 0.0;
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

double SpectralBlock::square(const SiteField<double>& u) const {
    const double sites = options_.sites;
    Waves<double> waves = new_waves<double>(), su = new_waves<double>();
    to_waves(u, waves);
    combine(1.0 / (sites * sites), waves, 0.0, su);
    stiffen(su);
    return dot(waves, su) / (sites * sites);
}

double SpectralBlock::uniform_known() const {
    double known = 0.0;
    if (!known_) return known;
    if (slab_.holds_uniform()) known = known_->uniform(components_ - 1);
    slab_.ranks.broadcast(std::span(&known, 1));
    return known;
}

void SpectralBlock::begin_step(double dt, double last) {
    if (!memory_) return;
    memory_->begin(from_top(), dt, last);
    table_ = relaxed_;
    uniform_ = stiffness(0, 0).zz;
    constrain(constraint_);
    const double sites = options_.sites;
    to_waves(memory_->known(), *known_);
    combine(0.0, *known_, 1.0 / (sites * sites), *known_);
    stiffen(*known_);
    const double factor = 1.0 + memory_->stiffening();
    for (double& entry : table_)
        entry *= factor;
    std::copy(table_.begin(), table_.end(), single_table_.begin());
    uniform_ *= factor;
}

void SpectralBlock::end_step() {
    if (memory_) memory_->end(from_top());
}

BranchEnergies SpectralBlock::branch_energies() const {
    if (!memory_) return {};
    const double factor = 1.0 + memory_->stiffening();
    return memory_->energies(from_top(),
                             [&](const SiteField<double>& u) { return square(u) / factor; });
}

template <class From, class T>
void SpectralBlock::at_sites(const Waves<From>& waves, SiteField<T>& field) const {
    const SurfaceTransform<T>& by = transform<T>();
#pragma omp parallel for schedule(static) num_threads(by.threads())
    for (int b = 0; b < waves.blocks(); ++b) {
        if constexpr (std::is_same_v<From, T>) {
            by.put_block(b, waves.block(b));
        } else {
            combine_row(1.0, waves.block(b), 0.0, by.room(), static_cast<int>(waves.length()));
            by.put_block(b, by.room());
        }
    }
    by.to_rows();
#pragma omp parallel for schedule(static) num_threads(by.threads())
    for (int y = 0; y < slab_.rows; ++y) {
        const T* const* rows = by.get_rows(y);
        for (std::size_t c = 0; c < field.size(); ++c)
            std::copy_n(rows[c], slab_.sites, field[c].plane(0).line(y));
    }
}
template void SpectralBlock::at_sites(const Waves<float>&, SiteField<float>&) const;
template void SpectralBlock::at_sites(const Waves<double>&, SiteField<float>&) const;
template void SpectralBlock::at_sites(const Waves<double>&, SiteField<double>&) const;

template <class T>
void SpectralBlock::to_waves(const SiteField<T>& field, Waves<T>& waves) const {
    const SurfaceTransform<T>& by = transform<T>();
    std::vector<PlaneView<const T>> planes;
    for (const Field<T>& component : field)
        planes.push_back(component.plane(0));
    put_planes(planes, by);
#pragma omp parallel for schedule(static) num_threads(by.threads())
    for (int b = 0; b < waves.blocks(); ++b)
        std::copy_n(by.get_block(b), waves.length(), waves.block(b));
}
template void SpectralBlock::to_waves(const SiteField<float>&, Waves<float>&) const;
template void SpectralBlock::to_waves(const SiteField<double>&, Waves<double>&) const;

void SpectralBlock::displace(double t, const Waves<float>& d, const SiteField<float>& at_sites) {
    combine(t, d, 1.0, waves_);
#pragma omp parallel for schedule(static)
    for (int y = 0; y < slab_.rows; ++y)
        for (int c = 0; c < components_; ++c)
            combine_row(t, at_sites[static_cast<std::size_t>(c)].plane(0).line(y), 1.0,
                        moving(layer_.plane(0), c).line(y), slab_.sites);
}

void SpectralBlock::respond(const Preconditioner& preconditioner) const {
    const double sites = options_.sites, norm = 1.0 / (sites * sites), k = preconditioner.k();
    double mean = -norm * constraint_.load();
    if (constraint_.is_top()) mean += uniform_ * constraint_.value;
    const std::size_t normal = slab_.block_length(components_ - 1);
#pragma omp parallel for schedule(static) num_threads(single_.threads())
    for (int y = 0; y < slab_.rows; ++y) {
        for (int c = 0; c < components_; ++c)
            tie_row(k, norm, moving(layer_.plane(0), c).line(y), moving(force_.plane(0), c).line(y),
                    single_.rows()[c], slab_.sites);
        single_.put_rows(y);
    }
    single_.to_blocks();
#pragma omp parallel for schedule(static) num_threads(single_.threads())
    for (int b = 0; b < slab_.blocks(); ++b) {
        float* const waves = single_.get_block(b);
        const bool uniform = b == 0 && slab_.holds_uniform();
        if (uniform) waves[normal] += static_cast<float>(mean);
        if (known_)
            combine_row(-1.0, known_->block(b), 1.0, waves, static_cast<int>(known_->length()));
        preconditioner.apply(b, waves, 0.0, waves);
        if (uniform && constraint_.is_mean_height())
            waves[normal] = static_cast<float>(constraint_.value);
        single_.put_block(b, waves);
    }
    single_.to_rows();
}

void SpectralBlock::restore_mean_height() {
    if (!constraint_.is_mean_height()) return;
    const double sites = options_.sites;
    const PlaneView<double> z = layer_.z.plane(0);
    ExactSum sum;
    elastic_kernels().sum(z, 0, z.ny, sum);
    const double by = constraint_.value - global_sum(slab_.ranks, sum) / (sites * sites);
    for (int y = 0; y < z.ny; ++y)
        for (int x = 0; x < z.nx; ++x)
            z(x, y) += by;
}

void SpectralBlock::apply_constraint() {
    restore_mean_height();
    const double sites = options_.sites;
    put_planes(moving_planes(layer_), transform_);
#pragma omp parallel for schedule(static) num_threads(transform_.threads())
    for (int b = 0; b < waves_.blocks(); ++b)
        combine_row(1.0 / (sites * sites), transform_.get_block(b), 0.0, waves_.block(b),
                    static_cast<int>(waves_.length()));
    if (constraint_.is_mean_height() && slab_.holds_uniform())
        waves_.uniform(components_ - 1) = constraint_.value;
}

SurfaceMatrix SpectralBlock::stiffness(int nx, int ny) const {
    const auto at = [&](int e) { return table_[entry(e, nx, ny)]; };
    if (components_ == 1) return {0.0, 0.0, at(zz), 0.0, 0.0, 0.0};
    return {at(xx), at(yy), at(zz), at(xy), at(xz), at(yz)};
}

std::size_t SpectralBlock::bytes() const {
    std::size_t sum = table_bytes() + layer_.bytes() + force_.bytes() + waves_.bytes();
    if (memory_) sum += relaxed_.size() * sizeof(double) + memory_->bytes() + known_->bytes();
    return sum;
}

Preconditioner::Preconditioner(const SpectralBlock& block, double k)
    : sites_(block.slab().sites), first_(block.slab().first_block()),
      components_(block.components()),
      table_(TableShape{sites_, components_}.size(block.slab().all_blocks())) {
    tune(block, k);
}

void Preconditioner::tune(const SpectralBlock& block, double k) {
    k_ = k;
    const TableShape shape{sites_, components_};
    const int columns = block.slab().columns();
#pragma omp parallel for schedule(static)
    for (int ny = 0; ny < columns; ++ny)
        for (int nx = 0; nx < columns; ++nx) {
            SurfaceMatrix m = block.stiffness(nx, ny);
            m.xx += k;
            m.yy += k;
            m.zz += k;
            SurfaceMatrix i = inverse(m);
            if (nx == 0 && ny == 0 && block.constraint().is_mean_height()) i.zz = 0.0;
            shape.put(i, nx, ny, table_);
        }
}

void Preconditioner::apply(int b, const float* from, double keep, float* to) const {
    const TableShape shape{sites_, components_};
    multiply_block(table_.data() + shape.size(first_ + b), sites_, components_, from, keep, to, to);
}

} // namespace asperity
