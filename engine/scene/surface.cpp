// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/scene/surface.hpp"

#include "engine/scene/heights.hpp"

#include <Random123/philox.h>
#include <fftw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace asperity {

namespace {

/// A map is not periodic if the steps across the box's edges exceed those inside by this factor.
constexpr double worst_seam = 2.0;

using std::numbers::pi;
using Complex = std::complex<double>;

std::size_t cells(int n) { return static_cast<std::size_t>(n) * static_cast<std::size_t>(n); }

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
    stat.rms = heights::rms_of(s.height);
    const int n = s.sites;
    const double q_unit = 2.0 * pi / s.length;
    std::vector<double> whole = s.height;
    if (s.holes > 0) { // level with the mean of the rest
        heights::remove_mean(whole);
        for (double& v : whole)
            if (std::isnan(v)) v = 0.0;
    }
    std::vector<Complex> wave(whole.begin(), whole.end());
    heights::transform(wave, n, n, FFTW_FORWARD);
    stat.spectrum.assign(static_cast<std::size_t>(n / 2) + 1, {});
    double slope2 = 0.0, curvature2 = 0.0;
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            const double kx = signed_wave(x, n), ky = signed_wave(y, n);
            const double power =
                std::norm(wave[static_cast<std::size_t>(y) * static_cast<std::size_t>(n) +
                               static_cast<std::size_t>(x)]) /
                (static_cast<double>(cells(n)) * static_cast<double>(cells(n)));
            const double k = std::sqrt(kx * kx + ky * ky);
            const double q2 = k * k * q_unit * q_unit;
            slope2 += power * q2;
            curvature2 += 0.25 * power * q2 * q2;
            const auto bin = static_cast<std::size_t>(std::lround(k));
            if (bin == 0 || bin >= stat.spectrum.size()) continue;
            stat.spectrum[bin].q += k * q_unit;
            stat.spectrum[bin].realised += power / (q_unit * q_unit);
            stat.spectrum[bin].target += target_spectrum(o, k * q_unit);
            stat.spectrum[bin].modes += 1;
        }
    stat.rms_slope = std::sqrt(slope2);
    stat.rms_curvature = std::sqrt(curvature2);
    std::erase_if(stat.spectrum, [](const SpectrumBin& b) { return b.modes == 0; });
    for (SpectrumBin& b : stat.spectrum) {
        b.q /= b.modes;
        b.realised /= b.modes;
        b.target /= b.modes;
    }
}

} // namespace

Surface finished(const SurfaceOptions& o, Surface s) {
    measure(o, s);
    if (o.radius > 0.0) {
        s.radius = o.radius;
        const double spacing = o.length / o.sites, centre = 0.5 * o.length;
        for (int y = 0; y < s.sites; ++y)
            for (int x = 0; x < s.sites; ++x) {
                const double dx = x * spacing - centre, dy = y * spacing - centre;
                s.height[static_cast<std::size_t>(y) * static_cast<std::size_t>(s.sites) +
                         static_cast<std::size_t>(x)] += cap_of(o.radius, dx, dy);
            }
        // In a box with free edges the sphere ends at its equator.
        s.holes =
            std::count_if(s.height.begin(), s.height.end(), [](double h) { return std::isnan(h); });
    }
    s.statistics.lowest = std::numeric_limits<double>::infinity();
    s.statistics.highest = -s.statistics.lowest;
    for (const double h : s.height) { // holes do not count
        if (h < s.statistics.lowest) s.statistics.lowest = h;
        if (h > s.statistics.highest) s.statistics.highest = h;
    }
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

Surface make_surface(const SurfaceOptions& o) {
    require(o.kind != SurfaceKind::file,
            "a measured surface is made from its heights (surface_from_heights), not from options");
    Surface s;
    s.sites = o.sites;
    s.length = o.length;
    s.height.assign(cells(o.sites), 0.0);
    if (o.kind == SurfaceKind::flat || o.rms == 0.0) return finished(o, std::move(s));

    const int n = o.sites;
    if (o.cutoff > 0.5 * n)
        s.notes.push_back(fmt::format("cutoff q1 = {:g} q_L lies above the Nyquist wavevector of "
                                      "{} sites; clipped to {:g} q_L",
                                      o.cutoff, n, 0.5 * n));
    std::vector<Complex> wave(cells(n));
    bool any = false;
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            const int kx = signed_wave(x, n), ky = signed_wave(y, n);
            const double c =
                shape(o, std::sqrt(static_cast<double>(kx) * kx + static_cast<double>(ky) * ky));
            if (c == 0.0) continue;
            const bool own_mirror = (2 * x) % n == 0 && (2 * y) % n == 0;
            wave[static_cast<std::size_t>(y) * static_cast<std::size_t>(n) +
                 static_cast<std::size_t>(x)] = std::sqrt(c) * random_factor(o, kx, ky, own_mirror);
            any = true;
        }
    require(any, fmt::format(
                     "{} sites hold no wave between q_L and q1 = {:g} q_L, so rms = {} Å cannot be "
                     "reached; use more sites or kind = \"flat\"",
                     n, o.cutoff, o.rms));
    heights::transform(wave, n, n, FFTW_BACKWARD);
    for (std::size_t i = 0; i < wave.size(); ++i)
        s.height[i] = wave[i].real();
    heights::remove_mean(s.height);
    heights::scale_to_rms(s.height, o.rms);
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

Surface surface_from_heights(const SurfaceOptions& o, std::vector<double> h, int nx, int ny) {
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
    Surface s;
    s.sites = o.sites;
    s.length = o.length;
    s.holes = std::count_if(h.begin(), h.end(), [](double v) { return std::isnan(v); });
    if (s.holes > 0) {
        require(s.holes < static_cast<long long>(h.size()),
                "the height map holds no height at all");
        require(
            !o.detrend && o.line_noise == LineNoise::keep && nx == ny && nx == sites_of_map(o),
            fmt::format("a map with holes is taken as it is, and its {} x {} points cover {} x {} "
                        "sites; bring it onto the lattice before, and leave detrend and "
                        "line_noise out",
                        nx, ny, sites_of_map(o), sites_of_map(o)));
    } else if (nx == ny) {
        const double edge = o.map_edge > 0.0 ? o.map_edge : o.length;
        s.doubts = treat_line_noise(h, nx, edge / nx, std::min(nx, sites_of_map(o)), o.line_noise);
    }
    if (o.detrend) {
        heights::remove_plane(h, nx, ny);
        s.notes.push_back("mean plane removed from the height map");
    }
    if (o.periodic) {
        const double before = heights::rms_of(h);
        heights::remove_jumps(h, nx, ny);
        s.notes.push_back(fmt::format("the map made periodic: rms {:.4g} Å before, {:.4g} Å after",
                                      before, heights::rms_of(h)));
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
        h = heights::resample(h, nx, ny, whole);
        s.notes.push_back(
            fmt::format("height map of {} x {} points resampled (Fourier, periodic) to {} x {}", nx,
                        ny, whole, whole));
    }
    if (whole > o.sites) {
        h = heights::middle(h, whole, o.sites);
        if (o.periodic) heights::remove_jumps(h, o.sites, o.sites);
        s.notes.push_back(fmt::format("the middle {:.6g} Å of the map are taken", o.length));
    }
    if (o.rms > 0.0) {
        const double own = heights::rms_of(h);
        double largest = 0.0;
        for (const double v : h) // a hole is no number, and no larger than any
            if (std::abs(v) > largest) largest = std::abs(v);
        require(
            own > 1e-12 * largest && own > 0.0,
            fmt::format("the height map is flat (rms = {:g} Å), so it cannot be scaled to rms = {} "
                        "Å; leave rms out or give a rough map",
                        own, o.rms));
        heights::remove_mean(h);
        heights::scale_to_rms(h, o.rms);
        s.notes.push_back(fmt::format("height map scaled from rms = {:g} Å to {:g} Å", own, o.rms));
    }
    const auto [inside, seam] = heights::steps(h, o.sites);
    if (o.repeats && seam > worst_seam * inside)
        s.notes.push_back(fmt::format(
            "the map does not repeat: over the box's edges heights jump by {:.3g} Å (rms), between "
            "neighbours inside by {:.3g} Å. The surface keeps this cliff; {}",
            seam, inside,
            o.kind == SurfaceKind::atoms ? "a box of whole periods of the substrate has none"
                                         : "surface.detrend = \"periodic\" removes it"));
    s.height = std::move(h);
    if (s.holes > 0)
        s.holes =
            std::count_if(s.height.begin(), s.height.end(), [](double v) { return std::isnan(v); });
    return finished(o, std::move(s));
}

} // namespace asperity
