// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Whose a result directory is, and which one is taken.
#include "io/error.hpp"
#include "io/json.hpp"
#include "io/result.hpp"
#include "io/result_directory.hpp"

#include "support/scratch.hpp"

#include <optional>
#include <span>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

namespace asperity::io {
namespace {

std::string refusal(const ResultRequest& request) {
    try {
        const ResultDirectory directory(request);
    } catch (const Error& error) {
        return std::to_string(error.code()) + " " + error.what();
    }
    return "";
}

bool holds(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

TEST(ResultDirectory, IsOnesAlone) {
    const Scratch scratch;
    const std::string path = scratch / "a";
    std::optional<ResultDirectory> owner(std::in_place, ResultRequest{path, "x"});
    EXPECT_TRUE(std::filesystem::exists(path + "/run.lock"));
    const std::string text = refusal({path, "x"});
    EXPECT_TRUE(holds(text, "4 ") && holds(text, "is in use") &&
                holds(text, std::to_string(::getpid())))
        << text;
    owner.reset();
    EXPECT_FALSE(std::filesystem::exists(path)) << "made for nothing";
    EXPECT_EQ(refusal({path, "x"}), "");
}

TEST(ResultDirectory, BreaksTheLockOfTheDeadAndOfNobodyElse) {
    const Scratch scratch;
    const std::string path = scratch / "a", file = path + "/run.lock";
    // A child takes it and dies without giving it back.
    const pid_t child = ::fork();
    if (child == 0) {
        new ResultDirectory({path, "x"});
        ::_exit(0);
    }
    ::waitpid(child, nullptr, 0);
    const std::string left = contents(file);
    ASSERT_TRUE(holds(left, "process " + std::to_string(child))) << left;
    {
        const ResultDirectory owner({path, "x"});
        ASSERT_EQ(owner.notes().size(), 1u);
        EXPECT_TRUE(holds(owner.notes()[0], "is gone")) << owner.notes()[0];
    }
    // The same of another host, and one that tells nothing.
    std::filesystem::create_directories(path);
    const std::size_t name = left.find(' ') + 1;
    const auto with_digest = [](const std::string& text) {
        return text + "digest " + digest_text(digest_of(std::as_bytes(std::span(text)))) + "\n";
    };
    const std::string whole = left.substr(0, left.find("digest"));
    ASSERT_EQ(with_digest(whole), left);
    scratch.write("a/run.lock", with_digest(whole.substr(0, name) + "elsewhere" +
                                            whole.substr(whole.find('\n'))));
    EXPECT_TRUE(holds(refusal({path, "x"}), "on host elsewhere"));
    EXPECT_EQ(contents(file).substr(0, 14), "host elsewhere") << "it is still theirs";
    // A number of a process that another has by now is nobody's.
    scratch.write("a/run.lock", with_digest(fmt::format(
                                    "host {}process {}\nsince then\n",
                                    left.substr(name, left.find('\n') + 1 - name), ::getpid())));
    EXPECT_EQ(refusal({path, "x"}), "");
    EXPECT_FALSE(std::filesystem::exists(file));
    // Other texts are somebody's, unless the record says that a command was writing one.
    for (const std::string& text :
         {std::string(), left.substr(0, name), left.substr(0, left.size() - 1), whole,
          left.substr(0, left.find("since")), std::string("host foo\n  HostName bar\n"),
          left + "more\n"}) {
        std::filesystem::create_directories(path);
        scratch.write("a/run.lock", text);
        const std::string said = refusal({path, "x"});
        EXPECT_TRUE(holds(said, "2 ") && holds(said, "not the lock of a run")) << said;
        EXPECT_EQ(contents(file), text);
        scratch.write("a/.asperity-files.json",
                      sealed_texts("files", {{"run.lock", "unfinished"}}));
        EXPECT_EQ(refusal({path, "x", false, false, {"result.json"}}), "") << text;
        EXPECT_TRUE(std::filesystem::is_empty(path)) << text;
    }
}

TEST(ResultDirectory, WritesIntoNoFileThatIsThere) {
    const Scratch scratch;
    const std::string path = scratch / "a";
    std::string left;
    {
        const ResultDirectory owner({path, "x"});
        left = contents(path + "/run.lock");
    }
    // A whole lock, and a file that the record calls unfinished, that are another name of a file.
    for (const std::string name : {"run.lock", "run.journal"}) {
        std::filesystem::create_directories(path);
        scratch.write("theirs", left);
        std::filesystem::create_hard_link(scratch / "theirs", path + "/" + name);
        scratch.write("a/.asperity-files.json", sealed_texts("files", {{name, "unfinished"}}));
        const std::string said = refusal({path, "x", false, true, {"run.journal"}});
        EXPECT_TRUE(holds(said, "2 ") && holds(said, "hard link")) << said;
        EXPECT_EQ(contents(scratch / "theirs"), left);
        std::filesystem::remove_all(path);
    }
    // The name of a temporary file may be taken, by a link for example.
    std::filesystem::create_directories(path);
    scratch.write("theirs", "a text");
    const std::string taken = path + "/" + OutputFile::temporary("f");
    std::filesystem::create_hard_link(scratch / "theirs", taken);
    write_whole({Directory(path), "f"}, "ours");
    EXPECT_EQ(contents(path + "/f"), "ours");
    EXPECT_EQ(contents(scratch / "theirs"), "a text");
    EXPECT_EQ(contents(taken), "a text");
}

TEST(ResultDirectory, IsOfOneOfManyThatTakeItAtOnce) {
    const Scratch scratch;
    const std::string path = scratch / "a", taken = scratch / "taken";
    std::filesystem::create_directories(path);
    std::vector<pid_t> children;
    for (int i = 0; i < 8; ++i) {
        const pid_t child = ::fork();
        if (child == 0) {
            int own = 0;
            for (int round = 0; round < 50; ++round) {
                try {
                    const ResultDirectory directory({path, "x"});
                    // Two at once would meet here.
                    const int alone = ::open(taken.c_str(), O_CREAT | O_EXCL | O_WRONLY, 0644);
                    if (alone < 0) ::_exit(2);
                    ++own;
                    ::close(alone);
                    ::unlink(taken.c_str());
                } catch (const FileError&) { // it is another's
                }
            }
            ::_exit(own > 0 ? 0 : 1);
        }
        children.push_back(child);
    }
    for (const pid_t child : children) {
        int status = 0;
        ::waitpid(child, &status, 0);
        EXPECT_NE(WEXITSTATUS(status), 2) << "two had it";
    }
    EXPECT_FALSE(std::filesystem::exists(path + "/run.lock"));
}

TEST(DirectoryLock, BelongsToTheProcessThatItIsHandedTo) {
    const Scratch scratch;
    const std::string file = scratch / "run.lock";
    int ends[2];
    ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends), 0);
    Descriptor ours(ends[0]);
    const Descriptor theirs(ends[1]);
    EXPECT_EQ(process_behind(theirs.get()), ::getpid());
    const auto try_to_take = [&] { DirectoryLock(Directory(scratch / "."), 7); };
    const pid_t child = ::fork();
    if (child == 0) {
        DirectoryLock(Directory(scratch / "."), process_behind(theirs.get()))
            .hand_over(theirs.get());
        ::_exit(0);
    }
    ::waitpid(child, nullptr, 0);
    EXPECT_TRUE(holds(contents(file), fmt::format("process {}\n", ::getpid()))) << contents(file);
    EXPECT_THROW(try_to_take(), FileError);
    ours = Descriptor(); // with the message in it, which holds the file
    EXPECT_NO_THROW(try_to_take());
    EXPECT_FALSE(std::filesystem::exists(file));
    // A pipe has nobody to hand anything to.
    ASSERT_EQ(::pipe(ends), 0);
    const Descriptor out(ends[0]), in(ends[1]);
    EXPECT_THROW(process_behind(out.get()), SceneError);
    EXPECT_THROW(DirectoryLock(Directory(scratch / "."), 7).hand_over(in.get()), FileError);
    EXPECT_FALSE(std::filesystem::exists(file)) << "it was not handed over";
}

TEST(ResultDirectory, RefusesResultsAndUnfinishedRuns) {
    const Scratch scratch;
    const std::string path = scratch / "a";
    const auto write = [&](const char* name, const std::string& text) {
        std::filesystem::create_directories(path);
        scratch.write(std::string("a/") + name, text);
    };
    write("run.journal", "x");
    EXPECT_TRUE(holds(refusal({path, "x"}), "2 ") && holds(refusal({path, "x"}), "--restart"));
    EXPECT_EQ(refusal({path, "x", true}), "");
    write("result.json", R"({"run": {"stopped": "signal"}})");
    EXPECT_TRUE(holds(refusal({path, "x"}), "unfinished"));
    write("result.json", R"({"failure": {"exit_code": 4}, "run": {}})");
    EXPECT_TRUE(holds(refusal({path, "x"}), "unfinished"));
    // A restart removes the files that the record calls unfinished, and no others.
    const std::vector<std::string> files = {"run.journal", "run.h5", "result.json"};
    const std::string refused = refusal({path, "x", false, true, files});
    EXPECT_TRUE(holds(refused, "2 ") && holds(refused, "a/run.journal: is there already") &&
                holds(refused, "a/result.json: is there already") && holds(refused, "no record"))
        << refused;
    write(".asperity-files.json", sealed_texts("files", {{"run.journal", "unfinished"},
                                                         {"result.json", "unfinished"},
                                                         {"run.h5.12.part", "unfinished"},
                                                         {"../b.1.part", "unfinished"}}));
    write("run.h5.12.part", "left over");
    scratch.write("b.1.part", "of another directory");
    write("x.part", "of another program");
    write("run.h5.13.part", "of another program");
    EXPECT_EQ(refusal({path, "x", false, true, files}), "");
    EXPECT_EQ(contents(scratch / "b.1.part"), "of another directory");
    std::filesystem::remove(path + "/.asperity-files.json"); // which still names that file
    for (const char* file : {"x.part", "run.h5.13.part"}) {
        EXPECT_EQ(contents(scratch / ("a/" + std::string(file))), "of another program");
        std::filesystem::remove(path + "/" + file);
    }
    EXPECT_TRUE(std::filesystem::is_empty(path)) << "--restart leaves something";
    // A result is never thrown away.
    write("result.json", R"({"run": {}})");
    write("run.journal", "x");
    for (const bool restart : {false, true})
        EXPECT_TRUE(holds(refusal({path, "x", false, restart}), "already holds a result"));
    EXPECT_FALSE(holds(refusal({path, "x"}), "--resume")) << "there is nothing to go on from";
    write("checkpoint.h5", "x"); // of one that drive.max_steps ended
    EXPECT_TRUE(holds(refusal({path, "x"}), "--resume auto"));
    for (const char* odd : {"", "[]", R"({"run": 3})", R"({"run": {"stopped": 7}})"}) {
        write("result.json", odd);
        EXPECT_TRUE(holds(refusal({path, "x"}), "already holds a result")) << odd;
    }
    EXPECT_TRUE(holds(refusal({scratch.write("file", ""), "x"}), "is not a directory"));
    EXPECT_THROW(Directory::make((scratch / "file") + "/sub"), FileError);
}

TEST(ResultDirectory, KeepsWhatTheRecordDoesNotName) {
    const Scratch scratch;
    const std::string path = scratch / "a", kept = path + "/run.h5";
    std::filesystem::create_directories(path);
    const ResultRequest request{path, "x", false, false, {"run.h5"}, {scratch / "map.h5"}};
    const auto is_kept = [&](const char* why) {
        const std::string before = std::filesystem::is_directory(kept) ? "" : contents(kept);
        const std::string text = refusal(request);
        EXPECT_TRUE(holds(text, "2 ") && holds(text, "a/run.h5: is there already") &&
                    holds(text, why))
            << text;
        EXPECT_TRUE(std::filesystem::exists(std::filesystem::symlink_status(kept)));
        if (!before.empty()) {
            EXPECT_EQ(contents(kept), before);
        }
        EXPECT_FALSE(std::filesystem::exists(path + "/run.lock"));
        std::filesystem::remove(kept);
    };
    scratch.write("a/run.h5", "by hand");
    is_kept("no record");
    std::filesystem::create_symlink("nowhere", kept);
    is_kept("symbolic link");
    std::filesystem::create_directory(kept);
    is_kept("no regular file");
    {
        const ResultDirectory place(request);
        scratch.write("a/run.h5", "ours");
    }
    EXPECT_TRUE(holds(refusal(request), "belongs to an earlier result"));
    scratch.write("a/run.h5", "changed");
    is_kept("was changed");
    scratch.write("a/other", "by hand");
    const ResultRequest other{path, "x", false, false, {"other"}};
    EXPECT_TRUE(holds(refusal(other), "no record") ||
                holds(refusal(other), "not one of the files"));
    // A command that does not come to its end may be repeated, but never over its input.
    try {
        const ResultDirectory place(request);
        scratch.write("a/run.h5", "half");
        throw FileError(kept, "cannot be written", "");
    } catch (const FileError&) {
    }
    EXPECT_EQ(refusal(request), "");
    std::filesystem::create_directories(path);
    scratch.write("map.h5", "the map");
    for (const bool symbolic : {false, true}) {
        std::filesystem::remove(kept);
        if (symbolic)
            std::filesystem::create_symlink("../map.h5", kept);
        else
            std::filesystem::create_hard_link(scratch / "map.h5", kept);
        scratch.write("a/.asperity-files.json",
                      sealed_json({{"files", {{"run.h5", "unfinished"}}}}));
        is_kept("which the command reads");
        EXPECT_EQ(contents(scratch / "map.h5"), "the map");
    }
    scratch.write("a/.asperity-files.json", "by hand");
    EXPECT_TRUE(holds(refusal(request), "is no record of the files"));
    EXPECT_EQ(contents(path + "/.asperity-files.json"), "by hand");
    std::filesystem::remove(path + "/.asperity-files.json");
    scratch.write("a/run.lock", "by hand");
    EXPECT_TRUE(holds(refusal(request), "not the lock of a run"));
    EXPECT_EQ(contents(path + "/run.lock"), "by hand");
}

TEST(ResultDirectory, NumbersItsDirectories) {
    const Scratch scratch;
    const auto before = std::filesystem::current_path();
    std::filesystem::current_path(scratch / "");
    for (const char* name : {"results/gold", "results/gold-2"}) {
        const ResultDirectory place({"", "gold"});
        EXPECT_EQ(place.path(), name);
        write_result(place.directory(), {});
    }
    {
        const ResultDirectory place({"", "gold"});
        EXPECT_EQ(place.path(), "results/gold-3");
        EXPECT_EQ(place.notes().at(0),
                  "results/gold already holds a result; this one goes to results/gold-3");
    }
    EXPECT_TRUE(holds(refusal({"", "gold", true}), "results/gold-2 holds a result"));
    std::filesystem::create_directories("results/gold-3");
    std::ofstream("results/gold-3/run.journal") << "x";
    EXPECT_EQ(ResultDirectory({"", "gold", true}).path(), "results/gold-3");
    std::filesystem::current_path(before);
}

} // namespace
} // namespace asperity::io
