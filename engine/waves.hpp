// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Vector fields on the block's lowest layer as plane waves: u(r) = sum_q u_q exp(i q r).
//
// u is real, so half of the waves say everything: columns q_x = 0 .. N/2, rows q_y = 0 .. N-1 (the
// upper half of which are negative). A sum over all waves counts the columns inside twice. With u_q
// normalised like this, Parseval reads  sum_r a.b = N^2 sum_q conj(a_q).b_q.
//
// Transforms are FFTW's real ones, with its threads where the library has them. Plans are made by
// estimate, not by measurement, so that two runs do the same arithmetic; sums over waves go row by
// row and then in the order of the rows, whatever the number of threads.
#pragma once

#include "kernels/views.hpp"

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <vector>

namespace asperity {

/// Coefficients of the three components, each [q_y][q_x] as (real, imaginary) pairs of T.
template <class T>
class Waves {
public:
    Waves() = default;
    explicit Waves(int sites)
        : sites_(sites), columns_(sites / 2 + 1),
          component_(
              (2 * static_cast<std::size_t>(sites) * static_cast<std::size_t>(columns_) + 15) / 16 *
              16) {
        data_.reset(static_cast<T*>(std::aligned_alloc(64, 3 * component_ * sizeof(T))));
        if (!data_) throw std::bad_alloc();
#pragma omp parallel for schedule(static)
        for (int y = 0; y < sites_; ++y)
            for (int c = 0; c < 3; ++c)
                for (int i = 0; i < 2 * columns_; ++i)
                    row(c, y)[i] = T(0);
    }

    int sites() const { return sites_; }
    int columns() const { return columns_; }
    T* component(int c) { return data_.get() + static_cast<std::size_t>(c) * component_; }
    T* row(int c, int y) { return component(c) + offset(y); }
    const T* row(int c, int y) const {
        return data_.get() + static_cast<std::size_t>(c) * component_ + offset(y);
    }
    std::size_t bytes() const { return 3 * component_ * sizeof(T); }

private:
    std::size_t offset(int y) const {
        return 2 * static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_);
    }
    struct Free {
        void operator()(void* p) const { std::free(p); }
    };
    int sites_ = 0, columns_ = 0;
    std::size_t component_ = 0;
    std::unique_ptr<T[], Free> data_;
};

/// sum_r a.b of the fields that the waves stand for.
template <class A, class B>
double dot(const Waves<A>& a, const Waves<B>& b) {
    const int n = a.sites(), columns = a.columns();
    std::vector<double> rows(static_cast<std::size_t>(n));
#pragma omp parallel for schedule(static)
    for (int y = 0; y < n; ++y) {
        double all = 0.0, once = 0.0; // once: columns that have no mirror image
        for (int c = 0; c < 3; ++c) {
            const A* p = a.row(c, y);
            const B* q = b.row(c, y);
            double even = 0.0, odd = 0.0; // two chains keep the adders busy
            for (int i = 0; i < columns; ++i) {
                even += static_cast<double>(p[2 * i]) * static_cast<double>(q[2 * i]);
                odd += static_cast<double>(p[2 * i + 1]) * static_cast<double>(q[2 * i + 1]);
            }
            all += even + odd;
            const auto column = [&](int i) {
                return static_cast<double>(p[2 * i]) * static_cast<double>(q[2 * i]) +
                       static_cast<double>(p[2 * i + 1]) * static_cast<double>(q[2 * i + 1]);
            };
            once += column(0);
            if (n % 2 == 0) once += column(columns - 1);
        }
        rows[static_cast<std::size_t>(y)] = 2.0 * all - once;
    }
    double sum = 0.0;
    for (double r : rows)
        sum += r;
    return sum * n * n;
}

/// y <- y + a x
template <class X, class Y>
void add(double a, const Waves<X>& x, Waves<Y>& y) {
#pragma omp parallel for schedule(static)
    for (int k = 0; k < x.sites(); ++k)
        for (int c = 0; c < 3; ++c) {
            const X* from = x.row(c, k);
            Y* to = y.row(c, k);
            for (int i = 0; i < 2 * x.columns(); ++i)
                to[i] =
                    static_cast<Y>(static_cast<double>(to[i]) + a * static_cast<double>(from[i]));
        }
}

/// The transform between the sites of a layer and its waves; T is double or float.
template <class T>
class SurfaceTransform {
public:
    /// row: distance between the rows of the fields to be transformed.
    SurfaceTransform(int sites, std::ptrdiff_t row);
    ~SurfaceTransform();
    SurfaceTransform(SurfaceTransform&&) noexcept;
    SurfaceTransform& operator=(SurfaceTransform&&) noexcept;

    /// N^2 u_q of the field.
    void forward(const VectorPlane<const T>& field, Waves<T>& waves) const;
    /// The field of waves, which are lost.
    void backward(Waves<T>& waves, const VectorPlane<T>& field) const;

private:
    struct Plans;
    std::unique_ptr<Plans> plans_;
};

} // namespace asperity
