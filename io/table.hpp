// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A table for the terminal: columns aligned by what is seen (UTF-8 counts as one), headings bold
// where colours are wanted (a terminal, and NO_COLOR not set).
#pragma once

#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

namespace asperity::io {

/// Characters seen, not bytes.
int visible_width(std::string_view text);
/// Colours on this stream: it is a terminal, NO_COLOR is not set and TERM is not "dumb".
bool colours(std::FILE* stream);

class Table {
public:
    explicit Table(std::vector<std::string> heads);
    /// First column flush left, the others flush right, unless told.
    void align_left(int column);
    void row(std::vector<std::string> cells); ///< missing cells are empty
    void rule();                              ///< a line across
    std::string text(bool with_colours) const;
    void print(std::FILE* stream) const;

private:
    std::vector<std::string> heads_;
    std::vector<bool> left_;
    std::vector<std::vector<std::string>> rows_; ///< empty: a rule
};

/// Four significant digits, or "-" for nothing: for cells.
std::string cell(double value, int digits = 4);

} // namespace asperity::io
