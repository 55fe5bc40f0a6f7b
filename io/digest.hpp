// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The digest of a stream of bytes, by which damage to a file is noticed: the CRC-32 of zlib, so
// that other programs can check it too; Python has it as zlib.crc32. A change within 32
// neighbouring bits is always noticed, any other with a probability of 1 - 2^-32. It is no
// protection against intent.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace asperity::io {

class Digest {
public:
    void update(std::span<const std::byte> bytes);
    /// Of everything so far; more may follow.
    std::uint32_t value() const { return value_; }

private:
    std::uint32_t value_ = 0;
};

} // namespace asperity::io
