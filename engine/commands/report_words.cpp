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

namespace {

std::string percent(double fraction) {
    return minus(fmt::format("{:.{}f}\u00a0%", 100.0 * fraction, std::abs(fraction) < 0.1 ? 2 : 1));
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
    const auto gamma = [&](const char* key, const char* name) {
        if (const auto value = run.number(key); value && flat > 0.0)
            list.push_back(
                {minus(fmt::format("{:.3f}", *value / flat)), "γ_{eff}/Δγ", name, meV(*value)});
    };
    gamma("binding_energy", "binding energy at zero load");
    gamma("work_of_adhesion.approach", "work of adhesion, approach");
    gamma("work_of_adhesion.pull_off", "work of adhesion, pull-off");
    gamma("theory.gamma_eff", "Persson’s theory");
    if (const auto contact = run.number("contact_fraction")) {
        const auto theory = run.number("theory.contact_fraction");
        list.push_back({percent(*contact), "", "of the sites in contact at zero load",
                        theory ? "theory: " + percent(*theory) : ""});
    } else if (const auto theory = run.number("theory.contact_fraction")) {
        list.push_back({percent(*theory), "", "contact area in theory", ""});
    }
    if (const auto force = run.number("pull_off_force")) {
        const double area = run.edge() * run.edge();
        list.push_back({fmt::format("{:.4g}", *force), "eV/Å", "largest attraction on the way out",
                        area > 0.0 && run.scene && !run.scene->surface.radius
                            ? fmt::format("{:.3g} GPa over the nominal area",
                                          *force / area / units::gigapascal)
                            : fmt::format("{:.3g} nN", 1.602177 * *force)});
    }
    if (const auto in = run.number("jkr.in"))
        list.push_back({fmt::format("{:.2f}", *in), "meV/Å²", "JKR energy, way in", ""});
    if (const auto out = run.number("jkr.out"))
        list.push_back({fmt::format("{:.2f}", *out), "meV/Å²", "JKR energy, way out", ""});
    if (const auto residual = run.number("energy.residual");
        residual && !run.result.find("failure"))
        list.push_back({fmt::format("{:.1e}", std::abs(*residual)), "", "energy balance",
                        "relative to its largest term"});
    return list;
}

std::vector<std::string> findings_in_words(const StoredRun& run) {
    std::vector<std::string> text;
    const double flat = run.number("delta_gamma").value_or(0.0);
    const auto state = run.number("binding_energy"),
               bonds = run.number("work_of_adhesion.pairwise");
    if (state && flat > 0.0) {
        std::string s =
            fmt::format("Without external force the solids are bound by {}, {} of the {} "
                        "of two flat surfaces.",
                        meV(*state), percent(*state / flat), meV(flat));
        if (bonds)
            s +=
                fmt::format(" The bonds across the interface give {}; {} of it is spent on bending "
                            "the block into contact.",
                            meV(*bonds), meV(*bonds - *state));
        if (const auto contact = run.number("contact_fraction"))
            s += fmt::format(" {} of the sites are in contact", percent(*contact));
        if (const auto pushed = run.number("pushed_fraction"))
            s += fmt::format(", {} are pushed by the substrate rather than pulled",
                             percent(*pushed));
        text.push_back(s + ".");
    }
    const auto in = run.number("work_of_adhesion.approach"),
               out = run.number("work_of_adhesion.pull_off");
    if (in && out && flat > 0.0) {
        const double lost = *out - *in;
        std::string s = fmt::format("Coming together the interface does a work of {}; taking it "
                                    "apart costs {}.",
                                    meV(*in), meV(*out));
        s += std::abs(lost) < 0.01 * flat
                 ? fmt::format(" The two agree to {}: hardly anything is lost on the way.",
                               meV(std::abs(lost)))
                 : fmt::format(" The difference, {}, is lost: where the surfaces snap together or "
                               "apart, their energy goes into vibrations (hysteresis).",
                               meV(lost));
        text.push_back(s);
    }
    if (const auto theory = run.number("theory.gamma_eff"); theory && flat > 0.0) {
        std::string s = fmt::format("Persson’s theory gives γ_{{eff}} = {} ({} of Δγ)",
                                    meV(*theory), percent(*theory / flat));
        if (const auto gaps = run.number("theory.gamma_eff_with_gaps"))
            s += fmt::format(", {} with the attraction across the gaps", meV(*gaps));
        if (const auto full = run.number("theory.gamma_full_contact"))
            s += fmt::format(", and {} if contact were full", meV(*full));
        if (state) s += fmt::format("; the simulation finds {}", meV(*state));
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
        list.push_back(fmt::format("force balance at every {:.3g} Å of the top plane’s path",
                                   scene.drive.step));
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
