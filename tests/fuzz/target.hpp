// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What the fuzz targets share.
#pragma once

#include "io/child_process.hpp"
#include "io/error.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <string_view>

#include <sys/mman.h>
#include <unistd.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace asperity::fuzz {

/// Bytes as a file that has a name and no place on a disk.
class MemoryFile {
public:
    explicit MemoryFile(std::string_view bytes) : file_(::memfd_create("fuzz", 0)) {
        if (file_ < 0 || !io::write_all(file_, bytes.data(), bytes.size())) std::abort();
    }
    ~MemoryFile() { ::close(file_); }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;
    std::string name() const { return "/proc/self/fd/" + std::to_string(file_); }
    std::string text() const {
        std::string text(1 << 16, '\0');
        const ssize_t size = ::pread(file_, text.data(), text.size(), 0);
        text.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
        return text;
    }
    int descriptor() const { return file_; }

private:
    int file_;
};

/// Runs work, which may throw io::Error.
template <class Work>
void try_out(const Work& work) {
    try {
        work();
    } catch (const io::Error&) {
    }
}

/// The same in a child process, for files that libhdf5 reads. A report of a sanitizer whose first
/// frame of a known object is Asperity's own ends the parent: that is a finding.
inline void try_out_in_child(const std::function<void()>& work) {
    const MemoryFile report("");
    const auto child = [&](int) {
        ::dup2(report.descriptor(), STDERR_FILENO);
        try_out(work);
    };
    const std::string ended = io::in_child_process(20, child, [](int) {});
    if (ended.empty()) return;
    const std::string text = report.text();
    const std::size_t ours = text.find(" in asperity::"), theirs = text.find("libhdf5");
    const bool hang = ended.starts_with("after");
    if (hang || ours >= theirs) return;
    std::fprintf(stderr, "the child ended %s:\n%s\n", ended.c_str(), text.c_str());
    std::abort();
}

} // namespace asperity::fuzz
