// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/hdf5_disk.hpp"

#include "io/files.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include <hdf5.h>
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

namespace {

/// The library's view of an open file.
struct OpenFile {
    H5FD_t head;
    Hdf5Disk* disk;
    haddr_t end_of_allocation;
    haddr_t end_of_file;
};

OpenFile& of(H5FD_t* file) { return *reinterpret_cast<OpenFile*>(file); }
const OpenFile& of(const H5FD_t* file) { return *reinterpret_cast<const OpenFile*>(file); }

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
    driver.maxaddr = (haddr_t{1} << 62) - 1;
    driver.fc_degree = H5F_CLOSE_STRONG;
    driver.fapl_size = sizeof(Hdf5Disk*);
    std::copy(std::begin(by_kind), std::end(by_kind), std::begin(driver.fl_map));
    driver.open = [](const char*, unsigned, hid_t access, haddr_t) -> H5FD_t* {
        const auto* disk = static_cast<Hdf5Disk* const*>(H5Pget_driver_info(access));
        struct stat status {};
        if (!disk || ::fstat((*disk)->fd, &status) != 0) return nullptr;
        auto* file = new OpenFile{};
        file->disk = *disk;
        file->end_of_file = static_cast<haddr_t>(status.st_size);
        return &file->head;
    };
    driver.close = [](H5FD_t* file) {
        delete &of(file);
        return 0;
    };
    driver.query = [](const H5FD_t*, unsigned long* flags) {
        if (flags)
            *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA |
                     H5FD_FEAT_DATA_SIEVE | H5FD_FEAT_AGGREGATE_SMALLDATA;
        return 0;
    };
    driver.get_eoa = [](const H5FD_t* file, H5FD_mem_t) { return of(file).end_of_allocation; };
    driver.set_eoa = [](H5FD_t* file, H5FD_mem_t, haddr_t end) {
        of(file).end_of_allocation = end;
        return 0;
    };
    driver.get_eof = [](const H5FD_t* file, H5FD_mem_t) { return of(file).end_of_file; };
    driver.read = [](H5FD_t* file, H5FD_mem_t, hid_t, haddr_t at, std::size_t size, void* to) {
        return of(file).disk->read(at, {static_cast<std::byte*>(to), size}) ? 0 : -1;
    };
    driver.write = [](H5FD_t* file, H5FD_mem_t, hid_t, haddr_t at, std::size_t size,
                      const void* from) {
        of(file).disk->write(at, {static_cast<const std::byte*>(from), size});
        of(file).end_of_file = std::max(of(file).end_of_file, at + static_cast<haddr_t>(size));
        return 0;
    };
    driver.truncate = [](H5FD_t* file, hid_t, hbool_t) { // the file ends where the data end
        OpenFile& f = of(file);
        if (f.end_of_allocation == f.end_of_file) return 0;
        f.end_of_file = f.end_of_allocation;
        Hdf5Disk& disk = *f.disk;
        if (disk.error == 0 && ::ftruncate(disk.fd, static_cast<off_t>(f.end_of_file)) != 0)
            disk.error = errno;
        return 0;
    };
    return driver;
}

} // namespace

std::int64_t hdf5_access(Hdf5Disk& disk) {
    static const H5FD_class_t driver = make_driver();
    static const hid_t id = H5FDregister(&driver);
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    Hdf5Disk* where = &disk;
    return H5Pset_driver(access, id, &where) < 0 ? H5I_INVALID_HID : access;
}

} // namespace asperity::io
