// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/commands/cost_output.hpp"

#include "io/plot.hpp"
#include "io/result.hpp"
#include "io/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace asperity {

namespace {

constexpr std::array<const char*, 2> question_names = {"state", "path"};

bool answered(const CostTable& table, std::size_t question) {
    for (const CostRow& row : table.rows)
        if (row.judged && !std::isnan(row.error[question])) return true;
    return false;
}

/// A relative error in percent with two digits: "0.83", "-0.0012"; "-": none.
std::string percent(double error) {
    if (std::isnan(error)) return "-";
    if (error == 0.0) return "0";
    const double p = 100.0 * error;
    const int digits = std::clamp(1 - static_cast<int>(std::floor(std::log10(std::abs(p)))), 0, 6);
    return fmt::format("{:.{}f}", p, digits);
}

std::string order_text(const std::optional<double>& order) {
    return order ? fmt::format("{:.1f}", *order) : "-";
}

std::string ratio(const CostTable& table, const CostRow& row) {
    const double r = row.seconds / table.rows[1].seconds;
    return std::isfinite(r) ? fmt::format("{:.2f}", r) : "-";
}

std::string setting_text(const CostRow& row) {
    std::string text;
    for (const std::string& assignment : row.setting)
        text += (text.empty() ? "--set " : " ") + assignment;
    return text.empty() ? "the scene as it is" : text;
}

std::string csv_field(const std::string& text) { return "\"" + text + "\""; }
std::string csv_number(double v) {
    return std::isfinite(v) ? fmt::format(",{:.10g}", v) : std::string(",");
}

void write_plot_of(const std::string& path, const CostTable& table, std::size_t question) {
    io::Plot plot;
    plot.title = fmt::format("{}: what accuracy costs, {}", table.name,
                             question == 0 ? "the state at zero load" : "the whole path");
    plot.x_label = "processor time (s)";
    plot.y_label = question == 0 ? "largest error of γ and contact (%)"
                                 : "largest error of γ, contact, works and force (%)";
    plot.x_log = plot.y_log = true;
    plot.width = 760, plot.height = 520;
    const auto add = [&](const std::string& label, io::PlotSeries::Style style, auto&& belongs) {
        io::PlotSeries series;
        series.label = label;
        series.style = style;
        for (const CostRow& row : table.rows)
            if (row.judged && belongs(row) && row.error[question] > 0.0 && row.seconds > 0.0) {
                series.x.push_back(row.seconds);
                series.y.push_back(100.0 * row.error[question]);
            }
        if (!series.x.empty()) plot.series.push_back(std::move(series));
    };
    // A colour for each group, so that there are no more than can be told apart.
    using Group = std::pair<const char*, std::vector<std::string>>;
    for (const auto& [label, knobs] :
         {Group{"cutoff, tail, precision", {"cutoff", "tail", "precision"}},
          Group{"layers, block model", {"layers", "model"}}, Group{"time step", {"timestep"}},
          Group{"velocity, damping", {"velocity", "damping"}},
          Group{"tolerance and step, quasi-static", {"tolerance", "step"}}})
        add(label, io::PlotSeries::Style::points, [&](const CostRow& row) {
            return std::find(knobs.begin(), knobs.end(), row.knob) != knobs.end();
        });
    add("combinations", io::PlotSeries::Style::rings,
        [](const CostRow& row) { return row.knob == "combination"; });
    io::PlotSeries front;
    front.label = "nothing is better in both";
    front.style = io::PlotSeries::Style::dashed;
    std::vector<const CostRow*> rows;
    for (const CostRow& row : table.rows)
        if (row.front[question] && row.error[question] > 0.0) rows.push_back(&row);
    std::sort(rows.begin(), rows.end(),
              [](const CostRow* a, const CostRow* b) { return a->seconds < b->seconds; });
    for (const CostRow* row : rows) {
        front.x.push_back(row->seconds);
        front.y.push_back(100.0 * row->error[question]);
    }
    plot.series.push_back(std::move(front));
    io::write_plot(path, plot);
}

} // namespace

std::string cost_csv(const CostTable& table) {
    std::string text = "knob,value,setting,processor_seconds,wall_seconds,ratio";
    for (std::size_t q = 0; q < cost_quantities; ++q)
        text += fmt::format(",{}", name(static_cast<CostQuantity>(q)));
    text += ",error_state,error_path";
    for (std::size_t q = 0; q < cost_quantities; ++q)
        text += fmt::format(",own_{}", name(static_cast<CostQuantity>(q)));
    text += ",front_state,front_path\n";
    for (const CostRow& row : table.rows) {
        text += csv_field(row.knob) + "," + csv_field(row.label) + "," +
                csv_field(fmt::format("{}", fmt::join(row.setting, " ")));
        for (const double v : {row.seconds, row.wall, row.seconds / table.rows[1].seconds})
            text += csv_number(v);
        for (const double v : row.numbers)
            text += csv_number(v);
        for (const double v : row.error)
            text += csv_number(v);
        for (const double v : row.own_error)
            text += csv_number(v);
        text += fmt::format(",{:d},{:d}\n", row.front[0], row.front[1]);
    }
    return text;
}

io::JsonValue cost_json(const CostTable& table) {
    io::JsonValue all = io::JsonValue::object();
    all["scene"] = table.scene;
    all["reference"] = table.what.reference_text;
    const auto by_quantity = [](const auto& numbers) {
        io::JsonValue v = io::JsonValue::object();
        for (std::size_t q = 0; q < cost_quantities; ++q)
            v[name(static_cast<CostQuantity>(q))] = io::JsonValue(numbers[q]);
        return v;
    };
    const auto by_question = [](const auto& values) {
        io::JsonValue v = io::JsonValue::object();
        for (std::size_t q = 0; q < questions.size(); ++q)
            v[question_names[q]] = io::JsonValue(values[q]);
        return v;
    };
    all["settings"] = io::JsonValue::array();
    for (const CostRow& row : table.rows) {
        io::JsonValue one = io::JsonValue::object();
        one["knob"] = row.knob;
        one["value"] = row.label;
        one["set"] = io::JsonValue::array();
        for (const std::string& assignment : row.setting)
            one["set"].push_back(assignment);
        one["processor_seconds"] = row.seconds;
        one["wall_seconds"] = row.wall;
        one["measured"] = by_quantity(row.numbers);
        one["error"] = by_question(row.error);
        one["own_error"] = by_quantity(row.own_error);
        one["pareto"] = by_question(row.front);
        if (row.outcome.state == PointState::failed) one["failed"] = row.outcome.reason;
        all["settings"].push_back(std::move(one));
    }
    all["orders"] = io::JsonValue::array();
    for (const CostOrder& order : table.orders) {
        io::JsonValue one = io::JsonValue::object();
        one["knob"] = order.knob->name;
        one["expected"] = order.knob->expected;
        one.put("expected_order", order.knob->order);
        one["measured"] = by_quantity(order.measured);
        all["orders"].push_back(std::move(one));
    }
    all["cheapest"] = io::JsonValue::object();
    for (std::size_t q = 0; q < questions.size(); ++q)
        for (std::size_t t = 0; t < cost_targets.size(); ++t)
            if (const auto row = table.cheapest[q][t]) {
                io::JsonValue one = io::JsonValue::object();
                one["target"] = cost_targets[t];
                one["set"] = setting_text(table.rows[*row]);
                one["error"] = table.rows[*row].error[q];
                one["processor_seconds"] = table.rows[*row].seconds;
                all["cheapest"][question_names[q]].push_back(std::move(one));
            }
    return all;
}

std::vector<std::string> write_cost(const std::string& directory, const CostTable& table) {
    io::make_directory(directory);
    std::vector<std::string> files = {"cost.csv", "cost.json"};
    io::write_whole(directory + "/cost.csv", cost_csv(table));
    for (std::size_t q = 0; q < questions.size(); ++q) {
        if (!answered(table, q)) continue;
        files.push_back(fmt::format("cost-{}.svg", question_names[q]));
        write_plot_of(directory + "/" + files.back(), table, q);
    }
    io::write_whole(directory + "/cost.json", cost_json(table).dump() + "\n");
    return files;
}

void print_cost(const CostTable& table) {
    const bool path = answered(table, 1);
    fmt::print(
        "\nErrors in %, against the reference: γ and works over flat on flat. * marks what "
        "nothing beats in both time\nand error: first star the state at zero load (γ, "
        "contact), second the whole path. The last of a knob is the one its own error is taken "
        "against.\n\n");
    std::vector<std::string> heads = {"knob", "value", "γ",         "contact",  "in",
                                      "out",  "force", "processor", "to scene", ""};
    io::Table out(heads);
    out.align_left(1);
    std::string last;
    for (const CostRow& row : table.rows) {
        if (row.knob != last && !last.empty()) out.rule();
        std::vector<std::string> cells = {row.knob == last ? "" : row.knob, row.label};
        last = row.knob;
        if (row.outcome.state == PointState::failed) {
            cells.insert(cells.end(), {"failed"});
            out.row(cells);
            continue;
        }
        for (const double e : cost_errors(row.numbers, table.rows.front().numbers))
            cells.push_back(percent(e));
        cells.push_back(std::isnan(row.seconds) ? "-" : fmt::format("{:.2f} s", row.seconds));
        cells.push_back(ratio(table, row));
        cells.push_back(fmt::format("{}{}", row.front[0] ? "*" : " ", row.front[1] ? "*" : " "));
        out.row(cells);
    }
    out.print(stdout);

    if (!table.orders.empty()) {
        fmt::print("\nOrder of each knob's own error (all else as in the scene): the power of the "
                   "knob that fits it.\n\n");
        io::Table orders({"knob", "γ", "contact", "in", "out", "force", "expected"});
        orders.align_left(6);
        for (const CostOrder& order : table.orders) {
            std::vector<std::string> cells = {order.knob->name};
            for (const auto& measured : order.measured)
                cells.push_back(order_text(measured));
            cells.push_back(order.knob->expected);
            orders.row(cells);
        }
        orders.print(stdout);
    }

    for (std::size_t q = 0; q < questions.size(); ++q) {
        if (!answered(table, q)) continue;
        fmt::print("\nCheapest for {}:\n", q == 0 ? "the state at zero load (γ, contact)"
                                                  : "the whole path (works, pull-off force too)");
        for (std::size_t t = 0; t < cost_targets.size(); ++t) {
            const auto found = table.cheapest[q][t];
            fmt::print("  {:>4} %  ", 100.0 * cost_targets[t]);
            if (!found) {
                fmt::print("none of those that were run\n");
                continue;
            }
            const CostRow& row = table.rows[*found];
            fmt::print("{:.2f} s, error {} %: {}\n", row.seconds, percent(row.error[q]),
                       setting_text(row));
        }
    }
    if (!path) fmt::print("\nThe path was not followed: works and force are not measured.\n");
    for (const std::string& note : table.what.notes)
        fmt::print("note: {}\n", note);
    for (const CostRow& row : table.rows)
        if (row.outcome.state == PointState::failed)
            fmt::print("failed: {} {}: {}\n", row.knob, row.label, row.outcome.reason);
}

} // namespace asperity
