// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/error.hpp"

#include "io/terminal.hpp"

#include <algorithm>
#include <cctype>

namespace asperity::io {

namespace {

/// Indents the lines after the first, so that a cause of several lines still reads as one.
std::string indented(const std::string& text) {
    std::string result;
    for (const char c : text) {
        result += c;
        if (c == '\n') result += "         ";
    }
    return result;
}

std::string format(const std::vector<Problem>& problems) {
    std::string text;
    for (const Problem& problem : problems) {
        if (!text.empty()) text += '\n';
        text += io::format(problem);
    }
    return text;
}

std::string plain(std::string_view word) { // case and the kind of dash do not count
    std::string result;
    for (const char c : word)
        result += c == '-' || c == ' '
                      ? '_'
                      : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return result;
}

/// Returns the number of edits (insert, delete, replace, swap neighbours) from a to b.
int distance(const std::string& a, const std::string& b) {
    const std::size_t n = b.size() + 1;
    std::vector<int> table((a.size() + 1) * n);
    for (std::size_t i = 0; i <= a.size(); ++i)
        for (std::size_t j = 0; j <= b.size(); ++j) {
            int& best = table[i * n + j];
            if (i == 0 || j == 0) {
                best = static_cast<int>(i + j);
                continue;
            }
            best = std::min({table[(i - 1) * n + j] + 1, table[i * n + j - 1] + 1,
                             table[(i - 1) * n + j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                best = std::min(best, table[(i - 2) * n + j - 2] + 1);
        }
    return table.back();
}

} // namespace

std::string format(const Problem& problem) {
    std::string text = problem.where.empty() ? problem.what : problem.where + ": " + problem.what;
    if (!problem.why.empty()) text += "\n    why: " + indented(problem.why);
    if (!problem.fix.empty()) text += "\n    fix: " + indented(problem.fix);
    return printable(text);
}

std::string nearest(std::string_view word, const std::vector<std::string>& candidates) {
    constexpr std::size_t longest_name = 64; // the table of distances grows with the square
    std::string best;
    if (word.size() > longest_name) return best;
    const std::string wanted = plain(word);
    int best_distance = 1 + static_cast<int>(wanted.size()) / 3; // at most a third may be wrong
    for (const std::string& candidate : candidates) {
        const std::string other = plain(candidate);
        int d = distance(wanted, other);
        if (std::min(wanted.size(), other.size()) >= 3 &&
            (other.starts_with(wanted) || wanted.starts_with(other)))
            d = std::min(d, 1); // "temp" for "temperature"
        if (d < best_distance || (d == best_distance && best.empty())) {
            best = candidate;
            best_distance = d;
        }
    }
    return best;
}

Error::Error(int code, Problem problem) : Error(code, std::vector<Problem>{std::move(problem)}) {}

Error::Error(int code, std::vector<Problem> problems)
    : std::runtime_error(format(problems)), code_(code), problems_(std::move(problems)) {}

} // namespace asperity::io
