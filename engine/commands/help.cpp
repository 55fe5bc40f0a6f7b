// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/commands/help.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace asperity {

namespace {

/// Columns of the help, and the one in which explanations begin.
constexpr std::size_t width = 80, indent = 26;

constexpr const char* exit_codes =
    "exit codes: 0 done, 1 internal error, 2 usage or scene, 3 physics guard,\n"
    "            4 files, 75 stopped early\n";

/// Returns the number of visible characters of a UTF-8 text.
std::size_t columns(std::string_view text) {
    return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
        return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
    }));
}

/// Returns a text in lines of this number of columns, broken at blanks.
std::vector<std::string> wrapped(std::string_view text, std::size_t most) {
    std::vector<std::string> lines(1);
    while (!text.empty()) {
        const std::string_view word = text.substr(0, text.find(' '));
        text.remove_prefix(std::min(text.size(), word.size() + 1));
        if (!lines.back().empty() && columns(lines.back()) + 1 + columns(word) > most)
            lines.emplace_back();
        lines.back() += (lines.back().empty() ? "" : " ") + std::string(word);
    }
    return lines;
}

/// Returns a name with its explanation beside it, or below if the name is long.
std::string entry(const std::string& name, const std::string& explanation) {
    std::string text = "  " + name;
    const bool beside = columns(text) + 2 <= indent;
    text += beside ? std::string(indent - columns(text), ' ') : "\n" + std::string(indent, ' ');
    bool first = true;
    for (const std::string& line : wrapped(explanation, width - indent))
        text += (std::exchange(first, false) ? "" : std::string(indent, ' ')) + line + "\n";
    return text;
}

bool is_word(const Option& option) { return !option.name.starts_with("-"); }

/// Returns an option as the help has it: "-o, --out DIR"; a long one stands where it would behind a
/// short one.
std::string spelt(const Option& option) {
    return (option.short_name.empty() ? "    " : option.short_name + ", ") + option.name +
           (option.value.empty() ? "" : " " + option.value);
}

std::string listed(const std::vector<Option>& options, bool words) {
    std::string text = words ? "arguments:\n" : "options:\n";
    for (const Option& option : options)
        if (is_word(option) == words)
            text += entry(words ? option.name : spelt(option), option.explanation);
    return text + (words ? "" : entry("-h, --help", "print this help"));
}

std::string sentence(std::string text) {
    text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
    return fmt::format("{}.", fmt::join(wrapped(text, width - 1), "\n"));
}

} // namespace

std::string help_of(const Command& command) {
    std::string usage = "usage: asperity " + command.name;
    bool words = false;
    for (const Option& option : command.options)
        if (is_word(option)) {
            usage += option.needed ? " " + option.name : " [" + option.name + "]";
            words = true;
        }
    return fmt::format("{} [options]\n\n{}\n\n{}{}\n{}", usage, sentence(command.purpose),
                       words ? listed(command.options, true) + "\n" : std::string(),
                       listed(command.options, false), exit_codes);
}

std::string overview_of(const std::vector<Command>& commands) {
    std::string text =
        "usage: asperity COMMAND [options]\n\n"
        "Adhesion and contact of elastic solids with randomly rough surfaces, from the\n"
        "atoms up. Start here: asperity init, then asperity run scene.toml.\n\ncommands:\n";
    for (const Command& command : commands)
        text += entry(command.name, command.purpose);
    return text + "\noptions:\n" + entry("    --version", "print the version") +
           entry("-h, --help", "print this help; of a command: asperity COMMAND --help") + "\n" +
           exit_codes;
}

} // namespace asperity
