// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/commands/commands.hpp"

#include "engine/run/run_record.hpp"
#include "engine/run/theory_case.hpp"
#include "engine/units.hpp"
#include "io/error.hpp"
#include "io/hdf5_file.hpp"
#include "io/result.hpp"
#include "io/result_directory.hpp"
#include "io/terminal.hpp"
#include "theory/maugis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

namespace asperity {

namespace {

/// theory.h5: everything at every magnification, and the spectrum that it came from.
void write_profile(const std::string& path, const TheoryCase& what, const TheoryNumbers& n) {
    io::Hdf5File file(path, io::Hdf5File::Mode::create);
    const auto& profile = n.state.profile;
    using Point = theory::ProfilePoint;
    const auto column = [&](const char* name, const char* unit, const char* doc,
                            const std::function<double(const Point&)>& value) {
        std::vector<double> values;
        for (const Point& p : profile)
            values.push_back(value(p));
        const std::string set = std::string("/profile/") + name;
        file.write<double>(set, {values.size()}, values);
        file.write_attribute(set, "unit", unit);
        file.write_attribute(set, "doc", doc);
    };
    const double meV = units::milli_per_unit, gpa = 1.0 / units::gigapascal;
    file.make_group("/profile");
    column("q", "1/Å", "wavevector", [](const Point& p) { return p.q; });
    column("zeta", "", "magnification q/q_L", [](const Point& p) { return p.zeta; });
    column("C", "Å^4", "power spectrum C(q)",
           [&](const Point& p) { return what.contact.spectrum(p.q); });
    column("A", "", "A/A0, projected contact area", [](const Point& p) { return p.area; });
    column("A_real", "", "A*/A0, following the roughness",
           [](const Point& p) { return p.real_area; });
    column("gamma_eff", "meV/Å^2", "Eq. (3)", [=](const Point& p) { return meV * p.gamma_eff; });
    column("sigma_a", "GPa", "detachment stress, Eq. (4)",
           [=](const Point& p) { return gpa * p.detachment_stress; });
    column("U_el", "meV/Å^2", "elastic energy over A0 of roughness from q to q1, Eq. (5)",
           [=](const Point& p) { return meV * p.elastic_energy; });
    column("stress_variance", "GPa^2", "T(q), of the stress at full contact",
           [=](const Point& p) { return gpa * gpa * p.stress_variance; });
    file.write_attribute("/profile", "delta_gamma", what.delta_gamma);
    file.write_attribute("/profile", "status", std::string(theory::name(n.state.status)));
    file.close();
}

/// Computed by `asperity theory` only: where adhesion ends.
struct Beyond {
    std::optional<theory::CriticalRoughness> critical;
    std::string note; ///< why something is not there
};

Beyond look_beyond(const TheoryCase& what) {
    Beyond beyond;
    if (what.contact.spectrum.q1() > 0.0 && !what.contact.spectrum.smooth()) try {
            beyond.critical = theory::critical_roughness(what.contact);
        } catch (const std::exception& error) {
            beyond.note = error.what();
        }
    return beyond;
}

const char* in_words(theory::Status status) {
    switch (status) {
    case theory::Status::adhesive:
        return "the surfaces hold together without any load";
    case theory::Status::pressed:
        return "the load alone holds the surfaces together: it takes more energy to bend them into "
               "contact than the bonds give back";
    case theory::Status::no_contact:
        return "there is no adhesive solution: the surfaces come apart, and all is zero";
    }
    return "";
}

void print_theory(const Case& c, const TheoryCase& what, const TheoryNumbers& n,
                  const Beyond& beyond) {
    const Scene& scene = c.scene;
    const auto& spectrum = what.contact.spectrum;
    fmt::print("{}: Persson's theory, Eqs. (1) to (5), rms {:.4g} Å, rms slope {:.4g}, load {:.6g} "
               "MPa\n\n",
               scene.name, spectrum.rms_height(), spectrum.rms_slope(), scene.drive.load);
    io::Table table({"", "meV/Å²", "over Δγ", "± (grid)"});
    const auto energy = [&](const std::string& name, double value, double error = -1.0) {
        table.row({name, fmt::format("{:.3f}", value),
                   fmt::format("{:.5f}", value / what.delta_gamma),
                   error < 0.0 ? std::string() : fmt::format("{:.1e}", error)});
    };
    energy(scene.theory.delta_gamma ? "Δγ, as the scene says" : "Δγ, flat on flat",
           what.delta_gamma);
    energy("γ_eff", n.gamma_eff, n.state.gamma_ratio_error);
    energy("γ assuming full contact", n.gamma_full_contact);
    energy("elastic energy U_el", units::milli_per_unit * n.state.elastic_energy);
    table.row({"contact area A/A0", "", fmt::format("{:.5f}", n.state.area),
               fmt::format("{:.1e}", n.state.area_error)});
    if (n.renormalised && n.renormalised->numbers) {
        const RenormalisedNumbers& r = *n.renormalised->numbers;
        table.row({"renormalised theory: γ_eff", fmt::format("{:.3f}", r.gamma_eff),
                   fmt::format("{:.5f}", r.gamma_eff_ratio),
                   fmt::format("{:.1e}", r.gamma_eff_error / what.flat)});
        table.row({"  contact area", "", fmt::format("{:.5f}", r.contact_fraction),
                   fmt::format("{:.1e}", r.contact_fraction_error)});
    }
    table.print(stdout);
    fmt::print("\n");
    if (beyond.critical)
        fmt::print("  critical rms   {:.4f} ± {:.1e} Å: beyond it nothing holds (assuming full "
                   "contact: {:.4f} Å)\n",
                   beyond.critical->h_rms, beyond.critical->error,
                   beyond.critical->full_contact_h_rms);
    if (n.theta)
        fmt::print("  theta          {:.4f} = E* h² q0 / Δγ{}\n", *n.theta,
                   beyond.critical
                       ? fmt::format(
                             ", {:.4f} at the critical rms",
                             *n.theta * std::pow(beyond.critical->h_rms / spectrum.rms_height(), 2))
                       : "");
    if (n.jkr_pull_off_force) {
        const double w = what.contact.work_of_adhesion;
        const double E = scene.block.young * units::gigapascal;
        const double length = zero_of(c.simulation.interface.potential);
        fmt::print("  JKR pull-off   {:.2f} eV/Å with γ_eff, R = {:.6g} Å; Tabor number of the "
                   "smooth sphere {:.3f} with E, {:.3f} with E*\n",
                   *n.jkr_pull_off_force, *what.radius,
                   theory::tabor_number(*what.radius, w, E, length),
                   theory::tabor_number(*what.radius, w, what.contact.contact_modulus, length));
    }
    fmt::print("  status         {}\n", in_words(n.state.status));
    if (n.state.status != theory::Status::adhesive)
        fmt::print("                 (in eV and Å: {})\n", n.state.reason);
    if (!n.state.converged)
        fmt::print("                 NOT converged to 1e-5: see the errors in the table\n");
    if (n.renormalised && n.renormalised->numbers &&
        n.renormalised->numbers->gamma_eff_expected_error) {
        const RenormalisedNumbers& r = *n.renormalised->numbers;
        fmt::print(
            "  renormalised   γ_eff {:.3f} ± {:.3f} Δγ, contact area {:.3f} ± {:.3f}: 19 of 20 "
            "simulated surfaces at zero load\n",
            r.gamma_eff_ratio, *r.gamma_eff_expected_error / what.flat, r.contact_fraction,
            *r.contact_fraction_expected_error);
    }
    if (n.renormalised && n.renormalised->numbers)
        fmt::print("  renormalised   mean separation {}, largest tension {:.4g} GPa\n",
                   n.renormalised->numbers->separation
                       ? fmt::format("{:.3f} Å", *n.renormalised->numbers->separation)
                       : std::string("undefined, nothing binds"),
                   n.renormalised->numbers->tension);
    if (n.renormalised && !n.renormalised->note.empty())
        fmt::print("  note: {}\n", n.renormalised->note);
    for (const std::string& note : what.notes)
        fmt::print("  note: {}\n", note);
    if (!beyond.note.empty()) fmt::print("  note: {}\n", beyond.note);
}

} // namespace

int theory_command(const Case& c, const std::string& out, bool json) {
    const Scene& scene = c.scene;
    const auto start = std::chrono::steady_clock::now();
    const TheoryCase what = theory_case(c);
    const TheoryNumbers numbers = solve_theory(what);
    const Beyond beyond = look_beyond(what);

    io::Result result = scene_result(scene);
    if (!what.origin.empty()) result.set("surface.origin", what.origin);
    result.set("delta_gamma", what.flat);
    record_theory(what, numbers, result);
    if (beyond.critical) {
        result.set("theory.critical_rms", beyond.critical->h_rms);
        result.set("theory.critical_rms_full_contact", beyond.critical->full_contact_h_rms);
    }
    result.set("run.wall_seconds",
               std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    if (json) {
        fmt::print("{}", result.text(-1));
        return io::exit_code::done;
    }
    const io::ResultDirectory place({out, scene.name + "-theory"});
    write_profile(place.directory() / "theory.h5", what, numbers);
    io::write_result(place.directory(), result);

    print_theory(c, what, numbers, beyond);
    for (const std::string& note : place.notes())
        fmt::print("  note: {}\n", note);
    fmt::print("  written: {0}/result.json, {0}/theory.h5 (the profile over magnification)\n",
               place.path());
    return io::exit_code::done;
}

} // namespace asperity
