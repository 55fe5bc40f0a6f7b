// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/scene/parse_path.hpp"

#include "engine/units.hpp"
#include "io/error.hpp"
#include "io/units.hpp"

#include <fmt/format.h>

#include <array>

namespace asperity {

namespace {

struct Word {
    Segment::Kind kind;
    const char* unit; ///< unit of the amount; empty: there is no amount
    const char* example;
};
constexpr std::array<Word, Segment::kinds> syntax = {{
    {Segment::approach, "", "approach"},
    {Segment::pull_off, "", "pull-off"},
    {Segment::relax, "", "relax"},
    {Segment::load, "MPa", "load 100 MPa"},
    {Segment::height, "Å", "height 12 Å"},
    {Segment::hold, "ps", "hold 20 ps"},
    {Segment::slide, "Å", "slide x 5 Å"},
}};

std::string examples() {
    std::string list;
    for (const Word& w : syntax)
        list += fmt::format("{}\"{}\"", list.empty() ? "" : ", ", w.example);
    return list;
}

/// Takes words off the end of a text, with the spaces before them. Returns false if it does not end
/// with them.
bool take_off(std::string& text, const std::string& words) {
    while (!text.empty() && text.back() == ' ')
        text.pop_back();
    if (!text.ends_with(" " + words)) return false;
    text.resize(text.size() - words.size() - 1);
    return true;
}

/// Returns the text of a member after its first word, without the spaces between.
std::string rest_of(const std::string& text, std::size_t from) {
    const std::size_t first = text.find_first_not_of(' ', from);
    return first == std::string::npos ? std::string() : text.substr(first);
}

} // namespace

std::vector<Segment> parse_path(const std::vector<std::string>& path, double area,
                                io::Problems& problems) {
    std::vector<Segment> segments;
    for (const std::string& member : path) {
        const std::string text = rest_of(member, 0);
        const std::string name = text.substr(0, text.find(' '));
        std::string amount = rest_of(text, name.size());
        const Word* found = nullptr;
        for (const Word& w : syntax)
            if (name == word(w.kind)) found = &w;
        const auto refuse = [&](std::string why, std::string fix) {
            problems.add("drive.path", fmt::format("has \"{}\"", member), std::move(why),
                         std::move(fix));
        };
        if (!found) {
            std::vector<std::string> known;
            known.reserve(std::size(syntax));
            for (const Word& w : syntax)
                known.emplace_back(word(w.kind));
            if (name == "zero-load") {
                refuse("it is called \"relax\": its state can carry a load", "write \"relax\"");
                continue;
            }
            const std::string close = io::nearest(name, known);
            refuse("segments are " + examples(),
                   close.empty() ? "take one of these" : "did you mean \"" + close + "\"?");
            continue;
        }
        Segment segment{found->kind, 0.0, 0, text};
        const bool wants_amount = found->unit[0] != '\0';
        if (segment.kind == Segment::slide) {
            const std::string axis = amount.substr(0, amount.find(' '));
            if (axis != "x" && axis != "y") {
                refuse("a slide goes along x or y",
                       fmt::format("for example \"{}\"", found->example));
                continue;
            }
            segment.axis = axis == "y";
            amount = rest_of(amount, axis.size());
            bool more = true;
            while (more) {
                const bool steady = take_off(amount, "until steady");
                const bool loaded = take_off(amount, "under load");
                segment.until_steady |= steady;
                if (loaded) segment.under = 0.0; // the value is known to resolve()
                more = steady || loaded;
            }
        }
        if (!wants_amount && !amount.empty()) {
            refuse(fmt::format("\"{}\" stands alone", name), fmt::format("take \"{}\"", name));
            continue;
        }
        if (wants_amount) {
            io::ParsedQuantity parsed = io::parse_quantity(amount, found->unit);
            if (segment.kind == Segment::load && !parsed.why.empty())
                if (const auto force = io::parse_quantity(amount, "nN"); force.why.empty())
                    parsed = {force.value * units::nanonewton / (units::megapascal * area), {}, {}};
            if (!parsed.why.empty()) {
                refuse(amount.empty() ? std::string("it needs an amount") : parsed.why,
                       fmt::format("for example \"{}\"", found->example));
                continue;
            }
            segment.amount = parsed.value;
            if (segment.kind == Segment::hold && !(segment.amount > 0.0)) {
                refuse("a time is above 0 ps", fmt::format("for example \"{}\"", found->example));
                continue;
            }
            if (segment.kind == Segment::slide && segment.amount == 0.0) {
                refuse("it goes nowhere", "give a distance, negative for the other direction");
                continue;
            }
        }
        if (segment.kind == Segment::load) segment.amount *= units::megapascal * area;
        if (segment.kind == Segment::hold) segment.amount *= units::picosecond;
        segments.push_back(std::move(segment));
    }
    return segments;
}

} // namespace asperity
