// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A file that only grows: records, one after the other, of which a mark tells how many bytes there
// were at some moment, and their digest.
//
// A run appends to it what it finds; a checkpoint holds the mark of its moment. Whatever happened
// to the file after that moment (half a record, a full disk, a kill) is cut off when the run goes
// on from the checkpoint, and what came before it is checked against the digest.
#pragma once

#include "io/files.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <ranges>
#include <span>
#include <string>
#include <vector>

namespace asperity::io {

class Journal {
public:
    struct Mark {
        std::uint64_t bytes = 0;
        std::uint32_t digest = 0;
    };

    /// Whether the file holds the mark's bytes as they were.
    static bool holds(const Directory& directory, const std::string& name, const Mark& mark);
    /// Copies the mark's bytes from one directory into another. Throws FileError.
    static void copy(const Directory& from, const Directory& to, const std::string& name,
                     const Mark& mark);
    /// Opens the file (makes it where it is missing) and cuts it to its first bytes, which must be
    /// held. Throws FileError.
    Journal(const Directory& directory, const std::string& name, std::uint64_t bytes = 0);

    /// kind: what it is, a number of the caller's. Throws FileError, and does so again for every
    /// record after one that failed.
    void append(std::uint64_t kind, Bytes payload);
    Mark mark() const { return {bytes_, digest_}; }
    /// Brings all records to the disk. Throws FileError.
    void synchronize();
    /// All records from the first, one at a time. Throws FileError.
    void replay(const std::function<void(std::uint64_t kind, Bytes payload)>& take) const;

private:
    std::string path_;
    Descriptor file_;
    std::uint64_t bytes_ = 0;
    std::uint32_t digest_ = 0;
    bool failed_ = false;
};

/// Numbers of a record's payload, in the order they are put.
class PayloadWriter {
public:
    /// A number, or a range of them.
    template <class T>
    void put(const T& values) {
        if constexpr (std::ranges::contiguous_range<T>) {
            const Bytes bytes = std::as_bytes(std::span(values));
            bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
        } else {
            put(std::span(&values, 1));
        }
    }
    void reserve(std::size_t bytes) { bytes_.reserve(bytes); }
    Bytes bytes() const { return bytes_; }

private:
    std::vector<std::byte> bytes_;
};

class PayloadReader {
public:
    explicit PayloadReader(Bytes bytes) : bytes_(bytes) {}
    template <class T>
    T get() {
        return get<T>(1).front();
    }
    template <class T>
    std::vector<T> get(std::size_t count) {
        std::vector<T> values(count);
        take(std::as_writable_bytes(std::span(values)));
        return values;
    }
    bool at_end() const { return bytes_.empty(); }

private:
    void take(std::span<std::byte> to);
    Bytes bytes_;
};

} // namespace asperity::io
