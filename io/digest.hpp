// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A 64-bit digest of a stream of bytes, by which damage to a file is noticed.
//
// Eight lanes of 64 bits take the words of the stream in turn: h <- rotate((h xor w) m, 29) with an
// odd constant m. Each step is a bijection of h for a given w, and of w for a given h, and so is
// the end that joins the lanes and the length: a change confined to one word is always noticed, any
// other with a probability of 1 - 2^-64. It is no protection against intent.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace asperity::io {

class Digest {
public:
    Digest();
    void update(std::span<const std::byte> bytes);
    /// Of everything so far; more may follow.
    std::uint64_t value() const;

private:
    static constexpr std::size_t lanes = 8, block = 8 * lanes;
    void take(const std::byte* from);

    std::array<std::uint64_t, lanes> state_;
    std::array<std::byte, block> rest_{}; ///< an unfinished block
    std::uint64_t length_ = 0;
};

} // namespace asperity::io
