// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/error.hpp"
#include "io/files.hpp"
#include "io/json.hpp"
#include "io/result.hpp"
#include "io/units.hpp"

#include "support/scratch.hpp"

#include <algorithm>
#include <limits>
#include <set>
#include <span>

#include <fmt/format.h>

namespace asperity::io {
namespace {

/// A value or a unit by its path, or null.
Json at(const Json& json, std::string path) {
    std::replace(path.begin(), path.end(), '.', '/');
    const Json::json_pointer pointer("/" + path);
    return json.contains(pointer) ? json.at(pointer) : Json();
}

TEST(Result, PutsValuesAndUnitsAtTheSamePlace) {
    Result result;
    result.set("pair_binding_energy", 8.0);
    result.set("work_of_interface.approach", std::optional<double>());
    result.set("run.phases.*.seconds", "advance", 0.5);
    result.set("run.phases.*.calls", "advance", 1000LL);
    result.set("dissipated.jumps[].energy", 0, 1.5);
    result.set("dissipated.jumps[].force", 0, std::vector{1.0, 2.0});
    result.set("dissipated.jumps[].energy", 1, 2.5);
    result.set("theory.persson.converged", true);
    result.set("run.stopped", "max_steps");
    Json scene, units;
    scene["surface"]["sites"] = 128;
    units["surface"]["sites"] = "1";
    result.set_scene(scene, units);
    const Json json = Json::parse(result.text());
    EXPECT_EQ(at(json, "pair_binding_energy"), 8.0);
    EXPECT_EQ(at(json, "units.pair_binding_energy"), "meV/Å^2");
    EXPECT_TRUE(at(json, "work_of_interface.approach").is_null());
    EXPECT_TRUE(at(json, "units.work_of_interface.approach").is_null());
    EXPECT_EQ(at(json, "run.phases.advance.seconds"), 0.5);
    EXPECT_EQ(at(json, "run.phases.advance.calls"), 1000);
    EXPECT_EQ(at(json, "units.run.phases.advance.seconds"), "s");
    EXPECT_EQ(at(json, "dissipated.jumps.1.energy"), 2.5);
    EXPECT_EQ(at(json, "dissipated.jumps.0.force.1"), 2.0);
    EXPECT_EQ(at(json, "units.dissipated.jumps.energy"), "eV");
    EXPECT_EQ(at(json, "units.dissipated.jumps.force"), "eV/Å");
    EXPECT_EQ(at(json, "theory.persson.converged"), true);
    EXPECT_EQ(at(json, "run.stopped"), "max_steps");
    EXPECT_EQ(at(json, "scene.surface.sites"), 128);
    EXPECT_EQ(at(json, "units.scene.surface.sites"), "1");
    EXPECT_EQ(result.number("pair_binding_energy"), 8.0);
    EXPECT_EQ(result.number("run.stopped"), std::nullopt);
    EXPECT_EQ(result.number("binding_energy"), std::nullopt);
    for (const char* absent : {"binding_energy", "theory.persson.gamma_eff", "failure", "relaxed"})
        EXPECT_TRUE(at(json, absent).is_null()) << absent;
}

TEST(Quantities, HaveUnitsThatCanBeReadAndNoNameTwice) {
    std::set<std::string_view> names;
    const auto check = [&](const Quantity& q) {
        EXPECT_TRUE(names.insert(q.name).second) << q.name;
        EXPECT_FALSE(q.meaning.empty()) << q.name;
        EXPECT_TRUE(q.unit.empty() || q.unit == "1" || parse_unit(q.unit)) << q.unit;
    };
    for (const Quantity& q : result_quantities())
        check(q);
    names.clear();
    for (const Quantity& q : run_quantities())
        check(q);
}

TEST(Quantities, OfRunFilesAreFoundByTheirPaths) {
    EXPECT_EQ(run_quantity("/fields/relaxed/gap")->unit, "Å");
    EXPECT_EQ(run_quantity("/fields/every:5/gap_density")->unit, "1/Å");
    EXPECT_EQ(run_quantity("/fields/pull-off@reference_height")->unit, "Å");
    for (const SiteQuantity& of : site_quantities) {
        EXPECT_EQ(run_quantity("/fields/relaxed/" + std::string(of.name))->unit, of.unit);
        const std::string key = "interface." + std::string(of.name);
        EXPECT_EQ(result_quantity(key + "_largest").unit, of.unit);
        EXPECT_EQ(result_quantity(key + "_digest").unit, "");
    }
    for (const char* none : {"/series/forces", "/fields/gap", "/fields//gap", "/fields/a/b/gap",
                             "/fields/a@b@reference_height"})
        EXPECT_EQ(run_quantity(none), nullptr) << none;
}

TEST(Result, NumbersKeepTheirBits) {
    Json json;
    json["x"] = 0.1 + 0.2;
    json["big"] = 1234567890123456789LL;
    json["nan"] = std::numeric_limits<double>::quiet_NaN();
    const Json back = parse_json(json_text(json), "x");
    EXPECT_EQ(back["x"], 0.1 + 0.2);
    EXPECT_EQ(back["big"], 1234567890123456789LL);
    EXPECT_TRUE(find(back, "nan")->is_null());
    EXPECT_EQ(find(back, "nan.deeper"), nullptr);
    EXPECT_THROW(parse_json("{\"x\": ", "f.json"), FileError);
    EXPECT_NO_THROW(json_text("\xff"));
    EXPECT_EQ(parse_json("18446744073709551615", "x"), 18446744073709551615.0);
    const std::string deep(50000, '[');
    EXPECT_THROW(parse_json(deep + std::string(50000, ']'), "f.json"), FileError);
    std::string objects;
    for (int i = 0; i < 50000; ++i)
        objects += "{\"a\":";
    EXPECT_THROW(parse_json(objects + "1" + std::string(50000, '}'), "f.json"), FileError);
}

TEST(Result, IsWrittenWhole) {
    const Scratch scratch;
    const Directory directory = Directory::make(scratch / "a/b");
    write_result(directory, Result());
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(directory.path()), {}), 1);
    const std::string text = contents(directory / "result.json");
    EXPECT_NO_THROW(parse_json(text, ""));
    // Its last member is the digest of what is before it.
    const std::size_t end = text.find(",\n  \"digest\": \"crc32:");
    ASSERT_NE(end, std::string::npos);
    const std::uint32_t digest = digest_of(std::as_bytes(std::span(text.data(), end)));
    EXPECT_EQ(text.substr(end), fmt::format(",\n  \"digest\": \"crc32:{:08x}\"\n}}\n", digest));
}

TEST(Result, AListWithoutElementsIsThereWithItsUnits) {
    Result result;
    result.set_list("dissipated.jumps[]");
    const Json empty = Json::parse(result.text());
    EXPECT_EQ(at(empty, "dissipated.jumps"), Json::array());
    result.set("dissipated.jumps[].energy", 0, 1.5);
    const Json one = Json::parse(result.text());
    EXPECT_EQ(at(one, "dissipated.jumps.0.energy"), 1.5);
    EXPECT_EQ(at(one, "units.dissipated.jumps.energy"), "eV");
    EXPECT_EQ(at(one, "units"), at(empty, "units"));
}

} // namespace
} // namespace asperity::io
