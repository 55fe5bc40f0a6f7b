// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/commands/report.hpp"

#include "engine/units.hpp"
#include "io/progress.hpp"
#include "io/table.hpp"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace asperity {

std::string minus(std::string number) {
    return number.starts_with('-') ? "−" + number.substr(1) : number;
}

std::string percent(double fraction) {
    return minus(fmt::format("{:.{}f}\u00a0%", 100.0 * fraction, std::abs(fraction) < 0.1 ? 2 : 1));
}

std::string in_words(const std::string& state) {
    if (state == "zero-load") return "at zero load";
    if (state == "pull-off") return "at the largest attraction of the pull-off";
    const std::string after = "after-zero-load:", step = "step-";
    if (state.starts_with(after)) return state.substr(after.size()) + " ps after zero load";
    if (state.starts_with(step)) return "at step " + state.substr(step.size());
    return "“" + state + "”";
}

namespace {

/// A smooth sphere's pull-off force for a work of adhesion in meV/Å^2, as JKR's F = 3πγR/2: eV/Å.
double smooth_pull_off(const StoredRun& run, double gamma) {
    return 1.5 * std::numbers::pi * *run.scene->surface.radius * gamma / units::milli_per_unit;
}

std::string meV(double gamma) { return minus(fmt::format("{:.2f} meV/Å²", gamma)); }

} // namespace

std::string lead(const StoredRun& run) {
    if (!run.scene) return "";
    const Scene& s = *run.scene;
    std::string surface = s.surface.kind == SurfaceKind::flat   ? "a flat substrate"
                          : s.surface.kind == SurfaceKind::file ? "a measured substrate"
                                                                : "a self-affine rough substrate";
    if (const auto rms = run.number("surface.rms"); rms && *rms > 0.0) {
        surface += fmt::format(" (rms height {:.3g} Å", *rms);
        if (const auto slope = run.number("surface.rms_slope"))
            surface += fmt::format(", rms slope {:.2g}", *slope);
        surface += ")";
    }
    if (s.surface.radius)
        surface += fmt::format(" on a sphere of R = {:.4g} nm", 0.1 * *s.surface.radius);
    return fmt::format("An elastic block on {}: {} × {} atoms, {:.1f} nm wide, {} layers thick.",
                       surface, s.surface.sites, s.surface.sites, 0.1 * s.edge(),
                       s.block.thickness);
}

std::vector<io::KeyNumber> key_numbers(const StoredRun& run) {
    std::vector<io::KeyNumber> list;
    const double flat = run.number("delta_gamma").value_or(0.0);
    const auto gamma = [&](const char* key, const char* name, const char* symbol = "γ_{eff}/Δγ") {
        if (const auto value = run.number(key); value && flat > 0.0)
            list.push_back(
                {minus(fmt::format("{:.3f}", *value / flat)), symbol, name, meV(*value)});
    };
    const auto nanonewton = [](double force) {
        return fmt::format("{:.4g} nN", force / units::nanonewton);
    };
    const auto force = run.number("pull_off_force");
    const auto in = run.number("work_of_adhesion.approach"),
               out = run.number("work_of_adhesion.pull_off");
    if (run.curved()) { // energies over the nominal area mean nothing
        gamma("jkr.out", "from the pull-off force, by JKR", "γ_{JKR}/Δγ");
        gamma("jkr.in_averaged", "from the attraction on the way in, by JKR, averaged over 2 ps",
              "γ_{JKR}/Δγ");
        if (force) {
            const auto smooth = run.number("sphere.maugis_images");
            const double jkr = smooth_pull_off(run, run.number("sphere.jkr").value_or(0.0));
            list.push_back(
                {fmt::format("{:.4g}", *force / units::nanonewton), "nN", "pull-off force",
                 jkr > 0.0 && smooth
                     ? fmt::format("smooth sphere: JKR {}, Maugis-Dugdale with images {}",
                                   nanonewton(jkr), nanonewton(smooth_pull_off(run, *smooth)))
                     : ""});
        }
        if (const auto radius = run.number("contact_radius.zero_load"))
            list.push_back({fmt::format("{:.1f}", *radius), "Å", "contact radius at zero load",
                            "√(area of the sites in contact / π)"});
    } else {
        gamma("binding_energy", "binding energy at zero load");
        if (const auto contact = run.number("contact_fraction")) {
            const auto theory = run.number("theory.contact_fraction");
            list.push_back({percent(*contact), "", "of the sites in contact at zero load",
                            theory ? "theory: " + percent(*theory) : ""});
        }
        if (force)
            list.push_back(
                {fmt::format("{:.3g}", *force / (run.edge() * run.edge()) / units::gigapascal),
                 "GPa", "pull-off stress, the largest attraction on the way out",
                 nanonewton(*force) + " in all"});
    }
    if (const auto loop = run.number("hysteresis.loop"); loop && in && out)
        list.push_back({minus(fmt::format("{:.4g}", run.curved() ? *loop : *out - *in)),
                        run.curved() ? "eV" : "meV/Å²", "lost in a cycle (hysteresis)",
                        "where surfaces snap together and apart"});
    if (!run.curved()) {
        gamma("work_of_adhesion.approach", "work of adhesion, approach");
        gamma("work_of_adhesion.pull_off", "work of adhesion, pull-off");
    }
    gamma("theory.gamma_eff",
          run.curved() ? "Persson’s theory, of the flat surface" : "Persson’s theory");
    if (const auto theory = run.number("theory.contact_fraction");
        theory && !run.number("contact_fraction"))
        list.push_back({percent(*theory), "", "contact area in theory", ""});
    if (const auto residual = run.number("energy.residual");
        residual && !run.result.find("failure"))
        list.push_back({fmt::format("{:.1e}", std::abs(*residual)), "", "energy balance",
                        "relative to its largest term"});
    return list;
}

namespace {

/// What the state at zero load is, in energies and in area.
std::string state_in_words(const StoredRun& run, double state, double flat) {
    std::string s;
    const auto bonds = run.number("work_of_adhesion.pairwise");
    const auto contact = run.number("contact_fraction"), pushed = run.number("pushed_fraction");
    if (run.curved()) {
        const double area = run.edge() * run.edge() / units::milli_per_unit;
        s = fmt::format("Without external force the sphere is bound by {:.4g} eV.", state * area);
    } else {
        s = fmt::format("Without external force the solids are bound by {}, {} of the {} of two "
                        "flat surfaces.",
                        meV(state), percent(state / flat), meV(flat));
        if (bonds)
            s += fmt::format(" The bonds across the interface give {}; {} of it is spent on "
                             "bending the block into contact.",
                             meV(*bonds), meV(*bonds - state));
    }
    if (contact) s += fmt::format(" {} of the sites are in contact", percent(*contact));
    if (contact && pushed)
        s += fmt::format(", {} are pushed by the substrate rather than pulled", percent(*pushed));
    return contact ? s + "." : s;
}

std::string cycle_in_words(const StoredRun& run, double in, double out, double flat) {
    const auto loop = run.number("hysteresis.loop"), at_in = run.number("hysteresis.approach"),
               at_out = run.number("hysteresis.pull_off");
    if (run.curved()) {
        if (!loop || !at_in || !at_out) return "";
        const auto number = [](double v) { return minus(fmt::format("{:.4g}", v)); };
        return fmt::format(
            "A cycle of approach and pull-off loses {} eV: {} on the way in, where "
            "the contact spreads by itself, and {} on the way out, where it lets go.",
            number(*loop), number(*at_in), number(*at_out));
    }
    const double lost = out - in;
    const std::string s =
        fmt::format("Coming together the interface does a work of {}; taking it apart costs {}.",
                    meV(in), meV(out));
    if (std::abs(lost) < 0.01 * flat)
        return s + fmt::format(" The two agree to {}: hardly anything is lost on the way.",
                               meV(std::abs(lost)));
    return s + fmt::format(" The difference, {}, is lost: where the surfaces snap together or "
                           "apart, their energy goes into vibrations (hysteresis).",
                           meV(lost));
}

} // namespace

std::vector<std::string> findings_in_words(const StoredRun& run) {
    std::vector<std::string> text;
    const double flat = run.number("delta_gamma").value_or(0.0);
    const auto state = run.number("binding_energy");
    const auto in = run.number("work_of_adhesion.approach"),
               out = run.number("work_of_adhesion.pull_off");
    if (state && flat > 0.0) text.push_back(state_in_words(run, *state, flat));
    if (in && out && flat > 0.0)
        if (const std::string s = cycle_in_words(run, *in, *out, flat); !s.empty())
            text.push_back(s);
    if (const auto theory = run.number("theory.gamma_eff"); theory && flat > 0.0) {
        std::string s = fmt::format("Persson’s theory gives γ_{{eff}} = {} ({} of Δγ)",
                                    meV(*theory), percent(*theory / flat));
        if (const auto gamma = run.number("theory.renormalised.gamma_eff"))
            s += fmt::format(", the renormalised theory {}", meV(*gamma));
        if (const auto full = run.number("theory.gamma_full_contact"))
            s += fmt::format(", and {} if contact were full", meV(*full));
        const auto found = run.curved() ? run.number("jkr.out") : state;
        if (found)
            s += fmt::format("; the simulation finds {}{}", meV(*found),
                             run.curved() ? " by JKR from the pull-off force" : "");
        text.push_back(s + ".");
    }
    if (const std::string note = run.text("theory.note"); !note.empty())
        text.push_back("The theory has no number for this scene: " + note + ".");
    return text;
}

std::vector<std::string> what_was_simulated(const Scene& scene) {
    std::vector<std::string> list;
    const auto& b = scene.block;
    const std::string model = b.model == BlockModel::lattice ? "a full lattice"
                              : b.model == BlockModel::multiscale
                                  ? fmt::format("a lattice that coarsens with depth ({} layers a "
                                                "level)",
                                                b.layers_per_level)
                                  : "the lattice’s static response, wave by wave";
    list.push_back(fmt::format("the elastic block: {}, {:.1f} nm thick, E = {:.4g} GPa, ν = {:.3g}",
                               model, 0.1 * b.thickness * scene.surface.spacing, b.young,
                               b.poisson));
    list.push_back(fmt::format("every pair of atoms across the interface within {:.4g} Å: "
                               "Lennard-Jones, ε = {:.4g} eV, r_{{0}} = {:.4g} Å{}",
                               scene.interface.cutoff, scene.interface.epsilon, scene.interface.r0,
                               scene.interface.tail ? ", with the continuum tail beyond" : ""));
    const bool relaxed = scene.has(PathPart::zero_load);
    if (relaxed)
        list.push_back("the relaxed state under zero load, straight from the undeformed block");
    else if (scene.drive.mode == DriveMode::quasistatic)
        list.push_back(fmt::format("force balance at every {:.3g} Å of the {}", scene.drive.step,
                                   scene.drive.hold == Hold::top ? "top plane’s path"
                                                                 : "lowest layer’s mean height"));
    else
        list.push_back(fmt::format("motion in time: the top plane driven at {:.4g} m/s, steps of "
                                   "{:.4g} fs",
                                   scene.drive.velocity, scene.drive.timestep));
    const bool dynamic = !relaxed && scene.drive.mode == DriveMode::dynamic;
    if (dynamic && scene.drive.damping > 0.0)
        list.push_back(
            fmt::format("damping, {:.3g} per ps relative to the top plane", scene.drive.damping));
    if (scene.surface.radius)
        list.push_back(fmt::format("curvature: R = {:.4g} Å", *scene.surface.radius));
    if (scene.surface.lattice_ratio != 1.0)
        list.push_back(fmt::format("lattices that do not fit: spacings in the ratio {:.4g}",
                                   scene.surface.lattice_ratio));
    if (dynamic && scene.drive.temperature > 0.0)
        list.push_back(fmt::format("thermal motion at {:.4g} K", scene.drive.temperature));
    if (b.strain == Strain::finite) list.push_back("finite strain");
    if (scene.drive.load != 0.0)
        list.push_back(fmt::format("an external load of {:.4g} MPa", scene.drive.load));
    return list;
}

std::vector<std::string> what_was_not(const Scene& scene) {
    std::vector<std::string> list;
    const bool dynamic = !scene.has(PathPart::zero_load) && scene.drive.mode == DriveMode::dynamic;
    if (!dynamic) list.push_back("time: no inertia, no vibrations, no rate");
    if (!dynamic || scene.drive.temperature == 0.0) list.push_back("thermal motion: T = 0");
    if (scene.surface.kind != SurfaceKind::flat)
        list.push_back("deformation of the substrate, which is rigid");
    list.push_back("plastic flow: the block is elastic throughout");
    if (scene.block.strain == Strain::linear)
        list.push_back("large strain: the block’s elasticity is linear");
    if (!scene.interface.tail)
        list.push_back(
            fmt::format("attraction beyond the cutoff of {:.4g} Å", scene.interface.cutoff));
    if (!scene.surface.radius) list.push_back("curvature of the bodies");
    list.push_back("edges: the box is periodic sideways");
    return list;
}

std::vector<std::vector<std::string>> provenance(const io::JsonValue& result) {
    std::vector<std::vector<std::string>> rows;
    const auto add = [&](const char* name, const char* key, const std::string& before = "") {
        const io::JsonValue* value = result.find(key);
        if (!value) return;
        if (value->is_text() && !value->text().empty())
            rows.push_back({name, before + value->text()});
        if (value->is_number()) rows.push_back({name, fmt::format("{:.10g}", value->number())});
    };
    add("measured surface", "surface.origin");
    add("version", "run.version", "Asperity ");
    add("git", "run.git");
    add("compiler", "run.compiler");
    add("flags", "run.flags");
    add("machine", "run.machine");
    add("kernels", "run.kernels");
    add("ranks", "run.ranks");
    add("threads a rank", "run.threads");
    add("steps", "run.steps");
    add("iterations of the relaxation", "run.iterations");
    if (const io::JsonValue* wall = result.find("run.wall_seconds"); wall && wall->is_number())
        rows.push_back({"wall time", io::duration_text(wall->number())});
    add("stopped", "run.stopped");
    return rows;
}

void cite(io::HtmlPage& page, const io::JsonValue& result) {
    const auto text = [&](const char* key) {
        const io::JsonValue* value = result.find(key);
        return value && value->is_text() ? value->text() : std::string("?");
    };
    page.section("cite", "How to cite");
    page.paragraph("Name the program with its version, and the paper whose system it simulates; "
                   "with the theory’s numbers, also the theory.");
    page.list("", {fmt::format("Asperity {} (commit {}): adhesion between randomly rough elastic "
                               "solids, from the atoms up.",
                               text("run.version"), text("run.git")),
                   "N. Mulakaluri and B. N. J. Persson, Adhesion between elastic solids with "
                   "randomly rough surfaces: comparison of analytical theory with molecular "
                   "dynamics simulations, arXiv:1112.5275 (2011).",
                   "B. N. J. Persson, Eur. Phys. J. E 8, 385 (2002): the theory of adhesion."});
}

} // namespace asperity
