// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/table.hpp"

#include "io/progress.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <numeric>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

namespace asperity::io {

int visible_width(std::string_view text) {
    int width = 0;
    for (const char c : text) // count the bytes that begin a character
        if ((static_cast<unsigned char>(c) & 0xC0) != 0x80) ++width;
    return width;
}

bool colours(std::FILE* stream) {
    const char* const no_color = std::getenv("NO_COLOR");
    const char* const term = std::getenv("TERM");
    return is_terminal(stream) && !(no_color && *no_color) &&
           !(term && std::strcmp(term, "dumb") == 0);
}

Table::Table(std::vector<std::string> heads)
    : heads_(std::move(heads)), left_(heads_.size(), false) {
    if (!left_.empty()) left_[0] = true;
}

void Table::align_left(int column) { left_.at(static_cast<std::size_t>(column)) = true; }

void Table::row(std::vector<std::string> cells) {
    cells.resize(heads_.size());
    rows_.push_back(std::move(cells));
}

void Table::rule() { rows_.emplace_back(); }

std::string Table::text(bool with_colours) const {
    std::vector<int> width;
    for (const std::string& head : heads_)
        width.push_back(visible_width(head));
    for (const auto& row : rows_)
        for (std::size_t i = 0; i < row.size(); ++i)
            width[i] = std::max(width[i], visible_width(row[i]));

    const auto line = [&](const std::vector<std::string>& cells) {
        std::string text;
        for (std::size_t i = 0; i < cells.size(); ++i) {
            const std::string pad(static_cast<std::size_t>(width[i] - visible_width(cells[i])),
                                  ' ');
            text += "  " + (left_[i] ? cells[i] + pad : pad + cells[i]);
        }
        text.erase(text.find_last_not_of(' ') + 1);
        return text;
    };
    const int total =
        std::accumulate(width.begin(), width.end(), 2 * static_cast<int>(width.size()));
    const std::string rule_text = fmt::format("  {:─<{}}", "", std::max(0, total - 2));

    std::string text;
    const bool headed = std::any_of(heads_.begin(), heads_.end(),
                                    [](const std::string& head) { return !head.empty(); });
    if (headed) {
        const std::string head = line(heads_);
        text += (with_colours ? "\033[1m" + head + "\033[0m" : head) + "\n" + rule_text + "\n";
    }
    for (const auto& row : rows_)
        text += (row.empty() ? rule_text : line(row)) + "\n";
    return text;
}

void Table::print(std::FILE* stream) const {
    const std::string out = text(colours(stream));
    std::fwrite(out.data(), 1, out.size(), stream);
}

std::string cell(double value, int digits) {
    if (!std::isfinite(value)) return "-";
    const double size = std::abs(value);
    if (value != 0.0 && (size < 1e-3 || size >= 1e6))
        return fmt::format("{:.{}e}", value, digits - 1);
    const int before = value == 0.0 ? 1 : static_cast<int>(std::floor(std::log10(size))) + 1;
    return fmt::format("{:.{}f}", value, std::clamp(digits - before, 0, digits + 2));
}

} // namespace asperity::io
