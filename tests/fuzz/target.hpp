// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What the fuzz targets share.
#pragma once

#include "io/error.hpp"
#include "io/files.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>
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
        if (file_ < 0 || !io::write_all(file_, std::as_bytes(std::span(bytes)), 0)) std::abort();
    }
    ~MemoryFile() { ::close(file_); }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;
    std::string name() const { return "/proc/self/fd/" + std::to_string(file_); }

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

} // namespace asperity::fuzz
