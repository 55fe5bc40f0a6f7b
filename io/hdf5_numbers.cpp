// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/hdf5_numbers.hpp"

#include "io/error.hpp"
#include "io/journal.hpp"
#include "io/machine.hpp"
#include "io/scene_file.hpp"

#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <new>
#include <optional>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace asperity::io {

namespace {

using NumberSets = std::map<std::string, NumberSet>;

constexpr const char* take_another = "take a copy that is whole, or write it again";

/// Largest ratio of compression by filters of HDF5: more means values that were never written.
constexpr double best_compression = 1100.0;

NumberSet number_set(const Hdf5File& file, const std::string& name, const NumbersWanted& wanted) {
    NumberSet set;
    for (const char* attribute : wanted.texts)
        if (const auto text = file.text_attribute(name, attribute)) set.texts[attribute] = *text;
    for (const char* attribute : wanted.numbers)
        if (const auto number = file.number_attribute(name, attribute))
            set.numbers[attribute] = *number;
    if (name == "/") return set;
    set.shape = file.shape(name);
    if (!wanted.values) return set;
    double count = 1.0;
    for (const std::uint64_t extent : set.shape)
        count *= static_cast<double>(extent);
    require_memory(file.path() + ":" + name, wanted.what,
                   24.0 * count); // in the child, in the file in memory, here
    const double stored = static_cast<double>(file.stored_bytes(name));
    if (count > best_compression * stored)
        refuse(
            file.path() + ":" + name, "is not whole",
            fmt::format("{:.0f} numbers are declared, and {:.0f} bytes are stored", count, stored),
            take_another);
    set.values = file.read<double>(name);
    return set;
}

NumberSets read_all(const std::string& file, const NumbersWanted& wanted) {
    const Hdf5File opened(file, Hdf5File::Mode::read_any);
    NumberSets sets{{"/", number_set(opened, "/", wanted)}};
    for (const std::string& name : wanted.data_sets(opened))
        sets[name] = number_set(opened, name, wanted);
    return sets;
}

void put(PayloadWriter& to, const std::string& text) {
    to.put(std::uint64_t{text.size()});
    to.put(text);
}
std::string text_of(PayloadReader& from) {
    const std::vector<char> text = from.get<char>(from.get<std::uint64_t>());
    return {text.begin(), text.end()};
}

/// Writes everything but the values, which follow in the order of the sets.
PayloadWriter head_of(const NumberSets& sets) {
    PayloadWriter head;
    head.put(std::uint64_t{sets.size()});
    for (const auto& [name, set] : sets) {
        put(head, name);
        head.put(std::uint64_t{set.shape.size()});
        head.put(set.shape);
        head.put(std::uint64_t{set.values.size()});
        head.put(std::uint64_t{set.texts.size()});
        for (const auto& [attribute, text] : set.texts)
            put(head, attribute), put(head, text);
        head.put(std::uint64_t{set.numbers.size()});
        for (const auto& [attribute, number] : set.numbers)
            put(head, attribute), head.put(number);
    }
    return head;
}

NumberSets sets_of(Bytes bytes) {
    PayloadReader head(bytes);
    NumberSets sets;
    for (auto left = head.get<std::uint64_t>(); left > 0; --left) {
        NumberSet& set = sets[text_of(head)];
        set.shape = head.get<std::uint64_t>(head.get<std::uint64_t>());
        set.values.resize(head.get<std::uint64_t>());
        for (auto texts = head.get<std::uint64_t>(); texts > 0; --texts) {
            const std::string attribute = text_of(head);
            set.texts[attribute] = text_of(head);
        }
        for (auto numbers = head.get<std::uint64_t>(); numbers > 0; --numbers) {
            const std::string attribute = text_of(head);
            set.numbers[attribute] = head.get<double>();
        }
    }
    return sets;
}

/// Head of the data that the child hands over. The child writes the head last, when the data are
/// complete.
struct Answer {
    enum : std::uint64_t { none, numbers, refused } kind = none;
    std::uint64_t head = 0; ///< bytes
};

/// A file in memory that both processes have, and what is written to it one after the other.
class Shared {
public:
    Shared() : file_(::memfd_create("asperity", MFD_CLOEXEC)) {}
    explicit operator bool() const { return static_cast<bool>(file_); }
    bool append(Bytes bytes) {
        const bool done = write_all(file_.get(), bytes, at_);
        at_ += bytes.size();
        return done;
    }
    bool take(std::span<std::byte> bytes) {
        const bool done =
            read_some(file_.get(), bytes, at_) == static_cast<std::ptrdiff_t>(bytes.size());
        at_ += bytes.size();
        return done;
    }
    void rewind() { at_ = 0; }

private:
    Descriptor file_;
    std::uint64_t at_ = 0;
};

void set_limit(int what, double value) {
    rlimit limit{};
    ::getrlimit(static_cast<__rlimit_resource_t>(what), &limit);
    if (value < static_cast<double>(limit.rlim_cur)) limit.rlim_cur = static_cast<rlim_t>(value);
    ::setrlimit(static_cast<__rlimit_resource_t>(what), &limit);
}

/// Limits the child's resources: its crash concerns no other process, and it ends in any case.
void set_limits(const std::string& file) {
    for (const int number : {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT, SIGXCPU})
        std::signal(number, SIG_DFL);
    const int nothing = ::open("/dev/null", O_RDWR);
    if (nothing >= 0) ::dup2(nothing, STDERR_FILENO);
    set_limit(RLIMIT_CORE, 0.0);
    std::error_code error;
    const double size = static_cast<double>(std::filesystem::file_size(file, error));
    set_limit(RLIMIT_CPU, error ? 60.0 : 60.0 + 1e-6 * size); // a MB/s is slow
    double pages = 0.0;                                       // address space in use
    std::ifstream("/proc/self/statm") >> pages;
    const double more = available_memory().bytes;
    if (pages > 0.0 && std::isfinite(more))
        set_limit(RLIMIT_AS, pages * static_cast<double>(::sysconf(_SC_PAGESIZE)) + more);
}

/// Carries out the child's work. Nothing may leave it: neither an exception nor exit handlers.
void answer(Shared& shared, const std::string& file, const NumbersWanted& wanted) {
    Answer kind;
    NumberSets sets;
    PayloadWriter head;
    const auto refused = [&](const Problem& problem) {
        kind.kind = Answer::refused;
        for (const std::string& text : {problem.where, problem.what, problem.why, problem.fix})
            put(head, text);
    };
    try {
        set_limits(file);
        sets = read_all(file, wanted);
        head = head_of(sets);
        kind.kind = Answer::numbers;
    } catch (const Error& error) {
        refused(error.problems().front());
    } catch (const std::bad_alloc&) {
        refused({file, "cannot be read", "the memory does not suffice for it", take_another});
    }
    kind.head = head.bytes().size();
    const Answer empty;
    bool done = shared.append(std::as_bytes(std::span(&empty, 1))) && shared.append(head.bytes());
    if (kind.kind == Answer::numbers)
        for (const auto& [name, set] : sets)
            done = done && shared.append(std::as_bytes(std::span(set.values)));
    shared.rewind();
    if (done) shared.append(std::as_bytes(std::span(&kind, 1)));
}

/// Runs the child to its end; the signal that ended it, or 0.
int run_child(Shared& shared, const std::string& file, const NumbersWanted& wanted) {
    const pid_t child = ::fork();
    if (child < 0)
        refuse(file, "cannot be read", std::strerror(errno), "free memory, or raise ulimit -u");
    if (child == 0) {
        try {
            answer(shared, file, wanted);
        } catch (...) { // no answer is one
        }
        ::_exit(0);
    }
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR)
        continue;
    return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
}

} // namespace

std::map<std::string, NumberSet> read_numbers(const std::string& file,
                                              const NumbersWanted& wanted) {
    Shared shared;
    if (!shared)
        refuse(file, "cannot be read", std::strerror(errno), "the system gives no file in memory");
    const int by_signal = run_child(shared, file, wanted);
    Answer kind;
    std::vector<std::byte> head;
    NumberSets sets;
    const auto take = [&](auto& values) {
        return shared.take(std::as_writable_bytes(std::span(values)));
    };
    shared.rewind();
    bool whole =
        shared.take(std::as_writable_bytes(std::span(&kind, 1))) && kind.kind != Answer::none;
    if (whole) {
        head.resize(kind.head);
        whole = take(head);
    }
    if (whole && kind.kind == Answer::refused) {
        PayloadReader problem(head);
        std::array<std::string, 4> text;
        for (std::string& part : text)
            part = text_of(problem);
        refuse(text[0], text[1], text[2], text[3]);
    }
    if (whole) sets = sets_of(head);
    for (auto& [name, set] : sets)
        whole = whole && take(set.values);
    if (!whole)
        refuse(file, "is damaged",
               by_signal == SIGXCPU ? "the HDF5 library finds no end in it"
               : by_signal != 0
                   ? fmt::format("the HDF5 library crashed on it ({})", strsignal(by_signal))
                   : std::string("the HDF5 library could not hand it over"),
               take_another);
    return sets;
}

} // namespace asperity::io
