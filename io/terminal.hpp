// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Output in a terminal: tables, and the progress of a run (phase, speed and remaining time).
#pragma once

#include <chrono>
#include <cstdio>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace asperity::io {

/// Table in a terminal. Columns are aligned by visible characters (UTF-8 counts as one); headings
/// are bold on a terminal, unless NO_COLOR is set or TERM is "dumb". Cells of a last column that is
/// flush left are broken if the table is wider than text_columns.
class Table {
public:
    /// Sets headings and alignment. sides: one character per column, '<' for flush left, '>' for
    /// flush right; by default the first column is flush left and the others are flush right.
    explicit Table(std::vector<std::string> heads, std::string sides = "");
    void row(std::vector<std::string> cells); ///< adds a row; missing cells are empty
    void rule() { rows_.emplace_back(); }     ///< adds a line across
    /// Returns the table as text.
    std::string text(bool with_colours) const;
    /// Prints the table.
    void print(std::FILE* stream) const;

private:
    std::vector<std::string> heads_;
    std::string sides_;
    std::vector<std::vector<std::string>> rows_; ///< an empty row is a line across
};

/// Returns a number as text for people, with this number of decimals, with more decimals if needed
/// for three significant digits, and with powers of ten for very small or large values: "69.91",
/// "0.00412", "4.12e-07". Returns "-" for a value that is not finite.
std::string number(double value, int decimals);
/// Returns a number as text with this number of significant digits, and with powers of ten for very
/// small or large values.
std::string cell(double value, int digits = 4);
/// Returns a number with its error, rounded to one significant digit of the error: "0.033 ± 0.004",
/// "(1.23 ± 0.05)e-06". Without an error returns cell(value).
std::string with_error(double value, double error);

/// Columns that a line of text fills at most; tables may be wider.
inline constexpr int text_columns = 80;
/// Returns a text without characters that control a terminal: names of scenes and files are
/// anyone's. A newline stays; another such character is written as "\x1b".
std::string printable(std::string_view text);
/// Returns the number of visible characters of a UTF-8 text.
int visible_width(std::string_view text);
/// Returns a text in lines of at most this number of columns, broken at blanks; a longer word stays
/// whole, and so does a number with the word behind it.
std::vector<std::string> wrapped(std::string_view text, int most);
/// Returns a printable() text whose lines fill at most text_columns. The rest of a longer line
/// stands below its first word, of a line "  name   value" below the value, and of "note: ..."
/// below the text, and of a line that begins at the margin this number of columns from there.
std::string folded(std::string_view unchecked, int of_margin = 0);
/// Prints a text, folded; arguments as of fmt::print().
template <typename... T>
void print_text(std::FILE* to, fmt::format_string<T...> text, T&&... values) {
    fmt::print(to, "{}", folded(fmt::format(text, std::forward<T>(values)...)));
}
/// Appends a text to a list; arguments as of fmt::print().
template <typename... T>
void print_text(std::vector<std::string>& to, fmt::format_string<T...> text, T&&... values) {
    to.push_back(fmt::format(text, std::forward<T>(values)...));
}

/// Mode of progress reports. "bar" redraws one line, on a terminal; "lines" prints a line
/// periodically, for logs and under mpirun (where ranks have no terminal); "auto" selects one of
/// both; "json" prints lines as JSON, {"fraction": completed part of the path (null: unknown),
/// "text": the line}, and sentences as {"text": sentence}.
enum class ProgressMode { automatic, bar, lines, json, off };
/// Returns the mode named "auto", "bar", "lines", "json" or "off"; nothing for another name.
std::optional<ProgressMode> progress_mode(std::string_view name);

/// Progress report of one rank. An update that prints nothing costs one reading of the clock.
class Progress {
public:
    /// State of the run at an update.
    struct State {
        std::string phase;      ///< "approach, F = -12.3 eV/Å"
        long long steps = 0;    ///< number of steps so far, before a resumption included
        double time_fs = 0.0;   ///< simulated time so far, fs; 0 for quasi-static paths
        double fraction = -1.0; ///< elapsed part of the run's time, 0 to 1; negative: unknown
        double left = -1.0;     ///< time left, s; negative: unknown
    };
    /// Starts the clock. quiet: print nothing, for ranks other than 0.
    Progress(ProgressMode mode, bool quiet = false, std::FILE* to = stderr);
    ~Progress() { finish(); }
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Returns true if update() would print. Callers make the text of the phase only then.
    bool due() const;
    void update(const State& state); ///< prints the state if due()
    /// Prints a sentence ("pull-off begins") in every mode except off, and restarts the measurement
    /// of the speed.
    void say(const std::string& sentence);
    /// Clears the bar. Called by the destructor too.
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

/// Largest width of a line of progress, columns.
inline constexpr int progress_columns = 79;
/// Returns a line of progress of at most progress_columns: time left, completed part, phase,
/// steps/s and simulated time per day; parts that do not fit are omitted from the end. seconds,
/// steps_done, time_done_fs: time, steps and simulated time since the measurement of the speed
/// began.
std::string progress_line(const Progress::State& state, double seconds, long long steps_done,
                          double time_done_fs);

/// Returns a duration as text: "1 h 02 min", "3 min 20 s", "12 s".
std::string duration_text(double seconds);
/// Parses a duration such as "23h50m", "90s", "1d", "45m30s" or "3600". Returns seconds; nothing if
/// the text is no duration.
std::optional<double> parse_duration(std::string_view written);
/// Parses a size of memory such as "64GB" or "500 MiB". Returns bytes; nothing if the text is no
/// size.
std::optional<double> parse_memory(std::string_view written);

} // namespace asperity::io
