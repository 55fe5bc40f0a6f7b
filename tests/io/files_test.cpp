// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The safe writer, digests, the journal: every change of a byte is noticed, and what cannot be
// written leaves what was there. Failures of the disk: a limit on the size of files (RLIMIT_FSIZE),
// set for one test; every call of the system failing in turn is tests/faults.
#include "io/error.hpp"
#include "io/files.hpp"
#include "io/hdf5_file.hpp"
#include "io/journal.hpp"

#include "support/scratch.hpp"

#include <csignal>
#include <numeric>

#include <fcntl.h>
#include <sys/resource.h>

namespace asperity::io {
namespace {

std::span<const std::byte> bytes(const std::string& text) { return std::as_bytes(std::span(text)); }

std::uint32_t crc(const std::string& text) { return digest_of(bytes(text)); }

int files_in(const std::string& directory) {
    return static_cast<int>(std::distance(std::filesystem::directory_iterator(directory), {}));
}

/// Files may not grow beyond this as long as it lives.
class SizeLimit {
public:
    explicit SizeLimit(rlim_t most) {
        std::signal(SIGXFSZ, SIG_IGN);
        ::getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit = {most, before_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~SizeLimit() { ::setrlimit(RLIMIT_FSIZE, &before_); }
    SizeLimit(const SizeLimit&) = delete;
    SizeLimit& operator=(const SizeLimit&) = delete;

private:
    rlimit before_{};
};

TEST(Digest, DependsOnEveryBitAndTheLengthAndNotOnTheParts) {
    std::string text(333, '\0');
    std::iota(text.begin(), text.end(), '\1');
    const std::uint32_t whole = crc(text);
    for (std::size_t cut = 0; cut <= text.size(); cut += 7) {
        const std::string first = text.substr(0, cut), rest = text.substr(cut);
        ASSERT_EQ(digest_of(bytes(rest), crc(first)), whole) << cut;
    }
    for (std::size_t bit = 0; bit < 8 * text.size(); ++bit) {
        std::string changed = text;
        changed[bit / 8] = static_cast<char>(changed[bit / 8] ^ (1 << (bit % 8)));
        ASSERT_NE(crc(changed), whole) << bit;
    }
    EXPECT_NE(crc(std::string(64, '\0')), crc(std::string(65, '\0')));
    EXPECT_NE(crc(""), crc(std::string(1, '\0')));
    EXPECT_EQ(crc("123456789"), 0xcbf43926u); // the check value of CRC-32/ISO-HDLC
}

TEST(OutputFile, AppearsWholeOrNotAtAll) {
    const Scratch scratch;
    const std::string path = scratch.write("a.txt", "old");
    {
        OutputFile file(path);
        file.write(bytes("half"));
        EXPECT_EQ(contents(path), "old");
    }
    EXPECT_EQ(contents(path), "old");
    EXPECT_EQ(files_in(scratch / ""), 1) << "a temporary file is left";
    write_whole(path, "new");
    EXPECT_EQ(contents(path), "new");
    EXPECT_EQ(files_in(scratch / ""), 1);
    EXPECT_THROW(write_whole(scratch / "none/a.txt", "x"), FileError);
    std::filesystem::create_directories(scratch / "taken/x");
    EXPECT_THROW(write_whole(scratch / "taken", "x"), FileError);
    EXPECT_EQ(files_in(scratch / ""), 2);
    // A link is replaced, not followed.
    std::filesystem::create_symlink(path, scratch / "link");
    write_whole(scratch / "link", "through");
    EXPECT_EQ(contents(path), "new");
}

TEST(OutputFile, GoesIntoItsDirectoryWhereverThatIs) {
    const Scratch scratch;
    const Directory directory = Directory::make(scratch / "here");
    std::filesystem::rename(scratch / "here", scratch / "there");
    std::filesystem::create_directory(scratch / "here");
    write_whole({directory, "a.txt"}, "x");
    EXPECT_EQ(contents(scratch / "there/a.txt"), "x") << "never into another";
    std::filesystem::remove_all(scratch / "there");
    EXPECT_THROW(write_whole({directory, "a.txt"}, "x"), FileError);
}

TEST(OutputFile, AFullDiskKeepsTheOldFile) {
    const Scratch scratch;
    const std::string path = scratch / "a.h5";
    const std::vector<double> old(1000, 1.0), large(100000, 2.0);
    const auto write = [&](const std::vector<double>& data) {
        Hdf5File file(path, Hdf5File::Mode::create);
        file.write<double>("/x", {data.size()}, data);
        file.make_dataset<double>("/s", {0, 100});
        for (int i = 0; i < 100; ++i)
            file.write_slab<double>("/s", {file.extend("/s"), 0}, {1, 100},
                                    std::span(data).first(100));
        file.close();
    };
    write(old);
    for (rlim_t most = 0; most < 900'000; most += 50'000) {
        const SizeLimit limit(most);
        EXPECT_THROW(write(large), FileError) << most;
    }
    EXPECT_EQ(files_in(scratch / ""), 1);
    EXPECT_EQ(Hdf5File(path, Hdf5File::Mode::read).read<double>("/x"), old);
    write(large);
    EXPECT_EQ(Hdf5File(path, Hdf5File::Mode::read).read<double>("/x"), large);
}

TEST(Hdf5File, NoticesEveryDamage) {
    const Scratch scratch;
    const std::string path = scratch / "a.h5";
    {
        Hdf5File file(path, Hdf5File::Mode::create);
        std::vector<double> data(300);
        std::iota(data.begin(), data.end(), 0.5);
        file.write<double>("/group/x", {data.size()}, data);
        file.write_attribute("/group", "scene", "a text that matters");
        file.close();
    }
    const std::string whole = contents(path);
    EXPECT_TRUE(Hdf5File(path, Hdf5File::Mode::read).exists("/group/x"));
    const auto refused = [&](const std::string& damaged) {
        const std::string other = scratch.write("b.h5", damaged);
        try {
            const Hdf5File file(other, Hdf5File::Mode::read);
        } catch (const FileError&) {
            return true;
        }
        return false;
    };
    for (std::size_t at = 0; at < whole.size(); at += at < 2048 ? 1 : 37) {
        std::string damaged = whole;
        damaged[at] = static_cast<char>(damaged[at] ^ (1 << (at % 8)));
        EXPECT_TRUE(refused(damaged)) << "bit in byte " << at;
    }
    for (std::size_t from = 0; from < whole.size(); from += 512) {
        std::string damaged = whole;
        for (std::size_t i = from; i < std::min(from + 512, whole.size()); ++i)
            damaged[i] = '\0';
        EXPECT_TRUE(damaged == whole || refused(damaged)) << "page at " << from;
    }
    for (std::size_t size = 0; size < whole.size(); size += 61)
        EXPECT_TRUE(refused(whole.substr(0, size))) << "cut to " << size;
    EXPECT_TRUE(refused(whole.substr(0, whole.size() - 1)));
    EXPECT_TRUE(refused(whole + "x"));
}

TEST(Journal, IsCutAndCheckedByItsMark) {
    const Scratch scratch;
    const Directory directory = Directory::make(scratch / "d");
    Journal::Mark mark;
    {
        Journal journal(directory, "j");
        for (int i = 0; i < 100; ++i)
            journal.append(1, bytes("record " + std::to_string(i)));
        mark = journal.mark();
        journal.append(2, bytes("later"));
        journal.synchronize();
    }
    const std::string file = scratch / "d/j";
    EXPECT_TRUE(Journal::holds(directory, "j", mark));
    std::filesystem::resize_file(file, std::filesystem::file_size(file) - 3); // half a record
    {
        Journal journal(directory, "j", mark.bytes);
        EXPECT_EQ(journal.mark().digest, mark.digest);
        journal.append(3, bytes("again"));
        std::vector<std::string> found;
        journal.replay([&](std::uint64_t, PayloadReader payload) {
            const std::vector<char> text = payload.remaining<char>();
            found.emplace_back(text.begin(), text.end());
        });
        ASSERT_EQ(found.size(), 101u);
        EXPECT_EQ(found[42], "record 42");
        EXPECT_EQ(found.back(), "again");
    }
    EXPECT_TRUE(Journal::holds(directory, "j", mark));
    std::string damaged = contents(file);
    damaged[100] = static_cast<char>(damaged[100] ^ 1);
    scratch.write("d/j", damaged);
    EXPECT_FALSE(Journal::holds(directory, "j", mark));
    scratch.write("d/j", damaged.substr(0, 50));
    EXPECT_FALSE(Journal::holds(directory, "j", mark));
}

TEST(Journal, ARecordThatFailedIsNotForgotten) {
    const Scratch scratch;
    Journal journal(Directory::make(scratch / "d"), "j");
    journal.append(1, bytes("first"));
    {
        const SizeLimit limit(30);
        EXPECT_THROW(journal.append(1, bytes("second")), FileError);
    }
    EXPECT_THROW(journal.append(1, bytes("third")), FileError);
    int records = 0;
    journal.replay([&](std::uint64_t, const PayloadReader&) { ++records; });
    EXPECT_EQ(records, 1);
}

TEST(Journal, TakesAnEntryInPartsAndGivesItInParts) {
    const Scratch scratch;
    Journal journal(Directory::make(scratch / "d"), "j");
    journal.append(1, bytes("first"));
    const Journal::Mark before = journal.mark();
    journal.begin(2, 6);
    journal.add(bytes("abc"));
    EXPECT_EQ(journal.mark().bytes, before.bytes) << "half an entry is none";
    EXPECT_THROW(journal.add(bytes("defg")), std::logic_error);
    journal.add(bytes("def"));
    std::string found;
    journal.replay([&](std::uint64_t kind, PayloadReader payload) {
        if (kind != 2) return;
        for (; !payload.at_end(); found += payload.get<char>()) {
            PayloadReader ahead = payload;
            found += static_cast<char>(ahead.remaining<char>().back());
        }
        EXPECT_THROW(payload.get<char>(), FileError);
    });
    EXPECT_EQ(found, "fafbfcfdfeff");
    EXPECT_TRUE(Journal::holds(Directory::make(scratch / "d"), "j", journal.mark()));
}

} // namespace
} // namespace asperity::io
