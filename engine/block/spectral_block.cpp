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

using Entry = MatrixRow<double>::Entry;
// `using enum` of an enumeration in a class template is more than clang 14 understands.
constexpr Entry xx = Entry::xx, yy = Entry::yy, zz = Entry::zz, xy = Entry::xy, xz = Entry::xz,
                yz = Entry::yz, entries = Entry::entries;

/// What row n_y of N sees of a table over the quadrant: [entry][ny][nx], or the one number of a
/// wave.
template <class T>
MatrixRow<T> matrix_row(const std::vector<T>& table, std::size_t columns, int row, int sites) {
    const std::size_t size = columns * columns;
    const T* from = table.data() + static_cast<std::size_t>(std::min(row, sites - row)) * columns;
    MatrixRow<T> m;
    for (std::size_t e = 0; e < entries; ++e)
        m.at[e] = from + (table.size() == size ? 0 : e * size);
    m.sign = 2 * row > sites ? T(-1) : T(1);
    return m;
}

/// f <- m u + norm f for row y of some waves.
template <class M, class T>
void multiply_waves(const MatrixRow<M>& m, int y, const Waves<T>& u, double norm, Waves<T>& f) {
    const T* from[3] = {};
    T* to[3] = {};
    for (int c = 0; c < u.components(); ++c) {
        from[c] = u.row(c, y);
        to[c] = f.row(c, y);
    }
    multiply_row(m, u.columns(), u.components(), from, norm, to);
}

/// S of every wave, or what is left of it without friction.
std::vector<double> stiffness_table(const BlockOptions& options, bool frictionless) {
    const std::size_t columns = static_cast<std::size_t>(options.sites / 2 + 1);
    const std::size_t size = columns * columns;
    std::vector<double> table((frictionless ? 1 : entries) * size);
    const CellElasticity elasticity = options.elasticity(0);
    std::vector<WavePhase> phase;
    for (int n = 0; n <= options.sites / 2; ++n)
        phase.push_back(wave_phase(n, options.sites));
#pragma omp parallel for schedule(dynamic, 4)
    for (std::size_t i = 0; i < columns; ++i)
        for (std::size_t j = 0; j <= i; ++j) {
            const SurfaceMatrix s =
                surface_stiffness(elasticity, phase[i], phase[j], options.thickness);
            const auto put = [&](std::size_t nx, std::size_t ny, const SurfaceMatrix& m) {
                double* const at = table.data() + ny * columns + nx;
                if (frictionless) {
                    *at = 1.0 / inverse(m).zz;
                    return;
                }
                const double values[entries] = {m.xx, m.yy, m.zz, m.xy, m.xz, m.yz};
                for (std::size_t e = 0; e < entries; ++e)
                    at[e * size] = values[e];
            };
            put(i, j, s);
            put(j, i, {s.yy, s.xx, s.zz, s.xy, s.yz, s.xz});
        }
    return table;
}

} // namespace

SpectralBlock::SpectralBlock(const BlockOptions& options, const Communicator& communicator,
                             bool frictionless)
    : options_(options), slab_(options.sites, communicator), components_(frictionless ? 1 : 3),
      columns_(static_cast<std::size_t>(slab_.columns())),
      table_(stiffness_table(options, frictionless)), layer_(tile(), 1, 0), force_(tile(), 1, 0),
      waves_(slab_, components_), transform_(slab_), single_(slab_) {
    uniform_ = stiffness(0, 0).zz;
    if (!options.branches.empty()) {
        memory_.emplace(options.branches, slab_, components_);
        relaxed_ = table_;
        known_.emplace(slab_, components_);
    }
    constrain({});
}

double* SpectralBlock::table(int entry, int ny) {
    return const_cast<double*>(std::as_const(*this).table(entry, ny));
}

const double* SpectralBlock::table(int entry, int ny) const {
    const int kept = components_ == 1 ? 0 : entry;
    return table_.data() +
           (static_cast<std::size_t>(kept) * columns_ + static_cast<std::size_t>(ny)) * columns_;
}

void SpectralBlock::set_uniform(double z) {
    layer_ = VectorField<double>(tile(), 1, 0);
    const PlaneView<double> uz = layer_.z.plane(0);
    for (int y = 0; y < uz.ny; ++y)
        std::fill(uz.line(y), uz.line(y) + uz.nx, z);
    waves_.clear();
    if (slab_.holds_uniform()) waves_.row(components_ - 1, 0)[0] = z;
}

void SpectralBlock::constrain(const Constraint& constraint) {
    constraint_ = constraint;
    table(zz, 0)[0] = constraint.is_top() ? uniform_ : 0.0;
}

double SpectralBlock::top() const {
    return constraint_.is_top() ? constraint_.value : mean_height() - constraint_.load() / spring();
}

double SpectralBlock::mean_height() const {
    double mean = slab_.holds_uniform() ? waves_.row(components_ - 1, 0)[0] : 0.0;
    slab_.ranks.broadcast(std::span(&mean, 1)); // the root holds the first row
    return mean;
}

double SpectralBlock::top_force() const {
    if (!constraint_.is_top()) return constraint_.load();
    const double known = options_.sites * options_.sites * uniform_known();
    return spring() * (mean_height() - constraint_.value) + known;
}

void SpectralBlock::gradient(Waves<double>& g) const {
    for (int c = 0; c < components_; ++c)
        transform_.forward(moving(force_.plane(0), c), g, c);
    const double sites = options_.sites, norm = 1.0 / (sites * sites);
#pragma omp parallel for schedule(static)
    for (int y = 0; y < slab_.rows; ++y)
        stiffen_row(y, waves_, -norm, g);
    if (known_) combine(1.0, *known_, 1.0, g);
    if (!slab_.holds_uniform()) return;
    double& mean = g.row(components_ - 1, 0)[0];
    mean += norm * constraint_.load();
    if (constraint_.is_top()) mean -= uniform_ * constraint_.value;
    if (constraint_.is_mean_height()) mean = 0.0;
}

template <class T>
void SpectralBlock::stiffen_row(int y, const Waves<T>& u, double norm, Waves<T>& f) const {
    multiply_waves(matrix_row(table_, columns_, slab_.first + y, slab_.sites), y, u, norm, f);
}
template void SpectralBlock::stiffen_row(int, const Waves<float>&, double, Waves<float>&) const;
template void SpectralBlock::stiffen_row(int, const Waves<double>&, double, Waves<double>&) const;

double SpectralBlock::elastic_energy() const {
    // Half u.(S u), u measured from a prescribed top plane, and what a load stretches the block by.
    const double from = constraint_.is_top() ? constraint_.value : 0.0;
    Waves<double> su = new_waves<double>();
    combine(1.0, waves_, 0.0, su);
    if (slab_.holds_uniform()) su.row(components_ - 1, 0)[0] -= from;
#pragma omp parallel for schedule(static)
    for (int y = 0; y < slab_.rows; ++y)
        stiffen_row(y, su, 0.0, su);
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
#pragma omp parallel for schedule(static)
    for (int y = 0; y < slab_.rows; ++y)
        stiffen_row(y, su, 0.0, su);
    return dot(waves, su) / (sites * sites);
}

double SpectralBlock::uniform_known() const {
    double known = 0.0;
    if (!known_) return known;
    if (slab_.holds_uniform()) known = known_->row(components_ - 1, 0)[0];
    slab_.ranks.broadcast(std::span(&known, 1));
    return known;
}

void SpectralBlock::begin_step(double dt) {
    if (!memory_) return;
    memory_->begin(from_top(), dt);
    table_ = relaxed_;
    uniform_ = stiffness(0, 0).zz;
    constrain(constraint_);
    const double sites = options_.sites;
    to_waves(memory_->known(), *known_);
    combine(0.0, *known_, 1.0 / (sites * sites), *known_);
#pragma omp parallel for schedule(static)
    for (int y = 0; y < slab_.rows; ++y)
        stiffen_row(y, *known_, 0.0, *known_);
    const double factor = 1.0 + memory_->stiffening();
    for (double& entry : table_)
        entry *= factor;
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

template <class T>
void SpectralBlock::at_sites(Waves<T>& waves, SiteField<T>& field) const {
    for (int c = 0; c < components_; ++c)
        transform<T>().backward(waves, c, field[static_cast<std::size_t>(c)].plane(0));
}
template void SpectralBlock::at_sites(Waves<float>&, SiteField<float>&) const;
template void SpectralBlock::at_sites(Waves<double>&, SiteField<double>&) const;

template <class T>
void SpectralBlock::to_waves(const SiteField<T>& field, Waves<T>& waves) const {
    for (int c = 0; c < components_; ++c)
        transform<T>().forward(field[static_cast<std::size_t>(c)].plane(0), waves, c);
}
template void SpectralBlock::to_waves(const SiteField<float>&, Waves<float>&) const;
template void SpectralBlock::to_waves(const SiteField<double>&, Waves<double>&) const;

void SpectralBlock::displace(double t, const Waves<float>& d, const SiteField<float>& at_sites) {
#pragma omp parallel for schedule(static)
    for (int y = 0; y < slab_.rows; ++y)
        for (int c = 0; c < components_; ++c) {
            combine_row(t, d.row(c, y), 1.0, waves_.row(c, y), d.length());
            combine_row(t, at_sites[static_cast<std::size_t>(c)].plane(0).line(y), 1.0,
                        moving(layer_.plane(0), c).line(y), slab_.sites);
        }
}

void SpectralBlock::respond(const Preconditioner& preconditioner, Waves<float>& waves,
                            const Rows& use) const {
    const double sites = options_.sites, norm = 1.0 / (sites * sites), k = preconditioner.k();
    single_.forward(
        [&](int y, float* const* rows) {
            for (int c = 0; c < components_; ++c)
                tie_row(k, norm, moving(layer_.plane(0), c).line(y),
                        moving(force_.plane(0), c).line(y), rows[c], slab_.sites);
        },
        waves);
    const int normal = components_ - 1;
    if (slab_.holds_uniform()) {
        double mean = -norm * constraint_.load();
        if (constraint_.is_top()) mean += uniform_ * constraint_.value;
        waves.row(normal, 0)[0] += static_cast<float>(mean);
    }
    if (known_) combine(-1.0, *known_, 1.0, waves);
#pragma omp parallel for schedule(static)
    for (int y = 0; y < slab_.rows; ++y)
        preconditioner.apply_row(y, waves, waves);
    if (constraint_.is_mean_height() && slab_.holds_uniform())
        waves.row(normal, 0)[0] = static_cast<float>(constraint_.value);
    single_.backward(waves, use);
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
    const VectorPlane<const double> layer = std::as_const(layer_).plane(0);
    for (int c = 0; c < components_; ++c)
        transform_.forward(moving(layer, c), waves_, c);
    const double sites = options_.sites;
    combine(0.0, waves_, 1.0 / (sites * sites), waves_);
    if (constraint_.is_mean_height() && slab_.holds_uniform())
        waves_.row(components_ - 1, 0)[0] = constraint_.value;
}

SurfaceMatrix SpectralBlock::stiffness(int nx, int ny) const {
    const auto at = [&](int e) { return table(e, ny)[nx]; };
    if (components_ == 1) return {0.0, 0.0, at(zz), 0.0, 0.0, 0.0};
    return {at(xx), at(yy), at(zz), at(xy), at(xz), at(yz)};
}

std::size_t SpectralBlock::bytes() const {
    std::size_t sum =
        table_.size() * sizeof(double) + layer_.bytes() + force_.bytes() + waves_.bytes();
    if (memory_) sum += table_bytes() + memory_->bytes() + known_->bytes();
    return sum;
}

Preconditioner::Preconditioner(const SpectralBlock& block, double k)
    : sites_(block.slab().sites), first_(block.slab().first),
      columns_(static_cast<std::size_t>(block.slab().columns())),
      entries_(block.components() == 1 ? 1 : entries), table_(entries_ * columns_ * columns_) {
    tune(block, k);
}

void Preconditioner::tune(const SpectralBlock& block, double k) {
    k_ = k;
    const int columns = block.slab().columns();
    const std::size_t size = columns_ * columns_;
#pragma omp parallel for schedule(static)
    for (int ny = 0; ny < columns; ++ny)
        for (int nx = 0; nx < columns; ++nx) {
            SurfaceMatrix m = block.stiffness(nx, ny);
            float* const at = table_.data() + static_cast<std::size_t>(ny) * columns_ +
                              static_cast<std::size_t>(nx);
            m.xx += k;
            m.yy += k;
            m.zz += k;
            SurfaceMatrix i = inverse(m);
            if (nx == 0 && ny == 0 && block.constraint().is_mean_height()) i.zz = 0.0;
            if (entries_ == 1) {
                *at = static_cast<float>(i.zz);
                continue;
            }
            const double values[entries] = {i.xx, i.yy, i.zz, i.xy, i.xz, i.yz};
            for (std::size_t e = 0; e < entries; ++e)
                at[e * size] = static_cast<float>(values[e]);
        }
}

void Preconditioner::apply_row(int y, const Waves<float>& from, Waves<float>& to) const {
    multiply_waves(matrix_row(table_, columns_, first_ + y, sites_), y, from, 0.0, to);
}

} // namespace asperity
