// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/digest.hpp"

#include <zlib.h>

namespace asperity::io {

void Digest::update(std::span<const std::byte> bytes) {
    if (bytes.empty()) return; // a null pointer would start zlib's sum anew
    value_ = static_cast<std::uint32_t>(
        ::crc32_z(value_, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

} // namespace asperity::io
