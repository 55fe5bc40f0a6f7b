// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/commands/report.hpp"

#include "engine/commands/report_plots.hpp"
#include "io/error.hpp"
#include "io/result.hpp"
#include "io/table.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

namespace asperity {

namespace {

namespace fs = std::filesystem;

void write_findings(io::HtmlPage& page, const StoredRun& run) {
    if (const io::JsonValue* failure = run.result.find("failure"))
        page.notice("This run failed", run.text("failure.reason").empty()
                                           ? failure->dump(-1)
                                           : run.text("failure.reason"));
    if (const std::string stopped = run.text("run.stopped"); !stopped.empty())
        page.notice("This run was stopped early",
                    fmt::format("Reason: {}. The path is not complete; what is shown is what had "
                                "been reached.",
                                stopped));
    const auto numbers = key_numbers(run);
    if (!numbers.empty()) page.key_numbers(numbers);
    for (const std::string& sentence : findings_in_words(run))
        page.paragraph(sentence);
    for (const std::string& note : run.notes)
        page.paragraph("Note: " + note);
    if (!run.scene) return;
    page.begin_columns("columns");
    // A result without a path or a state came from the theory alone.
    const bool simulated = !run.series.empty() || !run.states.empty() || run.number("run.steps");
    if (simulated) {
        page.list("Simulated", what_was_simulated(*run.scene));
        page.list("Not simulated", what_was_not(*run.scene));
    } else {
        page.list("Computed", {"the theory alone: nothing was simulated"});
    }
    page.end_columns();
}

void write_path(io::HtmlPage& page, ReportFiles& files, const StoredRun& run) {
    const auto separation = separation_plot(run), loading = loading_plot(run),
               energy = energy_plot(run), contact = contact_plot(run), balance = balance_plot(run);
    if (!separation && !energy) return;
    page.section("path", "Along the path");
    page.begin_columns("figures");
    if (separation)
        files.add(
            page, *separation,
            "Force of the substrate on the block over the mean separation, the mean height of "
            "the lowest layer above the substrate’s mean plane. Negative: attraction. The "
            "area under a curve is the work of adhesion of that leg.");
    if (loading)
        files.add(page, *loading,
                  "Elastic force on the driven top plane over its displacement: what a testing "
                  "machine would record. Between the curves lies the energy lost in a cycle.");
    if (contact)
        files.add(page, *contact,
                  "Sites nearer to an atom of the substrate than the inflection of the potential "
                  "(in contact), and sites whose net normal force is repulsive (pushed).");
    if (energy)
        files.add(page, *energy,
                  "Energies per nominal area over time. Work is done by the top plane and the "
                  "moving medium of the damping.");
    if (balance)
        files.add(page, *balance,
                  "Work done minus energy gained minus energy damped, over the largest of these "
                  "terms met so far.");
    page.end_columns();
}

void write_state(io::HtmlPage& page, ReportFiles& files, const StoredRun& run,
                 const StoredState& state) {
    const std::string heading =
        state.name == "zero-load" ? "The state at zero load" : "The state “" + state.name + "”";
    page.section("state-" + file_name(state.name), heading);
    page.begin_columns("figures");
    for (const io::MapPlot& map : state_maps(run, state))
        files.add(page, map,
                  map.unit == "Å"
                      ? "Height of each site above the substrate below it. The colour bar spans "
                        "99\u00a0% of the values."
                  : map.unit == "GPa"
                      ? "Normal force of the substrate on a site over its area. Blue "
                        "pulls, orange pushes; the colour bar spans 99\u00a0% of the "
                        "values."
                      : "Sites nearer to an atom of the substrate than the "
                        "inflection of the potential.");
    if (const auto gaps = gap_plot(state))
        files.add(page, *gaps, "Distribution of the gaps of all sites, normalised to one.");
    page.end_columns();
}

/// A page of a hundred snapshots would be for nobody.
void write_states(io::HtmlPage& page, ReportFiles& files, const StoredRun& run) {
    constexpr std::size_t most = 6;
    const std::size_t n = run.states.size(), shown = std::min(n, most);
    for (std::size_t i = 0; i < shown; ++i)
        write_state(page, files, run, run.states[shown < 2 ? i : i * (n - 1) / (shown - 1)]);
    if (shown < n)
        page.paragraph(fmt::format("{} of the {} states in run.h5 are shown; `asperity export` "
                                   "writes them all.",
                                   shown, n));
}

void write_surface(io::HtmlPage& page, ReportFiles& files, const StoredRun& run) {
    const auto height = height_map(run);
    const auto spectrum = spectrum_plot(run), roughness = roughness_plot(run);
    if (!height && !spectrum && !roughness) return;
    page.section("surface", "Surface and theory");
    page.begin_columns("figures");
    if (height)
        files.add(page, *height, "The substrate from above. The colour bar spans 99\u00a0% of it.");
    if (spectrum)
        files.add(page, *spectrum,
                  "Radially averaged power spectrum of the surface that was made, and what was "
                  "asked for.");
    if (roughness)
        files.add(page, *roughness,
                  "Persson’s theory for this scene at other roughnesses (dotted: with the "
                  "attraction across the gaps), and this run’s numbers.");
    page.end_columns();
}

/// Every number of the contract that is there.
void write_numbers(io::HtmlPage& page, const StoredRun& run) {
    const double flat = run.number("delta_gamma").value_or(0.0);
    std::vector<std::vector<std::string>> rows;
    const auto add = [&](const char* name, const char* key, const char* unit, bool energy = false) {
        const auto value = run.number(key);
        if (!value) return;
        rows.push_back({name, minus(fmt::format("{:.6g}", *value)), unit,
                        energy && flat > 0.0 ? fmt::format("{:.4f}", *value / flat) : ""});
    };
    add("flat on flat, Δγ", "delta_gamma", "meV/Å²", true);
    add("binding energy at zero load", "binding_energy", "meV/Å²", true);
    add("work of adhesion, approach", "work_of_adhesion.approach", "meV/Å²", true);
    add("work of adhesion, pull-off", "work_of_adhesion.pull_off", "meV/Å²", true);
    add("atom-by-atom work", "work_of_adhesion.pairwise", "meV/Å²", true);
    add("contact fraction", "contact_fraction", "");
    add("pushed fraction", "pushed_fraction", "");
    add("largest attraction on the way out", "pull_off_force", "eV/Å");
    add("JKR energy, way in", "jkr.in", "meV/Å²", true);
    add("JKR energy, way out", "jkr.out", "meV/Å²", true);
    add("theory: γ_{eff}", "theory.gamma_eff", "meV/Å²", true);
    add("theory: γ_{eff} with attraction across gaps", "theory.gamma_eff_with_gaps", "meV/Å²",
        true);
    add("theory: γ assuming full contact", "theory.gamma_full_contact", "meV/Å²", true);
    add("theory: contact fraction", "theory.contact_fraction", "");
    add("theory: critical rms", "theory.critical_rms", "Å");
    add("surface: rms height", "surface.rms", "Å");
    add("surface: rms slope", "surface.rms_slope", "");
    add("surface: lowest", "surface.min", "Å");
    add("surface: highest", "surface.max", "Å");
    add("energy balance: residual", "energy.residual", "relative");
    add("work done", "energy.work", "eV");
    add("kinetic energy at the end", "energy.kinetic", "eV");
    add("elastic energy at the end", "energy.elastic", "eV");
    add("interface energy at the end", "energy.interface", "eV");
    add("energy damped", "energy.damped", "eV");
    if (rows.empty()) return;
    page.section("numbers", "All numbers");
    page.table({"", "value", "unit", "over Δγ"}, rows);
}

void write_times(io::HtmlPage& page, const StoredRun& run) {
    const io::JsonValue* phases = run.result.find("run.phases");
    if (!phases || !phases->is_object() || phases->members().empty()) return;
    page.section("times", "Time spent");
    double longest = 0.0;
    for (const auto& [name, phase] : phases->members())
        if (const io::JsonValue* s = phase.find("seconds"); s && s->is_number())
            longest = std::max(longest, s->number());
    std::vector<io::HtmlPage::Bar> bars;
    for (const auto& [name, phase] : phases->members()) {
        const io::JsonValue *s = phase.find("seconds"), *calls = phase.find("calls");
        if (!s || !s->is_number() || !calls || !calls->is_number()) continue;
        bars.push_back({name, longest > 0.0 ? s->number() / longest : 0.0,
                        fmt::format("{:.3g} s, {:.0f} ×", s->number(), calls->number())});
    }
    std::sort(bars.begin(), bars.end(),
              [](const auto& a, const auto& b) { return a.share > b.share; });
    page.bars(bars);
}

io::HtmlPage run_page(const StoredRun& run, ReportFiles& files) {
    io::HtmlPage page("Asperity report", run.name, lead(run));
    write_findings(page, run);
    write_path(page, files, run);
    write_states(page, files, run);
    write_surface(page, files, run);
    write_numbers(page, run);
    write_times(page, run);
    if (!run.toml.empty()) {
        page.section("scene", "The scene");
        page.paragraph("Every key with the value that was used. Saved as a file, it runs again.");
        page.preformatted(run.toml);
    }
    page.section("provenance", "Provenance");
    page.table({}, provenance(run.result));
    cite(page, run.result);
    return page;
}

} // namespace

ReportFiles::ReportFiles(const std::string& directory)
    : directory_((fs::path(directory) / "report").string()) {
    io::make_directory(directory_);
}

std::string ReportFiles::keep(const std::string& name, const std::string& svg,
                              const std::string& csv) {
    const std::string stem = (fs::path(directory_) / name).string();
    io::write_whole(stem + ".png", io::png_of_svg(svg, 2.0));
    io::write_whole(stem + ".csv", csv);
    written_ += 2;
    return fmt::format("report/{0}.png, {0}.csv", name);
}

void ReportFiles::add(io::HtmlPage& page, const io::Plot& plot, const std::string& caption) {
    io::Plot alone = plot;
    alone.id.clear();
    page.figure(io::plot_svg(plot), caption,
                keep(plot.id, io::plot_svg(alone), io::plot_csv(plot)));
}

void ReportFiles::add(io::HtmlPage& page, const io::MapPlot& map, const std::string& caption) {
    io::MapPlot alone = map;
    alone.id.clear();
    page.figure(io::map_svg(map), caption, keep(map.id, io::map_svg(alone), io::map_csv(map)));
}

int report_command(const std::string& directory) {
    expect_result(directory, {"result.json", "sweep.json"});
    ReportFiles files(directory);
    std::error_code error;
    const bool sweep = fs::exists(fs::path(directory) / "sweep.json", error);
    const io::HtmlPage page =
        sweep ? sweep_page(directory, files) : run_page(read_run(directory), files);
    const std::string path = (fs::path(directory) / "report.html").string();
    const std::string text = page.text();
    io::write_whole(path, text);
    fmt::print("{}: one page, {:.1f} MB, nothing else needed; {} files of its plots in {}\n", path,
               static_cast<double>(text.size()) / 1e6, files.written(),
               (fs::path(directory) / "report").string());
    return io::exit_code::done;
}

} // namespace asperity
