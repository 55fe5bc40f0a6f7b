// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The one way to write a file that matters: beside its place, every result of the system checked,
// brought to the disk, then renamed into its place, and the directory's entry brought to the disk
// too. Until then an earlier file of that name stays as it is, whatever happens.
//
// HDF5 files are written through it as well (hdf5_file.hpp), and end in a digest of all their bytes
// (seal), which readers check.
#pragma once

#include "io/directory.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>

namespace asperity::io {

class OutputFile {
public:
    /// Opens a temporary file beside it. Throws FileError.
    explicit OutputFile(const FilePlace& place);
    /// Not put in its place: gone.
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    int fd() const { return file_.get(); }
    const std::string& path() const { return path_; }
    /// Appends. Throws FileError.
    void write(std::span<const std::byte> bytes);
    /// Appends the digest of all bytes that are in the file.
    void seal();
    /// To the disk, and into its place. Throws FileError.
    void commit();

    /// How the names of temporary files end.
    static constexpr const char* suffix = ".part";

private:
    std::string path_;
    Directory directory_;
    std::string name_, temporary_;
    Descriptor file_;
    bool in_place_ = false;
};

/// Writes a text, whole or not at all. Throws FileError.
void write_whole(const FilePlace& place, const std::string& text);

/// All bytes to the file at this offset; false: errno says why not.
bool write_all(int fd, std::span<const std::byte> bytes, std::uint64_t offset);
/// Bytes of the file from this offset; fewer at its end; -1: errno says why.
std::ptrdiff_t read_some(int fd, std::span<std::byte> bytes, std::uint64_t offset);

/// Calls take with the first bytes of the file, part by part. False: there are fewer.
bool read_parts(int fd, std::uint64_t length,
                const std::function<void(std::span<const std::byte>)>& take);

/// What the end of a file says of it.
enum class Seal { none, whole, broken };
Seal check_seal(int fd);

} // namespace asperity::io
