// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// `asperity report DIR`: a run or a sweep as one page (report.html), with every plot as PNG and CSV
// in report/ beside it. These files are the report's own: a second report writes them anew.
//
// report.cpp         the page of a run, from top to bottom
// report_words.cpp   what was simulated and what was not, the findings in words
// report_plots.cpp   its plots and maps
// report_sweep.cpp   the page of a sweep
#pragma once

#include "engine/commands/stored_run.hpp"
#include "io/html_page.hpp"
#include "io/map_plot.hpp"
#include "io/plot.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace asperity {

/// On one rank. Returns the exit code. Throws io::FileError for a directory that holds neither
/// result.json nor sweep.json, or cannot be written to.
int report_command(const std::string& directory);

/// A plot or a map with its caption, or nothing, where the run has nothing to show.
struct Figure {
    Figure(std::optional<io::Plot> p, std::string words)
        : plot(std::move(p)), caption(std::move(words)) {}
    Figure(std::optional<io::MapPlot> m, std::string words)
        : map(std::move(m)), caption(std::move(words)) {}
    bool there() const { return plot || map; }

    std::optional<io::Plot> plot;
    std::optional<io::MapPlot> map;
    std::string caption;
};

/// Puts figures into the page and their PNG and CSV into DIR/report/.
class ReportFiles {
public:
    explicit ReportFiles(const std::string& directory);
    /// A section of those that are there, side by side; none, if none is.
    void section(io::HtmlPage& page, const std::string& id, const std::string& heading,
                 const std::vector<Figure>& figures);
    std::size_t written() const { return written_; }

private:
    std::string keep(const std::string& name, const std::string& svg, const std::string& csv);

    std::string directory_; ///< DIR/report
    std::size_t written_ = 0;
};

/// DIR/report.html. Returns what was written, in words.
std::string write_page(const std::string& directory, const io::HtmlPage& page,
                       const ReportFiles& files);

/// The page of a run, DIR/report.html and its files. Returns what was written, in words.
std::string write_run_page(const StoredRun& run);

// report_words.cpp
std::string minus(std::string number); ///< with the sign that is as wide as a digit
std::string percent(double fraction);
std::string in_words(const std::string& state); ///< "zero-load": "at zero load"
std::vector<io::KeyNumber> key_numbers(const StoredRun& run);
std::string lead(const StoredRun& run);
std::vector<std::string> findings_in_words(const StoredRun& run);
std::vector<std::string> what_was_simulated(const Scene& scene);
std::vector<std::string> what_was_not(const Scene& scene);
/// Rows for the page's last tables: from a result's or a sweep's `run`.
std::vector<std::vector<std::string>> provenance(const io::JsonValue& result);
void cite(io::HtmlPage& page, const io::JsonValue& result);

// report_sweep.cpp
/// The page of a sweep and those of its points. Returns what was written, in words.
std::string write_sweep_page(const std::string& directory);
/// Whether a directory holds a sweep, or, beside each other, those of several scenes.
bool holds_sweep(const std::string& directory);

} // namespace asperity
