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

/// Reader of an entry's payload, in memory or in a file: numbers in the order in which they were
/// put. A copy reads on from the same place.
class PayloadReader {
public:
    /// Reads from memory.
    explicit PayloadReader(Bytes bytes) : left_(bytes.size()), bytes_(bytes) {}
    /// Reads `size` bytes of an open file from `offset` on. path: for messages; must outlive the
    /// reader.
    PayloadReader(int file, const std::string& path, std::uint64_t offset, std::uint64_t size)
        : left_(size), file_(file), path_(&path), offset_(offset) {}
    /// Returns the next number. Throws FileError at the end.
    template <class T>
    T get() {
        T value;
        take(std::as_writable_bytes(std::span(&value, 1)));
        return value;
    }
    /// Returns the next `count` numbers. Throws FileError at the end.
    template <class T>
    std::vector<T> get(std::size_t count) {
        std::vector<T> values(count);
        take(std::as_writable_bytes(std::span(values)));
        return values;
    }
    /// Returns all numbers that have not been read.
    template <class T>
    std::vector<T> remaining() {
        return get<T>(left_ / sizeof(T));
    }
    /// Returns true if all numbers have been read.
    bool at_end() const { return left_ == 0; }

private:
    void take(std::span<std::byte> to);
    std::uint64_t left_; ///< bytes
    Bytes bytes_{};      ///< numbers in memory that have not been read
    int file_ = -1;      ///< descriptor; -1: memory is read
    const std::string* path_ = nullptr;
    std::uint64_t offset_ = 0;
};

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
    void append(std::uint64_t kind, Bytes payload) {
        begin(kind, payload.size());
        add(payload);
    }
    /// Begins an entry whose `size` bytes of payload follow by add(). The entry is part of the
    /// journal when it is complete. Throws like append().
    void begin(std::uint64_t kind, std::uint64_t size);
    /// Appends a part of the payload of the entry that was begun. Throws like append().
    void add(Bytes part);
    /// Returns the mark of the present end.
    Mark mark() const { return complete_; }
    /// Flushes all entries to the disk. Throws FileError.
    void synchronize();
    /// Calls take with every entry, in their order. The reader reads the file and must not outlive
    /// the journal. Throws FileError.
    void replay(const std::function<void(std::uint64_t kind, PayloadReader payload)>& take) const;

private:
    void write(Bytes bytes);

    std::string path_;
    Descriptor file_;
    Mark complete_, written_;   ///< ends of the complete entries and of all that was written
    std::uint64_t missing_ = 0; ///< bytes that the entry that was begun still lacks
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

} // namespace asperity::io
