// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/digest.hpp"

#include <array>
#include <bit>
#include <cstring>

namespace asperity::io {

namespace {

static_assert(std::endian::native == std::endian::little);

using Table = std::array<std::uint32_t, 256>;

/// tables[k][b]: what a byte b does to the state k bytes later. Eight bytes are taken in one step
/// (M. E. Kounavis and F. L. Berry, Proc. IEEE ISCC 2005, p. 855).
constexpr std::array<Table, 8> make_tables() {
    std::array<Table, 8> tables{};
    for (std::uint32_t b = 0; b < 256; ++b) {
        std::uint32_t state = b;
        for (int bit = 0; bit < 8; ++bit)
            state = (state >> 1) ^ (state & 1u ? 0xedb88320u : 0u);
        tables[0][b] = state;
    }
    for (std::size_t k = 1; k < 8; ++k)
        for (std::size_t b = 0; b < 256; ++b)
            tables[k][b] = (tables[k - 1][b] >> 8) ^ tables[0][tables[k - 1][b] & 255u];
    return tables;
}
constexpr std::array<Table, 8> tables = make_tables();

} // namespace

void Digest::update(std::span<const std::byte> bytes) {
    std::uint32_t state = state_;
    for (; bytes.size() >= 8; bytes = bytes.subspan(8)) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes.data(), 8);
        word ^= state;
        state = 0;
        for (std::size_t i = 0; i < 8; ++i)
            state ^= tables[7 - i][(word >> (8 * i)) & 255u];
    }
    for (const std::byte byte : bytes)
        state = (state >> 8) ^ tables[0][(state ^ static_cast<std::uint32_t>(byte)) & 255u];
    state_ = state;
}

} // namespace asperity::io
