// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/terminal.hpp"

#include "io/json.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <utility>

#include <sys/ioctl.h>
#include <unistd.h>

namespace asperity::io {

namespace {

/// Returns true if somebody reads the stream at once. Open MPI's mpirun gives its ranks a terminal
/// of their own, wherever the output goes in the end: this one does not count.
bool is_terminal(std::FILE* stream) {
    return ::isatty(::fileno(stream)) != 0 && !std::getenv("OMPI_COMM_WORLD_SIZE");
}

bool colours(std::FILE* stream) {
    const char* const no_color = std::getenv("NO_COLOR");
    const char* const term = std::getenv("TERM");
    return is_terminal(stream) && !(no_color && *no_color) &&
           !(term && std::string_view(term) == "dumb");
}

constexpr double bar_seconds = 0.2;
/// Returns the time to the next line, which grows with the run: 2 s, 10 s, then each 10 % of the
/// time so far.
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

/// Returns the columns of the terminal that a line may fill.
int columns_of(std::FILE* stream) {
    struct winsize window {};
    const bool known = ::ioctl(::fileno(stream), TIOCGWINSZ, &window) == 0 && window.ws_col > 10;
    return known ? window.ws_col - 1 : 110;
}

} // namespace

std::string printable(std::string_view text) {
    std::string shown;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto byte = static_cast<unsigned char>(text[i]);
        const auto next = i + 1 < text.size() ? static_cast<unsigned char>(text[i + 1]) : 0u;
        if (byte == 0xc2 && next >= 0x80 && next < 0xa0) // U+0080 to U+009F in UTF-8
            shown += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[++i]));
        else if ((byte < 0x20 && byte != '\n') || byte == 0x7f)
            shown += fmt::format("\\x{:02x}", byte);
        else
            shown += text[i];
    }
    return shown;
}

int visible_width(std::string_view text) {
    return static_cast<int>(std::count_if(text.begin(), text.end(), [](char c) {
        return (static_cast<unsigned char>(c) & 0xC0) != 0x80; // begins a character
    }));
}

namespace {

/// Returns true for a number, to which the next word belongs as its unit: "(558 mJ/m²)".
bool is_number(std::string_view word) {
    return word.find_first_of("0123456789") < 2 &&
           word.find_first_not_of("(+-.0123456789e") == std::string_view::npos;
}

} // namespace

std::vector<std::string> wrapped(std::string_view text, int most) {
    std::vector<std::string> lines(1);
    while (!text.empty()) {
        const std::string_view word = text.substr(0, text.find(' '));
        text.remove_prefix(std::min(text.size(), word.size() + 1));
        if (!lines.back().empty() && visible_width(lines.back()) + 1 + visible_width(word) > most) {
            const std::size_t last = lines.back().rfind(' ');
            const bool both = last != std::string::npos &&
                              is_number(std::string_view(lines.back()).substr(last + 1));
            lines.push_back(both ? lines.back().substr(last + 1) : std::string());
            if (both) lines[lines.size() - 2].resize(last);
        }
        lines.back() += (lines.back().empty() ? "" : " ") + std::string(word);
    }
    return lines;
}

namespace {

/// Returns the number of columns below which the rest of a long line stands: those of its value
/// behind a name and two blanks, or of its text behind "why: ", "fix: " or "note: ".
std::size_t hanging_indent(std::string_view line) {
    const std::size_t first = std::min(line.find_first_not_of(' '), line.size());
    for (const std::string_view label : {"why: ", "fix: ", "note: "})
        if (line.substr(first).starts_with(label)) return first + label.size();
    const std::size_t gap = line.find("  ", first);
    const std::size_t value = gap < 20 ? line.find_first_not_of(' ', gap) : first;
    return value == std::string_view::npos ? first : value;
}

} // namespace

std::string folded(std::string_view unchecked, int of_margin) {
    const std::string shown = printable(unchecked);
    std::string_view text = shown;
    std::string all;
    while (!text.empty()) {
        const std::string_view line = text.substr(0, text.find('\n'));
        const bool ends = line.size() < text.size();
        text.remove_prefix(line.size() + (ends ? 1 : 0));
        const std::size_t begin = hanging_indent(line);
        if (visible_width(line) <= text_columns) {
            all += line;
        } else {
            const int indent = begin == 0 ? of_margin : visible_width(line.substr(0, begin));
            bool below = false;
            for (const std::string& part : wrapped(line.substr(begin), text_columns - indent)) {
                all += std::exchange(below, true)
                           ? "\n" + std::string(static_cast<std::size_t>(indent), ' ')
                           : std::string(line.substr(0, begin));
                all += part;
            }
        }
        if (ends) all += '\n';
    }
    return all;
}

Table::Table(std::vector<std::string> heads, std::string sides)
    : heads_(std::move(heads)), sides_(std::move(sides)) {
    if (sides_.empty()) sides_ = "<";
    sides_.resize(heads_.size(), '>');
}

void Table::row(std::vector<std::string> cells) {
    cells.resize(heads_.size());
    for (std::string& cell : cells)
        cell = printable(cell);
    rows_.push_back(std::move(cells));
}

std::string Table::text(bool with_colours) const {
    std::vector<int> width;
    for (const std::string& head : heads_)
        width.push_back(visible_width(head));
    for (const auto& row : rows_)
        for (std::size_t i = 0; i < row.size(); ++i)
            width[i] = std::max(width[i], visible_width(row[i]));
    const auto total = [&] {
        return std::accumulate(width.begin(), width.end(), 2 * static_cast<int>(width.size()));
    };
    constexpr int least_column = 20;
    int& last = width.back();
    if (sides_.back() == '<' && total() > text_columns)
        last = std::max(std::min(last, least_column), last - (total() - text_columns));

    const auto line = [&](const std::vector<std::string>& cells) {
        std::string text;
        for (std::size_t i = 0; i < cells.size(); ++i) {
            const std::string pad(static_cast<std::size_t>(width[i] - visible_width(cells[i])),
                                  ' ');
            text += "  " + (sides_[i] == '<' ? cells[i] + pad : pad + cells[i]);
        }
        text.erase(text.find_last_not_of(' ') + 1);
        return text;
    };
    const auto lines = [&](std::vector<std::string> cells) {
        std::string text;
        for (const std::string& part : wrapped(cells.back(), last)) {
            cells.back() = part;
            text += line(cells) + "\n";
            std::fill(cells.begin(), cells.end(), "");
        }
        return text;
    };
    const std::string rule_text = fmt::format("  {:─<{}}", "", std::max(0, total() - 2));

    std::string text;
    const bool headed = std::any_of(heads_.begin(), heads_.end(),
                                    [](const std::string& head) { return !head.empty(); });
    if (headed) {
        const std::string head = line(heads_);
        text += (with_colours ? "\033[1m" + head + "\033[0m" : head) + "\n" + rule_text + "\n";
    }
    for (const auto& row : rows_)
        text += row.empty() ? rule_text + "\n" : lines(row);
    return text;
}

void Table::print(std::FILE* stream) const {
    const std::string out = text(colours(stream));
    std::fwrite(out.data(), 1, out.size(), stream);
}

std::string number(double value, int decimals) {
    if (!std::isfinite(value)) return "-";
    const double size = std::abs(value);
    if (size >= 1e7) return fmt::format("{:.3e}", value);
    // Rounded to `decimals`, the number has three digits.
    if (value == 0.0 || size * std::pow(10.0, decimals) >= 99.5)
        return fmt::format("{:.{}f}", value == 0.0 ? 0.0 : value, decimals);
    if (size < 0.9995e-3) return fmt::format("{:.2e}", value);
    const int before = static_cast<int>(std::floor(std::log10(size))) + 1;
    return fmt::format("{:.{}f}", value, 3 - before);
}

std::string with_error(double value, double error) {
    if (!std::isfinite(value) || !std::isfinite(error) || !(error > 0.0)) return cell(value);
    const double largest = std::max(std::abs(value), error);
    if (largest < 1e-4 || largest >= 1e7) {
        const double exponent = std::floor(std::log10(largest)), unit = std::pow(10.0, exponent);
        return fmt::format("({})e{:+03d}", with_error(value / unit, error / unit),
                           static_cast<int>(exponent));
    }
    const double digit = std::floor(std::log10(error)), unit = std::pow(10.0, digit);
    if (std::round(error / unit) >= 10.0) return with_error(value, 10.0 * unit);
    const int decimals = std::max(0, -static_cast<int>(digit));
    return fmt::format("{:.{}f} ± {:.{}f}", std::round(value / unit) * unit, decimals,
                       std::round(error / unit) * unit, decimals);
}

std::string cell(double value, int digits) {
    if (!std::isfinite(value)) return "-";
    const double size = std::abs(value);
    if (value != 0.0 && (size < 1e-3 || size >= 1e6))
        return fmt::format("{:.{}e}", value, digits - 1);
    const int before = value == 0.0 ? 1 : static_cast<int>(std::floor(std::log10(size))) + 1;
    return number(value, std::clamp(digits - before, 0, digits + 2));
}

std::optional<ProgressMode> progress_mode(std::string_view name) {
    static constexpr std::string_view names[] = {"auto", "bar", "lines", "json", "off"};
    const auto* const at = std::find(std::begin(names), std::end(names), name);
    if (at == std::end(names)) return std::nullopt;
    return static_cast<ProgressMode>(at - std::begin(names));
}

Progress::Progress(ProgressMode mode, bool quiet, std::FILE* to)
    : mode_(quiet ? ProgressMode::off : mode), to_(to) {
    const bool terminal = is_terminal(to);
    if (mode_ == ProgressMode::automatic || (mode_ == ProgressMode::bar && !terminal))
        mode_ = terminal ? ProgressMode::bar : ProgressMode::lines;
    last_ = start_;
}

bool Progress::due() const {
    if (mode_ == ProgressMode::off) return false;
    const auto now = Clock::now();
    return seconds(now - last_) >=
           (mode_ == ProgressMode::bar ? bar_seconds : line_seconds(seconds(now - start_)));
}

void Progress::update(const State& state) {
    const auto now = Clock::now();
    // Rates count from the first update (setting up is no stepping) of this count of steps.
    if (first_steps_ < 0 || state.steps < last_steps_) {
        first_steps_ = state.steps;
        first_time_ = state.time_fs;
        start_ = now;
    }
    last_steps_ = state.steps;
    if (!due()) return;
    last_ = now;
    const std::string line = progress_line(state, seconds(now - start_), state.steps - first_steps_,
                                           state.time_fs - first_time_);
    if (mode_ == ProgressMode::bar) {
        put(fmt::format("\r\033[K{:.{}}", printable(line),
                        std::min(progress_columns, columns_of(to_))));
        bar_drawn_ = true;
    } else if (mode_ == ProgressMode::json) {
        const Json fraction = state.fraction < 0.0 ? Json() : Json(state.fraction);
        put(json_text({{"fraction", fraction}, {"text", line}}) + "\n");
    } else {
        put(printable(line) + "\n");
    }
}

/// Writes a text; a failure is no reason to end a run.
void Progress::put(const std::string& text) {
    std::fwrite(text.data(), 1, text.size(), to_);
    std::fflush(to_);
}

void Progress::say(const std::string& sentence) {
    first_steps_ = -1; // the next steps are of another kind and speed
    if (mode_ == ProgressMode::off) return;
    finish();
    const bool json = mode_ == ProgressMode::json;
    put((json ? json_text({{"text", sentence}}) : printable(sentence)) + "\n");
}

void Progress::finish() {
    if (!bar_drawn_) return;
    put("\r\033[K");
    bar_drawn_ = false;
}

std::string progress_line(const Progress::State& state, double seconds, long long steps_done,
                          double time_done_fs) {
    std::string line;
    if (state.left >= 0.0) line = fmt::format("{} left, ", duration_text(state.left));
    if (state.fraction >= 0.0) line += fmt::format("{:.0f} %, ", 100.0 * state.fraction);
    // The phase in parts that a comma ends, then the rates.
    std::vector<std::string> parts;
    for (std::string_view left = state.phase; !left.empty();) {
        const std::size_t end = std::min(left.find(", "), left.size());
        parts.push_back((parts.empty() ? "" : ", ") + std::string(left.substr(0, end)));
        left.remove_prefix(std::min(left.size(), end + 2));
    }
    if (seconds > 0.0 && steps_done > 0) {
        parts.push_back(fmt::format(" | step {}", state.steps));
        parts.push_back(
            fmt::format(", {} steps/s", amount(static_cast<double>(steps_done) / seconds)));
        if (time_done_fs > 0.0)
            parts.push_back(", " + simulated_per_day(time_done_fs / seconds * 86400.0));
    }
    for (const std::string& part : parts) {
        if (visible_width(line) + visible_width(part) > progress_columns) break;
        line += part;
    }
    return line;
}

std::string duration_text(double seconds) {
    const long long whole = std::llround(seconds);
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

std::optional<double> parse_memory(std::string_view written) {
    static constexpr std::pair<std::string_view, double> units[] = {
        {"MB", 1e6}, {"GB", 1e9}, {"TB", 1e12}, {"MiB", 0x1p20}, {"GiB", 0x1p30}, {"TiB", 0x1p40}};
    double value = 0.0;
    const auto parsed = std::from_chars(written.data(), written.data() + written.size(), value);
    if (parsed.ec != std::errc() || !(value > 0.0) || value > 1e9) return std::nullopt;
    written.remove_prefix(static_cast<std::size_t>(parsed.ptr - written.data()));
    written.remove_prefix(std::min(written.find_first_not_of(' '), written.size()));
    for (const auto& [unit, bytes] : units)
        if (written == unit) return value * bytes;
    return std::nullopt;
}

} // namespace asperity::io
