// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The reader on a scene of its own: a teapot. Every kind of mistake with its exact position.
#include "io/error.hpp"
#include "io/json.hpp"
#include "io/scene_reader.hpp"

#include "support/scratch.hpp"

#include <gtest/gtest.h>

namespace asperity::io {
namespace {

enum class Glaze { none, celadon, raku };

struct Teapot {
    double height = 150.0; // mm
    int cups = 4;
    long long serial = 7;
    bool lid = true;
    std::string maker = "unknown";
    Glaze glaze = Glaze::celadon;
    std::optional<double> crack;
    std::optional<long long> chips;
    std::vector<std::string> coats = {"raku"};
    std::vector<std::string> marks = {"seal"};
    double heat = 0.5;
};

Schema bind(Teapot& t) {
    Schema schema;
    schema.section("body", "The pot itself.");
    schema.number("height", t.height, "m", between(0.0, 200.0), "how tall");
    schema.integer("cups", t.cups, between(1, 12), "how many it fills");
    schema.integer("serial", t.serial, any(), "its number");
    schema.key("lid", t.lid, "whether it has one");
    schema.key("maker", t.maker, "who made it");
    schema.section("surface", "What is seen.");
    schema.choice<Glaze>(
        "glaze", t.glaze,
        {{"none", Glaze::none}, {"celadon", Glaze::celadon}, {"raku", Glaze::raku}}, "its glaze");
    schema.number_or("crack", t.crack, "none", "m", positive(), "length of the crack");
    schema.number_or("chips", t.chips, "some", "", at_least(0), "how many");
    schema.list("coats", t.coats, {"raku", "celadon"}, "in order");
    schema.list("marks", t.marks, {"seal", "every:"}, "on the foot");
    schema.number("heat", t.heat, "", Range{0.0, 1.0, true, true}, "of the kiln");
    return schema;
}

struct Read {
    Teapot pot;
    Positions positions;
    std::vector<Problem> problems;
};

Read read(const std::string& text, const std::vector<std::string>& overrides = {}) {
    Read result;
    Problems problems;
    bind(result.pot).read(text, "pot.toml", overrides, result.positions, problems);
    result.problems = problems.list();
    return result;
}

Problem only(const std::string& text, const std::vector<std::string>& overrides = {}) {
    const Read result = read(text, overrides);
    EXPECT_EQ(result.problems.size(), 1u) << text;
    return result.problems.empty() ? Problem{} : result.problems.front();
}

TEST(SceneReader, ReadsEveryType) {
    const Read r = read(R"([body]
height = "20 cm"
cups = 6
serial = 12345678901
lid = false
maker = "Hamada"
[surface]
glaze = "raku"
crack = "1 mm"
chips = 3
coats = ["celadon", "raku"]
marks = ["seal", "every:20"]
heat = "60 %"
)");
    ASSERT_TRUE(r.problems.empty()) << format(r.problems.front());
    EXPECT_EQ(r.pot.height, 0.2);
    EXPECT_EQ(r.pot.cups, 6);
    EXPECT_EQ(r.pot.serial, 12345678901);
    EXPECT_FALSE(r.pot.lid);
    EXPECT_EQ(r.pot.maker, "Hamada");
    EXPECT_EQ(r.pot.glaze, Glaze::raku);
    EXPECT_EQ(r.pot.crack, 0.001);
    EXPECT_EQ(r.pot.chips, 3);
    EXPECT_EQ(r.pot.coats, (std::vector<std::string>{"celadon", "raku"}));
    EXPECT_EQ(r.pot.marks, (std::vector<std::string>{"seal", "every:20"}));
    EXPECT_EQ(r.pot.heat, 0.6);
    EXPECT_TRUE(r.positions.is_set("body.cups"));
    EXPECT_EQ(r.positions.where("body.cups"), "pot.toml:3:8");
    EXPECT_EQ(r.positions.where("body.never"), "pot.toml");
}

TEST(SceneReader, NothingSetMeansDefaults) {
    const Read r = read("");
    EXPECT_TRUE(r.problems.empty());
    EXPECT_EQ(r.pot.cups, 4);
    EXPECT_FALSE(r.pot.crack.has_value());
    EXPECT_FALSE(r.positions.is_set("body.cups"));
}

TEST(SceneReader, WholeNumbersAreNumbersToo) {
    EXPECT_EQ(read("[body]\nheight = 3\n").pot.height, 3.0);
    EXPECT_EQ(read("body.height = 3\n").pot.height, 3.0); // dotted keys are TOML too
    EXPECT_FALSE(read("[surface]\ncrack = \"none\"\n").pot.crack.has_value());
}

TEST(SceneReader, WhatIsGoneSaysWhatToDo) {
    const auto said = [](const std::string& text, const std::vector<std::string>& overrides = {}) {
        Teapot pot;
        std::vector<Variation> sweep;
        Schema schema = bind(pot);
        schema.variations({"kiln", "", "", &sweep});
        schema.removed({"body.spout", "", "no pot has one", "pour over the rim"});
        schema.removed({"surface.glaze", "lead", "it is poisonous", "take celadon"});
        Positions positions;
        Problems problems;
        schema.read(text, "pot.toml", overrides, positions, problems);
        EXPECT_EQ(problems.list().size(), 1u) << text;
        return problems.empty() ? Problem{} : problems.list().front();
    };
    Problem p = said("[body]\ncups = 3\nspout = 2\n");
    EXPECT_EQ(p.where, "pot.toml:3:1");
    EXPECT_EQ(p.what, "body.spout is not a key any more");
    EXPECT_EQ(p.why, "no pot has one");
    EXPECT_EQ(p.fix, "pour over the rim");
    EXPECT_EQ(said("", {"body.spout=none"}).where, "--set body.spout=none");
    EXPECT_EQ(said("[kiln]\nbody.spout = [1, 2]\n").fix, "pour over the rim");
    EXPECT_EQ(said("body.spouts = 2\n").what, "body.spouts is no key of a scene");
    p = said("[surface]\nglaze = \"lead\"\n");
    EXPECT_EQ(p.where, "pot.toml:2:9");
    EXPECT_EQ(p.what, "surface.glaze = \"lead\" is not a choice any more");
    EXPECT_EQ(p.fix, "take celadon");
    EXPECT_EQ(said("surface.glaze = \"gold\"\n").what,
              "surface.glaze = \"gold\" is none of its choices");
}

/// A scene with one mistake, and what is said of it; an empty member is not looked at.
struct Mistake {
    const char* text;
    Problem said;
};

TEST(SceneReader, MistakesAreExplained) {
    const Mistake mistakes[] = {
        // Names.
        {"[body]\ncups = 3\n  hieght = 3\n",
         {"pot.toml:3:3", "body.hieght is no key of a scene", "", "did you mean body.height?"}},
        {"[surface]\ncups = 3\n", {"pot.toml:2:1", "", "", "did you mean body.cups?"}},
        {"cups = 3\n",
         {"pot.toml:1:1", "", "every key stands in a [section]", "did you mean body.cups?"}},
        {"[body]\ncups = 3\n[surfase]\nheat = 0.1\n",
         {"pot.toml:3:2", "[surfase] is no section of a scene", "", "did you mean [surface]?"}},
        {"[[body]]\ncups = 3\n", {"", "[[body]] is a list of sections", "", ""}},
        // Types.
        {"[body]\ncups = \"many\"\n",
         {"pot.toml:2:8", "body.cups = \"many\" is of the wrong type",
          "a whole number is needed, this is a string", ""}},
        {"[body]\ncups = 3.0\n", {"", "", "a whole number is needed, this is a number", ""}},
        {"[body]\nlid = 1\n", {"", "", "true or false is needed, this is a whole number", ""}},
        {"[body]\nmaker = true\n", {"", "", "a string is needed, this is true or false", ""}},
        {"[body]\nheight = true\n",
         {"", "", "a number or a quantity in m is needed, this is true or false", ""}},
        {"[surface]\ncoats = \"raku\"\n",
         {"", "", "a list of strings is needed, this is a string", ""}},
        {"[surface]\ncoats = [1, 2]\n",
         {"", "", "a list of strings is needed, this is a value of another form", ""}},
        {"[surface]\nglaze = 3\n",
         {"", "", "one of \"none\", \"celadon\", \"raku\" is needed, this is a whole number", ""}},
        {"[body]\ncups = 2026-01-01\n",
         {"", "", "a whole number is needed, this is a value of another form", ""}},
        {"[body]\nmaker = \"\"\n", {"", "body.maker = \"\" is empty", "", ""}},
        // Ranges and units.
        {"[body]\ncups = 13\n",
         {"pot.toml:2:8", "body.cups = 13 is out of range", "allowed: 1 to 12", ""}},
        {"[body]\nheight = \"-1 m\"\n", {"", "", "allowed: 0 to 200 m", ""}},
        {"[surface]\ncrack = 0.0\n",
         {"", "", "allowed: above 0 m", "give a value in that range; \"none\" is allowed too"}},
        {"[surface]\nheat = 1\n", {"", "", "allowed: above 0 to below 1", ""}},
        {"[surface]\nheat = nan\n", {"", "surface.heat = nan is not finite", "", ""}},
        {"[surface]\nchips = -1\n", {"", "", "allowed: 0 or more", ""}},
        {"[body]\ncups = 99999999999\n", {"", "", "allowed: 1 to 12", ""}},
        {"[body]\nheight = \"3 stone\"\n",
         {"", "body.height = \"3 stone\" cannot be read as a quantity",
          "'stone' is no unit known here", ""}},
        {"[body]\nheight = \"3 K\"\n", {"", "", "a length is needed, and K is a temperature", ""}},
        {"[surface]\ncrack = \"nine\"\n",
         {"", "", "",
          "give a number in m, or one with a unit, for example \"1 m\"; \"none\" is allowed too"}},
        // Choices.
        {"[surface]\nglaze = \"seladon\"\n",
         {"pot.toml:2:9", "", "choices: \"none\", \"celadon\", \"raku\"",
          "did you mean \"celadon\"?"}},
        {"[surface]\nmarks = [\"seal\", \"evry:3\"]\n",
         {"", "", "choices: \"seal\", \"every:N\"", ""}},
        {"[surface]\nmarks = [\"every:\"]\n", {}},
        {"[surface]\nmarks = [\"every:0\"]\n", {}},
        {"[surface]\nmarks = [\"every:-1\"]\n", {}},
        {"[surface]\nmarks = [\"every:x\"]\n", {}},
        {"[surface]\nmarks = [\"every:1.5\"]\n", {}},
        // Syntax.
        {"[body]\nheight = 20 cm\n",
         {"pot.toml:2:", "this is no TOML", "",
          "words, and numbers with a unit, stand in quotes: height = \"20 cm\""}},
        {"[body]\ncups = 3\ncups = 4\n",
         {"pot.toml:3:", "", "", "a section stands in one place, and a key once in it"}},
        {"body = { cups = 3 }\nbody.height = 2\n",
         {"", "", "", "a section stands in one place, and a key once in it"}},
        {"[body]\ncups = 3\n[body]\nheight = 2\n",
         {"", "", "", "a section stands in one place, and a key once in it"}},
        {"[body]\ncups\n", {"", "", "", "a line is [section], or key = value, or a # comment"}},
        {"[body\n", {}},
        {"[body]\nmaker = \"x\n", {}},
        {"[body]\ncups =\n", {}},
        {"\xff\xfe", {}},
    };
    for (const Mistake& m : mistakes) {
        const Problem p = only(m.text);
        EXPECT_TRUE(p.where.starts_with(m.said.where)) << m.text << p.where;
        for (const auto member : {&Problem::what, &Problem::why, &Problem::fix})
            if (!(m.said.*member).empty()) {
                EXPECT_EQ(p.*member, m.said.*member) << m.text;
            }
    }
}

TEST(SceneReader, AllAtOnceInTheOrderOfTheText) {
    const Read r = read("[surface]\nheat = 7\nglaze = \"rakku\"\n[body]\ncups = 0\nhandle = 1\n"
                        "[extras]\nx = 1\n",
                        {"body.lid=perhaps", "body.height"});
    ASSERT_EQ(r.problems.size(), 7u);
    const char* where[] = {"pot.toml:2:8",     "pot.toml:3:9", "pot.toml:5:8",
                           "pot.toml:6:1",     "pot.toml:7:2", "--set body.lid=perhaps",
                           "--set body.height"};
    for (std::size_t i = 0; i < 7; ++i)
        EXPECT_EQ(r.problems[i].where, where[i]);
}

TEST(SceneReader, Overrides) {
    const Read r =
        read("[body]\ncups = 3\n",
             {"body.cups=5", "body.height=12 cm", "body.maker=Leach", "surface.coats=celadon,raku",
              "body.lid=false", "surface.crack=none", "surface.marks=[\"every:3\"]",
              "surface.glaze=\"none\"", "surface.heat = 0.25"});
    ASSERT_TRUE(r.problems.empty()) << format(r.problems.front());
    EXPECT_EQ(r.pot.cups, 5);
    EXPECT_EQ(r.pot.height, 0.12);
    EXPECT_EQ(r.pot.maker, "Leach");
    EXPECT_EQ(r.pot.coats, (std::vector<std::string>{"celadon", "raku"}));
    EXPECT_EQ(r.pot.glaze, Glaze::none);
    EXPECT_EQ(r.pot.marks, (std::vector<std::string>{"every:3"}));
    EXPECT_EQ(r.pot.heat, 0.25);
    EXPECT_EQ(r.positions.where("body.cups"), "--set body.cups=5");

    Problem p = only("", {"cups=3"});
    EXPECT_EQ(p.where, "--set cups=3");
    EXPECT_EQ(p.fix, "did you mean body.cups?");
    p = only("", {"body.cups=0"});
    EXPECT_EQ(p.where, "--set body.cups=0");
    EXPECT_EQ(p.why, "allowed: 1 to 12");
    p = only("", {"body.cups"});
    EXPECT_EQ(p.why, "an override is section.key=value");
    only("", {"body.cups="});
    only("", {"body.cups=1\nmaker=\"x\""});
}

TEST(SceneReader, ProblemsOfOthersFindTheirPosition) {
    const Read r = read("[body]\ncups = 3\n", {"body.height=0.1"});
    Problems problems(r.positions);
    EXPECT_NO_THROW(problems.throw_if_any());
    problems.add("body.cups", "= 3 is odd", "pairs are wanted", "take 4");
    problems.add("body.height", "is low");
    problems.add("surface.heat", ": cold");
    try {
        problems.throw_if_any();
        FAIL();
    } catch (const SceneError& error) {
        EXPECT_EQ(error.code(), 2);
        EXPECT_STREQ(error.what(), "pot.toml:2:8: body.cups = 3 is odd\n"
                                   "    why: pairs are wanted\n"
                                   "    fix: take 4\n"
                                   "--set body.height=0.1: body.height is low\n"
                                   "pot.toml: surface.heat: cold");
    }
}

TEST(SceneReader, WrittenBackItReadsTheSame) {
    Teapot pot;
    pot.height = 0.1 + 0.2;
    pot.maker = "a \"b\" \\ c\n\u00E9";
    pot.crack = 1e-7;
    pot.chips = 5;
    pot.glaze = Glaze::none;
    pot.coats = {};
    pot.marks = {"every:9", "seal"};
    for (const bool docs : {false, true}) {
        const std::string text = bind(pot).toml(docs);
        const Read r = read(text);
        ASSERT_TRUE(r.problems.empty()) << text << format(r.problems.front());
        EXPECT_EQ(r.pot.height, pot.height);
        EXPECT_EQ(r.pot.maker, pot.maker);
        EXPECT_EQ(r.pot.crack, pot.crack);
        EXPECT_EQ(r.pot.chips, pot.chips);
        EXPECT_EQ(r.pot.glaze, pot.glaze);
        EXPECT_EQ(r.pot.coats, pot.coats);
        EXPECT_EQ(r.pot.marks, pot.marks);
    }
    const Json json = bind(pot).json();
    EXPECT_EQ(json["body"]["maker"], pot.maker);
    EXPECT_EQ(json["surface"]["crack"], 1e-7);
    EXPECT_EQ(json["surface"]["marks"].size(), 2u);
}

TEST(SceneReader, Nearest) {
    const std::vector<std::string> words = {"temperature", "timestep", "rms", "rolloff",
                                            "layers_per_level"};
    EXPECT_EQ(nearest("tempreature", words), "temperature");
    EXPECT_EQ(nearest("temp", words), "temperature");
    EXPECT_EQ(nearest("RMS", words), "rms");
    EXPECT_EQ(nearest("roll-off", words), "rolloff");
    EXPECT_EQ(nearest("layers-per-level", words), "layers_per_level");
    EXPECT_EQ(nearest("cuda", {"none", "auto", "0"}), "") << "a digit begins no word";
    EXPECT_EQ(nearest("time_step", words), "timestep");
    EXPECT_EQ(nearest("banana", words), "");
}

TEST(SceneReader, KeysOfManyParts) {
    std::string deep = "a";
    for (int i = 0; i < 100000; ++i)
        deep += ".a";
    const Problem p = only("[body]\ncups = 3\n" + deep + " = 1\n");
    EXPECT_EQ(p.where, "pot.toml:3:1");
    EXPECT_EQ(p.why, "a key has more than 32 parts");
    for (const std::string& text :
         {"[" + deep + "]\nx = 1\n", "x = {" + deep + " = 1}\n",
          "x = \"\"\"\n\"\\\"\"\"\"\"\n" + deep + " = 1\n", "x = '''\n''''\n" + deep + " = 1\n"})
        EXPECT_EQ(only(text).why, "a key has more than 32 parts") << text.substr(0, 30);
    only("", {"body.cups={" + deep + "=1}"});
    only("", {"body.cups=1\n" + deep + "=1"});
    EXPECT_EQ(only("", {"=3"}).what, "there is no key before the =");
    // Strings and comments may have as many dots as they like.
    EXPECT_TRUE(read("[body] # " + deep + "\nmaker = \"" + deep + "\"\n").problems.empty());
    EXPECT_TRUE(read("[body]\nmaker = '''\n" + deep + "'''\n").problems.empty());
    EXPECT_TRUE(read("", {"body.maker=../" + deep}).problems.empty());
}

TEST(SceneReader, ManyProblemsAreCounted) {
    std::string text = "[body]\n";
    for (int i = 0; i < 100000; ++i)
        text += "key" + std::to_string(i) + " = 1\n";
    const Read result = read(text);
    ASSERT_EQ(result.problems.size(), 51u);
    EXPECT_EQ(result.problems.back().what, "has 99950 more problems");
    const std::string name(3000000, 'k'); // is not compared with every key, letter by letter
    EXPECT_LT(only("[body]\n" + name + " = 1\n").what.size(), 100u);
}

TEST(SceneReader, Advice) {
    EXPECT_EQ(only("", {"body.height=1,5"}).fix,
              "write \"1.5\" if that is meant; several values are for `asperity sweep`");
    for (const std::string list : {"1.5,2", "1,2,3", "1e3,5"})
        EXPECT_EQ(only("", {"body.height=" + list}).fix,
                  "give one of them; all of them are for `asperity sweep SCENE --set KEY=" + list +
                      "`");
    EXPECT_EQ(only("", {"body.height=77e9"}).fix,
              "give a value in that range; a number without a unit is in m, another unit is "
              "written as in \"1 m\"");
    EXPECT_EQ(only("", {"body.cups=99999999999999999999"}).why, "allowed: 1 to 12");
}

TEST(SceneReader, FilesThatCannotBeRead) {
    const Scratch scratch;
    EXPECT_THROW(read_scene_file(scratch / "none.toml"), SceneError);
    EXPECT_THROW(read_scene_file(scratch / ""), SceneError);
    EXPECT_EQ(read_scene_file(scratch.write("a.toml", "x\n")), "x\n");
    EXPECT_EQ(read_scene_file(scratch.write("empty.toml", "")), "");
    EXPECT_THROW(read_scene_file("/dev/zero"), SceneError); // has no end
}

} // namespace
} // namespace asperity::io
