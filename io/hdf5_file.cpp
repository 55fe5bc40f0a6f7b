// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The C library prints its own error stack unless told not to; it is silenced once, and the stack's
// innermost entry becomes the cause in our message.
#include "io/hdf5_file.hpp"

#include "io/error.hpp"
#include "io/hdf5_disk.hpp"
#include "io/hdf5_handle.hpp"
#include "io/output_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <functional>
#include <numeric>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace asperity::io {

namespace {

void silence() {
    static const herr_t once = H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    static_cast<void>(once);
}

/// What the library says went wrong, from the bottom of its stack.
std::string cause() {
    std::string text;
    H5Ewalk2(
        H5E_DEFAULT, H5E_WALK_UPWARD,
        [](unsigned n, const H5E_error2_t* entry, void* out) -> herr_t {
            if (n == 0 && entry->desc) *static_cast<std::string*>(out) = entry->desc;
            return 0;
        },
        &text);
    return text.empty() ? "the HDF5 library gives no reason" : "HDF5: " + text;
}

std::uint64_t volume(const Hdf5File::Shape& shape) {
    return std::accumulate(shape.begin(), shape.end(), std::uint64_t{1}, std::multiplies<>());
}

std::vector<hsize_t> extents(const Hdf5File::Shape& shape) { return {shape.begin(), shape.end()}; }

} // namespace

/// Where the bytes are: a file under construction, or one that is read.
class Hdf5File::Storage {
public:
    explicit Storage(std::unique_ptr<OutputFile> created) : output(std::move(created)) {
        disk.fd = output->fd();
    }
    explicit Storage(Descriptor opened) : input(std::move(opened)) { disk.fd = input.get(); }

    std::unique_ptr<OutputFile> output; ///< null: the file is read
    Descriptor input;
    Hdf5Disk disk;
};

namespace {

/// Tells readers that the file ended in a digest when it was whole.
constexpr const char* seal_attribute = "asperity_digest";

} // namespace

Hdf5File::Hdf5File(const FilePlace& place, Mode mode) : path_(place.path()) {
    silence();
    if (mode == Mode::read) {
        storage_ = std::make_unique<Storage>(place.open(O_RDONLY));
        open_to_read();
        return;
    }
    storage_ = std::make_unique<Storage>(std::make_unique<OutputFile>(place));
    const Hdf5Handle access(hdf5_access(storage_->disk), H5Pclose);
    id_ = H5Fcreate(path_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
    if (id_ < 0)
        throw FileError(path_, "cannot be created", cause(),
                        "check its directory and the space on its disk");
    try {
        write_attribute("/", seal_attribute, std::int64_t{1});
    } catch (...) {
        H5Fclose(std::exchange(id_, -1));
        throw;
    }
}

void Hdf5File::open_to_read() {
    if (!storage_->input)
        throw FileError(path_, "cannot be opened", std::strerror(errno), "check the path");
    const Seal seal = check_seal(storage_->input.get());
    if (seal == Seal::none)
        throw FileError(
            path_, "cannot be opened",
            "it has no digest at its end: it was cut short, or another program wrote it",
            "take a copy that is whole");
    if (seal == Seal::broken)
        throw FileError(path_, "is damaged", "its bytes are not those its digest was made of",
                        "take a copy that is whole");
    const Hdf5Handle access(hdf5_access(storage_->disk), H5Pclose);
    id_ = H5Fopen(path_.c_str(), H5F_ACC_RDONLY, access);
    if (id_ < 0) throw FileError(path_, "cannot be opened", cause(), "check that it is whole");
}

Hdf5File::~Hdf5File() {
    if (id_ >= 0) H5Fclose(id_);
}

Hdf5File::Hdf5File(Hdf5File&& other) noexcept
    : path_(std::move(other.path_)), storage_(std::move(other.storage_)),
      id_(std::exchange(other.id_, -1)) {}

void Hdf5File::fail(const std::string& object, const std::string& what) const {
    check_disk();
    throw FileError(path_, object.empty() ? what : object + " " + what, cause(),
                    "check that the file is whole");
}

void Hdf5File::check_disk() const {
    if (storage_ && storage_->disk.error != 0)
        throw FileError(path_, "cannot be written", std::strerror(storage_->disk.error),
                        "check the space on its disk");
}

void Hdf5File::close() {
    if (id_ < 0) return;
    if (H5Fclose(std::exchange(id_, -1)) < 0) fail("", "cannot be closed");
    check_disk();
    if (storage_->output) {
        storage_->output->seal();
        storage_->output->commit();
    }
    storage_.reset();
}

bool Hdf5File::exists(const std::string& object) const {
    if (object == "/") return true;
    // The library wants every group on the way looked at in turn.
    for (std::size_t slash = object.find('/', 1);; slash = object.find('/', slash + 1)) {
        if (H5Lexists(id_, object.substr(0, slash).c_str(), H5P_DEFAULT) <= 0) return false;
        if (slash == std::string::npos) return true;
    }
}

int Hdf5File::kind(const std::string& object) const {
    if (!exists(object)) return H5I_BADID;
    const Hdf5Handle handle(H5Oopen(id_, object.c_str(), H5P_DEFAULT), H5Oclose);
    if (!handle.good()) fail(object, "cannot be opened");
    return H5Iget_type(handle);
}

bool Hdf5File::is_dataset(const std::string& object) const { return kind(object) == H5I_DATASET; }

bool Hdf5File::is_group(const std::string& object) const { return kind(object) == H5I_GROUP; }

Hdf5Handle Hdf5File::open(const std::string& dataset) const {
    const hid_t set = H5Dopen2(id_, dataset.c_str(), H5P_DEFAULT);
    if (set < 0) fail(dataset, "is not a data set");
    return {set, H5Dclose};
}

bool Hdf5File::holds_numbers(const std::string& dataset) const {
    const Hdf5Handle set = open(dataset), type(H5Dget_type(set), H5Tclose);
    const H5T_class_t kind = type.good() ? H5Tget_class(type) : H5T_NO_CLASS;
    return kind == H5T_INTEGER || kind == H5T_FLOAT;
}

void Hdf5File::make_group(const std::string& group) {
    if (group.empty() || exists(group)) return;
    const std::size_t slash = group.rfind('/');
    if (slash != std::string::npos && slash > 0) make_group(group.substr(0, slash));
    const Hdf5Handle made(H5Gcreate2(id_, group.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                          H5Gclose);
    if (!made.good()) fail(group, "cannot be made as a group");
}

std::vector<std::string> Hdf5File::members(const std::string& group) const {
    const Hdf5Handle handle(H5Gopen2(id_, group.c_str(), H5P_DEFAULT), H5Gclose);
    if (!handle.good()) fail(group, "cannot be opened as a group");
    std::vector<std::string> names;
    const auto each = [](hid_t, const char* name, const H5L_info_t*, void* out) -> herr_t {
        static_cast<std::vector<std::string>*>(out)->emplace_back(name);
        return 0;
    };
    if (H5Literate(handle, H5_INDEX_NAME, H5_ITER_INC, nullptr, each, &names) < 0)
        fail(group, "cannot be listed");
    return names;
}

void Hdf5File::create(const std::string& dataset, std::int64_t type, std::int64_t space,
                      const Shape& chunk) {
    if (const std::size_t slash = dataset.rfind('/'); slash != std::string::npos && slash > 0)
        make_group(dataset.substr(0, slash));
    const Hdf5Handle layout(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    const int rank = static_cast<int>(chunk.size());
    // No times in the file: the same data are the same bytes.
    if (!layout.good() || H5Pset_obj_track_times(layout, false) < 0 ||
        (rank > 0 && H5Pset_chunk(layout, rank, extents(chunk).data()) < 0))
        fail(dataset, "cannot be made");
    const Hdf5Handle set(
        H5Dcreate2(id_, dataset.c_str(), type, space, H5P_DEFAULT, layout, H5P_DEFAULT), H5Dclose);
    if (!set.good()) fail(dataset, "cannot be made");
}

template <class T>
void Hdf5File::make_dataset(const std::string& dataset, const Shape& shape) {
    const int rank = static_cast<int>(shape.size());
    const Hdf5Handle space(rank == 0 ? H5Screate(H5S_SCALAR)
                                     : H5Screate_simple(rank, extents(shape).data(), nullptr),
                           H5Sclose);
    create(dataset, hdf5_type<T>(), space, {});
}

template <class T>
void Hdf5File::write(const std::string& dataset, const Shape& shape, std::span<const T> data) {
    if (data.size() != volume(shape))
        throw FileError(path_, dataset + " cannot be written",
                        fmt::format("{} values for a shape of {}", data.size(), volume(shape)),
                        "this is a mistake in the program");
    make_dataset<T>(dataset, shape);
    if (!data.empty() &&
        H5Dwrite(open(dataset), hdf5_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, data.data()) < 0)
        fail(dataset, "cannot be written");
    check_disk();
}

namespace {

/// The file's side of a slab, and the memory's.
bool transfer(hid_t set, hid_t type, const Hdf5File::Shape& offset, const Hdf5File::Shape& count,
              void* read_into, const void* write_from) {
    const Hdf5Handle file_space(H5Dget_space(set), H5Sclose);
    const std::vector<hsize_t> start = extents(offset), extent = extents(count);
    const Hdf5Handle memory(
        H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr), H5Sclose);
    if (!file_space.good() || !memory.good() ||
        H5Sget_simple_extent_ndims(file_space) != static_cast<int>(count.size()) ||
        H5Sselect_hyperslab(file_space, H5S_SELECT_SET, start.data(), nullptr, extent.data(),
                            nullptr) < 0 ||
        H5Sselect_valid(file_space) <= 0)
        return false;
    if (read_into) return H5Dread(set, type, memory, file_space, H5P_DEFAULT, read_into) >= 0;
    return H5Dwrite(set, type, memory, file_space, H5P_DEFAULT, write_from) >= 0;
}

} // namespace

template <class T>
void Hdf5File::write_slab(const std::string& dataset, const Shape& offset, const Shape& count,
                          std::span<const T> data) {
    if (offset.size() != count.size() || data.size() != volume(count) ||
        !transfer(open(dataset), hdf5_type<T>(), offset, count, nullptr, data.data()))
        fail(dataset, fmt::format("does not take a block of {} at {}", count, offset));
    check_disk();
}

template <class T>
void Hdf5File::read_slab(const std::string& dataset, const Shape& offset, const Shape& count,
                         std::span<T> data) const {
    if (offset.size() != count.size() || data.size() != volume(count) ||
        !transfer(open(dataset), hdf5_type<T>(), offset, count, data.data(), nullptr))
        fail(dataset, fmt::format("does not give a block of {} at {}", count, offset));
}

template <class T>
std::vector<T> Hdf5File::read(const std::string& dataset) const {
    std::vector<T> data(volume(shape(dataset)));
    if (!data.empty() &&
        H5Dread(open(dataset), hdf5_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, data.data()) < 0)
        fail(dataset, "cannot be read");
    return data;
}

Hdf5File::Shape Hdf5File::shape(const std::string& dataset) const {
    if (!exists(dataset))
        throw FileError(path_, "has no data set " + dataset,
                        "the file was written by something else", "check the file");
    const Hdf5Handle space(H5Dget_space(open(dataset)), H5Sclose);
    const int rank = space.good() ? H5Sget_simple_extent_ndims(space) : -1;
    if (rank < 0) fail(dataset, "has no shape");
    std::vector<hsize_t> extent(static_cast<std::size_t>(rank));
    if (rank > 0 && H5Sget_simple_extent_dims(space, extent.data(), nullptr) < 0)
        fail(dataset, "has no shape");
    return {extent.begin(), extent.end()};
}

template <class T>
void Hdf5File::make_series(const std::string& dataset, const Shape& row) {
    std::vector<hsize_t> extent = {0}, most = {H5S_UNLIMITED};
    extent.insert(extent.end(), row.begin(), row.end());
    most.insert(most.end(), row.begin(), row.end());
    // About 8 kB a chunk for plain series, at least one row for others.
    const std::uint64_t bytes = std::max<std::uint64_t>(1, volume(row) * sizeof(T));
    Shape chunk(extent.begin(), extent.end());
    chunk[0] = std::max<std::uint64_t>(1, 8192 / bytes);
    const Hdf5Handle space(
        H5Screate_simple(static_cast<int>(extent.size()), extent.data(), most.data()), H5Sclose);
    create(dataset, hdf5_type<T>(), space, chunk);
}

template <class T>
void Hdf5File::append(const std::string& dataset, std::span<const T> rows) {
    if (rows.empty()) return;
    Shape now = shape(dataset);
    const std::uint64_t row = volume(Shape(now.begin() + (now.empty() ? 0 : 1), now.end()));
    const Hdf5Handle set = open(dataset);
    if (now.empty() || row == 0 || rows.size() % row != 0)
        fail(dataset, "does not take these rows");
    Shape offset(now.size(), 0), count = now;
    offset[0] = now[0];
    count[0] = rows.size() / row;
    now[0] += count[0];
    const std::vector<hsize_t> extent = extents(now);
    if (H5Dset_extent(set, extent.data()) < 0 ||
        !transfer(set, hdf5_type<T>(), offset, count, nullptr, rows.data()))
        fail(dataset, "cannot be appended to");
    check_disk();
}

#define ASPERITY_HDF5_TYPE(T)                                                                      \
    template void Hdf5File::write<T>(const std::string&, const Shape&, std::span<const T>);        \
    template void Hdf5File::make_dataset<T>(const std::string&, const Shape&);                     \
    template void Hdf5File::write_slab<T>(const std::string&, const Shape&, const Shape&,          \
                                          std::span<const T>);                                     \
    template void Hdf5File::read_slab<T>(const std::string&, const Shape&, const Shape&,           \
                                         std::span<T>) const;                                      \
    template std::vector<T> Hdf5File::read<T>(const std::string&) const;                           \
    template void Hdf5File::make_series<T>(const std::string&, const Shape&);                      \
    template void Hdf5File::append<T>(const std::string&, std::span<const T>);
ASPERITY_HDF5_TYPE(double)
ASPERITY_HDF5_TYPE(float)
ASPERITY_HDF5_TYPE(std::int64_t)
ASPERITY_HDF5_TYPE(std::int32_t)
ASPERITY_HDF5_TYPE(std::uint8_t)
#undef ASPERITY_HDF5_TYPE

} // namespace asperity::io
