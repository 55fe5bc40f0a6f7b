// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/waves.hpp"

#include <fftw3.h>
#include <fmt/format.h>
#include <omp.h>

#include <stdexcept>
#include <type_traits>

namespace asperity {

namespace {

/// FFTW's names for the two precisions.
struct DoubleFftw {
    using Plan = fftw_plan;
    using Complex = fftw_complex;
    static constexpr auto forward = fftw_plan_many_dft_r2c;
    static constexpr auto backward = fftw_plan_many_dft_c2r;
    static constexpr auto run_forward = fftw_execute_dft_r2c;
    static constexpr auto run_backward = fftw_execute_dft_c2r;
    static constexpr auto destroy = fftw_destroy_plan;
#if ASPERITY_FFTW_THREADS
    static constexpr auto init_threads = fftw_init_threads;
    static constexpr auto threads = fftw_plan_with_nthreads;
#endif
};
struct FloatFftw {
    using Plan = fftwf_plan;
    using Complex = fftwf_complex;
    static constexpr auto forward = fftwf_plan_many_dft_r2c;
    static constexpr auto backward = fftwf_plan_many_dft_c2r;
    static constexpr auto run_forward = fftwf_execute_dft_r2c;
    static constexpr auto run_backward = fftwf_execute_dft_c2r;
    static constexpr auto destroy = fftwf_destroy_plan;
#if ASPERITY_FFTW_THREADS
    static constexpr auto init_threads = fftwf_init_threads;
    static constexpr auto threads = fftwf_plan_with_nthreads;
#endif
};
template <class T>
using Fftw = std::conditional_t<std::is_same_v<T, double>, DoubleFftw, FloatFftw>;

} // namespace

template <class T>
struct SurfaceTransform<T>::Plans {
    typename Fftw<T>::Plan forward = nullptr, backward = nullptr;
    Plans() = default;
    Plans(const Plans&) = delete;
    Plans& operator=(const Plans&) = delete;
    ~Plans() {
        if (forward) Fftw<T>::destroy(forward);
        if (backward) Fftw<T>::destroy(backward);
    }
};

template <class T>
SurfaceTransform<T>::SurfaceTransform(int sites, std::ptrdiff_t row)
    : plans_(std::make_unique<Plans>()) {
    using F = Fftw<T>;
#if ASPERITY_FFTW_THREADS
    static const bool threaded = F::init_threads() != 0;
    if (threaded) F::threads(omp_get_max_threads());
#endif
    // A plan depends on strides and alignment only; one made on these arrays serves all.
    Waves<T> waves(sites);
    const auto length = static_cast<std::size_t>(row) * static_cast<std::size_t>(sites);
    const std::unique_ptr<T, void (*)(void*)> field(
        static_cast<T*>(std::aligned_alloc(64, (length + 15) / 16 * 16 * sizeof(T))), std::free);
    if (!field) throw std::bad_alloc();
    auto* const complex = reinterpret_cast<typename F::Complex*>(waves.component(0));
    const int n[2] = {sites, sites}, real[2] = {sites, static_cast<int>(row)},
              half[2] = {sites, waves.columns()};
    plans_->forward =
        F::forward(2, n, 1, field.get(), real, 1, 0, complex, half, 1, 0, FFTW_ESTIMATE);
    plans_->backward =
        F::backward(2, n, 1, complex, half, 1, 0, field.get(), real, 1, 0, FFTW_ESTIMATE);
#if ASPERITY_FFTW_THREADS
    if (threaded) F::threads(1); // as others expect it
#endif
    if (!plans_->forward || !plans_->backward)
        throw std::runtime_error(fmt::format("FFTW has no plan for {0} x {0} sites", sites));
}

template <class T>
SurfaceTransform<T>::~SurfaceTransform() = default;
template <class T>
SurfaceTransform<T>::SurfaceTransform(SurfaceTransform&&) noexcept = default;
template <class T>
SurfaceTransform<T>& SurfaceTransform<T>::operator=(SurfaceTransform&&) noexcept = default;

template <class T>
void SurfaceTransform<T>::forward(const VectorPlane<const T>& field, Waves<T>& waves) const {
    const T* const in[3] = {field.x.origin, field.y.origin, field.z.origin};
    for (int c = 0; c < 3; ++c) // out of place, FFTW only reads
        Fftw<T>::run_forward(plans_->forward, const_cast<T*>(in[c]),
                             reinterpret_cast<typename Fftw<T>::Complex*>(waves.component(c)));
}

template <class T>
void SurfaceTransform<T>::backward(Waves<T>& waves, const VectorPlane<T>& field) const {
    T* const out[3] = {field.x.origin, field.y.origin, field.z.origin};
    for (int c = 0; c < 3; ++c)
        Fftw<T>::run_backward(plans_->backward,
                              reinterpret_cast<typename Fftw<T>::Complex*>(waves.component(c)),
                              out[c]);
}

template class SurfaceTransform<double>;
template class SurfaceTransform<float>;

} // namespace asperity
