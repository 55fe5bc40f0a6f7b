// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/atoms_file.hpp"
#include "target.hpp"

#include <cmath>

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace asperity;
    if (size < 1) return 0;
    const std::string_view bytes(reinterpret_cast<const char*>(data + 1), size - 1);
    fuzz::try_out([&] {
        const io::AtomsFile atoms =
            io::read_atoms_text(bytes, data[0] & 1 ? "fuzz.xyz" : "fuzz.data");
        // What is not refused is a substrate: finite, whole, inside of its box.
        const std::size_t count = atoms.x.size();
        if (count < 1 || atoms.y.size() != count || atoms.z.size() != count ||
            atoms.type.size() != count)
            std::abort();
        if (!(atoms.width_x > 0.0) || !(atoms.width_y > 0.0)) std::abort();
        for (std::size_t i = 0; i < count; ++i)
            if (!(atoms.x[i] >= 0.0 && atoms.x[i] < atoms.width_x && atoms.y[i] >= 0.0 &&
                  atoms.y[i] < atoms.width_y && std::isfinite(atoms.z[i]) &&
                  static_cast<std::size_t>(atoms.type[i]) < atoms.types.size()))
                std::abort();
    });
    return 0;
}
