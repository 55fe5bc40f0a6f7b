// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What is shown in a terminal: tables; what a run is doing, how fast, and how long it will still
// take.
#pragma once

#include <chrono>
#include <cstdio>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace asperity::io {

/// Columns aligned by what is seen (UTF-8 counts as one); headings bold on a terminal, unless
/// NO_COLOR is set or TERM is "dumb".
class Table {
public:
    /// sides: '<' for a column flush left, '>' for one flush right; without it the first is flush
    /// left and the others flush right.
    explicit Table(std::vector<std::string> heads, std::string sides = "");
    void row(std::vector<std::string> cells); ///< missing cells are empty
    void rule() { rows_.emplace_back(); }     ///< a line across
    std::string text(bool with_colours) const;
    void print(std::FILE* stream) const;

private:
    std::vector<std::string> heads_;
    std::string sides_;
    std::vector<std::vector<std::string>> rows_; ///< empty: a rule
};

/// A number for people: with so many decimals, or with more where these would show less than three
/// significant digits, and by powers of ten where it is tiny or huge: "69.91", "0.00412",
/// "4.12e-07". "-" for what is not finite.
std::string number(double value, int decimals);
/// The same with so many significant digits, where powers of ten are not needed.
std::string cell(double value, int digits = 4);

/// "bar" redraws one line, on a terminal; "lines" prints a line now and then, for logs and under
/// mpirun (where ranks see no terminal); "auto" picks.
enum class ProgressMode { automatic, bar, lines, off };
std::optional<ProgressMode> progress_mode(std::string_view name); ///< "auto", "bar", "lines", "off"

/// Updates cost a look at the clock; call them every few steps, from one rank.
class Progress {
public:
    struct State {
        std::string phase;      ///< "approach, F = -12.3 eV/Å"
        long long steps = 0;    ///< done so far, in all
        double time_fs = 0.0;   ///< simulated so far; 0: no clock in this run
        double fraction = -1.0; ///< done of the whole path, 0..1; negative: unknown
    };
    /// quiet: nothing is printed (ranks other than 0).
    Progress(ProgressMode mode, bool quiet = false, std::FILE* to = stderr);
    ~Progress() { finish(); }
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// True when enough time has passed that update() would print: build the phase text
    /// only then.
    bool due() const;
    void update(const State& state);
    /// A sentence of its own ("pull-off begins"), whatever the mode but off. Rates are counted
    /// anew.
    void say(const std::string& sentence);
    /// Clears the bar. Called by the destructor too.
    void finish();

    ProgressMode mode() const { return mode_; } ///< after "auto" was decided

private:
    using Clock = std::chrono::steady_clock;
    void put(const std::string& text);

    ProgressMode mode_;
    std::FILE* to_;
    Clock::time_point start_ = Clock::now();
    Clock::time_point last_; ///< when it was printed
    long long first_steps_ = -1;
    long long last_steps_ = 0;
    double first_time_ = 0.0;
    double first_fraction_ = -1.0;
    bool bar_drawn_ = false;
};

/// One line as it would be printed: phase, steps/s, simulated time a day, time left.
std::string progress_line(const Progress::State& state, double seconds, long long steps_done,
                          double time_done_fs, double fraction_done);

/// "1 h 02 min", "3 min 20 s", "12 s".
std::string duration_text(double seconds);
/// Seconds of "23h50m", "90s", "1d", "45m30s", "3600"; empty if it is none.
std::optional<double> parse_duration(std::string_view written);

} // namespace asperity::io
