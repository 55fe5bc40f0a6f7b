// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/progress.hpp"

#include "io/table.hpp"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <utility>

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace asperity::io {

namespace {

constexpr double bar_seconds = 0.2;
/// Lines get rarer as a run gets longer: after 2 s, 10 s, then each 10 % of the time so far.
double line_seconds(double elapsed) {
    return elapsed < 10.0 ? 2.0 : elapsed < 100.0 ? 10.0 : 0.1 * elapsed;
}

double seconds(std::chrono::steady_clock::duration time) {
    return std::chrono::duration<double>(time).count();
}

std::string amount(double value) {
    if (value >= 1e6) return fmt::format("{:.2f} M", value / 1e6);
    if (value >= 1e4) return fmt::format("{:.1f} k", value / 1e3);
    return fmt::format("{:.{}f}", value, value < 10.0 ? 2 : value < 100.0 ? 1 : 0);
}

std::string simulated_per_day(double fs_per_day) {
    if (fs_per_day >= 1e9) return fmt::format("{} µs/day", amount(fs_per_day / 1e9));
    if (fs_per_day >= 1e6) return fmt::format("{} ns/day", amount(fs_per_day / 1e6));
    return fmt::format("{} ps/day", amount(fs_per_day / 1e3));
}

/// Cut to what one line of the terminal shows.
std::string fitted(const std::string& text, std::FILE* stream) {
    struct winsize window {};
    const int columns = ::ioctl(::fileno(stream), TIOCGWINSZ, &window) == 0 && window.ws_col > 10
                            ? window.ws_col - 1
                            : 110;
    if (visible_width(text) <= columns) return text;
    std::string cut;
    int width = 0;
    for (const char c : text) {
        if ((static_cast<unsigned char>(c) & 0xC0) != 0x80 && ++width > columns) break;
        cut += c;
    }
    return cut;
}

} // namespace

std::optional<ProgressMode> progress_mode(std::string_view name) {
    static constexpr std::string_view names[] = {"auto", "bar", "lines", "off"};
    const auto* const at = std::find(std::begin(names), std::end(names), name);
    if (at == std::end(names)) return std::nullopt;
    return static_cast<ProgressMode>(at - std::begin(names));
}

bool is_terminal(std::FILE* stream) {
    return ::isatty(::fileno(stream)) != 0 && !std::getenv("OMPI_COMM_WORLD_SIZE");
}

Progress::Progress(ProgressMode mode, bool quiet, std::FILE* to)
    : mode_(mode), quiet_(quiet), to_(to), start_(Clock::now()), last_print_(start_) {
    const bool terminal = is_terminal(to);
    if (quiet)
        mode_ = ProgressMode::off;
    else if (mode == ProgressMode::automatic || (mode == ProgressMode::bar && !terminal))
        mode_ = terminal ? ProgressMode::bar : ProgressMode::lines;
}

Progress::~Progress() { finish(); }

void Progress::tell(Listener listener) {
    if (!quiet_) listener_ = std::move(listener);
}

bool Progress::due() const { return tell_due(Clock::now()) || print_due(Clock::now()); }

bool Progress::tell_due(Clock::time_point now) const {
    return listener_ && seconds(now - last_told_) >= bar_seconds;
}

bool Progress::print_due(Clock::time_point now) const {
    if (mode_ == ProgressMode::off) return false;
    const bool bar = mode_ == ProgressMode::bar;
    return seconds(now - last_print_) >= (bar ? bar_seconds : line_seconds(seconds(now - start_)));
}

void Progress::update(const State& state) {
    const auto now = Clock::now();
    if (tell_due(now)) {
        last_told_ = now;
        listener_(state);
    }
    if (mode_ == ProgressMode::off) return;
    // Rates count from the first update (setting up is no stepping) of this count of steps.
    if (first_steps_ < 0 || state.steps < last_steps_) {
        first_steps_ = state.steps;
        first_time_ = state.time_fs;
        first_fraction_ = state.fraction;
        start_ = now;
    }
    last_steps_ = state.steps;
    if (!print_due(now)) return;
    last_print_ = now;
    const double fraction_done =
        state.fraction >= 0.0 && first_fraction_ >= 0.0 ? state.fraction - first_fraction_ : -1.0;
    const std::string line = progress_line(state, seconds(now - start_), state.steps - first_steps_,
                                           state.time_fs - first_time_, fraction_done);
    if (mode_ == ProgressMode::bar) {
        put("\r\033[K" + fitted(line, to_));
        bar_drawn_ = true;
    } else {
        put(line + "\n");
    }
}

/// What nobody can read any more is no reason to end a run.
void Progress::put(const std::string& text) {
    std::fwrite(text.data(), 1, text.size(), to_);
    std::fflush(to_);
}

void Progress::say(const std::string& sentence) {
    first_steps_ = -1; // what follows is of another kind and speed
    if (mode_ == ProgressMode::off) return;
    finish();
    put(sentence + "\n");
}

void Progress::finish() {
    if (!bar_drawn_) return;
    put("\r\033[K");
    bar_drawn_ = false;
}

std::string progress_line(const Progress::State& state, double seconds, long long steps_done,
                          double time_done_fs, double fraction_done) {
    std::string line;
    if (state.fraction >= 0.0) line = fmt::format("{:3.0f} %  ", 100.0 * state.fraction);
    line += state.phase;
    if (seconds > 0.0 && steps_done > 0) {
        line += fmt::format(" | step {}, {} steps/s", state.steps,
                            amount(static_cast<double>(steps_done) / seconds));
        if (time_done_fs > 0.0) line += ", " + simulated_per_day(time_done_fs / seconds * 86400.0);
        if (fraction_done > 1e-3)
            line += fmt::format(" | {} left",
                                duration_text(seconds * (1.0 - state.fraction) / fraction_done));
    }
    return line;
}

std::string duration_text(double seconds) {
    const auto whole = static_cast<long long>(seconds + 0.5);
    if (seconds < 9.95) return fmt::format("{:.1f} s", seconds);
    if (whole < 60) return fmt::format("{} s", whole);
    if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
    if (whole < 86400) return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
    return fmt::format("{} d {:02} h", whole / 86400, whole / 3600 % 24);
}

std::optional<double> parse_duration(std::string_view written) {
    static constexpr std::pair<std::string_view, double> units[] = {
        {"min", 60.0}, {"m", 60.0}, {"d", 86400.0}, {"h", 3600.0}, {"s", 1.0}};
    std::string lone(written); // only a lone number may stand without unit
    if (written.find_first_of("dhms") == std::string_view::npos) lone += 's';
    double total = 0.0, last_unit = 1e30;
    for (std::string_view text = lone; !text.empty();) {
        double value = 0.0;
        const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value,
                                            std::chars_format::fixed);
        text.remove_prefix(static_cast<std::size_t>(parsed.ptr - text.data()));
        const auto* const unit = std::find_if(std::begin(units), std::end(units),
                                              [&](auto& u) { return text.starts_with(u.first); });
        if (parsed.ec != std::errc() || !(value >= 0.0) || value > 1e9 || unit == std::end(units) ||
            unit->second >= last_unit) // days before hours before minutes
            return std::nullopt;
        text.remove_prefix(unit->first.size());
        last_unit = unit->second;
        total += value * last_unit;
    }
    return total > 0.0 ? std::optional(total) : std::nullopt;
}

} // namespace asperity::io
