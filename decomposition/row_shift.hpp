// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The Fourier shift of periodic rows of numbers.
//
// A row h(j), j = 0 .. n-1, is interpolated by the sum of its waves, h(x) = sum_k h_k exp(2 pi i k
// x/n), -n/2 < k < n/2, in which the shortest wave, of undetermined sign, is h_N cos(pi x): h is
// then real at every x, and a shift by a whole number of places is exact. Values and slopes at j +
// d are those of this sum, so that the slope is the derivative of the values with respect to d.
#pragma once

#include <complex>
#include <memory>
#include <vector>

namespace asperity {

/// The shift of rows of n numbers. Results are bitwise identical in any thread.
class RowShift {
public:
    using Complex = std::complex<double>;

    /// Makes the plans. Throws std::runtime_error if FFTW fails.
    explicit RowShift(int n);
    ~RowShift();
    RowShift(RowShift&&) noexcept;
    RowShift& operator=(RowShift&&) noexcept;

    /// Returns the number of waves of a row, n/2 + 1.
    std::size_t waves() const { return static_cast<std::size_t>(n_ / 2) + 1; }
    /// Sets waves to the coefficients h_k of a row.
    void transform(const double* row, Complex* waves) const;
    /// Returns exp(2 pi i k d/n) for each wave.
    std::vector<Complex> phases(double d) const;
    /// Sets values to the row at j + d, and slopes to its derivative with respect to d; each may be
    /// nullptr. phases: result of phases(d).
    void shift(const Complex* waves, const std::vector<Complex>& phases, double* values,
               double* slopes) const;

private:
    struct Plans;
    int n_;
    std::unique_ptr<Plans> plans_;
};

} // namespace asperity
