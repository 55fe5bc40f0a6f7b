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
    const std::string curves =
        run.curved()
            ? "Force of the substrate on the block over the mean height of the lowest layer above "
              "the apex; negative is attraction. Beside it what a smooth sphere would do: JKR "
              "alone, "
              "and JKR and Maugis-Dugdale with the sphere’s periodic images."
            : "Force of the substrate on the block over the mean separation, the mean height of "
              "the lowest layer above the substrate’s mean plane; negative is attraction. The area "
              "under a curve is the work of adhesion of that leg.";
    files.section(
        page, "path", "Force and contact",
        {{separation_plot(run), curves},
         {contact_plot(run), "Sites nearer to an atom of the substrate than the inflection of the "
                             "potential (in contact), and sites whose net normal force is "
                             "repulsive (pushed)."}});
}

void write_energies(io::HtmlPage& page, ReportFiles& files, const StoredRun& run) {
    files.section(
        page, "energies", "Energies",
        {{energy_plot(run), "Energies over the path. Work is done by the top plane and the moving "
                            "medium of the damping."},
         {balance_plot(run), "Work done minus energy gained minus energy damped, over the largest "
                             "of these terms met so far."},
         {loading_plot(run), "Elastic force on the driven top plane over its displacement: what a "
                             "testing machine would record. Between the curves lies the energy "
                             "lost in a cycle."}});
}

std::string caption_of(const io::MapPlot& map) {
    if (map.unit == "Å")
        return std::string("Height of each site above the substrate below it. The colour bar ") +
               (map.high ? "ends at the cutoff." : "spans 99\u00a0% of the values.");
    if (map.unit == "GPa")
        return "Normal force of the substrate on a site over its area. Blue pulls, orange pushes; "
               "the colour bar spans 99\u00a0% of the values.";
    return "Sites nearer to an atom of the substrate than the inflection of the potential.";
}

void write_state(io::HtmlPage& page, ReportFiles& files, const StoredRun& run,
                 const StoredState& state) {
    std::vector<Figure> figures;
    for (const io::MapPlot& map : state_maps(run, state))
        figures.emplace_back(map, caption_of(map));
    figures.emplace_back(pressure_plot(state),
                         "How the interface’s pressure is distributed over the sites that feel "
                         "any: the left wing pulls, the right one pushes. Per site of the box.");
    figures.emplace_back(gap_plot(state),
                         "Distribution of the gaps of all sites, normalised to one.");
    files.section(page, "state-" + file_name(state.name), "The state " + in_words(state.name),
                  figures);
}

/// At zero load first. A page of a hundred snapshots would be for nobody.
void write_states(io::HtmlPage& page, ReportFiles& files, const StoredRun& run) {
    constexpr std::size_t most = 6;
    std::vector<StoredState> states = run.states;
    std::stable_partition(states.begin(), states.end(),
                          [](const StoredState& s) { return s.name == "zero-load"; });
    const std::size_t n = states.size(), shown = std::min(n, most);
    for (std::size_t i = 0; i < shown; ++i)
        write_state(page, files, run, states[shown < 2 ? i : i * (n - 1) / (shown - 1)]);
    if (shown < n)
        page.paragraph(fmt::format("{} of the {} states in run.h5 are shown; `asperity export` "
                                   "writes them all.",
                                   shown, n));
}

void write_surface(io::HtmlPage& page, ReportFiles& files, const StoredRun& run) {
    files.section(
        page, "surface", "Surface and theory",
        {{height_map(run), "The substrate from above. The colour bar spans 99\u00a0% of it."},
         {spectrum_plot(run),
          "Radially averaged power spectrum of the surface that was made, and what was asked for."},
         {roughness_plot(run), "Persson’s theory for this scene at other roughnesses (dotted: "
                               "the renormalised theory), and this run’s numbers."}});
}

/// Every number of the result that is there.
void write_numbers(io::HtmlPage& page, const StoredRun& run) {
    const double flat = run.number("delta_gamma").value_or(0.0);
    // Of a sphere, the nominal area says nothing, and so does energy over it.
    const bool per_area = flat > 0.0 && !run.curved();
    const std::string energy = "meV/Å²";
    struct Row {
        const char *name, *key;
        std::string unit;
        bool over_flat = false;
    };
    const std::vector<Row> list = {
        {"flat on flat, Δγ", "delta_gamma", energy, flat > 0.0},
        {"binding energy at zero load", "binding_energy", energy, per_area},
        {"work of adhesion, approach", "work_of_adhesion.approach", energy, per_area},
        {"work of adhesion, pull-off", "work_of_adhesion.pull_off", energy, per_area},
        {"atom-by-atom work", "work_of_adhesion.pairwise", energy, per_area},
        {"contact fraction", "contact_fraction", ""},
        {"pushed fraction", "pushed_fraction", ""},
        {"largest attraction on the way out", "pull_off_force", "eV/Å"},
        {"energy lost in the cycle", "hysteresis.loop", "eV"},
        {"of it on the way in", "hysteresis.approach", "eV"},
        {"of it on the way out", "hysteresis.pull_off", "eV"},
        {"JKR energy, way in", "jkr.in", energy, flat > 0.0},
        {"JKR energy, way in, averaged over 2 ps", "jkr.in_averaged", energy, flat > 0.0},
        {"JKR energy, way out", "jkr.out", energy, flat > 0.0},
        {"JKR energy, way out, averaged over 2 ps", "jkr.out_averaged", energy, flat > 0.0},
        {"smooth sphere: JKR with images", "sphere.jkr_images", energy, flat > 0.0},
        {"smooth sphere: Maugis-Dugdale with images", "sphere.maugis_images", energy, flat > 0.0},
        {"smooth sphere: Maugis parameter λ", "sphere.maugis_parameter", ""},
        {"contact radius at zero load", "contact_radius.zero_load", "Å"},
        {"contact radius at the pull-off force", "contact_radius.pull_off", "Å"},
        {"theory: γ_{eff}", "theory.gamma_eff", energy, flat > 0.0},
        {"renormalised theory: γ_{eff}", "theory.renormalised.gamma_eff", energy, flat > 0.0},
        {"theory: γ assuming full contact", "theory.gamma_full_contact", energy, flat > 0.0},
        {"theory: contact fraction", "theory.contact_fraction", ""},
        {"theory: critical rms", "theory.critical_rms", "Å"},
        {"surface: rms height", "surface.rms", "Å"},
        {"surface: rms slope", "surface.rms_slope", ""},
        {"surface: lowest", "surface.min", "Å"},
        {"surface: highest", "surface.max", "Å"},
        {"energy balance: residual", "energy.residual", "relative"},
        {"work done", "energy.work", "eV"},
        {"kinetic energy at the end", "energy.kinetic", "eV"},
        {"elastic energy at the end", "energy.elastic", "eV"},
        {"interface energy at the end", "energy.interface", "eV"},
        {"energy damped", "energy.damped", "eV"}};
    std::vector<std::vector<std::string>> rows;
    for (const Row& row : list)
        if (const auto value = run.number(row.key))
            rows.push_back({row.name, minus(fmt::format("{:.6g}", *value)), row.unit,
                            row.over_flat ? fmt::format("{:.4f}", *value / flat) : ""});
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
    io::HtmlPage page("Asperity report", run.title, lead(run));
    write_findings(page, run);
    write_path(page, files, run);
    write_states(page, files, run);
    write_surface(page, files, run);
    write_energies(page, files, run);
    write_numbers(page, run);
    write_times(page, run);
    if (!run.toml.empty()) {
        page.section("scene", "The scene");
        const bool measured = run.scene && run.scene->surface.kind == SurfaceKind::file;
        page.paragraph(
            fmt::format("Every key with the value that was used. Saved as a file, it runs again{}.",
                        measured ? ", with the map beside it" : ""));
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

void ReportFiles::section(io::HtmlPage& page, const std::string& id, const std::string& heading,
                          const std::vector<Figure>& figures) {
    if (std::none_of(figures.begin(), figures.end(), [](const Figure& f) { return f.there(); }))
        return;
    page.section(id, heading);
    page.begin_columns("figures");
    for (const Figure& figure : figures) {
        if (const auto& plot = figure.plot)
            page.figure(io::plot_svg(*plot), figure.caption,
                        keep(plot->id, io::plot_document(*plot), io::plot_csv(*plot)));
        if (const auto& map = figure.map)
            page.figure(io::map_svg(*map), figure.caption,
                        keep(map->id, io::map_document(*map), io::map_csv(*map)));
    }
    page.end_columns();
}

std::string write_page(const std::string& directory, const io::HtmlPage& page,
                       const ReportFiles& files) {
    const std::string path = (fs::path(directory) / "report.html").string();
    const std::string text = page.text();
    io::write_whole(path, text);
    return fmt::format(
        "{}: one page, {:.1f} MB, nothing else needed; {} files of its plots in {}\n", path,
        static_cast<double>(text.size()) / 1e6, files.written(),
        (fs::path(directory) / "report").string());
}

std::string write_run_page(const StoredRun& run) {
    ReportFiles files(run.directory);
    return write_page(run.directory, run_page(run, files), files);
}

int report_command(const std::string& directory) {
    const bool sweep = holds_sweep(directory);
    if (!sweep) expect_result(directory, {"result.json", "sweep.json"});
    fmt::print("{}", sweep ? write_sweep_page(directory) : write_run_page(read_run(directory)));
    return io::exit_code::done;
}

} // namespace asperity
