// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Output of a run at its beginning and at its end.
#pragma once

#include "engine/case/case.hpp"
#include "engine/path/path_results.hpp"
#include "io/result.hpp"

#include <cstdio>
#include <string>
#include <vector>

namespace asperity {

/// Prints the effects and sizes of the simulation in a few lines. threads: threads of a rank;
/// bytes: memory of the path on all ranks; directory: the result directory.
void print_opening(std::FILE* to, const Case& c, const Surface& surface, const ProcessGrid& grid,
                   int threads, std::size_t bytes, const std::string& directory);

/// Returns the state of a run for its line of progress: "approach, -12.3 MPa, contact 0.012, height
/// 3.11 Å". force: total normal force, eV/Å; in_contact: number of sites; mean_height: Å.
std::string progress_phase(const Case& c, const std::string& segment, double force,
                           long long in_contact, double mean_height);

/// A number as people read it, in the unit of its size, with a value for each column of a table.
struct SummaryRow {
    std::string name;
    std::string unit = {};                ///< "meV/Å² (mJ/m²)"; empty: a pure number
    std::vector<std::string> values = {}; ///< "55.60 (891)"; "-": none
    bool detail = false;                  ///< an error or a share of the number above
};

/// Numbers of a state, of approach and pull-off, or of the segments of a path.
struct SummaryTable {
    std::string head; ///< name of the state or path
    std::vector<std::string> columns = {};
    std::vector<SummaryRow> rows = {};
    std::vector<std::string> sentences = {}; ///< lines below the table
    bool for_pages = false;                  ///< the terminal does not show the table
};

/// The main numbers of a run, and sentences on their meaning. The terminal prints them, and reports
/// and notebooks take them from result.json.
struct Summary {
    std::vector<SummaryTable> tables;
    std::vector<std::string> sentences;
};
/// Returns the summary of the numbers of a result.
Summary summary_of(const Case& c, const io::Result& result, const PathResults& results);
/// Adds the rows and sentences to a result.
void add_summary(const Summary& summary, io::Result& result);
/// Prints a summary. directory: the result directory; "": prints the tables alone.
void print_summary(std::FILE* to, const Summary& summary, const std::string& directory);

} // namespace asperity
