// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// How the HDF5 library reaches the disk: a file driver on a descriptor of ours.
//
// The library does not survive a failed write: what it could not write stays in its caches, and its
// exit handler crashes on it. So it never sees one. The driver remembers the first error, keeps in
// memory what comes after it, and reports success; Hdf5File looks at the error and throws. The
// driver knows no locks: who may write a file is decided elsewhere (result_directory.hpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace asperity::io {

struct Hdf5Disk {
    int fd = -1;
    int error = 0; ///< errno of the first write that failed
    std::vector<std::pair<std::uint64_t, std::vector<std::byte>>> kept; ///< writes after it

    bool read(std::uint64_t offset, std::span<std::byte> bytes);
    void write(std::uint64_t offset, std::span<const std::byte> bytes);
};

/// Properties (an HDF5 file access list) with which a file is opened or created on this disk, which
/// must outlive the file. The caller closes the list.
std::int64_t hdf5_access(Hdf5Disk& disk);

} // namespace asperity::io
