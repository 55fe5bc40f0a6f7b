// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/spectral_block.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace asperity {

namespace {

enum Entry { xx, yy, zz, xy, xz, yz, entries };

/// One row of the table, as seen from a row of waves: with the signs of its q_y.
struct StiffnessRow {
    const double* at[entries];
    double sign; ///< of q_y: on xy and yz

    SurfaceMatrix operator[](int i) const {
        return {at[xx][i], at[yy][i], at[zz][i], sign * at[xy][i], at[xz][i], sign * at[yz][i]};
    }
};

/// m u for u = (x, y, z), where m acts on (x, y, i z); real and imaginary parts.
struct Product {
    double x[2], y[2], z[2];
};
template <class T>
ASPERITY_INLINE Product times(const SurfaceMatrix& m, const T* x, const T* y, const T* z) {
    const double w[2] = {-z[1], z[0]};
    Product p{};
    double pw[2];
    for (int k = 0; k < 2; ++k) {
        p.x[k] = m.xx * x[k] + m.xy * y[k] + m.xz * w[k];
        p.y[k] = m.xy * x[k] + m.yy * y[k] + m.yz * w[k];
        pw[k] = m.xz * x[k] + m.yz * y[k] + m.zz * w[k];
    }
    p.z[0] = pw[1];
    p.z[1] = -pw[0];
    return p;
}

} // namespace

SpectralBlock::SpectralBlock(const BlockOptions& options, const Communicator& communicator)
    : options_(options),
      communicator_(communicator), tile_{0, 0, options.sites, options.sites, options.sites},
      columns_(static_cast<std::size_t>(options.sites / 2 + 1)), layer_(tile_, 1, 0),
      force_(tile_, 1, 0), waves_(options.sites), scratch_(options.sites),
      transform_(options.sites, layer_.plane(0).x.row) {
    if (communicator.size() > 1)
        throw std::invalid_argument(
            fmt::format("= \"spectral\" on {} ranks: its Fourier transforms are those of one rank "
                        "with threads; start one rank (OMP_NUM_THREADS sets its threads), or take "
                        "block.model = \"multiscale\"",
                        communicator.size()));
    table_.resize(entries * columns_ * columns_);
    const CellElasticity elasticity = options.elasticity(0);
    std::vector<WavePhase> phase;
    for (int n = 0; n <= options.sites / 2; ++n)
        phase.push_back(wave_phase(n, options.sites));
#pragma omp parallel for schedule(dynamic, 4)
    for (std::size_t i = 0; i < columns_; ++i)
        for (std::size_t j = 0; j <= i; ++j) {
            const SurfaceMatrix s =
                surface_stiffness(elasticity, phase[i], phase[j], options.thickness);
            const auto put = [&](std::size_t nx, std::size_t ny, const SurfaceMatrix& m) {
                const double values[entries] = {m.xx, m.yy, m.zz, m.xy, m.xz, m.yz};
                for (int e = 0; e < entries; ++e)
                    table(e, static_cast<int>(ny))[nx] = values[e];
            };
            put(i, j, s);
            put(j, i, {s.yy, s.xx, s.zz, s.xy, s.yz, s.xz});
        }
    uniform_ = table(zz, 0)[0];
    free_top();
}

template <class Work>
void SpectralBlock::each_row(const Work& work) const {
    const int n = options_.sites;
#pragma omp parallel for schedule(static)
    for (int y = 0; y < n; ++y) {
        StiffnessRow s{};
        for (int e = 0; e < entries; ++e)
            s.at[e] = table(e, std::min(y, n - y));
        s.sign = 2 * y > n ? -1.0 : 1.0;
        work(y, s);
    }
}

void SpectralBlock::set_uniform(double z) {
    layer_ = new_field();
    const PlaneView<double> uz = layer_.z.plane(0);
    for (int y = 0; y < tile_.ny; ++y)
        std::fill(uz.line(y), uz.line(y) + tile_.nx, z);
    waves_ = Waves<double>(options_.sites);
    waves_.row(2, 0)[0] = z;
    if (!top_free_) top_ = z;
}

void SpectralBlock::hold_top(double z) {
    top_ = z;
    top_free_ = false;
    table(zz, 0)[0] = uniform_;
}

void SpectralBlock::free_top() {
    top_free_ = true;
    table(zz, 0)[0] = 0.0;
}

double SpectralBlock::top_force() const {
    if (top_free_) return 0.0;
    const double sites = options_.sites;
    return sites * sites * uniform_ * (mean_height() - top_);
}

void SpectralBlock::gradient(double load, Waves<double>& g) const {
    transform_.forward(force_.plane(0), g);
    const double sites = options_.sites, norm = 1.0 / (sites * sites);
    add_stiffness(waves_, -norm, g);
    double& mean = g.row(2, 0)[0];
    mean += norm * load;
    if (!top_free_) mean -= uniform_ * top_;
}

template <class T>
void SpectralBlock::add_stiffness(const Waves<T>& u, double norm, Waves<T>& f) const {
    each_row([&](int row, const StiffnessRow& s) {
        const T *x = u.row(0, row), *y = u.row(1, row), *z = u.row(2, row);
        T *fx = f.row(0, row), *fy = f.row(1, row), *fz = f.row(2, row);
        for (int i = 0; i < u.columns(); ++i) {
            const Product p = times(s[i], x + 2 * i, y + 2 * i, z + 2 * i);
            for (int k = 2 * i; k < 2 * i + 2; ++k) {
                fx[k] = static_cast<T>(p.x[k - 2 * i] + norm * fx[k]);
                fy[k] = static_cast<T>(p.y[k - 2 * i] + norm * fy[k]);
                fz[k] = static_cast<T>(p.z[k - 2 * i] + norm * fz[k]);
            }
        }
    });
}
template void SpectralBlock::add_stiffness(const Waves<float>&, double, Waves<float>&) const;

template <class T>
void SpectralBlock::precondition(double k, Waves<T>& v) const {
    each_row([&](int row, const StiffnessRow& s) {
        T *x = v.row(0, row), *y = v.row(1, row), *z = v.row(2, row);
        for (int i = 0; i < v.columns(); ++i) {
            SurfaceMatrix m = s[i];
            m.xx += k;
            m.yy += k;
            m.zz += k;
            const Product p = times(inverse(m), x + 2 * i, y + 2 * i, z + 2 * i);
            for (int c = 0; c < 2; ++c) {
                x[2 * i + c] = static_cast<T>(p.x[c]);
                y[2 * i + c] = static_cast<T>(p.y[c]);
                z[2 * i + c] = static_cast<T>(p.z[c]);
            }
        }
    });
}
template void SpectralBlock::precondition(double, Waves<float>&) const;
template void SpectralBlock::precondition(double, Waves<double>&) const;

double SpectralBlock::elastic_energy() const {
    const int n = options_.sites, columns = waves_.columns();
    std::vector<double> rows(static_cast<std::size_t>(n));
    const double top = top_free_ ? 0.0 : top_;
    each_row([&](int row, const StiffnessRow& s) {
        const double *x = waves_.row(0, row), *y = waves_.row(1, row), *z = waves_.row(2, row);
        double sum = 0.0;
        for (int i = 0; i < columns; ++i) {
            double u[2] = {z[2 * i], z[2 * i + 1]};
            if (row == 0 && i == 0) u[0] -= top;
            const Product p = times(s[i], x + 2 * i, y + 2 * i, u);
            double e = 0.0;
            for (int k = 0; k < 2; ++k)
                e += x[2 * i + k] * p.x[k] + y[2 * i + k] * p.y[k] + u[k] * p.z[k];
            const bool once = i == 0 || (n % 2 == 0 && i + 1 == columns);
            sum += once ? e : 2.0 * e;
        }
        rows[static_cast<std::size_t>(row)] = sum;
    });
    double sum = 0.0;
    for (double r : rows)
        sum += r;
    return 0.5 * sum * n * n;
}

void SpectralBlock::at_sites(const Waves<double>& waves, VectorField<double>& field) {
#pragma omp parallel for schedule(static)
    for (int y = 0; y < waves.sites(); ++y)
        for (int c = 0; c < 3; ++c)
            std::copy_n(waves.row(c, y), 2 * waves.columns(), scratch_.row(c, y));
    transform_.backward(scratch_, field.plane(0));
}

void SpectralBlock::displace(double t, const Waves<double>& d,
                             const VectorField<double>& d_at_sites) {
    add(t, d, waves_);
    const VectorPlane<double> u = layer_.plane(0);
    const VectorPlane<const double> by = d_at_sites.plane(0);
#pragma omp parallel for schedule(static)
    for (int y = 0; y < tile_.ny; ++y)
        for (int x = 0; x < tile_.nx; ++x) {
            u.x(x, y) += t * by.x(x, y);
            u.y(x, y) += t * by.y(x, y);
            u.z(x, y) += t * by.z(x, y);
        }
}

void SpectralBlock::settle() { to_waves(layer_, waves_); }

void SpectralBlock::to_waves(const VectorField<double>& field, Waves<double>& waves) const {
    transform_.forward(field.plane(0), waves);
    const double sites = options_.sites, norm = 1.0 / (sites * sites);
#pragma omp parallel for schedule(static)
    for (int y = 0; y < waves.sites(); ++y)
        for (int c = 0; c < 3; ++c)
            for (int i = 0; i < 2 * waves.columns(); ++i)
                waves.row(c, y)[i] *= norm;
}

SurfaceMatrix SpectralBlock::stiffness(int nx, int ny) const {
    const auto at = [&](int e) { return table(e, ny)[nx]; };
    return {at(xx), at(yy), at(zz), at(xy), at(xz), at(yz)};
}

std::size_t SpectralBlock::bytes() const {
    return table_.size() * sizeof(double) + layer_.bytes() + force_.bytes() + waves_.bytes() +
           scratch_.bytes();
}

} // namespace asperity
