// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// HDF5 files: one class owns a file and checks every return code of the C library; an error names
// the file, the object and the library's message.
//
// Data sets are named by absolute paths ("/fields/relaxed/height"); missing groups of a path are
// created. Arrays are row-major, slowest index first. The stored type is the type written; readers
// convert. Collective (parallel) access is not used: one rank writes.
//
// A file is written through OutputFile (files.hpp): it exists under its name, complete and on the
// disk, once close() returns, and is discarded without close(). It ends in a digest of all its
// bytes, metadata included. (HDF5 ignores bytes after its own data.) This process opens only files
// whose digest is right, because libhdf5 crashes on some damaged files. Users' files are opened by
// a child process (hdf5_numbers.hpp).
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
    /// Returns the number of values of a shape.
    static std::uint64_t volume(const Shape& shape);
    using Attribute = std::variant<std::int64_t, double, std::string, std::vector<std::int64_t>,
                                   std::vector<std::string>>;

    /// Mode of opening: a new file; a file with a digest; a file with or without a digest.
    enum class Mode { create, read, read_any };
    /// Opens a file; a created file replaces an old one in close(). Throws FileError if the file
    /// cannot be opened or its digest is wrong, with Mode::read also if it has none. All functions
    /// throw FileError on failure.
    Hdf5File(const FilePlace& place, Mode mode);
    ~Hdf5File();
    Hdf5File(Hdf5File&&) noexcept;

    const std::string& path() const { return path_; }
    /// Closes the file; renames a created file to its final name.
    void close();

    bool exists(const std::string& object) const; ///< returns true for a group or data set
    /// Creates the group and its parents, if they are missing.
    void make_group(const std::string& group);
    /// Returns the names of the members of a group, in alphabetical order.
    std::vector<std::string> members(const std::string& group) const;
    bool is_dataset(const std::string& object) const;
    /// Returns the paths of all data sets of numbers with this number of dimensions, in
    /// alphabetical order.
    std::vector<std::string> datasets(std::size_t dimensions) const;
    /// Returns true if the values of a data set are plain integers or floats.
    bool holds_numbers(const std::string& dataset) const;
    /// Returns the size of the values of a data set in the file, bytes.
    std::uint64_t stored_bytes(const std::string& dataset) const;

    /// Writes an attribute of a group or data set; replaces an attribute of the same name.
    void write_attribute(const std::string& object, const std::string& name,
                         const Attribute& value);
    /// Returns a text attribute; nothing if the object has no attribute of this name. Throws
    /// FileError if the attribute is not a text.
    std::optional<std::string> text_attribute(const std::string& object,
                                              const std::string& name) const;
    /// Returns a numeric attribute; nothing if the object has no attribute of this name. Throws
    /// FileError if the attribute is not a number.
    std::optional<double> number_attribute(const std::string& object,
                                           const std::string& name) const;

    /// Creates a data set and writes it. compressed: store in blocks of rows with the lossless
    /// filters shuffle and deflate, if the library has them. The data set must not exist. In this
    /// and the following functions T is double, float, std::int64_t, std::int32_t or std::uint8_t.
    template <class T>
    void write(const std::string& dataset, const Shape& shape, std::span<const T> data,
               bool compressed = false) {
        create(dataset, type(T()), shape, compressed);
        write_slab(dataset, Shape(shape.size(), 0), shape, data);
    }
    /// Creates a data set to be filled by write_slab(); one of shape {0, ...} grows by extend().
    /// compressed: as for write().
    template <class T>
    void make_dataset(const std::string& dataset, const Shape& shape, bool compressed = false) {
        create(dataset, type(T()), shape, compressed);
    }
    /// Writes a block of a data set. offset, count: first index and extent of the block.
    template <class T>
    void write_slab(const std::string& dataset, const Shape& offset, const Shape& count,
                    std::span<const T> data) {
        transfer(dataset, type(T()), offset, count, data.size(), nullptr, data.data());
    }
    /// Reads a block of a data set. offset, count: first index and extent of the block.
    template <class T>
    void read_slab(const std::string& dataset, const Shape& offset, const Shape& count,
                   std::span<T> data) const {
        transfer(dataset, type(T()), offset, count, data.size(), data.data(), nullptr);
    }
    /// Reads a whole data set, converted to T by HDF5.
    template <class T>
    std::vector<T> read(const std::string& dataset) const {
        const Shape all = shape(dataset);
        std::vector<T> data(volume(all));
        read_slab<T>(dataset, Shape(all.size(), 0), all, data);
        return data;
    }
    Shape shape(const std::string& dataset) const; ///< returns the shape of a data set

    /// Adds a row to a growing data set. Returns the index of the row.
    std::uint64_t extend(const std::string& dataset);

private:
    struct Open;

    /// Returns the library's type of a number.
    static std::int64_t type(double);
    static std::int64_t type(float);
    static std::int64_t type(std::int64_t);
    static std::int64_t type(std::int32_t);
    static std::int64_t type(std::uint8_t);

    /// Creates a data set and the groups above it.
    void create(const std::string& dataset, std::int64_t type, const Shape& shape,
                bool compressed = false);
    /// Transfers a block from or to memory with room for `values` values.
    void transfer(const std::string& dataset, std::int64_t type, const Shape& offset,
                  const Shape& count, std::size_t values, void* read_into,
                  const void* write_from) const;

    std::string path_;
    std::unique_ptr<Open> open_;
};

} // namespace asperity::io
