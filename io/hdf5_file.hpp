// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// HDF5 without its handles: one class owns a file, every return code of the C library is looked at,
// and a failure says which file, which object, and what the library gave as the cause.
//
// Data sets are named by absolute paths ("/fields/zero-load/height"); groups on the way are made as
// needed. Arrays are row-major, slowest index first. The stored type is the type written:
// conversions are left to the reader. Collective (parallel) access is not used; one rank writes.
//
// A file is written like every other that matters (output_file.hpp): it appears in its place, whole
// and on the disk, when close() returns; without a close it is dropped. It ends in a digest of all
// its bytes, metadata included. (HDF5 ignores what comes after its own data.) Only files whose
// digest is right are opened: libhdf5 crashes on some damaged ones.
#pragma once

#include "io/directory.hpp"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace asperity::io {

class Hdf5Handle;

class Hdf5File {
public:
    using Shape = std::vector<std::uint64_t>;

    enum class Mode { create, read };
    /// create: a new file, which replaces an old one. read: throws FileError if the file is damaged
    /// as far as its digest tells, or has none.
    Hdf5File(const FilePlace& place, Mode mode);
    ~Hdf5File();
    Hdf5File(Hdf5File&& other) noexcept;

    const std::string& path() const { return path_; }
    /// Puts a file that was created in its place. Throws FileError.
    void close();

    bool exists(const std::string& object) const;
    /// Makes the group and those above it, if they are not there.
    void make_group(const std::string& group);
    /// Names of the members of a group, in alphabetical order.
    std::vector<std::string> members(const std::string& group) const;
    bool is_dataset(const std::string& object) const;
    bool is_group(const std::string& object) const;
    /// Of a data set: are its values plain integers or floats?
    bool holds_numbers(const std::string& dataset) const;

    /// Attributes of a group or data set; written over if there.
    void write_attribute(const std::string& object, const std::string& name,
                         const std::string& value);
    void write_attribute(const std::string& object, const std::string& name, const char* value) {
        write_attribute(object, name, std::string(value));
    }
    /// T: double or std::int64_t.
    template <class T>
    void write_attribute(const std::string& object, const std::string& name, T value);
    template <class T>
    void write_attribute(const std::string& object, const std::string& name,
                         const std::vector<T>& value);
    void write_text_list_attribute(const std::string& object, const std::string& name,
                                   const std::vector<std::string>& value);
    bool has_attribute(const std::string& object, const std::string& name) const;
    std::string read_text_attribute(const std::string& object, const std::string& name) const;
    /// T: double or std::int64_t.
    template <class T>
    T read_attribute(const std::string& object, const std::string& name) const;

    /// T: double, float, std::int64_t, std::int32_t or std::uint8_t, in all that follows.
    /// Makes a data set of this shape and writes it; it must not be there yet.
    template <class T>
    void write(const std::string& dataset, const Shape& shape, std::span<const T> data);
    template <class T>
    void write(const std::string& dataset, const Shape& shape, const std::vector<T>& data) {
        write<T>(dataset, shape, std::span<const T>(data));
    }
    /// Makes a data set to be filled by write_slab.
    template <class T>
    void make_dataset(const std::string& dataset, const Shape& shape);
    /// Writes, reads the block at offset of extent count.
    template <class T>
    void write_slab(const std::string& dataset, const Shape& offset, const Shape& count,
                    std::span<const T> data);
    template <class T>
    void read_slab(const std::string& dataset, const Shape& offset, const Shape& count,
                   std::span<T> data) const;
    /// The whole data set, converted to T by HDF5.
    template <class T>
    std::vector<T> read(const std::string& dataset) const;
    Shape shape(const std::string& dataset) const;

    /// A data set whose first index grows; row: the shape of one row ({} : a plain series).
    template <class T>
    void make_series(const std::string& dataset, const Shape& row = {});
    /// Appends whole rows.
    template <class T>
    void append(const std::string& dataset, std::span<const T> rows);

private:
    class Storage;
    void open_to_read();
    /// The kind of object that this is (H5I_type_t); not there: none.
    int kind(const std::string& object) const;
    Hdf5Handle open(const std::string& dataset) const;
    /// Makes a data set, and the groups above it; chunk: {} where its size is fixed.
    void create(const std::string& dataset, std::int64_t type, std::int64_t space,
                const Shape& chunk);
    /// Drops an old attribute of that name, makes the new one and writes it.
    void put_attribute(const std::string& object, const std::string& name, std::int64_t type,
                       std::int64_t space, const void* data);
    [[noreturn]] void fail(const std::string& object, const std::string& what) const;
    /// Throws FileError if the disk has refused anything so far.
    void check_disk() const;

    std::string path_;
    std::unique_ptr<Storage> storage_;
    std::int64_t id_ = -1;
};

} // namespace asperity::io
