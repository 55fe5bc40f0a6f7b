// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/hdf5_disk.hpp"

#include "io/hdf5_handle.hpp"
#include "io/output_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include <sys/stat.h>
#include <unistd.h>

#if H5_VERSION_GE(1, 13, 0)
#include <H5FDdevelop.h>
#endif

namespace asperity::io {

bool Hdf5Disk::read(std::uint64_t offset, std::span<std::byte> bytes) {
    const std::ptrdiff_t n = read_some(fd, bytes, offset);
    if (n < 0) return false;
    std::fill(bytes.begin() + n, bytes.end(), std::byte{0}); // beyond the end of the file
    for (const auto& [at, data] : kept) {
        const std::uint64_t from = std::max(at, offset);
        const std::uint64_t to = std::min(at + data.size(), offset + bytes.size());
        if (from < to)
            std::memcpy(bytes.data() + (from - offset), data.data() + (from - at), to - from);
    }
    return true;
}

void Hdf5Disk::write(std::uint64_t offset, std::span<const std::byte> bytes) {
    if (error == 0 && write_all(fd, bytes, offset)) return;
    if (error == 0) error = errno;
    kept.emplace_back(offset, std::vector<std::byte>(bytes.begin(), bytes.end()));
}

void Hdf5Disk::cut(std::uint64_t size) {
    if (error == 0 && ::ftruncate(fd, static_cast<off_t>(size)) != 0) error = errno;
}

namespace {

/// The library's view of an open file; what it asks of a driver follows.
struct OpenFile {
    H5FD_t head;
    Hdf5Disk* disk;
    haddr_t end_of_allocation;
    haddr_t end_of_file;
};

OpenFile& file_of(H5FD_t* file) { return *reinterpret_cast<OpenFile*>(file); }
const OpenFile& file_of(const H5FD_t* file) { return *reinterpret_cast<const OpenFile*>(file); }

constexpr haddr_t largest = (haddr_t{1} << 62) - 1;

H5FD_t* open_disk(const char*, unsigned, hid_t access, haddr_t) {
    const auto* disk = static_cast<Hdf5Disk* const*>(H5Pget_driver_info(access));
    struct stat status {};
    if (!disk || ::fstat((*disk)->fd, &status) != 0) return nullptr;
    auto* file = new OpenFile{};
    file->disk = *disk;
    file->end_of_file = static_cast<haddr_t>(status.st_size);
    return &file->head;
}

herr_t close_disk(H5FD_t* file) {
    delete &file_of(file);
    return 0;
}

int compare_disks(const H5FD_t* a, const H5FD_t* b) {
    const int x = file_of(a).disk->fd, y = file_of(b).disk->fd;
    return x < y ? -1 : x > y ? 1 : 0;
}

herr_t query_disk(const H5FD_t*, unsigned long* flags) {
    if (flags)
        *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA |
                 H5FD_FEAT_DATA_SIEVE | H5FD_FEAT_AGGREGATE_SMALLDATA;
    return 0;
}

haddr_t end_of_allocation(const H5FD_t* file, H5FD_mem_t) {
    return file_of(file).end_of_allocation;
}

herr_t allocate_up_to(H5FD_t* file, H5FD_mem_t, haddr_t end) {
    file_of(file).end_of_allocation = end;
    return 0;
}

haddr_t end_of_file(const H5FD_t* file, H5FD_mem_t) { return file_of(file).end_of_file; }

herr_t read_disk(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t at, std::size_t size, void* to) {
    return file_of(file).disk->read(at, {static_cast<std::byte*>(to), size}) ? 0 : -1;
}

herr_t write_disk(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t at, std::size_t size, const void* from) {
    OpenFile& f = file_of(file);
    f.disk->write(at, {static_cast<const std::byte*>(from), size});
    f.end_of_file = std::max(f.end_of_file, at + static_cast<haddr_t>(size));
    return 0;
}

/// The file ends where the library's data end.
herr_t truncate_disk(H5FD_t* file, hid_t, hbool_t) {
    OpenFile& f = file_of(file);
    if (f.end_of_allocation == f.end_of_file) return 0;
    f.disk->cut(f.end_of_allocation);
    f.end_of_file = f.end_of_allocation;
    return 0;
}

H5FD_class_t make_driver() {
    const H5FD_mem_t by_kind[H5FD_MEM_NTYPES] = H5FD_FLMAP_DICHOTOMY;
    H5FD_class_t driver{};
#ifdef H5FD_CLASS_VERSION
    driver.version = H5FD_CLASS_VERSION;
#endif
#if H5_VERSION_GE(1, 13, 0)
    driver.value = static_cast<H5FD_class_value_t>(600); // beyond those that are given out
#endif
    driver.name = "asperity";
    driver.maxaddr = largest;
    driver.fc_degree = H5F_CLOSE_STRONG;
    driver.fapl_size = sizeof(Hdf5Disk*);
    driver.open = open_disk;
    driver.close = close_disk;
    driver.cmp = compare_disks;
    driver.query = query_disk;
    driver.get_eoa = end_of_allocation;
    driver.set_eoa = allocate_up_to;
    driver.get_eof = end_of_file;
    driver.read = read_disk;
    driver.write = write_disk;
    driver.truncate = truncate_disk;
    std::copy(std::begin(by_kind), std::end(by_kind), std::begin(driver.fl_map));
    return driver;
}

} // namespace

std::int64_t hdf5_access(Hdf5Disk& disk) {
    static const H5FD_class_t driver = make_driver();
    static const hid_t id = H5FDregister(&driver);
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    Hdf5Disk* where = &disk;
    if (access >= 0 && (id < 0 || H5Pset_driver(access, id, &where) < 0)) {
        H5Pclose(access);
        return -1;
    }
    return access;
}

} // namespace asperity::io
