// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/scene/accuracy.hpp"

#include "engine/scene/accuracy_table.hpp"
#include "engine/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace asperity {

namespace {

using calibration::Dial;

/// One setting of one dial; error and time of the settings that make a choice add and multiply.
struct Option {
    std::string key, value; ///< empty: the scene's own, whatever it is
    double error = 0.0, time = 1.0;
    void (*apply)(Scene&, double) = nullptr;
    double number = 0.0;
};

std::string percent(double fraction) { return fmt::format("{:.2g} %", 100.0 * fraction); }

void set_timestep(Scene& scene, double dt) { scene.drive.timestep = dt; }
void set_mixed(Scene& scene, double) { scene.numerics.precision = Precision::mixed; }
void set_layers(Scene& scene, double layers) {
    if (layers > 0.0)
        scene.block.layers_per_level = static_cast<int>(layers);
    else
        scene.block.model = BlockModel::lattice;
}

Option option_of(const calibration::Row& row, bool whole_path) {
    Option option{"", "", whole_path ? row.path : row.state, row.time, nullptr, row.value};
    switch (row.dial) {
    case Dial::timestep:
        option.key = "drive.timestep";
        option.value = fmt::format("{:g} fs", row.value);
        option.apply = set_timestep;
        break;
    case Dial::precision:
        option.key = "numerics.precision";
        option.value = "mixed";
        option.apply = set_mixed;
        break;
    case Dial::layers:
        option.key = row.value > 0.0 ? "block.layers_per_level" : "block.model";
        option.value = row.value > 0.0 ? fmt::format("{:g}", row.value) : "lattice";
        option.apply = set_layers;
        break;
    }
    return option;
}

bool stays_stable(const Scene& scene, const calibration::Row& row) {
    return row.dial != Dial::timestep || scene.surface.sites <= calibration::most_sites ||
           row.value <= calibration::longest_timestep_of_more;
}

/// What each dial may be set to in this scene.
std::vector<std::vector<Option>> options_of(const Scene& scene, std::vector<std::string>& kept) {
    const auto open = [&](const char* key) {
        if (!scene.positions.is_set(key)) return true;
        kept.emplace_back(key);
        return false;
    };
    const bool in_time = !scene.without_time();
    const auto rows = [&](Dial dial) {
        std::vector<Option> list;
        for (const calibration::Row& row : calibration::rows)
            if (row.dial == dial && stays_stable(scene, row))
                list.push_back(option_of(row, in_time));
        return list;
    };
    std::vector<std::vector<Option>> dials;
    const bool layers_open = open("block.layers_per_level"), model_open = open("block.model");
    if (in_time && layers_open && scene.block.model == BlockModel::multiscale) {
        dials.push_back(rows(Dial::layers));
        if (!model_open)
            std::erase_if(dials.back(), [](const Option& o) { return o.number == 0.0; });
    }
    if (in_time && open("drive.timestep")) dials.push_back(rows(Dial::timestep));
    if (open("numerics.precision")) {
        dials.push_back(rows(Dial::precision));
        dials.back().push_back({}); // double
    }
    return dials;
}

/// The cheapest combination within the target, one option a dial; empty: there is none. `least`
/// becomes the smallest error that any has.
std::vector<Option> cheapest(const std::vector<std::vector<Option>>& dials, double target,
                             double& least) {
    std::vector<Option> best;
    double best_time = std::numeric_limits<double>::infinity();
    std::vector<std::size_t> at(dials.size(), 0);
    least = best_time;
    for (bool more = true; more;) {
        double error = 0.0, time = 1.0;
        for (std::size_t d = 0; d < dials.size(); ++d) {
            error += dials[d][at[d]].error;
            time *= dials[d][at[d]].time;
        }
        least = std::min(least, error);
        if (error <= target && time < best_time) {
            best_time = time;
            best.clear();
            for (std::size_t d = 0; d < dials.size(); ++d)
                best.push_back(dials[d][at[d]]);
        }
        std::size_t d = 0; // the next combination
        while (d < dials.size() && ++at[d] == dials[d].size())
            at[d++] = 0;
        more = d < dials.size();
    }
    return best;
}

/// Keys that the calibration knows one value of, and limits of others.
void check_coverage(const Scene& scene, io::Problems& problems) {
    const Scene known;
    const auto outside = [&](const std::string& key, const std::string& value,
                             const std::string& covered) {
        problems.add(key, value + " is outside the calibration of numerics.accuracy",
                     "it was measured for " + covered,
                     "choose the settings yourself (numerics.accuracy = \"none\"); asperity cost "
                     "measures what they cost this scene");
    };
    const auto same = [&](const char* key, double value, double measured) {
        if (std::abs(value - measured) > 1e-3 * std::abs(measured))
            outside(key, fmt::format("= {:.6g}", value), fmt::format("{:.6g}", measured));
    };
    const auto& s = scene.surface;
    same("surface.spacing", s.spacing, known.surface.spacing);
    same("surface.lattice_ratio", s.lattice_ratio, known.surface.lattice_ratio);
    same("block.young", scene.block.young, known.block.young);
    same("block.poisson", scene.block.poisson, known.block.poisson);
    same("block.atom_mass", scene.block.atom_mass, known.block.atom_mass);
    if (scene.interface.kind == InterfaceKind::wall)
        outside("interface.kind", "= \"wall\"", "atoms");
    same("interface.epsilon", scene.interface.epsilon, known.interface.epsilon);
    same("interface.r0", scene.interface.r0, known.interface.r0);
    if (scene.block.strain == Strain::finite)
        outside("block.strain", "= \"finite\"", "small strain");
    if (scene.drive.temperature > 0.0)
        outside("drive.temperature", fmt::format("= {:.6g} K", scene.drive.temperature), "0 K");
    if (!scene.without_time() && scene.drive.velocity > calibration::fastest)
        outside("drive.velocity", fmt::format("= {:.6g} m/s", scene.drive.velocity),
                fmt::format("{:g} m/s and less", calibration::fastest));
    if (s.sites < calibration::fewest_sites)
        outside("surface.sites", fmt::format("= {}", s.sites),
                fmt::format("{} and more", calibration::fewest_sites));
    if (s.radius)
        outside("surface.radius", fmt::format("= {:.6g} Å", *s.radius),
                "solids that are not curved");
    if (s.reads_file())
        outside("surface.kind", s.kind == SurfaceKind::file ? "= \"file\"" : "= \"atoms\"",
                "self-affine surfaces");
    if (s.kind == SurfaceKind::self_affine)
        if (const double bending = bending_energy(scene); bending > calibration::most_bending)
            outside("surface.rms",
                    fmt::format("= {:.6g} Å, where full contact takes {:.0f} meV/Å² of bending,",
                                s.rms, bending),
                    fmt::format("up to {:.0f} meV/Å²", calibration::most_bending));
}

} // namespace

double bending_energy(const Scene& scene) {
    const Scene::Surface& s = scene.surface;
    // In units of q_L: h² ~ ∫ q C dq and <q h²> ~ ∫ q² C dq, with C = 1 from 1 to q0 and
    // (q/q0)^-2(1+H) from there to q1.
    const double q1 = std::min(s.cutoff, 0.5 * s.sites), q0 = std::min(s.rolloff, q1);
    const auto moment = [&](double n) { // ∫ q^n C dq
        const double flat = (std::pow(q0, n + 1.0) - 1.0) / (n + 1.0);
        const double power = n + 1.0 - 2.0 * (1.0 + s.hurst);
        const double fall =
            std::abs(power) < 1e-9 ? std::log(q1 / q0) : (std::pow(q1 / q0, power) - 1.0) / power;
        return flat + std::pow(q0, n + 1.0) * fall;
    };
    const double wave = 2.0 * std::numbers::pi / scene.edge();
    const double mean = moment(1.0) > 0.0 ? moment(2.0) / moment(1.0) : 1.0; // one wave: q_L
    const double modulus =
        scene.block.young * units::gigapascal / (1.0 - scene.block.poisson * scene.block.poisson);
    return units::milli_per_unit * 0.25 * modulus * s.rms * s.rms * wave * mean;
}

void choose_accuracy(Scene& scene, io::Problems& problems) {
    if (!scene.numerics.accuracy) return;
    const std::size_t before = problems.list().size();
    check_coverage(scene, problems);
    if (problems.list().size() > before) return;
    AccuracyChoice choice;
    choice.target = *scene.numerics.accuracy;
    const auto dials = options_of(scene, choice.kept);
    double least = 0.0;
    const std::vector<Option> chosen = cheapest(dials, choice.target, least);
    if (chosen.size() != dials.size()) {
        problems.add("numerics.accuracy", "= " + percent(choice.target) + " is not covered",
                     fmt::format("the smallest error that the calibration knows for what this "
                                 "scene leaves open is {}",
                                 percent(least)),
                     fmt::format("ask for {} or more, or choose the settings yourself; asperity "
                                 "cost measures what they cost this scene",
                                 percent(1.01 * least)));
        return;
    }
    for (const Option& option : chosen) {
        if (!option.apply) continue;
        option.apply(scene, option.number);
        choice.settings.emplace_back(option.key, option.value);
        choice.expected_error += option.error;
    }
    choice.calibration = calibration::source;
    scene.choice = std::move(choice);
}

std::optional<LongerStep> longer_timestep(const Scene& scene) {
    io::Problems outside;
    check_coverage(scene, outside);
    if (scene.without_time() || !outside.list().empty()) return std::nullopt;
    LongerStep longest = {0.0, 0.0};
    for (const calibration::Row& row : calibration::rows)
        if (row.dial == Dial::timestep && row.value > longest.timestep && stays_stable(scene, row))
            longest = {row.value, row.path};
    if (2.0 * scene.drive.timestep >= longest.timestep) return std::nullopt;
    return longest;
}

std::vector<std::string> accuracy_lines(const AccuracyChoice& choice) {
    std::string chosen, kept;
    for (const auto& [key, value] : choice.settings)
        chosen += fmt::format("{}{} = {}", chosen.empty() ? "" : ", ", key, value);
    for (const std::string& key : choice.kept)
        kept += (kept.empty() ? "" : ", ") + key;
    std::vector<std::string> lines = {
        fmt::format("for {}: {}", percent(choice.target),
                    chosen.empty() ? "nothing was left to choose" : chosen),
        fmt::format("up to {} of error expected ({})", percent(choice.expected_error),
                    choice.calibration)};
    if (!kept.empty()) lines.push_back("kept as the scene says, and not in that error: " + kept);
    return lines;
}

} // namespace asperity
