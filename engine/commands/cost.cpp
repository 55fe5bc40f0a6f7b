// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/commands/cost.hpp"

#include "engine/commands/cost_output.hpp"
#include "engine/setup/setup.hpp"
#include "io/error.hpp"
#include "io/scene_reader.hpp"
#include "io/spelling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <utility>

namespace asperity {

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

std::string key_of(const std::string& assignment) {
    return assignment.substr(0, assignment.find('='));
}

/// Later settings of a key take the place of earlier ones.
Setting joined(const Setting& first, const Setting& then) {
    Setting all;
    for (const std::string& assignment : first)
        if (std::none_of(then.begin(), then.end(), [&](const std::string& other) {
                return key_of(other) == key_of(assignment);
            }))
            all.push_back(assignment);
    all.insert(all.end(), then.begin(), then.end());
    return all;
}

CostRow row_of(const std::string& knob, const KnobValue& value, const Setting& base = {}) {
    CostRow row;
    row.knob = knob;
    row.label = value.label;
    row.own = value.setting;
    row.setting = joined(base, value.setting);
    row.x = value.x;
    return row;
}

double number_at(const io::JsonValue& result, const char* path) {
    const io::JsonValue* value = result.find(path);
    return value && value->is_number() ? value->number() : nothing;
}

/// Knobs that are asked for.
void choose_knobs(CostCase& what, const std::vector<std::string>& names) {
    if (names.empty()) return;
    std::vector<std::string> there;
    for (const Knob& knob : what.knobs)
        there.push_back(knob.name);
    for (const std::string& name : names)
        if (std::find(there.begin(), there.end(), name) == there.end()) {
            const std::string near = io::nearest(name, there);
            throw io::SceneError(io::Problem{"--knobs " + name, "is no knob of this scene",
                                             fmt::format("knobs: {}", fmt::join(there, ", ")),
                                             near.empty() ? "leave --knobs out for all of them"
                                                          : "did you mean " + near + "?"});
        }
    std::erase_if(what.knobs, [&](const Knob& knob) {
        return std::find(names.begin(), names.end(), knob.name) == names.end();
    });
}

/// Of a knob the row of its twin, or none.
const CostRow* twin_of(const CostTable& table, const Knob& knob) {
    for (const CostRow& row : table.rows)
        if (knob.twin && row.knob == knob.name && row.own == knob.twin->setting) return &row;
    return nullptr;
}

/// Runs the rows from `first` on. False: stopped before the end.
class Runs {
public:
    Runs(const CostOptions& options, std::string directory)
        : options_(options), directory_(std::move(directory)),
          text_(io::read_scene_file(options.scene)) {}

    bool run(CostTable& table, std::size_t first) {
        std::vector<SweepJob> jobs;
        std::vector<std::size_t> job_of; // settings that make one scene are one run
        for (std::size_t i = first; i < table.rows.size(); ++i) {
            SweepJob job = job_for(table.rows[i]);
            const auto at = made_.try_emplace(scene_json(job.scene).dump(-1), job).first;
            const auto same = std::find_if(jobs.begin(), jobs.end(), [&](const SweepJob& other) {
                return other.directory == at->second.directory;
            });
            job_of.push_back(static_cast<std::size_t>(same - jobs.begin()));
            if (same == jobs.end()) jobs.push_back(at->second);
        }
        std::vector<PointOutcome> outcomes;
        for (const SweepJob& job : jobs)
            outcomes.push_back(look_at(job));
        const auto there =
            std::count_if(outcomes.begin(), outcomes.end(),
                          [](const PointOutcome& o) { return o.state != PointState::waiting; });
        fmt::print("{} runs in {}", jobs.size(), directory_);
        if (there > 0) fmt::print("; {} are there already", there);
        fmt::print("\n");
        std::fflush(stdout);
        SweepRunOptions how;
        how.at_once = options_.jobs;
        how.threads = 1;
        how.progress = options_.progress;
        const auto fill_in = [&] {
            for (std::size_t i = first; i < table.rows.size(); ++i)
                take_over(table.rows[i], outcomes[job_of[i - first]]);
        };
        const bool all = run_points(jobs, outcomes, how, [](std::size_t) {});
        fill_in();
        return all;
    }

private:
    /// Named by what it sets.
    SweepJob job_for(const CostRow& row) const {
        SweepJob job;
        Setting sorted = row.setting;
        std::sort(sorted.begin(), sorted.end());
        for (const std::string& assignment : sorted)
            job.name += (job.name.empty() ? "" : ",") + assignment.substr(assignment.find('.') + 1);
        if (job.name.empty()) job.name = "scene";
        job.directory = directory_ + "/" + job.name;
        // Maps and frames would be timed too.
        const Setting quiet = {"output.fields=zero-load", "output.trajectory=none"};
        job.overrides = joined(joined(options_.overrides, quiet), row.setting);
        job.scene = read_scene_text(text_, options_.scene, job.overrides);
        examine(job.scene, 1);
        return job;
    }

    static void take_over(CostRow& row, const PointOutcome& outcome) {
        row.outcome = outcome;
        const bool done = outcome.state == PointState::finished;
        row.numbers.fill(nothing);
        if (!done) return;
        row.numbers = cost_numbers(outcome.result);
        row.seconds = number_at(outcome.result, "run.processor_seconds");
        row.wall = number_at(outcome.result, "run.wall_seconds");
    }

    const CostOptions& options_;
    std::string directory_, text_;
    std::map<std::string, SweepJob> made_; ///< by what the scene says
};

void add_knobs(CostTable& table) {
    for (const Knob& knob : table.what.knobs) {
        for (const KnobValue& value : knob.values)
            table.rows.push_back(row_of(knob.name, value, knob.base));
        if (knob.twin) table.rows.push_back(row_of(knob.name, *knob.twin, knob.base));
    }
    for (CostRow& row : table.rows)
        if (row.knob == "thickness") row.judged = false; // another solid
}

/// Of a part's knobs the cheapest value whose own error is within the share. None: no value is; the
/// twin is taken, if it can be (it has no other path).
const CostRow* cheapest_of_part(const CostTable& table, const std::string& part, Question question,
                                double share) {
    const CostRow* best = nullptr;
    for (const Knob& knob : table.what.knobs) {
        if (knob.part != part) continue;
        const CostRow* twin = twin_of(table, knob);
        for (const CostRow& row : table.rows) {
            if (row.knob != knob.name || !twin) continue;
            if (&row == twin && knob.name == "velocity") continue; // it is another base
            const bool within = largest_error(row.numbers, twin->numbers, question) <= share;
            if (within && (!best || row.seconds < best->seconds)) best = &row;
        }
    }
    return best;
}

void add_combinations(CostTable& table) {
    std::vector<CostRow> found;
    for (const CombinationBase& base : table.what.bases)
        for (const Question question : questions)
            for (const double target : cost_targets) {
                const bool whole_path = base.label != "zero load alone";
                if (whole_path != (question == Question::path)) continue;
                const double share = target / static_cast<double>(base.parts.size());
                CostRow row;
                row.knob = "combination";
                row.label = base.label;
                row.setting = base.setting;
                bool possible = true;
                for (const std::string& part : base.parts) {
                    const bool known =
                        std::any_of(table.what.knobs.begin(), table.what.knobs.end(),
                                    [&](const Knob& knob) { return knob.part == part; });
                    if (!known) continue;
                    const CostRow* chosen = cheapest_of_part(table, part, question, share);
                    if (!chosen) {
                        possible = false;
                        break;
                    }
                    row.setting = joined(row.setting, chosen->own);
                    row.label += ", " + chosen->label;
                }
                const bool there = std::any_of(found.begin(), found.end(), [&](const CostRow& r) {
                    return r.setting == row.setting;
                });
                if (possible && !there) found.push_back(std::move(row));
            }
    table.rows.insert(table.rows.end(), found.begin(), found.end());
}

int finished(const CostTable& table, const std::string& directory, bool all) {
    const std::vector<std::string> files = write_cost(directory, table);
    print_cost(table);
    fmt::print("in {}:", directory);
    for (const std::string& file : files)
        fmt::print(" {}", file);
    fmt::print("\n");
    if (all) return io::exit_code::done;
    fmt::print("Stopped early: the same command goes on from here.\n");
    return io::exit_code::stopped;
}

} // namespace

void judge(CostTable& table) {
    const CostNumbers& best = table.rows.front().numbers;
    for (CostRow& row : table.rows)
        for (std::size_t q = 0; q < questions.size(); ++q)
            row.error[q] = largest_error(row.numbers, best, questions[q]);
    for (std::size_t q = 0; q < questions.size(); ++q) {
        std::vector<double> seconds, errors;
        for (const CostRow& row : table.rows) {
            seconds.push_back(row.seconds);
            errors.push_back(row.judged ? row.error[q] : nothing);
        }
        const std::vector<bool> front = pareto_front(seconds, errors);
        for (std::size_t i = 0; i < front.size(); ++i)
            table.rows[i].front[q] = front[i];
        for (std::size_t t = 0; t < cost_targets.size(); ++t)
            table.cheapest[q][t] = cheapest_within(seconds, errors, cost_targets[t]);
    }
    table.orders.clear();
    for (CostRow& row : table.rows)
        row.own_error.fill(nothing);
    for (const Knob& knob : table.what.knobs) {
        const CostRow* twin = twin_of(table, knob);
        if (!twin) continue;
        std::vector<double> x;
        std::array<std::vector<double>, cost_quantities> errors;
        for (CostRow& row : table.rows) {
            if (row.knob != knob.name || &row == twin) continue;
            row.own_error = cost_errors(row.numbers, twin->numbers);
            x.push_back(row.x);
            for (std::size_t q = 0; q < cost_quantities; ++q)
                errors[q].push_back(row.own_error[q]);
        }
        CostOrder order{&knob, {}};
        const std::optional<double> x0 =
            knob.twin_is_exact ? std::nullopt : std::optional(knob.twin->x);
        for (std::size_t q = 0; q < cost_quantities; ++q)
            order.measured[q] = order_of(x, errors[q], x0);
        table.orders.push_back(order);
    }
}

int cost_command(const CostOptions& options) {
    if (std::getenv("OMPI_COMM_WORLD_SIZE"))
        throw io::SceneError(io::Problem{"asperity cost", "it is not started under mpirun",
                                         "it starts its runs itself, each with one thread, so that "
                                         "their times can be compared",
                                         "asperity cost SCENE --jobs 2 runs two side by side"});
    const Scene scene = read_scene(options.scene, options.overrides);
    CostTable table;
    table.name = scene.name;
    table.scene = scene_json(scene);
    table.what = cost_case(scene);
    choose_knobs(table.what, options.knobs);
    table.rows.push_back(row_of("reference", {"reference", table.what.reference, 0.0}));
    table.rows.front().judged = false;
    table.rows.push_back(row_of("scene", {"as it is", {}, 0.0}));
    add_knobs(table);

    const std::string directory =
        options.out.empty() ? "results/" + scene.name + "-cost" : options.out;
    fmt::print("reference: {}\n", table.what.reference_text);
    Runs runs(options, directory);
    if (!runs.run(table, 0)) {
        judge(table);
        return finished(table, directory, false);
    }
    const PointOutcome& reference = table.rows.front().outcome;
    if (reference.state == PointState::failed) {
        fmt::print("The reference failed, and there is nothing to compare with: {}\n",
                   reference.reason);
        return reference.exit_code;
    }
    judge(table);
    const std::size_t first = table.rows.size();
    add_combinations(table);
    const bool all = table.rows.size() == first || runs.run(table, first);
    judge(table);
    return finished(table, directory, all);
}

} // namespace asperity
