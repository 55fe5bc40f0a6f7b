// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A page that needs nothing but itself: style, script and pictures are inside, so it can be mailed,
// printed, read on a phone, and kept beside a paper. It is dark where the reader's screen is dark,
// and always light on paper. The script only adds the read-out under the plots.
//
// Texts are escaped; "h_{rms}" is set with a subscript.
#pragma once

#include <string>
#include <vector>

namespace asperity::io {

/// One of the numbers at the top.
struct KeyNumber {
    std::string value;
    std::string unit;
    std::string name;
    std::string note; ///< what it is compared with, small
};

class HtmlPage {
public:
    /// kicker: the line above the title.
    HtmlPage(const std::string& kicker, const std::string& title, const std::string& lead);

    void section(const std::string& id, const std::string& heading);
    void paragraph(const std::string& text);
    /// Something the reader must not miss: the reason of a failure.
    void notice(const std::string& heading, const std::string& text);
    void key_numbers(const std::vector<KeyNumber>& numbers);
    void list(const std::string& heading, const std::vector<std::string>& items);
    /// Lists side by side, between begin and end; figures likewise.
    void begin_columns(const std::string& kind) { body_ += "<div class=\"" + kind + "\">\n"; }
    void end_columns() { body_ += "</div>\n"; }
    /// A plot or map as an SVG element; files: where else its numbers are.
    void figure(const std::string& svg, const std::string& caption, const std::string& files);
    /// The first column is set flush left, the others as numbers. links: the first cells lead to
    /// these files, named from where the page is; empty: nowhere.
    void table(const std::vector<std::string>& heads,
               const std::vector<std::vector<std::string>>& rows,
               const std::vector<std::string>& links = {});
    /// Small pictures in rows, each a link likewise.
    struct Thumbnail {
        std::string png;
        std::string caption;
        std::string link;
    };
    void thumbnails(const std::vector<Thumbnail>& list);
    /// Shares of a whole as bars: name, share (0 to 1), text.
    struct Bar {
        std::string name;
        double share = 0.0;
        std::string text;
    };
    void bars(const std::vector<Bar>& bars);
    void preformatted(const std::string& text);

    /// The whole document.
    std::string text() const;

private:
    std::string kicker_, title_, lead_;
    struct Entry {
        std::string id, heading;
    };
    std::vector<Entry> contents_;
    std::string body_;
};

} // namespace asperity::io
