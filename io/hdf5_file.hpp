// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// HDF5 without its handles: one class owns a file and checks every return code of the C library; an
// error says which file, which object, and what the library gave as the cause.
//
// Data sets are named by absolute paths ("/fields/relaxed/height"); missing groups of a path are
// created. Arrays are row-major, slowest index first. The stored type is the type written; readers
// convert. Collective (parallel) access is not used: one rank writes.
//
// A file is written like every other that matters (files.hpp): it appears in its place, whole and
// on the disk, when close() returns; without a close it is dropped. It ends in a digest of all its
// bytes, metadata included. (HDF5 ignores bytes after its own data.) The process of the program
// opens only files whose digest is right, because libhdf5 crashes on some damaged ones. Files that
// users bring are opened by a process of their own (hdf5_numbers.hpp).
#pragma once

#include "io/files.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace asperity::io {

/// An open HDF5 file.
class Hdf5File {
public:
    using Shape = std::vector<std::uint64_t>;
    using Attribute = std::variant<std::int64_t, double, std::string, std::vector<std::int64_t>,
                                   std::vector<std::string>>;

    enum class Mode { create, read, read_any };
    /// Opens a file. create: a new file, which replaces an old one. read: throws FileError if the
    /// file has no digest or its digest is wrong. read_any: accepts a file without a digest too.
    Hdf5File(const FilePlace& place, Mode mode);
    ~Hdf5File();
    Hdf5File(Hdf5File&&) noexcept;

    const std::string& path() const { return path_; }
    /// Puts a created file in its place. Throws FileError.
    void close();

    bool exists(const std::string& object) const;
    /// Creates the group and its parents, if they are missing.
    void make_group(const std::string& group);
    /// Returns the names of the members of a group, in alphabetical order.
    std::vector<std::string> members(const std::string& group) const;
    bool is_dataset(const std::string& object) const;
    /// Returns the paths of all data sets of numbers with so many dimensions, in alphabetical
    /// order.
    std::vector<std::string> datasets(std::size_t dimensions) const;
    /// Returns true if the values of a data set are plain integers or floats.
    bool holds_numbers(const std::string& dataset) const;
    /// Returns the size of the values of a data set in the file, bytes.
    std::uint64_t stored_bytes(const std::string& dataset) const;

    /// Writes an attribute of a group or data set, in place of one of the same name.
    void write_attribute(const std::string& object, const std::string& name,
                         const Attribute& value);
    /// Returns an attribute that is a text, nothing if the object has none of this name. Throws
    /// FileError if the attribute is of another kind.
    std::optional<std::string> text_attribute(const std::string& object,
                                              const std::string& name) const;
    /// Returns an attribute that is a number, nothing if the object has none of this name. Throws
    /// FileError if the attribute is of another kind.
    std::optional<double> number_attribute(const std::string& object,
                                           const std::string& name) const;

    /// Creates a data set of this shape and writes it; it must not exist yet. A compressed one is
    /// stored without loss by the filters shuffle and deflate, in blocks of rows, if the library
    /// has them. In this and the following functions T is double, float, std::int64_t,
    /// std::int32_t or std::uint8_t.
    template <class T>
    void write(const std::string& dataset, const Shape& shape, std::span<const T> data,
               bool compressed = false) {
        create(dataset, type(T()), shape, compressed);
        write_slab(dataset, Shape(shape.size(), 0), shape, data);
    }
    /// Creates a data set to be filled by write_slab or, if it has no rows yet ({0, ...}), by
    /// append.
    template <class T>
    void make_dataset(const std::string& dataset, const Shape& shape) {
        create(dataset, type(T()), shape);
    }
    /// Writes the block of extent count at offset.
    template <class T>
    void write_slab(const std::string& dataset, const Shape& offset, const Shape& count,
                    std::span<const T> data) {
        transfer(dataset, type(T()), offset, count, data.size(), nullptr, data.data());
    }
    /// Reads the block of extent count at offset.
    template <class T>
    void read_slab(const std::string& dataset, const Shape& offset, const Shape& count,
                   std::span<T> data) const {
        transfer(dataset, type(T()), offset, count, data.size(), data.data(), nullptr);
    }
    /// Reads the whole data set, converted to T by HDF5.
    template <class T>
    std::vector<T> read(const std::string& dataset) const {
        const Shape all = shape(dataset);
        std::vector<T> data(volume(all));
        read_slab<T>(dataset, Shape(all.size(), 0), all, data);
        return data;
    }
    Shape shape(const std::string& dataset) const;

    /// Appends whole rows to a data set.
    template <class T>
    void append(const std::string& dataset, std::span<const T> rows) {
        append(dataset, type(T()), rows.size(), rows.data());
    }

private:
    struct Open;

    /// Returns the library's type of a number.
    static std::int64_t type(double);
    static std::int64_t type(float);
    static std::int64_t type(std::int64_t);
    static std::int64_t type(std::int32_t);
    static std::int64_t type(std::uint8_t);
    static std::uint64_t volume(const Shape& shape);

    /// Creates a data set and the groups above it.
    void create(const std::string& dataset, std::int64_t type, const Shape& shape,
                bool compressed = false);
    /// Transfers a block from or to memory, which holds so many values.
    void transfer(const std::string& dataset, std::int64_t type, const Shape& offset,
                  const Shape& count, std::size_t values, void* read_into,
                  const void* write_from) const;
    void append(const std::string& dataset, std::int64_t type, std::size_t values,
                const void* rows);

    std::string path_;
    std::unique_ptr<Open> open_;
};

} // namespace asperity::io
