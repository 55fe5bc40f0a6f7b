// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "decomposition/row_shift.hpp"

#include <fftw3.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace asperity {

struct RowShift::Plans {
    fftw_plan forward = nullptr, backward = nullptr;

    explicit Plans(int n) {
        std::vector<double> row(static_cast<std::size_t>(n));
        std::vector<Complex> waves(static_cast<std::size_t>(n / 2) + 1);
        auto* const to = reinterpret_cast<fftw_complex*>(waves.data());
        constexpr unsigned how = FFTW_ESTIMATE | FFTW_UNALIGNED;
        forward = fftw_plan_dft_r2c_1d(n, row.data(), to, how | FFTW_PRESERVE_INPUT);
        backward = fftw_plan_dft_c2r_1d(n, to, row.data(), how);
        if (!forward || !backward)
            throw std::runtime_error("FFTW has no plan for a row of " + std::to_string(n));
    }
    Plans(const Plans&) = delete;
    Plans& operator=(const Plans&) = delete;
    ~Plans() {
        if (forward) fftw_destroy_plan(forward);
        if (backward) fftw_destroy_plan(backward);
    }
};

RowShift::RowShift(int n) : n_(n), plans_(std::make_unique<Plans>(n)) {}
RowShift::~RowShift() = default;
RowShift::RowShift(RowShift&&) noexcept = default;
RowShift& RowShift::operator=(RowShift&&) noexcept = default;

void RowShift::transform(const double* row, Complex* waves) const {
    // FFTW's interface has no const; PRESERVE_INPUT leaves the row.
    fftw_execute_dft_r2c(plans_->forward, const_cast<double*>(row),
                         reinterpret_cast<fftw_complex*>(waves));
}

std::vector<RowShift::Complex> RowShift::phases(double d) const {
    std::vector<Complex> list(waves());
    for (std::size_t k = 0; k < list.size(); ++k)
        list[k] = std::polar(1.0, 2.0 * std::numbers::pi * static_cast<double>(k) * d / n_);
    return list;
}

void RowShift::shift(const Complex* waves, const std::vector<Complex>& phases, double* values,
                     double* slopes) const {
    const double norm = 1.0 / n_, unit = 2.0 * std::numbers::pi / n_;
    std::vector<Complex> shifted(phases.size());
    // The imaginary part of the shortest wave is not read: its real part is that of the sum.
    const auto to_row = [&](double* row) {
        fftw_execute_dft_c2r(plans_->backward, reinterpret_cast<fftw_complex*>(shifted.data()),
                             row);
    };
    if (values) {
        for (std::size_t k = 0; k < shifted.size(); ++k)
            shifted[k] = norm * waves[k] * phases[k];
        to_row(values);
    }
    if (slopes) {
        for (std::size_t k = 0; k < shifted.size(); ++k)
            shifted[k] = Complex(0.0, norm * unit * static_cast<double>(k)) * waves[k] * phases[k];
        to_row(slopes);
    }
}

} // namespace asperity
