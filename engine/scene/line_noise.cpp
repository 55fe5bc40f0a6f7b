// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/scene/line_noise.hpp"

#include "engine/scene/heights.hpp"

#include <fftw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>

namespace asperity {

namespace {

using Complex = std::complex<double>;

/// Excess of the variance of differences, over that along the lines, from which noise is looked
/// for.
constexpr double least_excess = 0.5;
/// Correlation of successive differences above which an excess is roughness.
constexpr double most_correlation = -0.4;
/// Share of the energy of full contact below which noise is not worth a note.
constexpr double least_energy = 0.01;
/// Waves along an edge below which a spectrum has too few of them to compare directions.
constexpr double first_wave = 8.0;

/// Index of line i, point k of it.
struct Lines {
    std::size_t n;
    bool along_y;
    std::size_t operator()(int i, int k) const {
        const auto line = static_cast<std::size_t>(i), point = static_cast<std::size_t>(k);
        return along_y ? line * n + point : point * n + line;
    }
};
Lines lines_of(int n, bool along_y) { return {static_cast<std::size_t>(n), along_y}; }

/// Variance of the differences of neighbours across the lines, and covariance of successive ones.
struct Differences {
    double variance = 0.0, covariance = 0.0;
};
Differences differences(const std::vector<double>& h, int n, bool along_y) {
    const Lines at = lines_of(n, along_y);
    double mean = 0.0;
    for (int k = 0; k < n; ++k)
        mean += h[at(n - 1, k)] - h[at(0, k)];
    mean /= static_cast<double>(n) * (n - 1);
    Differences sum;
    for (int i = 0; i + 1 < n; ++i)
        for (int k = 0; k < n; ++k) {
            const double d = h[at(i + 1, k)] - h[at(i, k)] - mean;
            sum.variance += d * d;
            if (i + 2 < n) sum.covariance += d * (h[at(i + 2, k)] - h[at(i + 1, k)] - mean);
        }
    sum.variance /= static_cast<double>(n) * (n - 1);
    sum.covariance /= static_cast<double>(n) * (n - 2);
    return sum;
}

/// Returns the waves of a map without its mean plane and the jumps between its edges.
std::vector<Complex> waves_of(std::vector<double> h, int n) {
    const Bands map({}, n);
    heights::remove_plane(h, map);
    heights::remove_jumps(h, map);
    std::vector<Complex> wave(h.begin(), h.end());
    map.transform(wave, FFTW_FORWARD);
    return wave;
}

/// A wave of n x n points: wavenumbers along and across the lines, without their signs.
struct Wave {
    double along, across, q;
};
Wave wave_at(int i, int k, int n) {
    const double across = std::min(i, n - i), along = std::min(k, n - k);
    return {along, across, std::sqrt(along * along + across * across)};
}

/// Returns sum q |h_q|^2 of the waves that `kept` x `kept` points hold, up to a factor.
double flattening_energy(const std::vector<double>& h, int n, int kept) {
    const std::vector<Complex> wave = waves_of(h, n);
    const Lines at = lines_of(n, true);
    double sum = 0.0;
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < n; ++k) {
            const Wave w = wave_at(i, k, n);
            if (2.0 * std::max(w.along, w.across) <= kept) sum += w.q * std::norm(wave[at(i, k)]);
        }
    return sum;
}

double rms_slope(const std::vector<double>& h, int n, double pixel) {
    return std::sqrt(differences(h, n, true).variance + differences(h, n, false).variance) / pixel;
}

} // namespace

bool LineNoiseStatistics::found() const {
    return slope_ratio * slope_ratio > 1.0 + least_excess && correlation < most_correlation;
}

LineNoiseStatistics line_noise_statistics(const std::vector<double>& h, int n) {
    LineNoiseStatistics s;
    if (n < 3) return s;
    Differences slow = differences(h, n, true), fast = differences(h, n, false);
    s.along_y = slow.variance >= fast.variance;
    if (!s.along_y) std::swap(slow, fast);
    const double excess = slow.variance - fast.variance;
    if (!(excess > 0.0)) return s;
    s.slope_ratio = std::sqrt(slow.variance / std::max(fast.variance, 1e-12 * slow.variance));
    s.correlation = (slow.covariance - fast.covariance) / excess;
    return s;
}

void align_rows(std::vector<double>& h, int n, bool along_y) {
    const Lines at = lines_of(n, along_y);
    std::vector<double> offset(static_cast<std::size_t>(n)), step(static_cast<std::size_t>(n));
    double mean = 0.0, moment = 0.0, square = 0.0;
    for (int i = 1; i < n; ++i) {
        for (int k = 0; k < n; ++k)
            step[static_cast<std::size_t>(k)] = h[at(i, k)] - h[at(i - 1, k)];
        const auto middle = step.begin() + n / 2;
        std::nth_element(step.begin(), middle, step.end());
        offset[static_cast<std::size_t>(i)] = offset[static_cast<std::size_t>(i - 1)] + *middle;
        mean += offset[static_cast<std::size_t>(i)] / n;
    }
    for (int i = 0; i < n; ++i) {
        const double place = i - 0.5 * (n - 1);
        moment += place * offset[static_cast<std::size_t>(i)];
        square += place * place;
    }
    for (int i = 0; i < n; ++i) {
        const double place = i - 0.5 * (n - 1);
        const double off = offset[static_cast<std::size_t>(i)] - mean -
                           (square > 0.0 ? moment / square : 0.0) * place;
        for (int k = 0; k < n; ++k)
            h[at(i, k)] -= off;
    }
}

ExcessOfLines make_isotropic(std::vector<double>& h, int n, bool along_y, int kept) {
    std::vector<Complex> wave = waves_of(h, n);
    const Lines at = lines_of(n, along_y);
    struct Sum {
        double power = 0.0;
        int waves = 0;
    };
    const auto ring = [](const Wave& w) { return static_cast<std::size_t>(std::lround(w.q)); };
    std::vector<Sum> rings(static_cast<std::size_t>(n) + 1); // waves along the lines
    const auto each = [&](const auto& visit) {
        for (int i = 0; i < n; ++i)
            for (int k = 0; k < n; ++k)
                visit(wave_at(i, k, n), at(i, k));
    };
    each([&](const Wave& w, std::size_t j) {
        if (w.along < w.across) return;
        rings[ring(w)].power += std::norm(wave[j]);
        rings[ring(w)].waves += 1;
    });
    const auto expected = [&](const Wave& w) {
        const Sum& r = rings[ring(w)];
        return r.waves > 0 ? r.power / r.waves : 0.0;
    };
    // Boxes of waves across the lines: their mean power over what is expected of it.
    constexpr std::size_t across_boxes = 64, along_boxes = 32;
    const auto box = [](const Wave& w) {
        const auto along = w.along < 1.0 ? 0 : 1 + static_cast<std::size_t>(std::log2(w.along));
        return along * across_boxes + static_cast<std::size_t>(2.0 * std::log2(w.across));
    };
    const auto comparable = [&](const Wave& w) {
        return w.across > w.along && w.q >= first_wave && expected(w) > 0.0;
    };
    std::vector<Sum> boxes(across_boxes * along_boxes);
    each([&](const Wave& w, std::size_t j) {
        if (!comparable(w)) return;
        boxes[box(w)].power += std::norm(wave[j]) / expected(w);
        boxes[box(w)].waves += 1;
    });
    ExcessOfLines found;
    std::vector<double> removed(rings.size()); // by ring
    each([&](const Wave& w, std::size_t j) {
        const bool counts = 2.0 * std::max(w.along, w.across) <= kept;
        const double own = w.q * std::norm(wave[j]);
        if (counts) found.whole += own;
        const Sum b = comparable(w) ? boxes[box(w)] : Sum{};
        // Only b.waves / 2 are independent, because h_-q is the conjugate of h_q.
        const double ratio = b.waves > 0 ? b.power / b.waves : 1.0;
        const bool excess = ratio > 2.0 && ratio > 1.0 + 5.0 * std::sqrt(2.0 / b.waves);
        if (excess && counts) removed[ring(w)] += own * (1.0 - 1.0 / ratio);
        wave[j] *= excess ? 1.0 / std::sqrt(ratio) - 1.0 : 0.0; // the change
    });
    for (const double r : removed)
        found.energy += r;
    double shorter = 0.0;
    std::size_t q = removed.size();
    while (q > 1 && shorter < 0.9 * found.energy)
        shorter += removed[--q];
    found.wavelength = static_cast<double>(n) / static_cast<double>(q);
    Bands({}, n).transform(wave, FFTW_BACKWARD);
    for (std::size_t j = 0; j < wave.size(); ++j)
        h[j] += wave[j].real() / static_cast<double>(h.size());
    return found;
}

std::vector<std::string> treat_line_noise(std::vector<double>& h, int n, double pixel, int kept,
                                          LineNoise treatment) {
    const LineNoiseStatistics s = line_noise_statistics(h, n);
    if (!s.found() && treatment == LineNoise::keep) return {};
    const std::string said =
        fmt::format("neighbours along {} differ {:.3g} times as much as along {}, and this excess "
                    "is correlated by "
                    "{:.2f} from one difference to the next (independent lines: -0.5)",
                    s.along_y ? "y" : "x", s.slope_ratio, s.along_y ? "x" : "y", s.correlation);
    if (treatment == LineNoise::keep) {
        std::vector<double> copy = h;
        const ExcessOfLines excess = make_isotropic(copy, n, s.along_y, kept);
        if (excess.share() < least_energy) return {};
        copy = h;
        align_rows(copy, n, s.along_y);
        const double left = make_isotropic(copy, n, s.along_y, kept).energy;
        const bool rows = left < 0.1 * excess.energy;
        return {fmt::format(
            "line noise of the scan: {}. It has {:.0f} % of the energy that flattens the map (full "
            "contact), most of it in waves shorter than {:.3g} pixels; a simulation takes it for "
            "roughness, "
            "and "
            "adhesion comes out too low. surface.line_noise = \"{}\" takes it off{}",
            said, 100.0 * excess.share(), excess.wavelength, rows ? "align-rows" : "isotropic",
            rows ? ""
                 : fmt::format(" (aligning the rows would leave {:.0f} % of it)",
                               100.0 * left / excess.energy))};
    }
    const double rms = heights::rms_of(h, Bands({}, n)), slope = rms_slope(h, n, pixel),
                 energy = flattening_energy(h, n, kept);
    if (treatment == LineNoise::align_rows)
        align_rows(h, n, s.along_y);
    else
        make_isotropic(h, n, s.along_y, kept);
    const LineNoiseStatistics now = line_noise_statistics(h, n);
    return {fmt::format(
        "line noise of the scan: {}{}. surface.line_noise = \"{}\" changed the rms height from "
        "{:.4g} "
        "to {:.4g} Å, the rms slope from {:.3g} to {:.3g}, and the energy that flattens the map by "
        "{:+.1f} %{}",
        s.found() ? "" : "none was found, ", said,
        treatment == LineNoise::align_rows ? "align-rows" : "isotropic", rms,
        heights::rms_of(h, Bands({}, n)), slope, rms_slope(h, n, pixel),
        100.0 * (flattening_energy(h, n, kept) / energy - 1.0),
        !now.found() ? ""
        : treatment == LineNoise::align_rows
            ? "; noise within the rows is left, which \"isotropic\" takes off"
            : "; noise is left")};
}

} // namespace asperity
