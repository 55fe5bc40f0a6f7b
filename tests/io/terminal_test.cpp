// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/error.hpp"
#include "io/terminal.hpp"

#include "support/scratch.hpp"

#include <cmath>
#include <cstdlib>
#include <sstream>
#include <string>

namespace asperity::io {
namespace {

TEST(Errors, Grammar) {
    EXPECT_EQ(format(Problem{"a:1:2", "x is wrong", "because\nof two things", "do this"}),
              "a:1:2: x is wrong\n    why: because\n         of two things\n    fix: do this");
    EXPECT_EQ(format(Problem{"", "x is wrong", "", ""}), "x is wrong");
    EXPECT_EQ(PhysicsError("a", "b", "c").code(), 3);
    EXPECT_EQ(FileError("p", "a", "b").code(), 4);
    EXPECT_STREQ(SceneError(std::vector<Problem>{{"a", "b", "", ""}, {"c", "d", "", ""}}).what(),
                 "a: b\nc: d");
}

TEST(Terminal, IsControlledByNoNameOfAFile) {
    const std::string name = "a\x1b[31mred\x07\x7f\r\xc2\x9bµ";
    const std::string shown = "a\\x1b[31mred\\x07\\x7f\\x0d\\x9bµ";
    EXPECT_EQ(printable(name + "\n"), shown + "\n");
    EXPECT_EQ(folded(name + "\n"), shown + "\n");
    EXPECT_EQ(format(Problem{name, name, name, ""}), shown + ": " + shown + "\n    why: " + shown);
    Table table({"", "b"});
    table.row({name, "1"});
    EXPECT_EQ(table.text(false).find('\x1b'), std::string::npos);
}

TEST(Table, AlignsWhatIsSeen) {
    Table table({"", "approach", "γ"});
    table.row({"work of adhesion", "12.34", "1"});
    table.rule();
    table.row({"Å", "7"});
    EXPECT_EQ(table.text(false), "                    approach  γ\n"
                                 "  ─────────────────────────────\n"
                                 "  work of adhesion     12.34  1\n"
                                 "  ─────────────────────────────\n"
                                 "  Å                        7\n");
    EXPECT_NE(table.text(true).find("\033[1m"), std::string::npos);
}

TEST(Table, ALastColumnOfTextIsBroken) {
    Table table({"effect", "", "because"}, "<<<");
    const std::string why =
        "a copy of the lowest layer is relaxed where the approach ends, and more";
    table.row({"relaxation", "on", why});
    const std::string text = table.text(false);
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
        EXPECT_LE(visible_width(line), text_columns) << line;
    EXPECT_NE(text.find("\n                  "), std::string::npos) << text; // below "a copy"
}

TEST(Errors, AreFoldedBehindTheirLabels) {
    const std::string fix(100, 'x');
    EXPECT_EQ(folded("    fix: take " + fix), "    fix: take\n         " + fix);
    EXPECT_EQ(folded("  note: take " + fix), "  note: take\n        " + fix);
}

TEST(Table, Cells) {
    EXPECT_EQ(cell(98.8612), "98.86");
    EXPECT_EQ(cell(-0.012346), "-0.01235");
    EXPECT_EQ(cell(0.0), "0.000");
    EXPECT_EQ(cell(1e-9), "1.000e-09");
    EXPECT_EQ(cell(123456.0), "123456");
    EXPECT_EQ(cell(1.0 / 0.0), "-");
    // A number ends where its error does.
    EXPECT_EQ(with_error(0.03265, 0.00384), "0.033 ± 0.004");
    EXPECT_EQ(with_error(-12.345, 0.0961), "-12.3 ± 0.1");
    EXPECT_EQ(with_error(1234.0, 38.0), "1230 ± 40");
    EXPECT_EQ(with_error(0.02, 0.3), "0.0 ± 0.3");
    EXPECT_EQ(with_error(1.234e-6, 5.4e-8), "(1.23 ± 0.05)e-06");
    EXPECT_EQ(with_error(98.8612, 0.0), "98.86");
    // As many decimals as asked for, and three significant digits in any case.
    for (const auto& [value, text] :
         std::initializer_list<std::pair<double, const char*>>{{69.912, "69.91"},
                                                               {55.6251, "55.63"},
                                                               {-1.0, "-1.00"},
                                                               {0.0, "0.00"},
                                                               {-0.0, "0.00"},
                                                               {0.99951, "1.00"},
                                                               {0.5, "0.500"},
                                                               {0.00412, "0.00412"},
                                                               {4.127e-7, "4.13e-07"},
                                                               {-3e-4, "-3.00e-04"},
                                                               {12345.678, "12345.68"},
                                                               {5.4321e12, "5.432e+12"},
                                                               {std::nan(""), "-"}})
        EXPECT_EQ(number(value, 2), text) << value;
    EXPECT_EQ(number(0.04, 1), "0.0400");
    EXPECT_EQ(number(123.0, 0), "123");
}

TEST(Durations, ReadAndWritten) {
    EXPECT_EQ(parse_duration("23h50m"), 85800.0);
    EXPECT_EQ(parse_duration("90s"), 90.0);
    EXPECT_EQ(parse_duration("90"), 90.0);
    EXPECT_EQ(parse_duration("1.5h"), 5400.0);
    EXPECT_EQ(parse_duration("1d2h3min4s"), 93784.0);
    for (const char* bad : {"", "h", "5x", "-5s", "0s", "5m5h", "5 m", "1h1h", "1h30"})
        EXPECT_FALSE(parse_duration(bad).has_value()) << bad;
    EXPECT_EQ(duration_text(3.21), "3.2 s");
    EXPECT_EQ(duration_text(59.7), "1 min 00 s");
    EXPECT_EQ(duration_text(3725), "1 h 02 min");
    EXPECT_EQ(duration_text(200000), "2 d 07 h");
}

TEST(Progress, SaysPhaseRateAndTimeLeft) {
    EXPECT_EQ(
        progress_line({"approach, F = -12.3 eV/Å", 4000, 40000.0, 0.5, 20.0}, 10.0, 2000, 20000.0),
        "20 s left, 50 %, approach, F = -12.3 eV/Å | step 4000, 200 steps/s, 173 ns/day");
    EXPECT_EQ(progress_line({"setting up", 0, 0.0, -1.0, -1.0}, 0.0, 0, 0.0), "setting up");
}

TEST(Progress, LinesFitEightyColumns) {
    const std::string phase =
        "slide x 13 Å under 300 MPa, -12345.6 MPa, contact 0.123, height 12.34 Å";
    EXPECT_EQ(progress_line({phase, 123456789, 1e9, 0.5, 4321.0}, 1e4, 123456789, 1e9),
              "1 h 12 min left, 50 %, slide x 13 Å under 300 MPa, -12345.6 MPa, contact 0.123");
}

TEST(Progress, ModesAndFiles) {
    EXPECT_EQ(progress_mode("auto"), ProgressMode::automatic);
    EXPECT_FALSE(progress_mode("loud").has_value());
    std::FILE* file = std::tmpfile();
    ASSERT_NE(file, nullptr);
    {
        Progress progress(ProgressMode::bar, false, file); // a file is no terminal
        EXPECT_EQ(progress.mode(), ProgressMode::lines);
        progress.update({"a", 1, 0.0, 0.0}); // too soon to print
        progress.say("pull-off begins");
        Progress quiet(ProgressMode::lines, true, file);
        quiet.say("never");
        EXPECT_FALSE(quiet.due());
    }
    std::rewind(file);
    char text[200] = {};
    const std::size_t n = std::fread(text, 1, sizeof text - 1, file);
    std::fclose(file);
    EXPECT_EQ(std::string(text, n), "pull-off begins\n");
}

} // namespace
} // namespace asperity::io
