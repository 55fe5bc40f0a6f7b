// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "theory/renormalised.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <boost/math/special_functions/bessel.hpp>

#include "theory/error.hpp"

namespace asperity::theory {

StiffnessTable::StiffnessTable(std::vector<WaveStiffness> waves) : waves_(std::move(waves)) {
    double before = 0;
    for (WaveStiffness& w : waves_) {
        if (!(w.q > before && w.free_zz > 0 && w.zz > 0 && w.xx > 0))
            throw InvalidInput(message("stiffness table: at q = ", w.q, " S_zz = ", w.zz,
                                       ", S_xx = ", w.xx, ", frictionless ", w.free_zz,
                                       "; wavevectors must ascend and stiffnesses be positive"));
        before = w.q;
        w.zz /= w.q;
        w.xx /= w.q;
        w.xz /= w.q;
        w.free_zz /= w.q;
    }
    if (waves_.empty()) throw InvalidInput("stiffness table: it is empty; give one wave at least");
}

StiffnessTable StiffnessTable::half_space(double contact_modulus, double poisson_ratio) {
    const double ratio = (1 - 2 * poisson_ratio) / (2 * (1 - poisson_ratio));
    const double free = contact_modulus / 2, stuck = free / (1 - ratio * ratio);
    return StiffnessTable({{1, stuck, stuck, ratio * stuck, free}});
}

WaveStiffness StiffnessTable::operator()(double q) const {
    const auto above = std::lower_bound(waves_.begin(), waves_.end(), q,
                                        [](const WaveStiffness& w, double x) { return w.q < x; });
    WaveStiffness s = above == waves_.end() ? waves_.back() : *above;
    if (above != waves_.end() && above != waves_.begin()) {
        const WaveStiffness& below = *(above - 1);
        const double f = (q - below.q) / (above->q - below.q);
        const auto mix = [&](double a, double b) { return a + f * (b - a); };
        s = {q, mix(below.zz, s.zz), mix(below.xx, s.xx), mix(below.xz, s.xz),
             mix(below.free_zz, s.free_zz)};
    }
    return {q, s.zz * q, s.xx * q, s.xz * q, s.free_zz * q};
}

namespace {

/// Where the shells are cut: wavevectors from q1 down to q_L and the variance above each.
struct Shells {
    std::vector<double> q, variance;
};

/// `steps` of them even in ln q, and one for each `length` of the rms of the roughness above q;
/// both `refinement` times halved. They are looked up in a table of 20 points a shell and more.
Shells cut_shells(const Spectrum& spectrum, int steps, double length, int refinement) {
    const double q1 = spectrum.q1(), width = std::log(q1 / spectrum.q_L());
    const double rms = spectrum.rms_height();
    const double more = std::min(rms / length, 1e4);
    const double fraction = steps / (steps + more);
    steps = static_cast<int>(std::ceil(steps + more)) << refinement;
    const int table = std::max(20000, 20 * steps);
    std::vector<double> mark(static_cast<std::size_t>(table) + 1), variance(mark.size());
    for (int i = 0; i <= table; ++i) {
        const auto k = static_cast<std::size_t>(i);
        variance[k] = spectrum.height_variance_above(q1 * std::exp(-width * i / table));
        mark[k] =
            fraction * i / table + (1 - fraction) * std::sqrt(std::max(0.0, variance[k])) / rms;
    }
    Shells shells{{q1}, {0}};
    for (int s = 1; s <= steps; ++s) {
        const double target = mark.back() * s / steps;
        auto i = std::lower_bound(mark.begin(), mark.end(), target) - mark.begin();
        i = std::clamp<std::ptrdiff_t>(i, 1, table);
        const auto k = static_cast<std::size_t>(i);
        const double f = (target - mark[k - 1]) / (mark[k] - mark[k - 1]);
        const double q = s == steps
                             ? spectrum.q_L()
                             : q1 * std::exp(-width * (static_cast<double>(i - 1) + f) / table);
        shells.q.push_back(q);
        shells.variance.push_back(s == steps ? rms * rms : spectrum.height_variance_above(q));
    }
    return shells;
}

/// The wavevector between two with the variance t above it.
double wavevector_at(const Spectrum& spectrum, double t, double low, double high) {
    for (int i = 0; i < 50; ++i) {
        const double middle = std::sqrt(low * high);
        (spectrum.height_variance_above(middle) > t ? low : high) = middle;
    }
    return std::sqrt(low * high);
}

/// Of S + φ″: below it the equation is continued by its tangent.
double smallest(double S, double D) { return 1e-4 * (S + std::abs(D)); }

/// dφ/dh² of a shell.
double rate(double S, double D, double curvature) {
    return 0.5 * (S + 2 * D - (S + D) * (S + D) / std::max(S + curvature, smallest(S, D)));
}

/// One flow of φ and its observables on one grid.
class Flow {
public:
    Flow(const RoughInterface& rough, const RenormalisedOptions& options, int refinement);
    void run();

    std::vector<double> u, phi;
    /// Of each point: contact fraction, φ_tt, what tilt has cost and lateral forces have stiffened
    /// of φ so far (expected errors), then V_uu of each ring and V_Ru of each ring.
    enum Column : std::size_t { touching, sideways, tilt_cost, stiffening, rings_from };
    [[nodiscard]] double observed(std::size_t i, Column c) const {
        return observed_[i * columns_ + c];
    }
    /// About the values that run() computes: at each shell and point the observables, and φ as
    /// often as Newton's method iterates.
    [[nodiscard]] double work() const {
        return static_cast<double>(shells_.q.size() * points_) * static_cast<double>(columns_ + 30);
    }

private:
    using Values = std::vector<double>;

    void make_grid(double spacing);
    [[nodiscard]] double curvature(const Values& f, std::size_t i) const {
        return left_[i] * (f[i - 1] - f[i]) + right_[i] * (f[i + 1] - f[i]);
    }
    void set_coefficients(double q, const Values& observed);
    void solve_potential(Values& f, const Values& from, double dt);
    void solve_observables(Values& x, const Values& f, double dt);
    [[nodiscard]] double rate_at_wall() const;

    const RoughInterface& rough_;
    Shells shells_;
    std::size_t points_ = 0, columns_ = 0, rings_ = 0;
    Values left_, right_; // second derivative: left (f[i-1] - f[i]) + right (f[i+1] - f[i])
    Values observed_;     // [point][column]
    Values stiffness_, tilt_, unrelieved_; // S, D and D without the gain of the shell, by point
    double frictionless_ = 0;              // S without friction
    Values below_, scale_, above_, right_side_;
    double wall_curvature_ = 0;
};

Flow::Flow(const RoughInterface& rough, const RenormalisedOptions& options, int refinement)
    : rough_(rough) {
    const FlatInterface& flat = rough.flat;
    const double well = flat.inflection() - flat.separation();
    shells_ = cut_shells(rough.spectrum, options.steps, well, refinement);
    make_grid(options.spacing * well / (1 << refinement));
    rings_ = flat.has_atoms() ? flat.rings().size() : 0;
    columns_ = rings_from + 2 * rings_;
    points_ = u.size();
    phi.resize(points_);
    observed_.assign(points_ * columns_, 0);
    const double slopes = std::pow(rough.spectrum.rms_slope(), 2);
    for (std::size_t i = 0; i < points_; ++i)
        observed_[i * columns_ + touching] = flat.contact(u[i], slopes);
    for (std::size_t k = 0; k < flat.rings().size(); ++k) {
        for (std::size_t i = 0; i < points_; ++i) {
            const FlatInterface::Terms terms = flat.terms(static_cast<int>(k), u[i]);
            phi[i] += terms.energy;
            if (rings_ == 0) continue;
            double* row = &observed_[i * columns_];
            row[sideways] += terms.sideways;
            row[rings_from + k] = terms.bend;
            row[rings_from + rings_ + k] = terms.tilt;
        }
    }
    wall_curvature_ = curvature(phi, 1);
    for (Values* c : {&stiffness_, &tilt_, &unrelieved_, &below_, &scale_, &above_, &right_side_})
        c->assign(points_, 0);
}

/// Even up to twice the distance from the minimum to the inflection beyond it, then wider in
/// proportion to the way.
void Flow::make_grid(double spacing) {
    const FlatInterface& flat = rough_.flat;
    const double well = flat.inflection() - flat.separation();
    const double even_until = flat.separation() + 2 * well, growth = 6 * well;
    const double rms = rough_.spectrum.rms_height();
    const double last = flat.reach() + 5 * rms + 8 * well;
    // x counts points; u(x) is smooth: even, then u = even_until + growth (e^y - 1 - y/2...) by
    // integration of du = spacing (1 + s²/(s + growth)/growth), s the way beyond even_until.
    double x = flat.closest();
    while (x < last) {
        u.push_back(x);
        const auto step = [&](double at) {
            const double s = std::max(0.0, at - even_until);
            return spacing * (1 + s * s / ((s + growth) * growth));
        };
        x += step(x + 0.5 * step(x)); // midpoint rule: spacing varies smoothly
    }
    u.push_back(x);
    left_.assign(u.size(), 0);
    right_.assign(u.size(), 0);
    for (std::size_t i = 1; i + 1 < u.size(); ++i) {
        const double a = u[i] - u[i - 1], b = u[i + 1] - u[i];
        left_[i] = 2 / (a * (a + b));
        right_[i] = 2 / (b * (a + b));
    }
}

/// S and D at every separation, from the observables of the rings.
void Flow::set_coefficients(double q, const Values& observed) {
    const WaveStiffness s = rough_.stiffness(q);
    const bool friction = rough_.friction && rings_ > 0;
    frictionless_ = s.free_zz;
    std::fill(stiffness_.begin(), stiffness_.end(), s.free_zz);
    if (rings_ == 0) return;
    Values tilted(rings_), bessel1(rings_);
    for (std::size_t k = 0; k < rings_; ++k) {
        const double x = q * rough_.flat.rings()[k];
        tilted[k] = 1 - boost::math::cyl_bessel_j(0, x);
        bessel1[k] = boost::math::cyl_bessel_j(1, x);
    }
    for (std::size_t i = 0; i < points_; ++i) {
        const double* row = &observed[i * columns_];
        double d = 0, kappa = 0;
        for (std::size_t k = 0; k < rings_; ++k) {
            d += row[rings_from + k] * tilted[k];
            kappa += row[rings_from + rings_ + k] * bessel1[k];
        }
        tilt_[i] = unrelieved_[i] = d;
        if (!friction) continue;
        stiffness_[i] = s.zz - s.xz * s.xz / (s.xx + std::max(row[sideways], 0.0));
        kappa = std::abs(kappa);
        const double K = s.xx + row[sideways], furthest = u[i] * q;
        const double v = K * furthest > kappa ? kappa / K : furthest;
        tilt_[i] = d - std::clamp((kappa - 0.5 * K * v) * v, 0.0, std::max(d, 0.0));
    }
}

double Flow::rate_at_wall() const { return rate(stiffness_[0], tilt_[0], wall_curvature_); }

/// f - dt F(f″) = from by Newton's method; the first value of f is given, the last stays zero.
void Flow::solve_potential(Values& f, const Values& from, double dt) {
    const double small = 1e-10 * rough_.flat.work_of_adhesion();
    for (int iteration = 0; iteration < 1000; ++iteration) {
        double before = 0, largest = 0;
        above_[0] = 0;
        for (std::size_t i = 1; i + 1 < points_; ++i) {
            const double S = stiffness_[i], D = tilt_[i], a2 = (S + D) * (S + D);
            const double total = S + curvature(f, i), least = smallest(S, D);
            const double at = std::max(total, least); // below: the tangent at least
            const double slope = 0.5 * a2 / (at * at);
            const double rate = 0.5 * (S + 2 * D - a2 / at) + slope * (total - at);
            const double lower = dt * slope * left_[i], upper = dt * slope * right_[i];
            const double pivot = 1 / (1 + lower + upper - lower * above_[i - 1]);
            above_[i] = upper * pivot;
            before = (from[i] + dt * rate - f[i] + lower * before) * pivot;
            right_side_[i] = before;
        }
        double next = 0;
        for (std::size_t i = points_ - 2; i >= 1; --i) {
            next = right_side_[i] + above_[i] * next;
            f[i] += next;
            largest = std::max(largest, std::abs(next));
        }
        // Rounding of f″ may keep the last digits moving.
        if (!(largest > small) || (iteration > 40 && largest < 1e3 * small)) return;
    }
    throw NoSolution(
        message("renormalised theory: Newton's method has not converged in 1000 "
                "iterations; this is a defect of the solver, please report the input"));
}

/// x - dt W x″ = x for all columns at once, W = ½ [(S + D)/(S + f″)]². It is the equation of a
/// small change of φ too: what a term of the rate has contributed to φ follows with that term
/// added.
void Flow::solve_observables(Values& x, const Values& f, double dt) {
    above_[0] = 0;
    for (std::size_t i = 1; i + 1 < points_; ++i) {
        const double S = stiffness_[i], bend = curvature(f, i);
        const double total = std::max(S + bend, smallest(S, tilt_[i]));
        const double w = (S + tilt_[i]) / total;
        const double lower = dt * 0.5 * w * w * left_[i], upper = dt * 0.5 * w * w * right_[i];
        const double pivot = 1 / (1 + lower + upper - lower * above_[i - 1]);
        below_[i] = lower;
        scale_[i] = pivot;
        above_[i] = upper * pivot;
        double* row = &x[i * columns_];
        const double* last = row - columns_;
        if (rings_ > 0) {
            row[tilt_cost] += dt * (rate(S, unrelieved_[i], bend) - rate(S, 0, bend));
            row[stiffening] += dt * (rate(S, tilt_[i], bend) - rate(frictionless_, tilt_[i], bend));
        }
        for (std::size_t k = 0; k < columns_; ++k)
            row[k] = (row[k] + lower * last[k]) * pivot;
    }
    for (std::size_t i = points_ - 2; i >= 1; --i) {
        double* row = &x[i * columns_];
        const double* next = row + columns_;
        const double factor = above_[i];
        for (std::size_t k = 0; k < columns_; ++k)
            row[k] += factor * next[k];
    }
}

/// Alexander's two stages: γ = 1 - 1/√2. Observables enter the coefficients of φ; at the stages
/// they are extrapolated from the last two steps, which keeps the order.
void Flow::run() {
    const double gamma = 1 - 1 / std::sqrt(2.0), ratio = (1 - gamma) / gamma;
    Values older = observed_, stage_observed(observed_.size()), stage(points_), from(points_);
    double older_step = 0;
    for (std::size_t s = 0; s + 1 < shells_.q.size(); ++s) {
        const double start = shells_.variance[s], step = shells_.variance[s + 1] - start;
        if (!(step > 0)) continue;
        const auto expect = [&](double ahead) {
            const double f = older_step > 0 && rings_ > 0 ? ahead * step / older_step : 0;
            for (std::size_t i = 0; i < observed_.size(); ++i)
                stage_observed[i] = observed_[i] + f * (observed_[i] - older[i]);
        };
        const double q =
            wavevector_at(rough_.spectrum, start + gamma * step, shells_.q[s + 1], shells_.q[s]);
        expect(gamma);
        set_coefficients(q, stage_observed);
        stage = phi;
        stage[0] += gamma * step * rate_at_wall();
        solve_potential(stage, phi, gamma * step);
        stage_observed = observed_;
        solve_observables(stage_observed, stage, gamma * step);
        Values next(observed_.size());
        for (std::size_t i = 0; i < next.size(); ++i)
            next[i] = observed_[i] + ratio * (stage_observed[i] - observed_[i]);
        // Where φ″ is about to reach -S, φ follows from that bound and not from a rate: carried
        // on by the rate it would fall below, and nothing would bring it back.
        for (std::size_t i = 0; i < points_; ++i) {
            const bool inner = i > 0 && i + 1 < points_;
            const double fraction =
                inner ? std::clamp(4 * (1 + curvature(stage, i) / stiffness_[i]), 0.0, 1.0) : 1;
            from[i] = stage[i] + fraction * (ratio - 1) * (stage[i] - phi[i]);
        }
        expect(1);
        set_coefficients(shells_.q[s + 1], stage_observed);
        stage[0] = from[0] + gamma * step * rate_at_wall();
        solve_potential(stage, from, gamma * step);
        solve_observables(next, stage, gamma * step);
        older.swap(observed_);
        observed_.swap(next);
        older_step = step;
        phi = stage;
    }
}

struct Point {
    double gamma, contact, separation, tension;
    double tilt_cost, stiffening; // of γ
};

/// Value at x of the parabola through three points.
double parabola(const double* x, const double* y, double at) {
    const double a = (y[1] - y[0]) / (x[1] - x[0]), b = (y[2] - y[1]) / (x[2] - x[1]);
    return y[0] + (at - x[0]) * (a + (at - x[1]) * (b - a) / (x[2] - x[0]));
}

double extremum(const double* x, const double* y) {
    const double a = (y[1] - y[0]) / (x[1] - x[0]), b = (y[2] - y[1]) / (x[2] - x[1]);
    const double bend = (b - a) / (x[2] - x[0]);
    return bend == 0 ? x[1] : (x[0] + x[1] - a / bend) / 2;
}

/// The state at the pressure p, on the branch that starts at the minimum of φ.
Point state_of(const Flow& flow, double pressure) {
    const auto& u = flow.u;
    const auto& phi = flow.phi;
    const std::size_t n = u.size();
    const auto least =
        static_cast<std::size_t>(std::min_element(phi.begin(), phi.end()) - phi.begin());
    // The largest tension, from the slopes between the points beyond the minimum.
    std::size_t steep = least;
    const auto slope = [&](std::size_t i) { return (phi[i + 1] - phi[i]) / (u[i + 1] - u[i]); };
    for (std::size_t i = least; i + 1 < n; ++i)
        if (slope(i) > slope(steep)) steep = i;
    Point point{};
    if (steep > 0 && steep + 2 < n) {
        double x[3], y[3];
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t i = steep - 1 + k;
            x[k] = (u[i] + u[i + 1]) / 2;
            y[k] = slope(i);
        }
        point.tension = parabola(x, y, std::clamp(extremum(x, y), x[0], x[2]));
    }
    if (-pressure > point.tension)
        throw NoSolution(message("renormalised theory: a pull of ", -pressure,
                                 " is more than the largest tension of the rough interface, ",
                                 point.tension, "; pull less"));
    const auto energy = [&](std::size_t i) { return phi[i] + pressure * u[i]; };
    std::size_t at = least;
    if (pressure > 0)
        while (at > 0 && energy(at - 1) < energy(at))
            --at;
    else
        while (at + 1 < n && at <= steep && energy(at + 1) < energy(at))
            ++at;
    if (at == 0)
        throw NoSolution(message("renormalised theory: at the pressure ", pressure,
                                 " the surfaces come closer than ", u[0],
                                 ", where their interaction is not looked at; press less"));
    at = std::clamp<std::size_t>(at, 1, n - 2);
    double x[3], y[3], total[3];
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = at - 1 + k;
        x[k] = u[i];
        y[k] = phi[i];
        total[k] = energy(i);
    }
    point.separation = std::clamp(extremum(x, total), x[0], x[2]);
    point.gamma = -parabola(x, y, point.separation);
    const auto observed = [&](Flow::Column c) {
        double at_points[3];
        for (std::size_t k = 0; k < 3; ++k)
            at_points[k] = flow.observed(at - 1 + k, c);
        return parabola(x, at_points, point.separation);
    };
    point.contact = observed(Flow::touching);
    point.tilt_cost = observed(Flow::tilt_cost);
    point.stiffening = observed(Flow::stiffening);
    return point;
}

ExpectedError expected_error(const RoughInterface& rough, const RenormalisedState& state) {
    const double lost = 1 - std::clamp(state.gamma_ratio, 0.0, 1.0);
    const double scatter = lost / std::sqrt(rough.spectrum.waves());
    const double slopes = std::pow(rough.spectrum.rms_slope(), 2);
    const bool atoms = rough.flat.has_atoms();
    const double spread = std::sqrt(state.contact_fraction * (1 - state.contact_fraction));
    return {
        std::hypot((rough.ensemble ? 1.5 : 0.5) * scatter, 3.2 * slopes * state.tilt_cost,
                   1.2 * state.stiffening) +
            state.gamma_ratio_error,
        std::hypot((rough.ensemble ? 1.1 : 0.8) * scatter, atoms ? 1.6 * slopes * spread : 0.0) +
            state.contact_error};
}

void check(const RoughInterface& rough, const RenormalisedOptions& options) {
    if (!std::isfinite(rough.pressure))
        throw InvalidInput(
            message("renormalised theory: pressure ", rough.pressure, " is not a number"));
    if (!(options.tolerance > 0 && options.useful > 0 && options.steps >= 2 &&
          options.spacing > 0 && options.max_refinement >= 0 && options.max_refinement < 12))
        throw InvalidInput(
            message("renormalised theory: tolerance ", options.tolerance, ", largest error ",
                    options.useful, ", steps ", options.steps, ", spacing ", options.spacing,
                    ", max_refinement ", options.max_refinement,
                    "; they must be positive, steps 2 at least, refinements below 12"));
    // Left of the grid the interface must be much stiffer than the block.
    const FlatInterface& flat = rough.flat;
    const double d = 0.01 * (flat.separation() - flat.closest()), u0 = flat.closest() + d;
    const double bend = (flat.energy(u0 - d) - 2 * flat.energy(u0) + flat.energy(u0 + d)) / (d * d);
    const double S =
        rough
            .stiffness(rough.spectrum.smooth() ? 1 / (flat.separation() - flat.closest())
                                               : rough.spectrum.q1())
            .free_zz;
    if (!(bend > 2 * S))
        throw InvalidInput(message("renormalised theory: at the separation ", flat.closest(),
                                   " the interface is no stiffer (", bend,
                                   ") than the block for its shortest wave (", S,
                                   "), so the block does not stay outside of the substrate; "
                                   "choose a softer block or a shorter-ranged repulsion"));
}

} // namespace

RenormalisedState solve(const RoughInterface& rough, const RenormalisedOptions& options) {
    check(rough, options);
    constexpr double most = 1.01; // roughness only weakens
    const double depth = rough.flat.work_of_adhesion();
    RenormalisedState state;
    if (rough.spectrum.smooth() && rough.pressure == 0) {
        state.gamma_eff = depth;
        state.gamma_ratio = state.contact_fraction = 1;
        state.separation = rough.flat.separation();
        state.tension = rough.flat.largest_tension();
        state.expected = ExpectedError{};
        return state;
    }
    Point coarse{}, best{};
    for (int level = 0; level <= options.max_refinement + 2; ++level) {
        Flow flow(rough, options, level);
        if (!rough.spectrum.smooth()) flow.run();
        const Point point = state_of(flow, rough.pressure);
        const auto extrapolate = [&](double Point::*value) {
            return level == 0 ? point.*value : (4 * (point.*value) - coarse.*value) / 3;
        };
        const Point now{extrapolate(&Point::gamma),
                        extrapolate(&Point::contact),
                        extrapolate(&Point::separation),
                        extrapolate(&Point::tension),
                        point.tilt_cost,
                        point.stiffening};
        const auto error = [&](double Point::*value) { return std::abs(now.*value - best.*value); };
        state.gamma_ratio_error = error(&Point::gamma) / depth;
        state.contact_error = error(&Point::contact);
        coarse = point;
        best = now;
        const double error_now = std::max(state.gamma_ratio_error, state.contact_error);
        state.converged = error_now <= options.tolerance;
        if (level >= 2 && state.converged) break;
        if (level >= 3 && !(error_now <= 30 * options.useful)) break; // two more grids do not help
        if (4 * flow.work() > options.most_work) break;
    }
    if (!(std::max(state.gamma_ratio_error, state.contact_error) <= options.useful))
        throw NoSolution(message("renormalised theory: on the finest grid tried the errors are ",
                                 state.gamma_ratio_error, " of the work of adhesion and ",
                                 state.contact_error, " of the contact, more than ", options.useful,
                                 ": roughness of rms slope ", rough.spectrum.rms_slope(),
                                 " is too steep for so strong an interface",
                                 "; choose less roughness, or a weaker or wider interaction"));
    if (best.gamma > most * depth)
        throw NoSolution(message(
            "renormalised theory: it finds ", best.gamma / depth, " times the work of adhesion of ",
            "the flat surfaces, more than they have: of second order in the slope it does not ",
            "hold at an rms slope of ", rough.spectrum.rms_slope(), "; choose less roughness"));
    state.gamma_eff = best.gamma;
    state.gamma_ratio = best.gamma / depth;
    // Pressed to many times the work of adhesion: no digits below the tolerance of the value.
    if (const double size = std::abs(state.gamma_ratio); size > 1) {
        state.gamma_ratio_error = std::max(state.gamma_ratio_error, options.tolerance * size);
        state.converged = state.converged && state.gamma_ratio_error <= options.tolerance;
    }
    state.contact_fraction = std::clamp(best.contact, 0.0, 1.0);
    state.separation = best.separation;
    state.tension = best.tension;
    state.tilt_cost = best.tilt_cost / depth;
    state.stiffening = best.stiffening / depth;
    if (rough.pressure == 0) state.expected = expected_error(rough, state);
    return state;
}

RenormalisedPotential renormalised_potential(const RoughInterface& rough, int refinement,
                                             const RenormalisedOptions& options) {
    check(rough, options);
    Flow flow(rough, options, refinement);
    if (!rough.spectrum.smooth()) flow.run();
    RenormalisedPotential result{flow.u, flow.phi, {}};
    for (std::size_t i = 0; i < flow.u.size(); ++i)
        result.contact.push_back(flow.observed(i, Flow::touching));
    return result;
}

} // namespace asperity::theory
