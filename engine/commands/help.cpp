// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/commands/help.hpp"

#include "io/terminal.hpp"

#include <cctype>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace asperity {

namespace {

/// Columns of the help, and the one in which explanations begin.
constexpr int width = io::text_columns, indent = 26;

constexpr const char* exit_codes =
    "exit codes: 0 done, 1 internal error, 2 usage or scene, 3 physics guard,\n"
    "            4 files, 75 stopped early\n";

std::string blanks(int count) { return std::string(static_cast<std::size_t>(count), ' '); }

/// Returns a name with its explanation beside it, or below if the name is long.
std::string entry(const std::string& name, const std::string& explanation) {
    std::string text = "  " + name;
    const bool beside = io::visible_width(text) + 2 <= indent;
    text += beside ? blanks(indent - io::visible_width(text)) : "\n" + blanks(indent);
    bool first = true;
    for (const std::string& line : io::wrapped(explanation, width - indent))
        text += (std::exchange(first, false) ? "" : blanks(indent)) + line + "\n";
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
    return fmt::format("{}.", fmt::join(io::wrapped(text, width - 1), "\n"));
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
