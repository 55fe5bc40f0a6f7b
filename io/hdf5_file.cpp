// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The C library prints its own error stack unless told not to; it is silenced once, and the stack's
// innermost entry becomes the cause in our message.
//
// The library does not survive a failed write: what it could not write stays in its caches, and
// closing the file, or its exit handler, may crash on it. So a file that could not be written is
// never closed, and the exit handler is not installed.
#include "io/hdf5_file.hpp"

#include "io/error.hpp"
#include "io/files.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <type_traits>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <hdf5.h>

namespace asperity::io {

static_assert(std::is_same_v<hid_t, std::int64_t>);

namespace {

/// The fastest level: higher ones make maps a few per cent smaller.
constexpr unsigned deflate_level = 1;

/// Returns the library's error from the bottom of its stack.
std::string cause(bool* by_system = nullptr) {
    std::string text;
    H5Ewalk2(
        H5E_DEFAULT, H5E_WALK_UPWARD,
        [](unsigned n, const H5E_error2_t* entry, void* out) -> herr_t {
            if (n == 0 && entry->desc) *static_cast<std::string*>(out) = entry->desc;
            return 0;
        },
        &text);
    // Error of a system call: "..., errno = 28, error message = 'No space left on device', ...".
    constexpr std::string_view system = "error message = '";
    if (const std::size_t at = text.find(system); at != std::string::npos) {
        if (by_system) *by_system = true;
        const std::size_t start = at + system.size();
        return text.substr(start, text.find('\'', start) - start);
    }
    return text.empty() ? "the HDF5 library gives no reason" : "HDF5: " + text;
}

std::vector<hsize_t> extents(const Hdf5File::Shape& shape) { return {shape.begin(), shape.end()}; }

/// Tells readers that the file ended in a digest when it was whole.
constexpr const char* seal_attribute = "asperity_digest";

/// Reason why the disk refused a file that is written; empty: it did not.
using Refusal = std::string;

/// One handle, closed by the function of its kind. refusal: message if closing fails, for objects
/// of a file that is written, whose data may reach the disk only then.
class Handle {
public:
    Handle(hid_t id, herr_t (*close)(hid_t), Refusal* refusal = nullptr)
        : id_(id), close_(close), refusal_(refusal) {}
    ~Handle() {
        if (id_ < 0 || (refusal_ && !refusal_->empty())) return;
        if (close_(id_) < 0 && refusal_) *refusal_ = cause();
    }
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    operator hid_t() const { return id_; }

private:
    hid_t id_;
    herr_t (*close_)(hid_t);
    Refusal* refusal_;
};

/// Result of the first call of the library in the process: a later one would find the exit handler
/// installed.
const herr_t no_exit_handler = H5dont_atexit();

/// Opens the file of a descriptor of this process, even if its directory was moved. Without the
/// library's locks: result_directory.hpp decides who may write a file.
hid_t open_descriptor(int fd, bool create) {
    const std::string path = fmt::format("/proc/self/fd/{}", fd);
    const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_file_locking(access, false, true);
    H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
    return create ? H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access)
                  : H5Fopen(path.c_str(), H5F_ACC_RDONLY, access);
}

} // namespace

/// Bytes of an open file, and the library's handle of it.
struct Hdf5File::Open {
    std::string path;
    std::unique_ptr<OutputFile> output; ///< null: the file is read
    Descriptor input;
    mutable Refusal refusal;
    hid_t id = -1;
    ~Open() {
        if (id >= 0 && refusal.empty()) H5Fclose(id);
    }

    /// Throws FileError if the disk has refused anything so far.
    void check_disk() const {
        if (!refusal.empty())
            throw FileError(path, "cannot be written", refusal, "check the space on its disk");
    }
    /// Throws FileError: what is wrong with the object, and the library's reason.
    [[noreturn]] void fail(const std::string& object, const std::string& what) const {
        check_disk();
        bool by_system = false;
        const std::string reason = cause(&by_system);
        if (output && by_system) refusal = reason;
        check_disk();
        throw FileError(path, object + " " + what, reason, "check that the file is whole");
    }
    /// Returns the handle of an object; fails if the library gave none.
    Handle handle(hid_t made, herr_t (*close)(hid_t), const std::string& object,
                  const std::string& what) const {
        if (made < 0) fail(object, what);
        return {made, close, output ? &refusal : nullptr};
    }
    Handle object(const std::string& name, const std::string& what) const {
        return handle(H5Oopen(id, name.c_str(), H5P_DEFAULT), H5Oclose, name, what);
    }
    Handle dataset(const std::string& name) const {
        return handle(H5Dopen2(id, name.c_str(), H5P_DEFAULT), H5Dclose, name, "is not a data set");
    }
    /// Calls read(attribute), which says whether it could: else fails with `what`. False where
    /// there is no such attribute.
    template <class Read>
    bool attribute(const std::string& object, const std::string& name, const std::string& what,
                   const Read& read) const {
        if (H5Aexists_by_name(id, object.c_str(), name.c_str(), H5P_DEFAULT) <= 0) return false;
        const Handle opened =
            handle(H5Aopen_by_name(id, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
                   H5Aclose, object, what);
        const Handle space(H5Aget_space(opened), H5Sclose);
        if (H5Sget_simple_extent_npoints(space) != 1 || !read(opened)) fail(object, what);
        return true;
    }
};

Hdf5File::Hdf5File(const FilePlace& place, Mode mode)
    : path_(place.path()), open_(std::make_unique<Open>()) {
    open_->path = path_;
    static const herr_t silenced = H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    static_cast<void>(silenced);
    static_cast<void>(no_exit_handler);
    const bool create = mode == Mode::create;
    if (create) {
        open_->output = std::make_unique<OutputFile>(place);
    } else {
        open_->input = place.open(O_RDONLY);
        if (!open_->input) fail_by_system(path_, "cannot be opened", "check the path");
        const Seal seal = check_seal(open_->input.get());
        if (seal == Seal::none && mode == Mode::read)
            throw FileError(
                path_, "cannot be opened",
                "it has no digest at its end: it was cut short, or another program wrote it",
                "take a copy that is whole");
        if (seal == Seal::broken)
            throw FileError(path_, "is damaged", "its bytes are not those its digest was made of",
                            "take a copy that is whole");
    }
    open_->id = open_descriptor(create ? open_->output->fd() : open_->input.get(), create);
    if (open_->id < 0)
        throw FileError(path_, create ? "cannot be created" : "cannot be opened", cause(),
                        create ? "check its directory and the space on its disk"
                               : "check that it is whole");
    if (create) write_attribute("/", seal_attribute, std::int64_t{1});
}

Hdf5File::~Hdf5File() = default;
Hdf5File::Hdf5File(Hdf5File&&) noexcept = default;

std::int64_t Hdf5File::type(double) { return H5T_NATIVE_DOUBLE; }
std::int64_t Hdf5File::type(float) { return H5T_NATIVE_FLOAT; }
std::int64_t Hdf5File::type(std::int64_t) { return H5T_NATIVE_INT64; }
std::int64_t Hdf5File::type(std::int32_t) { return H5T_NATIVE_INT32; }
std::int64_t Hdf5File::type(std::uint8_t) { return H5T_NATIVE_UINT8; }

std::uint64_t Hdf5File::volume(const Shape& shape) {
    return std::accumulate(shape.begin(), shape.end(), std::uint64_t{1}, std::multiplies<>());
}

void Hdf5File::close() {
    if (open_->id < 0) return;
    open_->check_disk();
    if (H5Fclose(std::exchange(open_->id, -1)) < 0) open_->fail("/", "cannot be written");
    if (!open_->output) return;
    open_->output->seal();
    open_->output->commit();
}

bool Hdf5File::exists(const std::string& object) const {
    if (object == "/") return true;
    // The library wants every group on the way looked at in turn.
    for (std::size_t slash = object.find('/', 1);; slash = object.find('/', slash + 1)) {
        if (H5Lexists(open_->id, object.substr(0, slash).c_str(), H5P_DEFAULT) <= 0) return false;
        if (slash == std::string::npos) return true;
    }
}

bool Hdf5File::is_dataset(const std::string& object) const {
    return exists(object) && H5Iget_type(open_->object(object, "cannot be opened")) == H5I_DATASET;
}

std::vector<std::string> Hdf5File::datasets(std::size_t dimensions) const {
    std::vector<std::string> names, found;
    const auto each = [](hid_t, const char* name, const H5L_info_t*, void* out) -> herr_t {
        auto& all = *static_cast<std::vector<std::string>*>(out);
        all.push_back(std::string("/") + name);
        return all.size() >= 10000 ? 1 : 0; // enough of them
    };
    if (H5Lvisit(open_->id, H5_INDEX_NAME, H5_ITER_INC, each, &names) < 0)
        open_->fail("/", "cannot be listed");
    for (const std::string& name : names)
        if (is_dataset(name) && holds_numbers(name) && shape(name).size() == dimensions)
            found.push_back(name);
    return found;
}

std::uint64_t Hdf5File::stored_bytes(const std::string& dataset) const {
    return H5Dget_storage_size(open_->dataset(dataset));
}

bool Hdf5File::holds_numbers(const std::string& dataset) const {
    const H5T_class_t kind = H5Tget_class(
        open_->handle(H5Dget_type(open_->dataset(dataset)), H5Tclose, dataset, "has no type"));
    return kind == H5T_INTEGER || kind == H5T_FLOAT;
}

void Hdf5File::make_group(const std::string& group) {
    if (group.empty() || exists(group)) return;
    make_group(group.substr(0, group.rfind('/')));
    open_->handle(H5Gcreate2(open_->id, group.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                  H5Gclose, group, "cannot be made as a group");
}

std::vector<std::string> Hdf5File::members(const std::string& group) const {
    const Handle opened = open_->handle(H5Gopen2(open_->id, group.c_str(), H5P_DEFAULT), H5Gclose,
                                        group, "cannot be opened as a group");
    std::vector<std::string> names;
    const auto each = [](hid_t, const char* name, const H5L_info_t*, void* out) -> herr_t {
        static_cast<std::vector<std::string>*>(out)->emplace_back(name);
        return 0;
    };
    if (H5Literate(opened, H5_INDEX_NAME, H5_ITER_INC, nullptr, each, &names) < 0)
        open_->fail(group, "cannot be listed");
    return names;
}

Hdf5File::Shape Hdf5File::shape(const std::string& dataset) const {
    if (!exists(dataset))
        throw FileError(path_, "has no data set " + dataset,
                        "the file was written by something else", "check the file");
    const Handle space =
        open_->handle(H5Dget_space(open_->dataset(dataset)), H5Sclose, dataset, "has no shape");
    std::vector<hsize_t> extent(H5S_MAX_RANK);
    const int rank = H5Sget_simple_extent_dims(space, extent.data(), nullptr);
    if (rank < 0) open_->fail(dataset, "has no shape");
    return {extent.begin(), extent.begin() + rank};
}

void Hdf5File::create(const std::string& dataset, std::int64_t type, const Shape& shape,
                      bool compressed) {
    make_group(dataset.substr(0, dataset.rfind('/')));
    const char* const what = "cannot be made";
    const Handle layout = open_->handle(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, dataset, what);
    // No times in the file: the same data are the same bytes.
    herr_t done = H5Pset_obj_track_times(layout, false);
    std::vector<hsize_t> most = extents(shape), chunk = most;
    const bool grows = !shape.empty() && shape[0] == 0;
    compressed = compressed && !grows && volume(shape) > 0 &&
                 H5Zfilter_avail(H5Z_FILTER_SHUFFLE) > 0 && H5Zfilter_avail(H5Z_FILTER_DEFLATE) > 0;
    if (grows || compressed) { // chunks of about this number of bytes, or of one row
        const std::uint64_t row = H5Tget_size(type) * volume({shape.begin() + 1, shape.end()}),
                            rows = (grows ? 8192 : 262144) / std::max<std::uint64_t>(1, row);
        chunk[0] = std::clamp<hsize_t>(rows, 1, grows ? rows + 1 : shape[0]);
        done = std::min(done, H5Pset_chunk(layout, static_cast<int>(chunk.size()), chunk.data()));
    }
    if (grows) most[0] = H5S_UNLIMITED;
    if (compressed)
        done = std::min({done, H5Pset_shuffle(layout), H5Pset_deflate(layout, deflate_level)});
    if (done < 0) open_->fail(dataset, what);
    const Handle space = open_->handle(
        H5Screate_simple(static_cast<int>(shape.size()), extents(shape).data(), most.data()),
        H5Sclose, dataset, what);
    open_->handle(
        H5Dcreate2(open_->id, dataset.c_str(), type, space, H5P_DEFAULT, layout, H5P_DEFAULT),
        H5Dclose, dataset, what);
}

void Hdf5File::transfer(const std::string& dataset, std::int64_t type, const Shape& offset,
                        const Shape& count, std::size_t values, void* read_into,
                        const void* write_from) const {
    const int rank = static_cast<int>(count.size());
    const Handle set = open_->dataset(dataset), file(H5Dget_space(set), H5Sclose),
                 memory(H5Screate_simple(rank, extents(count).data(), nullptr), H5Sclose);
    bool done = offset.size() == count.size() && values == volume(count) &&
                H5Sget_simple_extent_ndims(file) == rank;
    if (done && rank > 0)
        done = H5Sselect_hyperslab(file, H5S_SELECT_SET, extents(offset).data(), nullptr,
                                   extents(count).data(), nullptr) >= 0 &&
               H5Sselect_valid(file) > 0;
    if (done && values > 0)
        done = (read_into ? H5Dread(set, type, memory, file, H5P_DEFAULT, read_into)
                          : H5Dwrite(set, type, memory, file, H5P_DEFAULT, write_from)) >= 0;
    if (!done)
        open_->fail(dataset, fmt::format("does not {} a block of {} at {}",
                                         read_into ? "give" : "take", count, offset));
    open_->check_disk();
}

std::uint64_t Hdf5File::extend(const std::string& dataset) {
    Shape now = shape(dataset);
    const std::uint64_t row = now.at(0)++;
    if (H5Dset_extent(open_->dataset(dataset), extents(now).data()) < 0)
        open_->fail(dataset, "cannot be appended to");
    return row;
}

void Hdf5File::write_attribute(const std::string& object, const std::string& name,
                               const Attribute& value) {
    const std::string what = "cannot take the attribute " + name;
    const auto put = [&](hid_t type, int rank, hsize_t count, const void* data) {
        const Handle owner = open_->object(object, what);
        if (H5Aexists(owner, name.c_str()) > 0) H5Adelete(owner, name.c_str());
        const Handle space(H5Screate_simple(rank, &count, nullptr), H5Sclose);
        const Handle attribute =
            open_->handle(H5Acreate2(owner, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT),
                          H5Aclose, object, what);
        if (H5Awrite(attribute, type, data) < 0) open_->fail(object, what);
    };
    const auto put_text = [&](std::size_t size, int rank, hsize_t count, const void* data) {
        const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
        if (H5Tset_size(type, size) < 0 || H5Tset_cset(type, H5T_CSET_UTF8) < 0 ||
            H5Tset_strpad(type, rank == 0 ? H5T_STR_NULLTERM : H5T_STR_NULLPAD) < 0)
            open_->fail(object, what);
        put(type, rank, count, data);
    };
    const auto write = [&]<class T>(const T& it) {
        if constexpr (std::is_same_v<T, std::string>) {
            // Strings of variable length are text to Python, fixed ones are bytes.
            const char* start = it.c_str();
            put_text(H5T_VARIABLE, 0, 1, &start);
        } else if constexpr (std::is_same_v<T, std::vector<std::string>>) {
            std::size_t longest = 1;
            for (const std::string& text : it)
                longest = std::max(longest, text.size());
            std::string padded;
            for (const std::string& text : it)
                padded += text + std::string(longest - text.size(), '\0');
            put_text(longest, 1, it.size(), padded.data());
        } else if constexpr (std::is_same_v<T, std::vector<std::int64_t>>) {
            put(type(std::int64_t()), 1, it.size(), it.data());
        } else {
            put(type(it), 0, 1, &it);
        }
    };
    std::visit(write, value);
}

std::optional<std::string> Hdf5File::text_attribute(const std::string& object,
                                                    const std::string& name) const {
    const std::string what = "has an attribute " + name + " that is not one string";
    constexpr std::size_t longest = 1u << 16;
    std::string text;
    const bool found = open_->attribute(object, name, what, [&](hid_t attribute) {
        const Handle type(H5Aget_type(attribute), H5Tclose);
        if (H5Tget_class(type) != H5T_STRING) return false;
        if (H5Tis_variable_str(type) > 0) {
            char* data = nullptr;
            if (H5Aread(attribute, type, &data) < 0) return false;
            if (data) text = data;
            H5free_memory(data);
            return true;
        }
        const std::size_t size = H5Tget_size(type);
        if (size > longest) return false;
        text.resize(size);
        if (H5Aread(attribute, type, text.data()) < 0) return false;
        text.resize(std::min(text.find('\0'), size)); // or blanks, as Fortran pads
        text.resize(text.find_last_not_of(' ') + 1);
        return true;
    });
    return found ? std::optional(text) : std::nullopt;
}

std::optional<double> Hdf5File::number_attribute(const std::string& object,
                                                 const std::string& name) const {
    double value = 0.0;
    const bool found =
        open_->attribute(object, name, "has no number as attribute " + name, [&](hid_t attribute) {
            return H5Aread(attribute, H5T_NATIVE_DOUBLE, &value) >= 0;
        });
    return found ? std::optional(value) : std::nullopt;
}

} // namespace asperity::io
