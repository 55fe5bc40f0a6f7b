// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Output in a terminal: tables; and the progress of a run: its phase, speed and remaining time.
#pragma once

#include <chrono>
#include <cstdio>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace asperity::io {

/// Table in a terminal. Columns are aligned by visible characters (UTF-8 counts as one); headings
/// are bold on a terminal, unless NO_COLOR is set or TERM is "dumb".
class Table {
public:
    /// Sets headings and alignment. sides: '<' for a column flush left, '>' for one flush right; by
    /// default the first is flush left and the others flush right.
    explicit Table(std::vector<std::string> heads, std::string sides = "");
    void row(std::vector<std::string> cells); ///< adds a row; missing cells are empty
    void rule() { rows_.emplace_back(); }     ///< adds a line across
    std::string text(bool with_colours) const;
    void print(std::FILE* stream) const;

private:
    std::vector<std::string> heads_;
    std::string sides_;
    std::vector<std::vector<std::string>> rows_; ///< an empty row is a line across
};

/// Returns a number for people: with so many decimals, or with more if these would show less than
/// three significant digits, and with powers of ten if it is tiny or huge: "69.91", "0.00412",
/// "4.12e-07". "-" for a value that is not finite.
std::string number(double value, int decimals);
/// Returns a number with so many significant digits, unless it needs powers of ten.
std::string cell(double value, int digits = 4);
/// Returns a number with its error, which has one significant digit, to the decimals of the error:
/// "0.033 ± 0.004", "(1.23 ± 0.05)e-06"; without an error as cell() has it.
std::string with_error(double value, double error);

/// Mode of progress reports. "bar" redraws one line, on a terminal; "lines" prints a line now and
/// then, for logs and under mpirun (where ranks see no terminal); "auto" picks one of them; "json"
/// prints the lines as JSON, for programs: {"fraction": done part of the path (null: unknown),
/// "text": the line}, and sentences as {"text": sentence}.
enum class ProgressMode { automatic, bar, lines, json, off };
/// Returns the mode named "auto", "bar", "lines", "json" or "off"; nothing for another name.
std::optional<ProgressMode> progress_mode(std::string_view name);

/// Progress report of one rank. An update costs a look at the clock; call update() every few steps.
class Progress {
public:
    /// State of the run at an update.
    struct State {
        std::string phase;      ///< "approach, F = -12.3 eV/Å"
        long long steps = 0;    ///< steps done so far, in all
        double time_fs = 0.0;   ///< simulated time so far, fs; 0: the run has no clock
        double fraction = -1.0; ///< part of the run's time that is over, 0..1; negative: unknown
        double left = -1.0;     ///< time left, s; negative: unknown
    };
    /// Starts the clock. quiet: print nothing (ranks other than 0).
    Progress(ProgressMode mode, bool quiet = false, std::FILE* to = stderr);
    ~Progress() { finish(); }
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Returns true if enough time has passed that update() would print, so that callers build the
    /// phase text only then.
    bool due() const;
    void update(const State& state);
    /// Prints a sentence ("pull-off begins") in every mode but off, and begins a new count of the
    /// rates.
    void say(const std::string& sentence);
    /// Clears the bar. The destructor calls it too.
    void finish();

    ProgressMode mode() const { return mode_; } ///< returns the mode; "auto" is resolved

private:
    using Clock = std::chrono::steady_clock;
    void put(const std::string& text);

    ProgressMode mode_;
    std::FILE* to_;
    Clock::time_point start_ = Clock::now();
    Clock::time_point last_; ///< time of the last print
    long long first_steps_ = -1;
    long long last_steps_ = 0;
    double first_time_ = 0.0;
    bool bar_drawn_ = false;
};

/// Columns that a line of progress fills at most.
inline constexpr int progress_columns = 79;
/// Returns one progress line of at most progress_columns: time left, part that is done, phase,
/// steps/s and simulated time a day; what does not fit is left out, the last first.
std::string progress_line(const Progress::State& state, double seconds, long long steps_done,
                          double time_done_fs);

/// Returns a duration in words: "1 h 02 min", "3 min 20 s", "12 s".
std::string duration_text(double seconds);
/// Returns the seconds of "23h50m", "90s", "1d", "45m30s" or "3600"; nothing for another text.
std::optional<double> parse_duration(std::string_view written);

} // namespace asperity::io
