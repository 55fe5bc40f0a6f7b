// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "decomposition/surface_transform.hpp"

#include "decomposition/process_grid.hpp"

#include <fftw3-mpi.h>
#include <omp.h>

#include <algorithm>
#include <stdexcept>
#include <string>
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
    static constexpr auto init_ranks = fftw_mpi_init;
    static constexpr auto slab_forward = fftw_mpi_plan_dft_r2c_2d;
    static constexpr auto slab_backward = fftw_mpi_plan_dft_c2r_2d;
    static constexpr auto run_slab_forward = fftw_mpi_execute_dft_r2c;
    static constexpr auto run_slab_backward = fftw_mpi_execute_dft_c2r;
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
    static constexpr auto init_ranks = fftwf_mpi_init;
    static constexpr auto slab_forward = fftwf_mpi_plan_dft_r2c_2d;
    static constexpr auto slab_backward = fftwf_mpi_plan_dft_c2r_2d;
    static constexpr auto run_slab_forward = fftwf_mpi_execute_dft_r2c;
    static constexpr auto run_slab_backward = fftwf_mpi_execute_dft_c2r;
#if ASPERITY_FFTW_THREADS
    static constexpr auto init_threads = fftwf_init_threads;
    static constexpr auto threads = fftwf_plan_with_nthreads;
#endif
};
template <class T>
using Fftw = std::conditional_t<std::is_same_v<T, double>, DoubleFftw, FloatFftw>;

MPI_Comm mpi_of(const Communicator& ranks) { return MPI_Comm_f2c(ranks.handle()); }

/// FFTW's threads are to start before its ranks.
template <class T>
bool start_threads() {
#if ASPERITY_FFTW_THREADS
    static const bool threaded = Fftw<T>::init_threads() != 0;
    return threaded;
#else
    return false;
#endif
}
template <class T>
void start_ranks() {
    start_threads<T>();
    static const bool started = (Fftw<T>::init_ranks(), true);
    (void)started;
}

} // namespace

Slab::Slab(int n, const Communicator& communicator) : ranks(communicator), sites(n) {
    const Tile mine = ProcessGrid::slabs(ranks.size(), ranks.rank(), sites).tile(0);
    first = mine.y0;
    rows = mine.ny;
    capacity = static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns());
    if (ranks.size() == 1) return;
    start_ranks<double>();
    std::ptrdiff_t its_rows = 0, its_first = 0;
    capacity = static_cast<std::size_t>(
        fftw_mpi_local_size_2d(sites, columns(), mpi_of(ranks), &its_rows, &its_first));
    if (its_rows != rows || its_first != first)
        throw std::logic_error("FFTW-MPI cuts the surface into other slabs than the process grid");
}

std::vector<double> RowSums::total() const {
    std::vector<double> mine(sums_, 0.0);
    for (std::size_t i = 0; i < parts_.size(); ++i)
        mine[i % sums_] += parts_[i];
    const auto ranks = static_cast<std::size_t>(slab_.ranks.size());
    std::vector<double> all(ranks * sums_);
    slab_.ranks.all_gather(mine, std::vector<int>(ranks, static_cast<int>(sums_)), all);
    std::fill(mine.begin(), mine.end(), 0.0);
    for (std::size_t i = 0; i < all.size(); ++i)
        mine[i % sums_] += all[i];
    for (double& sum : mine)
        sum *= static_cast<double>(slab_.sites) * slab_.sites;
    return mine;
}

template <class T>
struct SurfaceTransform<T>::Plans {
    typename Fftw<T>::Plan forward = nullptr, backward = nullptr;
    bool slabs = false; ///< in place, in the waves: FFTW-MPI's rows of the field are as long
    Plans() = default;
    Plans(const Plans&) = delete;
    Plans& operator=(const Plans&) = delete;
    ~Plans() {
        if (forward) Fftw<T>::destroy(forward);
        if (backward) Fftw<T>::destroy(backward);
    }
};

template <class T>
SurfaceTransform<T>::SurfaceTransform(const Slab& slab, std::ptrdiff_t row)
    : plans_(std::make_unique<Plans>()) {
    using F = Fftw<T>;
    const bool threaded = start_threads<T>();
#if ASPERITY_FFTW_THREADS
    if (threaded) F::threads(omp_get_max_threads());
#endif
    // A plan depends on strides and alignment only; one made on these arrays is valid for all.
    Waves<T> waves(slab, 1);
    auto* const complex = reinterpret_cast<typename F::Complex*>(waves.component(0));
    plans_->slabs = slab.ranks.size() > 1;
    if (plans_->slabs) {
        start_ranks<T>();
        plans_->forward = F::slab_forward(slab.sites, slab.sites, waves.component(0), complex,
                                          mpi_of(slab.ranks), FFTW_ESTIMATE);
        plans_->backward = F::slab_backward(slab.sites, slab.sites, complex, waves.component(0),
                                            mpi_of(slab.ranks), FFTW_ESTIMATE);
    } else {
        Field<T> field(slab.tile(), 1, 0);
        const int n[2] = {slab.sites, slab.sites};
        const int real[2] = {slab.sites, static_cast<int>(row)};
        const int half[2] = {slab.sites, slab.columns()};
        T* const sites = field.plane(0).origin;
        plans_->forward =
            F::forward(2, n, 1, sites, real, 1, 0, complex, half, 1, 0, FFTW_ESTIMATE);
        plans_->backward =
            F::backward(2, n, 1, complex, half, 1, 0, sites, real, 1, 0, FFTW_ESTIMATE);
    }
#if ASPERITY_FFTW_THREADS
    if (threaded) F::threads(1); // as others expect it
#else
    (void)threaded;
#endif
    if (!plans_->forward || !plans_->backward)
        throw std::runtime_error("FFTW has no plan for a surface of " + std::to_string(slab.sites) +
                                 " sites across");
}

template <class T>
SurfaceTransform<T>::~SurfaceTransform() = default;
template <class T>
SurfaceTransform<T>::SurfaceTransform(SurfaceTransform&&) noexcept = default;
template <class T>
SurfaceTransform<T>& SurfaceTransform<T>::operator=(SurfaceTransform&&) noexcept = default;

template <class T>
void SurfaceTransform<T>::forward(const PlaneView<const T>& field, Waves<T>& waves,
                                  int component) const {
    auto* const complex = reinterpret_cast<typename Fftw<T>::Complex*>(waves.component(component));
    if (!plans_->slabs) { // out of place, FFTW only reads
        Fftw<T>::run_forward(plans_->forward, const_cast<T*>(field.origin), complex);
        return;
    }
    for (int y = 0; y < waves.rows(); ++y)
        std::copy_n(field.line(y), field.nx, waves.row(component, y));
    Fftw<T>::run_slab_forward(plans_->forward, waves.component(component), complex);
}

template <class T>
void SurfaceTransform<T>::backward(Waves<T>& waves, int component,
                                   const PlaneView<T>& field) const {
    auto* const complex = reinterpret_cast<typename Fftw<T>::Complex*>(waves.component(component));
    if (!plans_->slabs) {
        Fftw<T>::run_backward(plans_->backward, complex, field.origin);
        return;
    }
    Fftw<T>::run_slab_backward(plans_->backward, complex, waves.component(component));
    for (int y = 0; y < waves.rows(); ++y)
        std::copy_n(waves.row(component, y), field.nx, field.line(y));
}

template class SurfaceTransform<double>;
template class SurfaceTransform<float>;

} // namespace asperity
