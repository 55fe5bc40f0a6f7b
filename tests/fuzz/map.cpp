// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/height_map.hpp"
#include "target.hpp"

#include <cmath>

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace asperity;
    if (size < 1) return 0;
    const int flags = data[0];
    const std::string_view bytes(reinterpret_cast<const char*>(data + 1), size - 1);
    fuzz::try_out([&] {
        const fuzz::MemoryFile file(bytes);
        const io::HeightMap map = io::read_height_map(
            file.name(), {flags & 1 ? "nm" : "auto", (flags & 2) != 0, (flags & 4) != 0});
        // What is not refused is a map: square, whole, finite.
        const std::size_t n = map.rows;
        if (n < 1 || map.columns != n || map.heights.size() != n * n) std::abort();
        for (const double h : map.heights)
            if (!std::isfinite(h)) std::abort();
        if (map.width && !(*map.width > 0.0 && std::isfinite(*map.width))) std::abort();
    });
    return 0;
}
