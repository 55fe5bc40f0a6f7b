// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/map_formats.hpp"
#include "target.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace asperity;
    const fuzz::MemoryFile file(std::string_view(reinterpret_cast<const char*>(data), size));
    fuzz::try_out([&] { io::read_map_hdf5_here(file.name(), ""); });
    return 0;
}
