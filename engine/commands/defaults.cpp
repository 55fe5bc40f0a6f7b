// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/commands/command_line.hpp"

#include "decomposition/communicator.hpp"
#include "engine/run/series.hpp"
#include "engine/scene/scene.hpp"
#include "io/error.hpp"
#include "io/json.hpp"
#include "io/quantities.hpp"

#include <memory>
#include <string>

#include <fmt/format.h>

namespace asperity {

namespace {

struct DefaultsArguments : Arguments {
    bool markdown = false; ///< prints the page docs/reference/scene.md
    bool plain = false;    ///< leaves out the explanations
    bool results = false;  ///< prints the page docs/reference/result.md
};

/// Prints kind, unit, default, choices and meaning of every key as JSON; results: unit and meaning
/// of every value of result.json.
int print_schema(bool results) {
    io::Json all;
    if (results) {
        for (const io::Quantity& q : io::result_quantities())
            all[std::string(q.name)] = {{"unit", q.unit}, {"per", q.per}, {"meaning", q.meaning}};
    } else {
        Scene defaults;
        const io::Schema schema = bind(defaults);
        for (const io::Schema::Key& key : schema.keys()) {
            io::Json& one = all[key.path()];
            one["kind"] = key.kind();
            one["unit"] = key.unit;
            one["default"] = key.load();
            one["doc"] = key.doc;
            if (!key.word.empty()) one["word"] = key.word;
            if (!key.choices.empty()) one["choices"] = key.choices;
        }
    }
    fmt::print("{}\n", io::json_text(all));
    return io::exit_code::done;
}

int print_defaults(const DefaultsArguments& given) {
    if (given.json) return print_schema(given.results);
    fmt::print("{}", given.results    ? io::result_markdown(series_quantities())
                     : given.markdown ? scene_markdown()
                                      : scene_toml(Scene{}, !given.plain));
    return io::exit_code::done;
}

} // namespace

Command defaults_command() {
    const auto given = std::make_shared<DefaultsArguments>();
    return {.options = {{"--markdown", "", "as the reference page docs/reference/scene.md",
                         &given->markdown},
                        {"--plain", "", "without explanations", &given->plain},
                        takes::quiet(*given),
                        takes::json(*given),
                        {"--results", "",
                         "every name of result.json and run.h5: the reference page "
                         "docs/reference/result.md; with --json those of result.json",
                         &given->results}},
            .act = [given](const Communicator& world) {
                return on_root(world, [&] { return print_defaults(*given); });
            }};
}

} // namespace asperity
