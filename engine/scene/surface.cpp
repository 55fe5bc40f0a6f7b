// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/scene/surface.hpp"

#include "engine/scene/heights.hpp"

#include <Random123/philox.h>
#include <fftw3.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>

namespace asperity {

namespace {

/// A map is not periodic if the steps across the box's edges exceed those inside by this factor.
constexpr double worst_seam = 2.0;

using std::numbers::pi;
using Complex = std::complex<double>;

/// Returns index k of a transform of n points as a signed wavenumber; n/2 stays positive.
int signed_wave(int k, int n) { return 2 * k > n ? k - n : k; }

void require(bool holds, const std::string& message) {
    if (!holds) throw std::invalid_argument("surface: " + message);
}

/// Returns the largest wavevector of the grid's spectrum, in q_L.
double clipped_cutoff(const SurfaceOptions& o) { return std::min(o.cutoff, 0.5 * o.sites); }

/// Returns C(q) up to a factor: flat to the roll-off, then q^(-2(1+H)); q in q_L.
double shape(const SurfaceOptions& o, double q) {
    // The small tolerance includes waves exactly on a border in spite of rounding.
    if (q < 1.0 - 1e-9 || q > clipped_cutoff(o) * (1.0 + 1e-12)) return 0.0;
    return q <= o.rolloff ? 1.0 : std::pow(q / o.rolloff, -2.0 * (1.0 + o.hurst));
}

double uniform(std::uint32_t high, std::uint32_t low) {
    const std::uint64_t bits = (static_cast<std::uint64_t>(high) << 32 | low) >> 11;
    return (static_cast<double>(bits) + 0.5) * 0x1p-53; // in (0, 1)
}

/// Returns the random factor of wave (kx, ky), of unit mean square and hermitian: that of -k is the
/// conjugate.
Complex random_factor(const SurfaceOptions& o, int kx, int ky, bool own_mirror) {
    const bool mirrored = ky < 0 || (ky == 0 && kx < 0);
    const r123::Philox4x32::ctr_type counter = {{static_cast<std::uint32_t>(mirrored ? -kx : kx),
                                                 static_cast<std::uint32_t>(mirrored ? -ky : ky),
                                                 0u, 0u}};
    const r123::Philox4x32::key_type key = {
        {static_cast<std::uint32_t>(o.seed), static_cast<std::uint32_t>(o.seed >> 32)}};
    const auto bits = r123::Philox4x32()(counter, key);
    const double amplitude =
        o.amplitudes == Amplitudes::fixed ? 1.0 : std::sqrt(-std::log(uniform(bits[0], bits[1])));
    const double phase = 2.0 * pi * uniform(bits[2], bits[3]);
    // A wave that is its own mirror image has a real coefficient.
    if (own_mirror)
        return o.amplitudes == Amplitudes::fixed ? std::copysign(1.0, std::cos(phase))
                                                 : std::sqrt(2.0) * amplitude * std::cos(phase);
    return std::polar(amplitude, mirrored ? -phase : phase);
}

/// Measures slope and spectrum of the roughness from its Fourier coefficients.
void measure(const SurfaceOptions& o, Surface& s) {
    SurfaceStatistics& stat = s.statistics;
    const Bands bands = s.bands();
    stat.rms = heights::rms_of(s.height, bands);
    const int n = s.sites;
    const double q_unit = 2.0 * pi / s.length;
    std::vector<Complex> wave(s.height.begin(), s.height.end());
    if (s.holes > 0) { // level with the mean of the rest
        std::vector<double> whole = s.height;
        heights::remove_mean(whole, bands);
        for (std::size_t i = 0; i < wave.size(); ++i)
            wave[i] = std::isnan(whole[i]) ? 0.0 : whole[i];
    }
    bands.transform(wave, FFTW_FORWARD);
    const int first = bands.first(), end = first + bands.held();
    const double points = static_cast<double>(n) * n;
    // Power and wavenumber of each wave, and its power in the target: the sums of one rank
    // after the other are left with additions.
    std::vector<double> target(wave.size());
#pragma omp parallel for schedule(static)
    for (int y = first; y < end; ++y)
        for (int x = 0; x < n; ++x) {
            const double kx = signed_wave(x, n), ky = signed_wave(y, n);
            const double k = std::sqrt(kx * kx + ky * ky);
            Complex& w = wave[bands.at(x, y)];
            w = {std::norm(w) / (points * points), k};
            target[bands.at(x, y)] = target_spectrum(o, k * q_unit);
        }
    const auto bins = static_cast<std::size_t>(n / 2) + 1;
    std::vector<double> sums(2 + 4 * bins, 0.0);
    bands.in_order(sums, [&] {
        double &slope2 = sums[0], &curvature2 = sums[1];
        for (std::size_t i = 0; i < wave.size(); ++i) {
            const double power = wave[i].real(), k = wave[i].imag();
            const double q2 = k * k * q_unit * q_unit;
            slope2 += power * q2;
            curvature2 += 0.25 * power * q2 * q2;
            const auto bin = static_cast<std::size_t>(std::lround(k));
            if (bin == 0 || bin >= bins) continue;
            double* const sum = &sums[2 + 4 * bin];
            sum[0] += k * q_unit;
            sum[1] += power / (q_unit * q_unit);
            sum[2] += target[i];
            sum[3] += 1.0;
        }
    });
    stat.rms_slope = std::sqrt(sums[0]);
    stat.rms_curvature = std::sqrt(sums[1]);
    stat.spectrum.clear();
    for (std::size_t bin = 1; bin < bins; ++bin) {
        const double *const sum = &sums[2 + 4 * bin], modes = sum[3];
        if (modes > 0.0)
            stat.spectrum.push_back(
                {sum[0] / modes, sum[1] / modes, sum[2] / modes, static_cast<int>(modes)});
    }
}

/// Returns the number of holes in the heights of all ranks.
long long holes_of(const Surface& s) {
    std::array<std::int64_t, 1> holes = {
        std::count_if(s.height.begin(), s.height.end(), [](double h) { return std::isnan(h); })};
    s.ranks.sum(holes);
    return holes[0];
}

} // namespace

Surface finished(const SurfaceOptions& o, Surface s) {
    measure(o, s);
    if (o.radius > 0.0) {
        s.radius = o.radius;
        const double spacing = o.length / o.sites, centre = 0.5 * o.length;
        const Bands bands = s.bands();
        for (int y = bands.first(); y < bands.first() + bands.held(); ++y)
            for (int x = 0; x < s.sites; ++x) {
                const double dx = x * spacing - centre, dy = y * spacing - centre;
                s.height[bands.at(x, y)] += cap_of(o.radius, dx, dy);
            }
        s.holes = holes_of(s); // in a box with free edges the sphere ends at its equator
    }
    s.statistics.lowest = HUGE_VAL;
    s.statistics.highest = -s.statistics.lowest;
    for (const double h : s.height) { // holes do not count
        if (h < s.statistics.lowest) s.statistics.lowest = h;
        if (h > s.statistics.highest) s.statistics.highest = h;
    }
    s.statistics.lowest = -s.ranks.max(-s.statistics.lowest);
    s.statistics.highest = s.ranks.max(s.statistics.highest);
    return s;
}

Surface whole(Surface s) {
    if (s.ranks.size() == 1) return s;
    const Bands bands = s.bands();
    s.height = bands.fetch(s.height, 0, s.sites);
    if (s.pair) s.pair->counter_height = bands.fetch(s.pair->counter_height, 0, s.sites);
    s.ranks = Communicator();
    return s;
}

double target_spectrum(const SurfaceOptions& o, double q) {
    if (o.kind != SurfaceKind::self_affine || !(o.rms > 0.0)) return 0.0;
    const double q_unit = 2.0 * pi / o.length;
    // 2 pi int q C dq = rms^2 with C = C0 shape(q): the integral in q_L, in closed form.
    const double top = clipped_cutoff(o), corner = std::clamp(o.rolloff, 1.0, std::max(1.0, top));
    const double flat = 0.5 * (corner * corner - 1.0);
    const double ratio = top / corner, h = o.hurst;
    // If the roll-off lies below q_L the power law has fallen already where the spectrum begins.
    const double at_corner =
        std::pow(corner / o.rolloff, o.rolloff < corner ? -2.0 * (1.0 + h) : 0.0);
    const double tail = at_corner * corner * corner *
                        (h > 0.0 ? (1.0 - std::pow(ratio, -2.0 * h)) / (2.0 * h) : std::log(ratio));
    const double integral = 2.0 * pi * (flat + std::max(0.0, tail)) * q_unit * q_unit;
    return integral > 0.0 ? o.rms * o.rms * shape(o, q / q_unit) / integral : 0.0;
}

int substrate_sites(int block_sites, double lattice_ratio) {
    return std::max(1, static_cast<int>(std::lround(lattice_ratio * block_sites)));
}

Surface make_surface(const SurfaceOptions& o, const Communicator& ranks) {
    require(o.kind != SurfaceKind::file,
            "a measured surface is made from its heights (surface_from_heights), not from options");
    Surface s;
    s.sites = o.sites;
    s.length = o.length;
    s.ranks = ranks;
    const Bands bands = s.bands();
    s.height.assign(bands.size(), 0.0);
    if (o.kind == SurfaceKind::flat || o.rms == 0.0) return finished(o, std::move(s));

    const int n = o.sites;
    if (o.cutoff > 0.5 * n)
        s.notes.push_back(fmt::format("cutoff q1 = {:g} q_L lies above the Nyquist wavevector of "
                                      "{} sites; clipped to {:g} q_L",
                                      o.cutoff, n, 0.5 * n));
    std::vector<Complex> wave(bands.size());
    double any = 0.0; // waves
#pragma omp parallel for schedule(static) reduction(max : any)
    for (int y = bands.first(); y < bands.first() + bands.held(); ++y)
        for (int x = 0; x < n; ++x) {
            const int kx = signed_wave(x, n), ky = signed_wave(y, n);
            const double c =
                shape(o, std::sqrt(static_cast<double>(kx) * kx + static_cast<double>(ky) * ky));
            if (c == 0.0) continue;
            const bool own_mirror = (2 * x) % n == 0 && (2 * y) % n == 0;
            wave[bands.at(x, y)] = std::sqrt(c) * random_factor(o, kx, ky, own_mirror);
            any = 1.0;
        }
    require(
        ranks.max(any) > 0.0,
        fmt::format("{} sites hold no wave between q_L and q1 = {:g} q_L, so rms = {} Å cannot be "
                    "reached; use more sites or kind = \"flat\"",
                    n, o.cutoff, o.rms));
    bands.transform(wave, FFTW_BACKWARD);
    for (std::size_t i = 0; i < wave.size(); ++i)
        s.height[i] = wave[i].real();
    wave = std::vector<Complex>();
    heights::remove_mean(s.height, bands);
    heights::scale_to_rms(s.height, bands, o.rms);
    return finished(o, std::move(s));
}

int sites_of_map(const SurfaceOptions& o) {
    const double ratio = o.map_edge > 0.0 ? o.map_edge / o.length : 1.0;
    if (std::abs(ratio - 1.0) <= 0.005) return o.sites;
    constexpr double most = 131072.0; // along an edge, as in the file of a map
    require(ratio * o.sites <= most,
            fmt::format("the map is {:.6g} Å wide, {:.3g} times the box of {:.6g} Å, and would "
                        "cover {:.3g} atoms along an edge, of {:.0f} at most; check the map's "
                        "size and unit (surface.file_size) and surface.spacing",
                        o.map_edge, ratio, o.length, ratio * o.sites, most));
    return static_cast<int>(std::lround(ratio * o.sites));
}

namespace {

/// Refuses a measured map whose values are no heights, and treats its line noise. Returns the
/// number of holes. doubt: set to the note on line noise, if there is one.
long long examine_heights(const SurfaceOptions& o, std::vector<double>& h, int nx, int ny,
                          std::string& doubt) {
    require(nx >= 1 && ny >= 1 &&
                h.size() == static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny),
            fmt::format("the height map has {} values, not {} x {}; give a full matrix", h.size(),
                        nx, ny));
    const auto bad = std::find_if(h.begin(), h.end(), [&](double v) {
        return !std::isfinite(v) && !(o.holes && std::isnan(v));
    });
    if (bad != h.end()) {
        const auto at = static_cast<int>(bad - h.begin());
        require(false,
                fmt::format("the height map holds {} in row {}, column {}; fill such gaps by "
                            "neighbouring heights before the run",
                            *bad, at / nx + 1, at % nx + 1));
    }
    const long long holes =
        std::count_if(h.begin(), h.end(), [](double v) { return std::isnan(v); });
    if (holes > 0) {
        require(holes < static_cast<long long>(h.size()), "the height map holds no height at all");
        require(
            !o.detrend && o.line_noise == LineNoise::keep && nx == ny && nx == sites_of_map(o),
            fmt::format("a map with holes is taken as it is, and its {} x {} points cover {} x {} "
                        "sites; bring it onto the lattice before, and leave detrend and "
                        "line_noise out",
                        nx, ny, sites_of_map(o), sites_of_map(o)));
    } else if (nx == ny) {
        const double edge = o.map_edge > 0.0 ? o.map_edge : o.length;
        doubt = fmt::to_string(fmt::join(
            treat_line_noise(h, nx, edge / nx, std::min(nx, sites_of_map(o)), o.line_noise), "; "));
    }
    return holes;
}

} // namespace

Surface surface_from_heights(const SurfaceOptions& o, std::vector<double> on_root, int nx, int ny,
                             const Communicator& ranks) {
    Surface s;
    s.sites = o.sites;
    s.length = o.length;
    s.ranks = ranks;
    std::string doubt;
    ranks.on_root([&] { s.holes = examine_heights(o, on_root, nx, ny, doubt); });
    ranks.broadcast(doubt);
    if (!doubt.empty()) s.doubts.push_back(doubt);
    Bands bands(ranks, nx, ny);
    std::vector<double> h = bands.spread(std::move(on_root));
    if (o.detrend) {
        heights::remove_plane(h, bands);
        s.notes.push_back("mean plane removed from the height map");
    }
    if (o.periodic) {
        const double before = heights::rms_of(h, bands);
        heights::remove_jumps(h, bands);
        s.notes.push_back(fmt::format("the map made periodic: rms {:.4g} Å before, {:.4g} Å after",
                                      before, heights::rms_of(h, bands)));
    }
    const int whole = sites_of_map(o);
    require(whole >= o.sites,
            fmt::format("the height map is {:.6g} Å wide, the box {:.6g} Å; take {} sites at most, "
                        "or stretch the map on purpose with surface.file_size = {:.6g}",
                        o.map_edge, o.length, static_cast<int>(o.map_edge / o.length * o.sites),
                        o.length));
    if (whole == o.sites && o.map_edge > 0.0 && std::abs(o.map_edge - o.length) > 1e-9 * o.length)
        s.notes.push_back(fmt::format("the map, {:.6g} Å wide, is stretched by {:+.2f} % to the "
                                      "box",
                                      o.map_edge, 100.0 * (o.length / o.map_edge - 1.0)));
    if (nx != whole || ny != whole) {
        h = heights::resample(h, bands, whole);
        bands = {ranks, whole};
        s.notes.push_back(
            fmt::format("height map of {} x {} points resampled (Fourier, periodic) to {} x {}", nx,
                        ny, whole, whole));
    }
    if (whole > o.sites) {
        h = heights::middle(h, bands, o.sites);
        bands = s.bands();
        if (o.periodic) heights::remove_jumps(h, bands);
        s.notes.push_back(fmt::format("the middle {:.6g} Å of the map are taken", o.length));
    }
    if (o.rms > 0.0) {
        const double own = heights::rms_of(h, bands);
        double largest = 0.0;
        for (const double v : h) // a hole is no number, and no larger than any
            if (std::abs(v) > largest) largest = std::abs(v);
        largest = ranks.max(largest);
        require(
            own > 1e-12 * largest && own > 0.0,
            fmt::format("the height map is flat (rms = {:g} Å), so it cannot be scaled to rms = {} "
                        "Å; leave rms out or give a rough map",
                        own, o.rms));
        heights::remove_mean(h, bands);
        heights::scale_to_rms(h, bands, o.rms);
        s.notes.push_back(fmt::format("height map scaled from rms = {:g} Å to {:g} Å", own, o.rms));
    }
    const auto [inside, seam] = heights::steps(h, bands);
    if (o.repeats && seam > worst_seam * inside)
        s.notes.push_back(fmt::format(
            "the map does not repeat: over the box's edges heights jump by {:.3g} Å (rms), between "
            "neighbours inside by {:.3g} Å. The surface keeps this cliff; {}",
            seam, inside,
            o.kind == SurfaceKind::atoms ? "a box of whole periods of the substrate has none"
                                         : "surface.detrend = \"periodic\" removes it"));
    s.height = std::move(h);
    s.holes = holes_of(s);
    return finished(o, std::move(s));
}

} // namespace asperity
