// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/case/site_map.hpp"

#include "engine/case/site_field.hpp"
#include "engine/scene/heights.hpp"
#include "engine/scene/scene_files.hpp"
#include "io/error.hpp"
#include "io/files.hpp"
#include "io/units.hpp"

#include <Random123/philox.h>

#include <fftw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <sstream>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace asperity {

namespace {

constexpr double pi = std::numbers::pi;

/// Stands for the unit of a seed, a whole number that doubles hold exactly.
constexpr const char* seed_unit = "seed";
constexpr double largest_seed = 0x1p53;

/// A formula: its name and its numbers, with their units in the engine.
struct Formula {
    std::string name;
    std::vector<std::string> units; ///< unit of each number
    std::string form, example;
    /// Lengths that sites must resolve: index of the number, factor and words.
    struct Extent {
        std::size_t number;
        double factor;
        const char* words;
    };
    std::vector<Extent> extents;
};

std::vector<Formula> formulas_of(const io::SiteQuantity& of) {
    const std::string unit(of.unit), high(of.high), both = fmt::format("{} {}", of.low, of.high);
    std::vector<Formula> all = {{"stripes",
                                 {unit, unit, "Å"},
                                 "stripes LOW HIGH PERIOD",
                                 "stripes " + both + " 20 nm",
                                 {{2, 1.0, "a period"}}},
                                {"discs",
                                 {unit, unit, "Å", "Å"},
                                 "discs LOW HIGH RADIUS DISTANCE",
                                 "discs " + both + " 5 nm 20 nm",
                                 {{2, 2.0, "a diameter"}, {3, 1.0, "a distance"}}},
                                {"rings",
                                 {unit, "", "Å"},
                                 "rings MEAN AMPLITUDE PERIOD",
                                 "rings " + high + " 0.2 10 nm",
                                 {{2, 1.0, "a period"}}},
                                {"patches",
                                 {unit, unit, "Å", seed_unit},
                                 "patches LOW HIGH LENGTH SEED",
                                 "patches " + both + " 5 nm 1",
                                 {{2, 1.0, "a correlation length"}}}};
    return all;
}

/// Error of a formula, in words that follow the key and its value.
struct BadFormula {
    std::string what, why, fix;
};

/// Returns the numbers of a formula of a quantity. Throws BadFormula.
std::vector<double> numbers_of(const Formula& formula, const std::string& text,
                               const io::SiteQuantity& of) {
    std::istringstream words(text.substr(formula.name.size()));
    std::vector<std::string> quantities;
    for (std::string word; words >> word;)
        if (quantities.empty() ||
            std::string_view("+-.0123456789").find(word.front()) != std::string_view::npos)
            quantities.push_back(word);
        else
            quantities.back() += " " + word;
    const std::string fix =
        fmt::format("write \"{}\", as in \"{}\"", formula.form, formula.example);
    if (quantities.size() != formula.units.size())
        throw BadFormula{fmt::format("has {} numbers", quantities.size()),
                         fmt::format("the formula has {}", formula.units.size()), fix};
    std::vector<double> numbers;
    for (std::size_t i = 0; i < quantities.size(); ++i) {
        const bool length = formula.units[i] == "Å", seed = formula.units[i] == seed_unit;
        const io::ParsedQuantity read =
            io::parse_quantity(quantities[i], seed ? "" : formula.units[i]);
        if (!read.why.empty())
            throw BadFormula{fmt::format("has '{}'", quantities[i]), read.why, fix};
        if (!std::isfinite(read.value) || read.value < 0.0 || (length && read.value == 0.0))
            throw BadFormula{
                fmt::format("has '{}'", quantities[i]),
                length ? "a length is above zero"
                       : fmt::format("a {}, an amplitude and a seed are zero or more", of.words),
                fix};
        if (seed && !(read.value == std::floor(read.value) && read.value <= largest_seed))
            throw BadFormula{fmt::format("has a seed of {}", quantities[i]),
                             fmt::format("a seed is a whole number up to {:.0f}", largest_seed),
                             fix};
        numbers.push_back(read.value);
    }
    return numbers;
}

/// The sites of a box, in bands.
struct Square {
    int sites;
    double spacing;
    Bands bands;
    double edge() const { return sites * spacing; }

    /// Returns the values at(x, y) of the sites of this rank's band.
    template <class At>
    std::vector<double> of(const At& at) const {
        std::vector<double> values;
        values.reserve(bands.size());
        each([&](int x, int y, std::size_t) { values.push_back(at(x * spacing, y * spacing)); });
        return values;
    }
    /// Calls visit(x, y, place in the band) for each site of this rank's band.
    template <class Visit>
    void each(const Visit& visit) const {
        for (int y = bands.first(); y < bands.first() + bands.held(); ++y)
            for (int x = 0; x < sites; ++x)
                visit(x, y, bands.at(x, y));
    }
};

/// Returns the period nearest to one that fits into the box a whole number of times, of two sites
/// at least.
double fitting(double period, const Square& box) {
    const double most = std::floor(0.5 * box.sites);
    return box.edge() / std::clamp(std::round(box.edge() / period), 1.0, most);
}

/// Returns a field of random numbers whose autocorrelation is exp(-r^2 / length^2), times a factor.
std::vector<double> random_field(const Square& box, double length, std::uint64_t seed) {
    const int n = box.sites;
    std::vector<std::complex<double>> wave(box.bands.size());
    box.each([&](int x, int y, std::size_t i) {
        const auto bits = r123::Philox4x32()(
            {{static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), 0u, 1u}},
            {{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)}});
        wave[i] = bits[0] * 0x1p-32 - 0.5;
    });
    box.bands.transform(wave, FFTW_FORWARD);
    const double unit_q = 2.0 * pi / box.edge();
    box.each([&](int x, int y, std::size_t i) {
        const double kx = std::min(x, n - x), ky = std::min(y, n - y);
        const double q = unit_q * std::sqrt(kx * kx + ky * ky);
        wave[i] *= std::exp(-q * q * length * length / 8.0);
    });
    box.bands.transform(wave, FFTW_BACKWARD);
    std::vector<double> field;
    field.reserve(wave.size());
    for (const std::complex<double>& value : wave)
        field.push_back(value.real());
    return field;
}

/// Returns the number of values of a map that are below a bound. Collective.
std::int64_t count_below(const std::vector<double>& band, const Bands& bands, double bound) {
    std::array<std::int64_t, 1> count = {
        std::count_if(band.begin(), band.end(), [&](double value) { return value < bound; })};
    bands.ranks().sum(count);
    return count[0];
}

/// Returns a bound below which half of the values of a map are, of different values. Collective.
double median_of(const std::vector<double>& band, const Bands& bands) {
    double low = 0.0, high = 0.0;
    for (const double value : band)
        low = std::min(low, value), high = std::max(high, value);
    low = -bands.ranks().max(-low), high = std::nextafter(bands.ranks().max(high), HUGE_VAL);
    const std::int64_t half = static_cast<std::int64_t>(bands.columns()) * bands.rows() / 2;
    while (true) { // no more than half are below `low`, and more below `high`
        const double middle = 0.5 * (low + high);
        if (!(middle > low && middle < high)) return low;
        (count_below(band, bands, middle) > half ? high : low) = middle;
    }
}

/// Refuses lengths of a formula that the sites do not resolve. Throws BadFormula.
void refuse_too_fine(const Formula& formula, const std::vector<double>& numbers,
                     const Square& box) {
    constexpr double fewest = 2.0; // sites over a length, as for a wave at Nyquist
    for (const Formula::Extent& extent : formula.extents) {
        const double length = extent.factor * numbers[extent.number];
        if (length >= fewest * box.spacing * (1.0 - 1e-9)) continue;
        throw BadFormula{fmt::format("has {} of {:.6g} Å", extent.words, length),
                         fmt::format("sites are {:.6g} Å apart (surface.spacing), and a pattern "
                                     "finer than two of them is another one on the sites",
                                     box.spacing),
                         fmt::format("take {} of {:.6g} Å at least, or surface.spacing = {:.4g}",
                                     extent.words, fewest * box.spacing, length / fewest)};
    }
}

/// Returns the mean of a formula over an infinite plane; nothing for discs that overlap.
std::optional<double> mean_of(const Formula& formula, const std::vector<double>& p) {
    if (formula.name == "rings") return p[0];
    if (formula.name != "discs") return 0.5 * (p[0] + p[1]);
    if (2.0 * p[2] > p[3]) return {};
    return p[0] + (p[1] - p[0]) * pi * p[2] * p[2] / (p[3] * p[3]);
}

/// Notes a mean over the sites that is not that of the formula: of a coarse pattern, or of one that
/// the box cuts.
void note_other_mean(const Formula& formula, const std::vector<double>& numbers,
                     const io::SiteQuantity& of, double mean, std::vector<std::string>& notes) {
    constexpr double part = 0.01;
    const std::optional<double> asked = mean_of(formula, numbers);
    if (!asked || std::abs(mean - *asked) <= part * *asked) return;
    notes.push_back(fmt::format("interface.{}: the mean over the sites is {:.4g} {}, and that of "
                                "\"{}\" without an end {:.4g} {}",
                                of.name, mean, of.unit, formula.name, *asked, of.unit));
}

/// Returns the values of a formula with these numbers on the sites of the box. Throws BadFormula.
std::vector<double> values_of(const Formula& formula, const std::vector<double>& p,
                              const io::SiteQuantity& of, const Square& box,
                              std::vector<std::string>& notes) {
    const auto period_of = [&](double asked) {
        const double used = fitting(asked, box);
        if (asked > box.edge())
            throw BadFormula{fmt::format("has a period of {:.6g} Å", asked),
                             fmt::format("the box is {:.6g} Å wide, and repeats", box.edge()),
                             "take a shorter period or a wider box"};
        if (std::abs(used - asked) > 1e-9 * asked)
            notes.push_back(
                fmt::format("interface.{}: the period of {:.6g} Å is {:.6g} Å, of which {:.0f} "
                            "fit into the box",
                            of.name, asked, used, box.edge() / used));
        return used;
    };
    // A site on the border of two stripes is on its far side, however x / period is rounded.
    const auto phase = [](double x, double period) {
        const double periods = x / period + 1e-9;
        return periods - std::floor(periods);
    };
    if (formula.name == "stripes") {
        const double period = period_of(p[2]);
        return box.of([&](double x, double) { return phase(x, period) < 0.5 ? p[0] : p[1]; });
    }
    if (formula.name == "discs") {
        const double distance = period_of(p[3]);
        return box.of([&](double x, double y) {
            const double dx = distance * (phase(x, distance) - 0.5),
                         dy = distance * (phase(y, distance) - 0.5);
            return dx * dx + dy * dy < p[2] * p[2] ? p[1] : p[0];
        });
    }
    if (formula.name == "rings") {
        if (p[1] > 1.0)
            throw BadFormula{
                fmt::format("has an amplitude of {:.6g}", p[1]),
                fmt::format("above 1 the {} would be negative between the rings", of.words),
                "take an amplitude from 0 to 1"};
        const double middle = 0.5 * box.edge();
        return box.of([&](double x, double y) {
            const double along_x = x - middle, along_y = y - middle;
            const double r = std::sqrt(along_x * along_x + along_y * along_y);
            return p[0] * (1.0 + p[1] * std::cos(2.0 * pi * r / p[2]));
        });
    }
    const std::vector<double> field = random_field(box, p[2], static_cast<std::uint64_t>(p[3]));
    const double median = median_of(field, box.bands);
    std::vector<double> values;
    values.reserve(field.size());
    for (const double value : field)
        values.push_back(value >= median ? p[1] : p[0]);
    return values;
}

/// Returns the smallest and the largest value of a map. Collective.
std::pair<double, double> extremes(const std::vector<double>& band, const Bands& bands) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const double value : band)
        low = std::min(low, value), high = std::max(high, value);
    return {-bands.ranks().max(-low), bands.ranks().max(high)};
}

/// Returns the values of a file on the sites of the box. Throws io::SceneError.
std::vector<double> values_of_file(Case& c, const io::SiteQuantity& of, const std::string& file,
                                   const Square& box) {
    const SiteMapKeys& keys = c.scene.interface.maps[of.map];
    const std::string key = fmt::format("interface.{}", of.name);
    io::HeightMap map = read_field({keys.source,
                                    file,
                                    {keys.unit,
                                     keys.missing == MapMissing::fill,
                                     keys.crop == MapCrop::middle,
                                     keys.size,
                                     false,
                                     {std::string(of.words), std::string(of.name),
                                      std::string(of.unit), key, std::string(of.dimension)}}},
                                   box.bands.ranks())
                            .map;
    SurfaceOptions covered;
    covered.sites = box.sites;
    covered.length = box.edge();
    covered.map_edge = map.width.value_or(0.0);
    const int points = static_cast<int>(map.rows), whole = sites_of_map(covered);
    const auto refuse = [&](const std::string& what, const std::string& why,
                            const std::string& fix) {
        throw io::SceneError(io::Problem{c.scene.positions.where(key),
                                         fmt::format("{} = \"{}\" {}", key, keys.source, what), why,
                                         fix});
    };
    if (whole < box.sites)
        refuse(fmt::format("is {:.6g} Å wide", *map.width),
               fmt::format("the box is {:.6g} Å wide", box.edge()),
               fmt::format("take surface.spacing = {:.10g}, or stretch the map on purpose with "
                           "{}_size = {:.6g}",
                           *map.width / box.sites, key, box.edge()));
    const bool resampled = c.scene.surface.kind == SurfaceKind::file &&
                           c.scene.surface.resample == Resample::band_limited;
    if (points != whole && !resampled)
        refuse(fmt::format("has {} x {} values", points, points),
               fmt::format("it covers {} x {} sites", whole, whole),
               fmt::format("give a map of that size, or set surface.sites = {}", points));
    Bands bands(box.bands.ranks(), points);
    std::vector<double> values = bands.spread(std::move(map.heights));
    const auto [low, high] = extremes(values, bands);
    if (low < 0.0)
        refuse(fmt::format("has a value of {:.4g} {}", low, of.unit), std::string(of.negative),
               "set the negative values of the map to 0 before, or correct its zero");
    if (points != whole) {
        values = heights::resample(values, bands, whole);
        bands = {box.bands.ranks(), whole};
        for (double& value : values) // waves overshoot beside jumps
            value = std::clamp(value, low, high);
        map.notes.push_back(fmt::format("the field of {} x {} values resampled (Fourier, periodic) "
                                        "to {} x {}, and kept within its range",
                                        points, points, whole, whole));
    }
    if (whole > box.sites) {
        values = heights::middle(values, bands, box.sites);
        map.notes.push_back(fmt::format("the middle {:.6g} Å of the field are taken", box.edge()));
    }
    for (const auto* list : {&map.doubts, &map.notes})
        for (const std::string& note : *list)
            c.notes.push_back(fmt::format("{}: {}", key, note));
    return values;
}

/// Sets the sum and the digest of the values. Collective.
void find_sum_and_digest(SiteMap& map) {
    std::array<double, 2> sums{};
    map.bands().in_order(sums, [&] {
        for (const double value : map.values)
            sums[0] += value;
        sums[1] = io::digest_of(std::as_bytes(std::span(std::as_const(map.values))),
                                static_cast<std::uint32_t>(sums[1]));
    });
    map.sum = sums[0];
    map.digest = static_cast<std::uint32_t>(sums[1]);
}

} // namespace

std::shared_ptr<const SiteMap> site_map(Case& c, const io::SiteQuantity& of,
                                        const Communicator& world, io::Problems& problems) {
    const std::string &text = c.scene.interface.maps[of.map].source,
                      key = fmt::format("interface.{}", of.name);
    const Square box{
        c.scene.surface.sites, c.scene.surface.spacing, {world, c.scene.surface.sites}};
    auto map = std::make_shared<SiteMap>();
    map->name = of.name;
    map->source = text;
    map->sites = box.sites;
    map->ranks = world;
    const std::vector<Formula> formulas = formulas_of(of);
    const auto formula = std::find_if(formulas.begin(), formulas.end(), [&](const Formula& f) {
        return text == f.name || text.starts_with(f.name + " ");
    });
    try {
        if (formula != formulas.end()) {
            const std::vector<double> numbers = numbers_of(*formula, text, of);
            refuse_too_fine(*formula, numbers, box);
            map->values = values_of(*formula, numbers, of, box, c.notes);
            find_sum_and_digest(*map);
            note_other_mean(*formula, numbers, of, map->mean(), c.notes);
        } else {
            const std::size_t colon = text.find(":/");
            map->file = find_beside_scene(c.scene, text.substr(0, colon), key);
            if (map->file.empty())
                throw BadFormula{"is neither a file nor a formula",
                                 fmt::format("a map of the {} is looked for beside the scene and "
                                             "in the working directory; formulas are stripes, "
                                             "discs, rings and patches",
                                             of.words),
                                 fmt::format("give the path of a map, or write, for example, "
                                             "\"{}\"",
                                             formulas.front().example)};
            if (colon != std::string::npos) map->file += text.substr(colon);
            map->values = values_of_file(c, of, map->file, box);
            find_sum_and_digest(*map);
        }
    } catch (const BadFormula& bad) {
        problems.add(key, fmt::format("= \"{}\" {}", text, bad.what), bad.why, bad.fix);
        return nullptr;
    } catch (const io::SceneError& error) {
        for (const io::Problem& problem : error.problems())
            problems.add(problem);
        return nullptr;
    } catch (const RootFailure& error) { // whose reason the root has
        problems.add(key, std::string(": ") + error.what());
        return nullptr;
    } catch (const std::invalid_argument& error) { // thrown for its size
        problems.add(key, std::string(": ") + error.what());
        return nullptr;
    }
    std::tie(map->least, map->largest) = extremes(map->values, map->bands());
    return map;
}

} // namespace asperity
