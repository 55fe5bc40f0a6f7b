// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/commands/sweep_output.hpp"

#include "io/build_info.hpp"
#include "io/hdf5_file.hpp"
#include "io/result.hpp"
#include "io/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

namespace asperity {

namespace {

std::string csv_field(const std::string& text) {
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text)
        quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

std::string csv_number(double v) {
    return std::isfinite(v) ? fmt::format("{:.10g},", v) : std::string(",");
}

bool has_seeds(const SweepTable& table) {
    return std::any_of(table.axes.begin(), table.axes.end(),
                       [](const SweepAxis& axis) { return axis.is_seed(); });
}

/// "0.663 ± 0.004", or the number alone, or nothing.
std::string cell_of(const Spread& spread, int digits) {
    if (spread.count == 0) return "-";
    std::string text = fmt::format("{:.{}f}", spread.mean, digits);
    if (spread.deviation > 0.5 * std::pow(10.0, -digits))
        text += fmt::format(" ± {:.{}f}", spread.deviation, digits);
    return text;
}

/// A head, and what stands under it for a group.
struct Cells {
    std::string head;
    std::function<double(const SweepPoint&)> value;
    int digits;
};

std::vector<Cells> cells_of(const SweepTable& table) {
    const auto of = [](const SweepPoint& p, double gamma) { return gamma / p.what.delta_gamma; };
    const Cells gamma{"γ_eff/Δγ", [](const SweepPoint& p) { return p.numbers.state.gamma_ratio; },
                      5};
    const Cells area{"A/A0", [](const SweepPoint& p) { return p.numbers.state.area; }, 5};
    if (!table.simulated)
        return {{"γ_eff, meV/Å²", [](const SweepPoint& p) { return p.numbers.gamma_eff; }, 3},
                gamma,
                area,
                {"full contact",
                 [=](const SweepPoint& p) { return of(p, p.numbers.gamma_full_contact); }, 5},
                {"renormalised",
                 [](const SweepPoint& p) {
                     return p.numbers.renormalised && p.numbers.renormalised->numbers
                                ? p.numbers.renormalised->numbers->gamma_eff_ratio
                                : std::nan("");
                 },
                 5}};
    const auto share = [](const char* path) {
        return [path](const SweepPoint& p) {
            return result_number(p, path) / result_number(p, "delta_gamma");
        };
    };
    const auto plain = [](const char* path) {
        return [path](const SweepPoint& p) { return result_number(p, path); };
    };
    const auto flat = [](const auto& value) { // the nominal area of a sphere means nothing
        return [value](const SweepPoint& p) {
            return std::isfinite(result_number(p, "contact_radius.zero_load")) ? std::nan("")
                                                                               : value(p);
        };
    };
    std::vector<Cells> list = {{"state", flat(share("binding_energy")), 4},
                               {"approach", flat(share("work_of_adhesion.approach")), 4},
                               {"pull-off", flat(share("work_of_adhesion.pull_off")), 4},
                               {"JKR in", share("jkr.in"), 4},
                               {"JKR out", share("jkr.out"), 4},
                               {"contact", flat(plain("contact_fraction")), 4},
                               {"radius, Å", plain("contact_radius.zero_load"), 1},
                               {"loop, eV", plain("hysteresis.loop"), 1}};
    std::erase_if(list, [&](const Cells& cells) {
        return std::none_of(table.points.begin(), table.points.end(),
                            [&](const SweepPoint& p) { return std::isfinite(cells.value(p)); });
    });
    list.push_back({"theory", gamma.value, 4});
    list.push_back({"its contact", area.value, 4});
    return list;
}

/// "3 done", "2 done, 1 failed"; of theory alone "2 adhesive, 1 no contact".
std::string status_of(const SweepGroup& group, bool simulated) {
    if (group.points.size() == 1) return status_of(*group.points.front(), simulated);
    std::vector<std::pair<std::string, int>> counts; // in the order of the points
    for (const SweepPoint* p : group.points) {
        const std::string status = status_of(*p, simulated);
        auto at = std::find_if(counts.begin(), counts.end(),
                               [&](const auto& c) { return c.first == status; });
        if (at == counts.end()) at = counts.insert(at, {status, 0});
        ++at->second;
    }
    std::string text;
    for (const auto& [status, n] : counts)
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", n, status);
    return text;
}

void write_hdf5(const std::string& path, const SweepTable& table) {
    const std::string temporary = path + ".tmp";
    io::Hdf5File file(temporary, io::Hdf5File::Mode::create);
    const auto write = [&](const std::string& name, const std::string& unit,
                           const std::vector<double>& values) {
        file.write<double>(name, {values.size()}, values);
        file.write_attribute(name, "unit", unit);
    };
    Scene defaults;
    const io::Schema schema = bind(defaults);
    const std::vector<SweepGroup> groups = sweep_groups(table.axes, table.points);
    for (const char* group : {"/points", "/means"})
        file.make_group(group);
    std::size_t place = 0; // among the axes that are no seeds
    for (std::size_t i = 0; i < table.axes.size(); ++i) {
        const std::string& key = table.axes[i].key;
        const auto number = [](const io::JsonValue& v) {
            return v.is_number() ? v.number() : std::nan("");
        };
        const bool numbers =
            std::all_of(table.points.begin(), table.points.end(),
                        [i](const SweepPoint& p) { return p.values[i].is_number(); });
        std::vector<double> all, of_groups;
        std::vector<std::string> words;
        for (const SweepPoint& p : table.points) {
            all.push_back(number(p.values[i]));
            words.push_back(shown(p.values[i]));
        }
        if (numbers) write("/points/" + key, schema.find(key)->unit, all);
        // Words have no place in a data set of numbers: one a point, in their order.
        if (!numbers) file.write_text_list_attribute("/points", key, words);
        if (table.axes[i].is_seed()) continue;
        words.clear();
        for (const SweepGroup& g : groups) {
            of_groups.push_back(number(g.values[place]));
            words.push_back(shown(g.values[place]));
        }
        if (numbers) write("/means/" + key, schema.find(key)->unit, of_groups);
        if (!numbers) file.write_text_list_attribute("/means", key, words);
        ++place;
    }
    for (const SweepColumn& column : sweep_columns(table)) {
        std::vector<double> all, mean, deviation, count;
        for (const SweepPoint& p : table.points)
            all.push_back(column.value(p));
        for (const SweepGroup& g : groups) {
            const Spread spread = spread_of(g, column.value);
            mean.push_back(spread.mean);
            deviation.push_back(spread.deviation);
            count.push_back(spread.count);
        }
        write("/points/" + column.name, column.unit, all);
        write("/means/" + column.name, column.unit, mean);
        write("/means/" + column.name + ".deviation", column.unit, deviation);
        write("/means/" + column.name + ".count", "", count);
    }
    file.close();
    std::filesystem::rename(temporary, path);
}

} // namespace

std::string sweep_csv(const SweepTable& table) {
    const std::vector<SweepColumn> columns = sweep_columns(table);
    std::string text;
    for (const SweepAxis& axis : table.axes)
        text += csv_field(axis.key) + ",";
    for (const SweepColumn& column : columns)
        text += column.name + ",";
    text += "status\n";
    for (const SweepPoint& p : table.points) {
        for (const io::JsonValue& value : p.values)
            text += csv_field(shown(value)) + ",";
        for (const SweepColumn& column : columns)
            text += csv_number(column.value(p));
        text += status_of(p, table.simulated) + "\n";
    }
    return text;
}

std::string sweep_mean_csv(const SweepTable& table) {
    const std::vector<SweepColumn> columns = sweep_columns(table);
    std::string text;
    for (const SweepAxis& axis : table.axes)
        if (!axis.is_seed()) text += csv_field(axis.key) + ",";
    for (const SweepColumn& column : columns)
        text += fmt::format("{0},{0}.deviation,", column.name);
    text += "points\n";
    for (const SweepGroup& g : sweep_groups(table.axes, table.points)) {
        for (const io::JsonValue& value : g.values)
            text += csv_field(shown(value)) + ",";
        for (const SweepColumn& column : columns) {
            const Spread spread = spread_of(g, column.value);
            text += csv_number(spread.mean) + csv_number(spread.deviation);
        }
        const auto done = std::count_if(g.points.begin(), g.points.end(), [](const SweepPoint* p) {
            return p->outcome.state == PointState::finished;
        });
        text += fmt::format("{}\n", done);
    }
    return text;
}

io::JsonValue sweep_json(const SweepTable& table) {
    io::JsonValue root = io::JsonValue::object();
    root["name"] = table.name;
    root["scene"] = table.scene;
    io::JsonValue axes = io::JsonValue::array();
    for (const SweepAxis& axis : table.axes)
        axes.push_back(axis.key);
    root["axes"] = std::move(axes);
    const std::vector<SweepColumn> columns = sweep_columns(table);
    const auto theory_of = [&](const SweepPoint& p) {
        io::JsonValue point = io::JsonValue::object();
        point["set"] = io::JsonValue::object();
        for (std::size_t i = 0; i < table.axes.size(); ++i)
            point["set"][table.axes[i].key] = p.values[i];
        io::ResultRecord record;
        record.delta_gamma = p.what.flat;
        record_theory(p.what, p.numbers, record);
        const io::JsonValue result = io::result_json(record);
        point["delta_gamma"] = *result.find("delta_gamma");
        point["theory"] = *result.find("theory");
        return point;
    };
    io::JsonValue points = io::JsonValue::array();
    for (const SweepPoint& p : table.points) {
        io::JsonValue point = theory_of(p);
        if (table.simulated) {
            point["directory"] = p.name;
            point["status"] = status_of(p, true);
            if (p.outcome.exit_code != 0) {
                point["failure"]["exit_code"] = p.outcome.exit_code;
                point["failure"]["reason"] = p.outcome.reason;
            }
            io::JsonValue& numbers = point["result"] = io::JsonValue::object();
            for (const SweepColumn& column : columns)
                if (const double v = column.value(p);
                    std::isfinite(v) && !column.name.starts_with("theory."))
                    numbers[column.name] = v;
        }
        points.push_back(std::move(point));
    }
    root["points"] = std::move(points);
    for (const SweepPoint& p : table.theory)
        root["theory"].push_back(theory_of(p));
    if (table.simulated) {
        io::JsonValue means = io::JsonValue::array();
        for (const SweepGroup& g : sweep_groups(table.axes, table.points)) {
            io::JsonValue line = io::JsonValue::object();
            std::size_t place = 0;
            line["set"] = io::JsonValue::object();
            for (const SweepAxis& axis : table.axes)
                if (!axis.is_seed()) line["set"][axis.key] = g.values[place++];
            for (const SweepColumn& column : columns) {
                const Spread spread = spread_of(g, column.value);
                if (spread.count == 0) continue;
                line[column.name]["mean"] = spread.mean;
                if (spread.count > 1) line[column.name]["deviation"] = spread.deviation;
                line[column.name]["count"] = spread.count;
            }
            means.push_back(std::move(line));
        }
        root["means"] = std::move(means);
    }
    if (!table.notes.empty()) {
        io::JsonValue notes = io::JsonValue::array();
        for (const std::string& note : table.notes)
            notes.push_back(note);
        root["notes"] = std::move(notes);
    }
    const io::BuildInfo build = io::build_info();
    root["run"]["wall_seconds"] = table.seconds;
    root["run"]["version"] = build.version;
    root["run"]["git"] = build.git;
    root["run"]["compiler"] = build.compiler;
    root["run"]["flags"] = build.flags;
    return root;
}

std::vector<std::string> write_tables(const std::string& directory, const SweepTable& table) {
    io::make_directory(directory);
    const auto path = [&](const char* file) {
        return (std::filesystem::path(directory) / file).string();
    };
    std::vector<std::string> written = {path("sweep.csv")};
    io::write_whole(written.back(), sweep_csv(table));
    if (table.simulated && has_seeds(table)) {
        written.push_back(path("sweep-mean.csv"));
        io::write_whole(written.back(), sweep_mean_csv(table));
    }
    written.push_back(path("sweep.h5"));
    write_hdf5(written.back(), table);
    written.push_back(path("sweep.json"));
    io::write_whole(written.back(), sweep_json(table).dump() + "\n");
    return written;
}

SweepText sweep_text(const SweepTable& table) {
    SweepText text;
    for (const SweepAxis& axis : table.axes)
        if (!axis.is_seed()) text.heads.push_back(axis.key);
    const std::vector<Cells> list = cells_of(table);
    for (const Cells& cells : list)
        text.heads.push_back(cells.head);
    text.heads.emplace_back("");
    for (const SweepGroup& group : sweep_groups(table.axes, table.points)) {
        std::vector<std::string> row;
        for (const io::JsonValue& value : group.values)
            row.push_back(shown(value));
        for (const Cells& cells : list)
            row.push_back(cell_of(spread_of(group, cells.value), cells.digits));
        row.push_back(status_of(group, table.simulated));
        text.rows.push_back(std::move(row));
    }
    text.meaning = table.simulated
                       ? std::string("binding energies and works of adhesion over Δγ") +
                             (has_seeds(table) ? ", mean ± standard deviation over the seeds" : "")
                       : "";
    return text;
}

void print_table(const SweepTable& table) {
    const SweepText all = sweep_text(table);
    io::Table text(all.heads);
    text.align_left(static_cast<int>(all.heads.size()) - 1);
    // A hundred lines tell no more than twenty; the files have them all.
    const std::size_t n = all.rows.size(), stride = std::max<std::size_t>(1, (n + 19) / 25);
    for (std::size_t i = 0; i < n; ++i)
        if (i % stride == 0 || i + 1 == n) text.row(all.rows[i]);
    if (!all.meaning.empty()) fmt::print("{}: {}\n", table.name, all.meaning);
    text.print(stdout);
    if (stride > 1) fmt::print("  (every {}th of {} lines; all are in the files)\n", stride, n);
}

} // namespace asperity
