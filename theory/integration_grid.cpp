// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The grid of an integration: even in y = ln T + ln q. ln T because the first steps near the end of
// the adhesive branch happen at T/T_1 of 10⁻¹⁰ and less; ln q so that a stretch of the spectrum
// that adds hardly anything to T, while σ_a ∝ √q goes on growing, is still resolved. Refinement
// halves every interval, so the grids are nested and the error has the clean expansion that
// Richardson needs.
#include "theory/integration.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace asperity::theory {
namespace {

constexpr double deviations = 9; // erfc(9/√2)/2 = 1.1e-19

/// The boundary as it would be at full contact.
class FullContact {
public:
    FullContact(const Spectrum& spectrum, AreaReading reading, const IntegrationInput& input)
        : spectrum_(spectrum), reading_(reading), in_(input) {}

    [[nodiscard]] double T(const Magnification& m) const {
        return std::numbers::pi / 2 * in_.contact_modulus * in_.contact_modulus * m.slope;
    }
    [[nodiscard]] double energy(const Magnification& m) const {
        return std::numbers::pi / 2 * in_.contact_modulus * m.energy;
    }
    [[nodiscard]] double stretch(const Magnification& m) const {
        return area_factor(reading_, 2 * std::numbers::pi * m.slope);
    }
    /// Distance from the start of the path to the boundary.
    [[nodiscard]] double distance(const Magnification& m) const {
        const double gamma = (in_.g0 + energy(m)) / stretch(m);
        return std::sqrt(std::max(gamma, 0.0) * in_.contact_modulus * m.q) + in_.pressure;
    }
    /// Positive where the boundary is still out of reach.
    [[nodiscard]] double margin(double y) const {
        const Magnification m = spectrum_.at_coordinate(y);
        const double T_here = T(m);
        return T_here > 0 ? distance(m) - deviations * std::sqrt(T_here)
                          : std::numeric_limits<double>::infinity();
    }

private:
    const Spectrum& spectrum_;
    AreaReading reading_;
    IntegrationInput in_;
};

/// Marks from begin to end: even, or with steps that grow away from the onset.
std::vector<double> marks(double begin, double end, double spacing, std::optional<double> onset) {
    std::vector<double> y{begin};
    if (!onset || *onset < begin - spacing || *onset > end + spacing) {
        const int steps = std::max(1, static_cast<int>(std::ceil((end - begin) / spacing)));
        for (int k = 1; k < steps; ++k)
            y.push_back(begin + (end - begin) * k / steps);
    } else {
        constexpr double growth = 0.3, finest = 1.0 / 32;
        const auto step = [&](double distance) {
            return std::clamp(growth * distance, finest * spacing, spacing);
        };
        std::vector<double> below;
        for (double d = 0; *onset - d > begin; d += step(d))
            if (*onset - d < end) below.push_back(*onset - d);
        y.insert(y.end(), below.rbegin(), below.rend());
        for (double d = step(0); *onset + d < end; d += step(d))
            if (*onset + d > begin) y.push_back(*onset + d);
    }
    y.push_back(end);
    return y;
}

} // namespace

IntegrationGrid make_grid(const Spectrum& spectrum, AreaReading reading,
                          const IntegrationInput& input, double spacing, int refinement,
                          std::optional<double> onset) {
    const FullContact full(spectrum, reading, input);
    IntegrationGrid grid;
    const auto add = [&](const Magnification& m) {
        grid.q.push_back(m.q);
        grid.T.push_back(full.T(m));
        grid.energy.push_back(full.energy(m));
        grid.stretch.push_back(full.stretch(m));
    };
    const Magnification end = spectrum.last();
    const auto bands = spectrum.bands();
    const auto out_of_reach = [&] {
        grid = {};
        add(spectrum.at(spectrum.q_L()));
        add(end);
        grid.ever_detaches = false;
        return grid;
    };
    if (bands.empty()) return out_of_reach();

    // A variance surely before the start: the smallest distance the boundary ever has (seen in
    // a coarse look over the bands), at its steepest growth.
    double least = full.distance(spectrum.at(spectrum.q_L()));
    for (const auto& band : bands)
        for (int k = 1; k <= 16; ++k) {
            const double begin = std::max(band.y_begin, band.y_end - 8);
            least = std::min(least, full.distance(spectrum.at_coordinate(
                                        begin + k * (band.y_end - begin) / 16)));
        }
    least = std::max(least, 1e-150 * std::sqrt(full.T(end)));
    const double y_last = bands.back().y_end;
    const double y_first = y_last + 2 * std::log(least / (2 * deviations)) - std::log(full.T(end)) -
                           std::log(end.q / spectrum.q_L()) - 1;

    // Walk up to the first change of sign of the margin, then bisect onto it.
    double y_start = y_last, y_before = y_first;
    bool found = false;
    const double stride = std::max(spacing, 0.05);
    for (const auto& band : bands) {
        double y = std::max(band.y_begin, y_first);
        const int steps = std::max(1, static_cast<int>(std::ceil((band.y_end - y) / stride)));
        if (y >= band.y_end) continue;
        const double step = (band.y_end - y) / steps;
        for (int k = 0; k <= steps && !found; ++k) {
            const double here = k == steps ? band.y_end : y + k * step;
            if (full.margin(here) <= 0) {
                found = true;
                y_start = here;
            } else {
                y_before = here;
            }
        }
        if (found) break;
    }
    if (!found) return out_of_reach();
    for (int k = 0; k < 50 && y_before < y_start; ++k) {
        const double middle = (y_before + y_start) / 2;
        (full.margin(middle) <= 0 ? y_start : y_before) = middle;
    }
    y_start = y_before;

    const int halvings = 1 << refinement;
    bool first = true;
    for (const auto& band : bands) {
        const double begin = std::max(band.y_begin, y_start);
        if (begin >= band.y_end) continue;
        const Magnification m0 = spectrum.at_coordinate(begin);
        if (first || m0.q > grid.q.back()) {
            add(m0);
            if (!first) { // the far edge of a gap: the variance does not grow, to the last bit
                grid.T.back() = grid.T[grid.T.size() - 2];
                grid.energy.back() = grid.energy[grid.energy.size() - 2];
            }
        }
        first = false;
        const std::vector<double> y = marks(begin, band.y_end, spacing, onset);
        for (std::size_t i = 1; i < y.size(); ++i)
            for (int k = 1; k <= halvings; ++k)
                add(spectrum.at_coordinate(y[i] - (y[i] - y[i - 1]) * (halvings - k) / halvings));
    }
    // Rounding at the end of the last band must not leave a sliver of the spectrum out.
    grid.q.back() = std::min(end.q, grid.q.back());
    grid.T.back() = full.T(end);
    grid.energy.back() = full.energy(end);
    grid.stretch.back() = full.stretch(end);
    if (spectrum.q1() > grid.q.back()) add(end);
    return grid;
}

} // namespace asperity::theory
