// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// An append-only file of entries. A mark holds the number of its bytes at some moment, and their
// digest.
//
// A run appends its results to the journal; a checkpoint holds the mark of the journal at that
// moment. When the run resumes from the checkpoint, the bytes before the mark are compared with the
// digest, and everything after the mark (incomplete entries after a full disk or a kill) is cut
// off.
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

/// An append-only file of entries.
class Journal {
public:
    /// Length of the file at some moment, bytes, and the digest of these bytes.
    struct Mark {
        std::uint64_t bytes = 0;
        std::uint32_t digest = 0;
    };

    /// Returns true if the file still begins with the bytes of the mark.
    static bool holds(const Directory& directory, const std::string& name, const Mark& mark);
    /// Copies the bytes of the mark from one directory into another. Throws FileError.
    static void copy(const Directory& from, const Directory& to, const std::string& name,
                     const Mark& mark);
    /// Opens or creates the file and cuts it to its first `bytes` bytes, which must exist. Throws
    /// FileError.
    Journal(const Directory& directory, const std::string& name, std::uint64_t bytes = 0);

    /// Appends an entry. kind: number of the caller's choice. Throws FileError; after a failure
    /// every further call throws too.
    void append(std::uint64_t kind, Bytes payload);
    /// Returns the mark of the present end.
    Mark mark() const { return {bytes_, digest_}; }
    /// Flushes all entries to the disk. Throws FileError.
    void synchronize();
    /// Calls take with every entry, in their order. Throws FileError.
    void replay(const std::function<void(std::uint64_t kind, Bytes payload)>& take) const;

private:
    std::string path_;
    Descriptor file_;
    std::uint64_t bytes_ = 0;
    std::uint32_t digest_ = 0;
    bool failed_ = false;
};

/// Writer of an entry's payload: numbers in the order in which they are put.
class PayloadWriter {
public:
    /// Appends a number, or a range of numbers.
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

/// Reader of an entry's payload: numbers in the order in which they were put.
class PayloadReader {
public:
    explicit PayloadReader(Bytes bytes) : bytes_(bytes) {}
    /// Returns the next number. Throws FileError at the end.
    template <class T>
    T get() {
        return get<T>(1).front();
    }
    /// Returns the next `count` numbers. Throws FileError at the end.
    template <class T>
    std::vector<T> get(std::size_t count) {
        std::vector<T> values(count);
        take(std::as_writable_bytes(std::span(values)));
        return values;
    }
    /// Returns true if all numbers have been read.
    bool at_end() const { return bytes_.empty(); }

private:
    void take(std::span<std::byte> to);
    Bytes bytes_;
};

} // namespace asperity::io
