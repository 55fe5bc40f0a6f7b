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

#include <string>
#include <vector>

namespace asperity {

/// On one rank. Returns the exit code. Throws io::FileError for a directory that holds neither
/// result.json nor sweep.json, or cannot be written to.
int report_command(const std::string& directory);

/// Puts plots into the page and their PNG and CSV into DIR/report/.
class ReportFiles {
public:
    explicit ReportFiles(const std::string& directory);
    void add(io::HtmlPage& page, const io::Plot& plot, const std::string& caption);
    void add(io::HtmlPage& page, const io::MapPlot& map, const std::string& caption);
    std::size_t written() const { return written_; }

private:
    std::string keep(const std::string& name, const std::string& svg, const std::string& csv);

    std::string directory_; ///< DIR/report
    std::size_t written_ = 0;
};

// report_words.cpp
std::string minus(std::string number); ///< with the sign that is as wide as a digit
std::vector<io::KeyNumber> key_numbers(const StoredRun& run);
std::string lead(const StoredRun& run);
std::vector<std::string> findings_in_words(const StoredRun& run);
std::vector<std::string> what_was_simulated(const Scene& scene);
std::vector<std::string> what_was_not(const Scene& scene);
/// Rows for the page's last tables: from a result's or a sweep's `run`.
std::vector<std::vector<std::string>> provenance(const io::JsonValue& result);
void cite(io::HtmlPage& page, const io::JsonValue& result);

// report_sweep.cpp
io::HtmlPage sweep_page(const std::string& directory, ReportFiles& files);

} // namespace asperity
