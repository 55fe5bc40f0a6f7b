// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Eqs. (1) to (5): from a contact to a state, on grids each twice as fine as the one before.
//
// On each, g0 = γ_eff(1) is the root of γ_eff(ζ_1) = Δγ (stress_distribution.hpp): on the first by
// Boost's TOMS 748, on the others by secants from there. It lies between two known ends. From
// below, at p <= 0, g0 > p²/(E* q_L), or the boundary would start behind the load; at p > 0, g0 >=
// -U_full, because U_el never exceeds its value at full contact. From above, g0 <= Δγ S(q1). At p
// <= 0 the unknown is ln(g0 - p²/E* q_L): near the end of the branch γ_eff falls as the fourth
// power of A. At p = 0 no contact is always a solution; the one wanted is the largest, so the
// search comes down from above.
#include "theory/persson.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include <boost/math/tools/toms748_solve.hpp>

#include "theory/error.hpp"
#include "theory/stress_distribution.hpp"

namespace asperity::theory {

namespace {

constexpr double tolerance = 1e-3;   ///< largest error of γ_eff/Δγ and A/A0
constexpr double least_error = 5e-5; ///< two grids may agree by chance
constexpr int finest = 3;            ///< level of the finest grid that is tried
constexpr double spacing_of(int level) { return 0.16 / (1 << level); }
constexpr int nodes_of(int level) { return 4 << level; }

/// Returns the root between a and b, at which f has opposite signs.
template <class F>
double root_between(F&& f, double a, double b, double fa, double fb, double close_enough) {
    if (fa == 0 || fb == 0) return fa == 0 ? a : b;
    if (a > b) return root_between(f, b, a, fb, fa, close_enough);
    std::uintmax_t iterations = 100;
    const auto close = [=](double u, double v) { return std::abs(u - v) <= close_enough; };
    const auto bracket = boost::math::tools::toms748_solve(f, a, b, fa, fb, close, iterations);
    return (bracket.first + bracket.second) / 2;
}

/// Returns the root of a rising function next to x, looked for up to `reach` from x in steps that
/// grow from `step`.
template <class F>
std::optional<double> root_near(F&& f, double x, double step, double reach, double close_enough) {
    double fx = f(x);
    for (const double start = x, sign = fx > 0 ? -1 : 1; std::abs(x - start) < reach; step *= 2) {
        const double next = x + sign * step, f_next = f(next);
        if (f_next * fx <= 0) return root_between(f, x, next, fx, f_next, close_enough);
        x = next;
        fx = f_next;
    }
    return std::nullopt;
}

/// Returns the root next to x of a function that rises there, by secants from x and from `step`
/// beside it: the last of them has |f| <= small.
template <class F>
std::optional<double> root_by_secants(F&& f, double x, double step, double reach, double small) {
    double x0 = x, f0 = f(x0), x1 = f0 > 0 ? x0 - step : x0 + step;
    for (int i = 0; i < 10 && std::abs(x1 - x) < reach; ++i) {
        const double f1 = f(x1), slope = (f1 - f0) / (x1 - x0);
        if (!(slope > 0)) break;
        if (std::abs(f1) <= small) return x1;
        x0 = x1;
        f0 = f1;
        x1 -= f1 / slope;
    }
    return std::nullopt;
}

/// The contact on the grid of one level, and its unknown g0 as a coordinate x to search in.
class OnGrid {
public:
    OnGrid(const AdhesiveContact& contact, int level)
        : at(stress_steps(contact, spacing_of(level))), contact_(contact), nodes_(nodes_of(level)),
          close_(level == 0 ? 1e-5 : 1e-8), pressing_(contact.pressure > 0) {
        const FullContactState full = full_contact(contact);
        highest_ = contact.work_of_adhesion * full.real_area;
        lowest_ = pressing_ ? -full.elastic_energy
                            : contact.pressure * contact.pressure /
                                  (contact.contact_modulus * contact.spectrum.q_L());
    }

    const std::vector<StressStep> at;

    /// Returns the solution for g0, which is kept until the next one.
    const StressPath& path(double g0) {
        if (g0 != solved_) path_ = stress_path(contact_, at, g0, nodes_);
        solved_ = g0;
        return path_;
    }
    [[nodiscard]] double g0(double x) const {
        return pressing_ ? lowest_ + x * (highest_ - lowest_)
                         : lowest_ + contact_.work_of_adhesion * std::exp(x);
    }
    /// Returns γ_eff(ζ_1)/Δγ - 1; under a load times the area.
    [[nodiscard]] double excess(double x, double* area = nullptr) {
        const StressPath& found = path(g0(x));
        if (area != nullptr) *area = found.area.back();
        const double excess = found.gamma.back() / contact_.work_of_adhesion - 1;
        return pressing_ ? excess * found.area.back() : excess;
    }

    /// Returns x of the largest g0, searched without a start. `missed`: the least excess if there
    /// is none.
    [[nodiscard]] std::optional<double> search(double& missed) {
        missed = HUGE_VAL;
        if (!(highest_ > lowest_)) return std::nullopt;
        const auto f = [&](double x) { return excess(x); };
        double high = pressing_ ? 1 : std::log((highest_ - lowest_) / contact_.work_of_adhesion);
        double f_high = f(high);
        if (f_high <= 0) return high; // exactly zero in the continuum, at full contact
        const double bottom = pressing_     ? 0
                              : lowest_ > 0 ? std::log(1e-6 * lowest_ / contact_.work_of_adhesion)
                                            : -60;
        for (double step = pressing_ ? 1 : 0.3; high > bottom; step = std::min(2.0, 1.5 * step)) {
            double area = 1;
            const double low = std::max(bottom, high - step), f_low = excess(low, &area);
            missed = std::min(missed, f_low);
            if (f_low <= 0) return root_between(f, low, high, f_low, f_high, close_);
            if (lowest_ == 0 && area < 1e-4) break; // the branch has ended
            high = low;
            f_high = f_low;
        }
        return pressing_ ? std::optional(0.0) : std::nullopt;
    }
    /// Returns x of the largest g0, next to the root on a coarser grid.
    [[nodiscard]] std::optional<double> search_near(double x, double& missed) {
        const auto f = [&](double y) { return excess(y); };
        const auto near = root_by_secants(f, x, 1e-4, 0.2, 1e-7);
        return near ? near : search(missed);
    }

    /// Returns the excess at the end of the adhesive branch: g0 at its lower end, or zero under a
    /// load. zero_load_x: at zero load the x to start from, and that of the excess.
    [[nodiscard]] double excess_at_end(double& zero_load_x) {
        if (!(highest_ > lowest_)) return 1.0; // pulled harder than even full contact bears
        if (pressing_) return excess(-lowest_ / (highest_ - lowest_));
        if (lowest_ > 0) return excess(std::log(1e-6 * lowest_ / contact_.work_of_adhesion));
        // Zero load: g0 -> 0 with A -> 0; what is left of A² is the error of stopping short. W must
        // be in its linear part, a² << β.
        const double small = std::clamp(0.01 * std::sqrt(contact_.beta), 1e-4, 1e-2);
        double area = 1, value = excess(zero_load_x, &area);
        while (area > small && zero_load_x > -100)
            value = excess(zero_load_x *= 1.5, &area);
        return value;
    }

private:
    const AdhesiveContact& contact_;
    int nodes_;
    double close_; ///< tolerance of a root; that of the coarse grid is followed up
    bool pressing_;
    double lowest_ = 0, highest_ = 0;                          // limits of g0
    double solved_ = std::numeric_limits<double>::quiet_NaN(); // g0 of path_
    StressPath path_;
};

/// Returns the state of a path, whose first point is ζ = 1.
ContactState state_of(const AdhesiveContact& c, const std::vector<StressStep>& at,
                      const StressPath& path) {
    ContactState s;
    s.gamma_eff = path.gamma.front();
    s.gamma_ratio = c.work_of_adhesion > 0 ? s.gamma_eff / c.work_of_adhesion : 0;
    s.area = std::clamp(path.area.back(), 0.0, 1.0);
    s.elastic_energy = path.energy.back();
    for (std::size_t i = 0; i < at.size(); ++i) {
        const double zeta = i == 0 ? 1 : at[i].q / c.spectrum.q_L();
        // Next to ζ = 1 nothing happens as long as contact is full.
        if (i > 0 && i < path.start && zeta < 1.01) continue;
        s.profile.push_back({zeta * c.spectrum.q_L(), zeta, path.area[i],
                             path.area[i] * at[i].stretch, path.gamma[i], path.detachment_stress[i],
                             s.elastic_energy - path.energy[i], at[i].T});
    }
    s.status = s.gamma_eff > 0 ? Status::adhesive : Status::pressed;
    return s;
}

/// Returns the state on a smooth surface.
ContactState smooth_contact(const AdhesiveContact& c) {
    const double g = c.work_of_adhesion, q_L = c.spectrum.q_L();
    const double limit = std::sqrt(g * c.contact_modulus * q_L);
    if (c.pressure + limit <= 0) return ContactState(); // pulled off, or nothing holds
    return state_of(c, {{q_L, 0, 0, 1}, {c.spectrum.q1(), 0, 0, 1}},
                    {{1, 1}, {0, 0}, {g, g}, {limit, limit}, 1});
}

/// Returns the state of full contact at all magnifications, if the distribution never meets the
/// boundary.
std::optional<ContactState> conforming(OnGrid& grid, const AdhesiveContact& c) {
    const StressPath& path = grid.path(full_contact(c).gamma);
    if (path.area.back() < 1 || path.detachment_stress.front() + c.pressure <= 0) return {};
    return state_of(c, grid.at, path);
}

/// Solves on one grid. x: the root, started from that on a coarser grid.
std::optional<ContactState> solve_on(OnGrid& grid, const AdhesiveContact& c,
                                     std::optional<double>& x, double& missed) {
    if (c.work_of_adhesion > 0) {
        x = x ? grid.search_near(*x, missed) : grid.search(missed);
        if (!x) return std::nullopt;
        return state_of(c, grid.at, grid.path(grid.g0(*x)));
    }
    if (!(c.pressure > 0)) return std::nullopt;
    // The boundary stays at zero stress: any g0 that is low enough gives the elastic energy.
    const double energy = grid.path(grid.g0(0)).energy.back();
    return state_of(c, grid.at, grid.path(-energy));
}

} // namespace

ContactState solve(const AdhesiveContact& c) {
    check(c);
    if (c.spectrum.smooth()) return smooth_contact(c);
    ContactState s;
    std::optional<double> x;
    double missed = HUGE_VAL;
    for (int level = 0; level <= finest; ++level) {
        OnGrid grid(c, level);
        if (level == 0)
            if (auto full = conforming(grid, c)) return *full;
        auto now = solve_on(grid, c, x, missed);
        if (!now && level == 0 && missed < 0.03) continue; // a coarse grid may miss the very end
        if (!now) return {};
        const double size = std::max(1.0, std::abs(now->gamma_ratio));
        now->gamma_ratio_error =
            std::max(std::abs(now->gamma_ratio - s.gamma_ratio), least_error * size);
        now->area_error = std::max(std::abs(now->area - s.area), least_error);
        s = std::move(*now);
        s.converged = s.gamma_ratio_error <= tolerance * size && s.area_error <= tolerance;
        if (level > 0 && s.converged) break;
    }
    return s;
}

CriticalRoughness critical_roughness(const AdhesiveContact& c) {
    check(c);
    if (c.work_of_adhesion == 0 || (c.beta == 0 && c.pressure == 0))
        throw NoSolution(message("critical roughness: work of adhesion ", c.work_of_adhesion,
                                 ", beta ", c.beta,
                                 ": there is no adhesion, or with beta = 0 a "
                                 "sparse contact costs a^3 and gains a, so that adhesion fades but "
                                 "never ends; give both a positive value"));
    const auto at_roughness = [&](double log_h) {
        AdhesiveContact scaled = c;
        scaled.spectrum = c.spectrum.with_rms_height(std::exp(log_h));
        return scaled;
    };
    // Adhesion would end at this roughness if the area were fixed and S one: the natural scale of
    // h.
    double log_h =
        0.5 * std::log(c.work_of_adhesion / full_contact(at_roughness(0)).elastic_energy);
    constexpr double reach = 25;
    const auto full = root_near([&](double x) { return -full_contact(at_roughness(x)).gamma; },
                                log_h, 0.1, reach, 1e-12);
    double zero_load_x = -12;
    CriticalRoughness result;
    result.full_contact_h_rms = full ? std::exp(*full) : HUGE_VAL;
    for (const int level : {0, 1}) {
        const auto excess = [&](double x) {
            const AdhesiveContact scaled = at_roughness(x);
            return OnGrid(scaled, level).excess_at_end(zero_load_x);
        };
        const auto root = root_near(excess, log_h, level == 0 ? 0.1 : 1e-3, reach, 1e-6);
        if (!root)
            throw NoSolution(message(
                "critical roughness: at p = ", c.pressure,
                " adhesion does not end up to h_rms = ", std::exp(log_h + reach), ", beta ", c.beta,
                ": either the gain in contact area keeps up with the elastic energy, or the pull "
                "is too strong at any roughness; try area factor none, or another load"));
        log_h = *root;
        result.error = std::abs(std::exp(log_h) - result.h_rms);
        result.h_rms = std::exp(log_h);
    }
    return result;
}

// The gradient of an isotropic Gaussian surface has |∇h|² = s t with t exponentially distributed,
// so
//     S = ∫ √(1+st) e^{-t} dt = 1 + ½ √(πs) e^{1/s} erfc(1/√s).
// Where the exponential overflows, the series S = 1 + (s/2)(1 - s/2 + 3s²/4 - ...) is exact.
double area_factor(AreaFactor definition, double s, double c) {
    switch (definition) {
    case AreaFactor::none:
        return 1;
    case AreaFactor::lattice:
        return 1 / (1 + c * s);
    case AreaFactor::small_slope:
        return 1 + s / 2;
    case AreaFactor::gaussian:
        break;
    }
    if (s < 1.0 / 400) {
        double sum = 0, term = 1;
        for (int k = 1; k <= 10; ++k) {
            sum += term;
            term *= -(2 * k - 1) * s / 2;
        }
        return 1 + s / 2 * sum;
    }
    return 1 +
           0.5 * std::sqrt(std::numbers::pi * s) * std::exp(1 / s) * std::erfc(1 / std::sqrt(s));
}

std::string_view name(AreaFactor definition) {
    return definition == AreaFactor::gaussian      ? "gaussian"
           : definition == AreaFactor::small_slope ? "small-slope"
           : definition == AreaFactor::none        ? "none"
                                                   : "lattice";
}

FullContactState full_contact(const AdhesiveContact& c) {
    check(c);
    const Magnification end = c.spectrum.last();
    FullContactState s;
    s.real_area = area_factor(c.area_factor, 2 * std::numbers::pi * end.slope, c.tilt_cost);
    s.elastic_energy = std::numbers::pi / 2 * c.contact_modulus * end.energy;
    s.gamma = c.work_of_adhesion * s.real_area - s.elastic_energy;
    return s;
}

std::string_view name(Status status) {
    return status == Status::adhesive  ? "adhesive"
           : status == Status::pressed ? "pressed"
                                       : "no contact";
}

void check(const AdhesiveContact& c) {
    if (!(c.contact_modulus > 0 && c.work_of_adhesion >= 0 && c.beta >= 0 && c.beta <= 1 &&
          std::isfinite(c.contact_modulus + c.work_of_adhesion + c.pressure)))
        throw InvalidInput(message("contact modulus E* = ", c.contact_modulus,
                                   ", work of adhesion ", c.work_of_adhesion, ", pressure ",
                                   c.pressure, ", beta ", c.beta,
                                   ": the modulus must be positive, the work of adhesion not "
                                   "negative, beta in 0..1 (usually 0.45), and all finite"));
    if (!(c.spectrum.q_L() > 0))
        throw InvalidInput("the contact has no spectrum; build one with Spectrum::self_affine or "
                           "Spectrum::rings");
}

} // namespace asperity::theory
